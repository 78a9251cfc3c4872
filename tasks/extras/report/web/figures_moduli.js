'use strict';

const modulusSeries = {
  K: {colour: hues.blue, label: 'bulk modulus $K$', shape: 'circle'},
  G: {colour: hues.vermilion, label: 'mean shear modulus $G$', shape: 'triangle-up'},
};

function moduliPanel(placement, index, place, {x, y}) {
  const colour = {scale: 'series', field: 'series'}, shape = {scale: 'seriesShape', field: 'series'};
  return panel({...place, title: placement.title(index), x, y,
    data: [rowsOf('states', index), rowsOf('boxes', index), rowsOf('medians', index)],
    marks: [
      points(`states_${index}`, 'delta_phi', 'value', {colour, shape, size: 18, opacity: 0.6, hollow: 'datum.excluded',
        tooltip: {replicate: 'name', '': 'series', '$Δφ$': 'delta_phi', value: 'value'}}),
      ...uprightBoxes(`boxes_${index}`, 'delta_phi', {colour,
        tooltip: {'': 'series', '$Δφ$': 'delta_phi', ...boxTooltip}}),
      lines(`medians_${index}`, 'delta_phi', 'value', {by: 'series', colour, width: 1.2, defined: 'datum.n > 1'}),
    ]});
}

const moduliText = 'Moduli include the relaxation of particles, in units of $Y$. Only positive moduli are shown.';

function moduliFigure(data, choices) {
  const title = 'Elastic moduli against distance to jamming', id = 'moduli', above = 0;
  const keys = Object.keys(modulusSeries);
  const rows = rowsWith(data, keys, above);
  if (rows.length === 0)
    return {id, title, absent: 'no moduli were measured; run "isojam measure DIR --add moduli".'};
  if (choices.together) return moduliTogether(data, rows, {id, title, keys, above});
  const placement = placementOf(data, rows, choices);
  const {points: states, boxes} = stateEntries(data, keys, {tag: placement.tag, above, yType: 'log'});
  const medians = medianEntries(data, keys, {tag: placement.tag, above}).filter(({row}) => row >= 0);
  const counted = deciding(states, choices, boxes), deciders = deciding(boxes, choices, states);
  const x = {type: 'log', title: '$Δφ$',
    domain: domainOf([...counted, ...deciders].map((row) => row.delta_phi), {type: 'log'})};
  const y = {type: 'log', title: 'modulus', domain: domainOf([...counted.map((row) => row.value),
    ...deciders.flatMap(({low, high}) => [low, high])], {type: 'log'})};
  const series = Object.values(modulusSeries);
  return {
    id, title, datasets: {states, boxes, medians},
    note: `Bulk modulus and mean shear modulus of every state; lines join medians over ${countedText(data)}. ` +
      moduliText + boxText(boxes, 'at common $Δφ$') +
      outsideText(states, [['delta_phi', x.domain], ['value', y.domain]], boxes),
    spec: (width) => placedSpec(placement, {
      description: 'Bulk and shear modulus against distance to jamming.', width,
      datasets: {states, boxes, medians}, height: 220,
      scales: [
        {name: 'series', type: 'ordinal', domain: keys, range: series.map(({colour}) => colour)},
        {name: 'seriesShape', type: 'ordinal', domain: keys, range: series.map(({shape}) => shape)},
      ],
      legends: [{fill: 'series', stroke: 'series', shape: 'seriesShape', texts: labelsOf(modulusSeries)}],
      panelAt: (index, place) => moduliPanel(placement, index, place, {x, y})}),
  };
}

function moduliTogether(data, rows, {id, title, keys, above}) {
  const made = meansTogether(data, rows, {keys, titles: keys.map((key) => modulusSeries[key].label), yType: 'log',
    above, yTitle: 'modulus'});
  return {
    id, title, datasets: made.datasets,
    note: `Medians and quartiles over ${countedText(data)}, interpolated at common distances above jamming and ` +
      `slightly displaced; open symbols without a line are single replicates. ${moduliText}`,
    spec: (width) => made.spec(width, 'Bulk and shear moduli of all solids against distance to jamming.'),
  };
}
