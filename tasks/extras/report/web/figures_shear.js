'use strict';

const strokeDashes = {loading: [], unloading: [5, 3]};
const isShorn = ({strain, stress}) => isNumber(strain) && isNumber(stress);

/// The states of each replicate as two lines: loading, and unloading from the last state of loading on.
function strokesOf(states, data) {
  const strokes = [];
  for (const name of unique(states.map((state) => state.name))) {
    const {row, name: tag, ...more} = states.find((state) => state.name === name);
    const all = data.replicates.find((replicate) => replicate.name === name).shear.filter(isShorn);
    const turn = all.findIndex(({unloading}) => unloading);
    const parts = turn < 0 ? [['loading', all]] : [['loading', all.slice(0, turn)], ['unloading', all.slice(turn - 1)]];
    for (const [stroke, part] of parts)
      for (const {strain, stress} of part) strokes.push({...more, row, name, stroke, line: `${name} ${stroke}`, strain, stress});
  }
  return strokes;
}

/// Arrows in the middle of each line that point along it. `position` gives pixels of a strain and of a stress.
function arrowsOf(strokes, position) {
  return unique(strokes.map(({line}) => line)).flatMap((line) => {
    const along = strokes.filter((state) => state.line === line);
    if (along.length < 2) return [];
    const at = Math.max(1, Math.floor(along.length / 2)), [from, to] = [along[at - 1], along[at]].map(position);
    const angle = Math.atan2(to[0] - from[0], from[1] - to[1]) * 180 / Math.PI;
    return [{...along[at], angle}];
  });
}

const jumpText = ' If the stress is prescribed, the strain follows from it. It can jump back in the first step, which ' +
  'replaces the stress of the cubic cell, and in a rearrangement.';

/// True if the strain of some replicate decreases while the load increases.
const jumpsBack = (strokes) => strokes.some((state, k) => k > 0 && state.stroke === 'loading' &&
  state.line === strokes[k - 1].line && state.strain < strokes[k - 1].strain);

/// States of every replicate under load, and those that a drop led to.
function shearData(data, {tag, together}, rows) {
  const curveOf = ({shear}) => shear.filter(({strain, stress}) => isNumber(strain) && isNumber(stress))
    .map(({strain, stress}) => [strain, stress]);
  const {points: states, boxes} = pointsOrBoxes(data, {curveOf, tag, names: ['strain', 'stress']});
  const drops = [], shown = unique(rows).sort((a, b) => a - b), step = Math.min(6, 48 / shown.length);
  // All solids have the same strains.
  const aside = (label) => (shown.findIndex((row) => data.rows[row].label === label) - (shown.length - 1) / 2) * step;
  for (const box of together ? boxes : []) box.dodge = aside(box.group);
  for (const {name, row, excluded, shear} of data.replicates) {
    if (!states.some((state) => state.name === name)) continue;
    for (const {strain, stress, dropped} of shear)
      if (dropped && isNumber(strain) && isNumber(stress)) drops.push({...tag(row), name, excluded, strain, stress});
  }
  return {states, strokes: strokesOf(states, data), drops, boxes};
}

/// Pixels of a state in its panel.
function pixelsOf(x, y, width, placement) {
  const across = panelGrid(width, placement.count, placement.grid).width;
  const [right, up] = [positionAlong(x, across), positionAlong(y, placement.height)];
  return ({strain, stress}) => [right(strain), -up(stress)];
}

function shearPanel(placement, index, place, {x, y}) {
  const {colour} = placement;
  const tooltip = {replicate: 'name', '$γ$': 'strain', '$s/p$': 'stress'};
  const names = ['states', 'strokes', 'arrows', 'drops', 'boxes'];
  const [states, strokes, arrows, drops, boxes] = names.map((name) => `${name}_${index}`);
  const curves = lines(strokes, 'strain', 'stress', {by: 'line', colour, width: 1.2, opacity: 0.45});
  curves.marks[0].encode.enter.strokeDash = {scale: 'stroke', field: 'stroke'};
  const heads = points(arrows, 'strain', 'stress', {colour, shape: 'M0,-1L0.7,0.8L0,0.4L-0.7,0.8Z', size: 60, tooltip});
  heads.encode.enter.angle = {field: 'angle'};
  return panel({...place, title: placement.title(index), x, y,
    data: names.map((name) => rowsOf(name, index)),
    marks: [
      curves,
      points(states, 'strain', 'stress', {colour, shape: placement.shape, size: placement.together ? 16 : 8,
        opacity: 0.35, hollow: 'datum.excluded', tooltip}),
      heads,
      points(drops, 'strain', 'stress', {colour, size: 90, hollow: 'true', tooltip}),
      ...uprightBoxes(boxes, 'strain', {colour, width: placement.together ? 5 : 8,
        tooltip: {'': 'group', '$γ$': 'strain', ...boxTooltip}}),
    ]});
}

function shearFigure(data, choices) {
  const title = 'Shear', id = 'shear';
  const sheared = ({shear}) => shear.some(({strain, stress}) => isNumber(strain) && isNumber(stress));
  const rows = data.replicates.filter(sheared).map(({row}) => row);
  if (rows.length === 0)
    return {id, title, absent: 'no shear was measured; run "isojam measure DIR --add shear".'};
  const placement = placementOf(data, rows, choices);
  const datasets = shearData(data, placement, rows);
  const {states, strokes, boxes} = datasets, kinds = unique(strokes.map(({stroke}) => stroke));
  const counted = deciding(states, choices, boxes), deciders = deciding(boxes, choices, states);
  const x = {title: 'strain $γ$', domain: domainOf([...counted, ...deciders].map((row) => row.strain)), ticks: 4};
  const y = {title: 'shear stress over pressure',
    domain: domainOf([...counted.map((row) => row.stress), ...deciders.flatMap(({low, high}) => [low, high])])};
  return {
    id, title, datasets,
    note: 'Shear stress over pressure against strain, for the packing nearest jamming of every replicate. Arrows show ' +
      'the order of the states. Rings mark the states after a rearrangement. A packing that was jammed in a cubic ' +
      `cell has shear stress at zero strain.${jumpsBack(strokes) ? jumpText : ''}` +
      boxText(boxes, 'at common strains') +
      outsideText(states, [['strain', x.domain], ['stress', y.domain]], boxes),
    spec: (width) => placedSpec(placement, {description: 'Shear stress over pressure against strain.', width,
      datasets: {...datasets, arrows: arrowsOf(strokes, pixelsOf(x, y, width, placement))},
      scales: [{name: 'stroke', type: 'ordinal', domain: kinds, range: kinds.map((kind) => strokeDashes[kind])}],
      legends: kinds.length > 1 ? [{strokeDash: 'stroke', symbolType: 'stroke', symbolSize: 1600, symbolStrokeWidth: 1.6,
        symbolStrokeColor: ink, longSymbol: true}] : [],
      panelAt: (index, place) => shearPanel(placement, index, place, {x, y})}),
  };
}
