'use strict';

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
  return {states, drops, boxes};
}

function shearPanel(placement, index, place, {x, y}) {
  const {colour} = placement;
  const tooltip = {replicate: 'name', '$γ$': 'strain', '$s/p$': 'stress'};
  const [states, drops, boxes] = ['states', 'drops', 'boxes'].map((name) => `${name}_${index}`);
  return panel({...place, title: placement.title(index), x, y,
    data: ['states', 'drops', 'boxes'].map((name) => rowsOf(name, index)),
    marks: [
      lines(states, 'strain', 'stress', {by: 'name', colour, width: 1.2, opacity: placement.together ? 0.5 : 0.8}),
      points(states, 'strain', 'stress', {colour, shape: placement.shape, size: placement.together ? 20 : 10,
        opacity: 0.8, hollow: 'datum.excluded', tooltip}),
      points(drops, 'strain', 'stress', {colour, shape: 'triangle-down', size: 40, opacity: 0.9, tooltip}),
      ...uprightBoxes(boxes, 'strain', {colour, width: placement.together ? 5 : 8,
        tooltip: {'': 'group', '$γ$': 'strain', ...boxTooltip}}),
    ]});
}

function shearFigure(data, choices) {
  const title = 'Shear', id = 'shear';
  const sheared = ({shear}) => shear.some(({strain, stress}) => isNumber(strain) && isNumber(stress));
  const rows = data.replicates.filter(sheared).map(({row}) => row);
  if (rows.length === 0)
    return {id, title, absent: 'no shear was measured; add "shear" to "measure" in the manifest.'};
  const placement = placementOf(data, rows, choices);
  const datasets = shearData(data, placement, rows);
  const {states, boxes} = datasets;
  const counted = deciding(states, choices, boxes), deciders = deciding(boxes, choices, states);
  const x = {title: 'strain $γ$', domain: domainOf([...counted, ...deciders].map((row) => row.strain)), ticks: 4};
  const y = {title: 'shear stress over pressure',
    domain: domainOf([...counted.map((row) => row.stress), ...deciders.flatMap(({low, high}) => [low, high])])};
  return {
    id, title, datasets,
    note: 'Shear stress over pressure against strain, for the packing nearest jamming of every replicate. Triangles ' +
      'mark the states after a rearrangement. A packing that was jammed in a cubic cell has shear stress at zero ' +
      `strain.${boxText(boxes, 'at common strains')}` +
      outsideText(states, [['strain', x.domain], ['stress', y.domain]], boxes),
    spec: (width) => placedSpec(placement, {description: 'Shear stress over pressure against strain.', width, datasets,
      panelAt: (index, place) => shearPanel(placement, index, place, {x, y})}),
  };
}
