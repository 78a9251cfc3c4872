'use strict';

// Where sweep points are drawn, and what tells them apart: a panel for each, or all in one chart as in the paper's
// figures, solids by colour, N and swept parameters by symbol.

const variantShapes = ['circle', 'diamond', 'triangle-down', 'square', 'triangle-up', 'triangle-right',
  'triangle-left', 'cross'];
const variantDashes = [[], [7, 3], [2, 2], [7, 3, 2, 3], [12, 3], [4, 4], [1, 3], [12, 3, 2, 3]];

/// What a sweep point is called beside its solid: "N = 100" and swept parameters.
const variantOf = ({label, solid}) => label.slice(solid.length + 2);

const unique = (values) => [...new Set(values)];

const solidColour = {scale: 'solid', field: 'solid'};
const ordinalScale = (name, values) => (
  {name, type: 'ordinal', domain: Object.keys(values), range: Object.values(values)});
const solidScale = () => ordinalScale('solid', solidColours);
const shapeScale = () => ordinalScale('shape', solidShapes);

/// A panel for each sweep point of `present` (indices).
function inPanels(data, present) {
  const place = new Map(present.map((row, index) => [row, index]));
  return {
    together: false, count: present.length, title: (index) => data.rows[present[index]].label,
    tag: (row) => ({row: place.get(row) ?? -1, solid: data.rows[row].solid, group: data.rows[row].label, dodge: 0}),
    rowsAt: (index) => [present[index]],
    colour: solidColour, shape: {scale: 'shape', field: 'solid'}, scales: [solidScale(), shapeScale()], legends: [],
    height: 200, grid: {widest: 640},
  };
}

/// All sweep points in each of `charts`, which are named by their titles.
function inOne(data, present, charts) {
  const variants = unique(present.map((row) => variantOf(data.rows[row])));
  const solids = unique(present.map((row) => data.rows[row].solid));
  const colours = Object.fromEntries(solids.map((solid) => [solid, solidColours[solid]]));
  const shapes = variants.map((_, k) => variantShapes[k % variantShapes.length]);
  const step = Math.min(5, 16 / variants.length);
  const dodge = (variant) => (variants.indexOf(variant) - (variants.length - 1) / 2) * step;
  return {
    together: true, count: charts.length, title: (index) => charts[index],
    tag(row, chart = 0) {
      const variant = variantOf(data.rows[row]);
      return {row: chart, solid: data.rows[row].solid, variant, group: data.rows[row].label, dodge: dodge(variant)};
    },
    rowsAt: () => present,
    colour: solidColour, shape: {scale: 'variant', field: 'variant'},
    dash: (group) => variantDashes[variants.indexOf(variantOf(data.rows.find(({label}) => label === group))) %
      variantDashes.length],
    scales: [ordinalScale('solid', colours), {name: 'variant', type: 'ordinal', domain: variants, range: shapes}],
    legends: [{fill: 'solid', stroke: 'solid', symbolType: 'circle'},
      {shape: 'variant', symbolStrokeColor: ink, symbolFillColor: 'transparent'}],
    height: charts.length > 1 ? 300 : 380, grid: {least: 250, most: 3, widest: charts.length > 1 ? 400 : 720, gap: 76},
  };
}

/// The placement of the sweep points `rows` (indices, repeated as may be).
function placementOf(data, rows, {together}, charts = ['']) {
  const present = unique(rows).sort((a, b) => a - b);
  return together ? inOne(data, present, charts) : inPanels(data, present);
}

/// A specification with this placement.
const placedSpec = (placement, options) => panelSpec({...options, count: placement.count,
  height: placement.together ? placement.height : options.height ?? placement.height,
  grid: placement.grid, scales: [...placement.scales, ...options.scales ?? []],
  legends: [...placement.legends, ...options.legends ?? []]});
