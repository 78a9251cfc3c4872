'use strict';

/// Farther from jamming the sixth root bends.
const extrapolationReach = 0.07;

const rootCurve = ({states}) => states
  .filter(({root, delta_phi}) => root !== null && delta_phi < extrapolationReach)
  .map(({density, root}) => [root, density]);

function extrapolationData(data, tag) {
  // Heights are what replicates have in common: densities at a height are those of one distance from jamming.
  const {points, boxes} = pointsOrBoxes(data, {curveOf: rootCurve, tag, names: ['root', 'density'], least: 0.5});
  const extrapolation = [], drawn = new Set(points.map(({name}) => name));
  for (const {name, row, line, excluded} of data.replicates) {
    if (!line || !drawn.has(name)) continue;
    const ends = [line.from, line.to].map(([density, root]) => ({...tag(row), name, excluded, density, root}));
    extrapolation.push(...ends);
  }
  const atZero = groupsOf(data).flatMap(({row, excluded, members}) => {
    if (!boxes.some((box) => box.group === data.rows[row].label && box.excluded === excluded)) return [];
    const values = members.map((replicate) => replicate.phi_j).filter(isNumber);
    return values.length > 1 ? [{...tag(row), excluded, root: 0, ...boxOf(values)}] : [];
  });
  const medians = [...atZero, ...boxes]
    .map((box) => ({...box, density: box.median, line: `${box.group} ${box.excluded}`}));
  return {states: points, extrapolation, boxes: medians};
}

function extrapolationPanel(placement, index, place, {x, y}) {
  const {colour, together} = placement;
  const dashed = lines(`extrapolation_${index}`, 'density', 'root', {by: 'name',
    colour: together ? colour : {value: ink}, dash: [4, 3], width: 1, opacity: together ? 0.6 : 1, ...(together ? {} : {style: 'ink'})});
  return panel({...place, showX: true, title: placement.title(index), x, y,
    data: ['states', 'extrapolation', 'boxes'].map((name) => rowsOf(name, index)),
    marks: [
      dashed,
      points(`states_${index}`, 'density', 'root', {colour, size: 18, opacity: 0.8, shape: placement.shape,
        hollow: 'datum.excluded',
        tooltip: {replicate: 'name', '$φ$': 'density', '$Δφ$': 'delta_phi', '$(E/N)^{1/6}$': 'root'}}),
      lines(`boxes_${index}`, 'density', 'root', {by: 'line', colour, width: 1}),
      ...lyingBoxes(`boxes_${index}`, 'root', {colour, tooltip: {'': 'group', '$(E/N)^{1/6}$': 'root', ...boxTooltip}}),
      ...(together ? [points(`boxes_${index}`, 'density', 'root', {colour, shape: placement.shape, size: 26,
        tooltip: {'': 'group', '$(E/N)^{1/6}$': 'root', ...boxTooltip}})] : []),
    ]});
}

function extrapolationFigure(data, choices) {
  const title = 'Extrapolation to jamming', id = 'extrapolation';
  const rows = data.replicates.filter((replicate) => rootCurve(replicate).length > 0).map(({row}) => row);
  if (rows.length === 0) return {id, title, absent: 'no replicate has an equilibrium above jamming.'};
  const placement = placementOf(data, rows, choices);
  const datasets = extrapolationData(data, placement.tag), {states, extrapolation, boxes} = datasets;
  const every = [...deciding(states, choices, boxes), ...deciding(extrapolation, choices, boxes),
    ...deciding(boxes, choices, states)];
  const y = {domain: [0, domainOf(every.map((row) => row.root))[1]], title: '$(E/N)^{1/6}$', ticks: 4};
  // Every solid jams at a density of its own.
  const xOf = (index) => {
    const inside = (list) => list.filter(({row}) => row === index), others = [...inside(states), ...inside(boxes)];
    const own = (list) => deciding(inside(list), choices, others);
    const domain = domainOf([...[...own(states), ...own(extrapolation)].map(({density}) => density),
      ...own(boxes).flatMap(({low, high}) => [low, high])]);
    return {domain, title: 'density $φ$', ticks: 4};
  };
  const axes = Array.from({length: placement.count}, (_, index) => xOf(index));
  const outside = states.filter(({row, density}) => density < axes[row].domain[0] || density > axes[row].domain[1])
    .map((state) => ({...state, density: Infinity}));
  return {
    id, title, datasets,
    note: 'The energy grows as $Δφ^6$, so its sixth root is linear in $φ$. $φ_J$ is the zero of the line through the ' +
      'states nearest jamming (dashed, one for each replicate). Hollow symbols are excluded from means.' +
      boxText(boxes, 'at common energies; at zero they show $φ_J$') +
      outsideText(outside, [['density', [0, 1]]], boxes, ({row}) => axes[row].domain),
    spec: (width) => placedSpec(placement, {description: 'Sixth root of the energy per particle against density.',
      width, datasets, panelAt: (index, place) => extrapolationPanel(placement, index, place, {x: axes[index], y})}),
  };
}
