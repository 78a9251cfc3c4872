'use strict';

const endKeys = {omega_l: 'lowest', omega_h: 'highest'};

/// Power laws of the tables' rows, and what their slopes are.
function scalingFits(data, tag) {
  const fits = [], slopes = [];
  data.rows.forEach(({scaling}, row) => {
    for (const key of Object.keys(endKeys)) {
      const law = scaling[key];
      if (!law || !(law.to > law.from)) continue;
      const at = (distance) => law.prefactor * distance ** law.exponent;
      for (const delta_phi of [law.from, law.to])
        fits.push({...tag(row), series: key, delta_phi, value: at(delta_phi)});
      const half = law.ci95_half_width === null ? '' : ` ± ${law.ci95_half_width.toFixed(2)}`;
      slopes.push({...tag(row), series: key, exponent: law.exponent, ci95_half_width: law.ci95_half_width,
        delta_phi: law.to, value: at(law.to), text: `slope ${law.exponent.toFixed(2)}${half}`.replace('-', '−')});
    }
  });
  return {fits, slopes};
}

/// Below the end of the line, where points that rise leave room, and inside of the panel.
const slopeLabels = (from) => ({
  type: 'text', from: {data: from},
  encode: {enter: {
    x: {signal: "max(0, min(scale('x', datum.delta_phi) + 10, width - 6.2 * length(datum.text)))"},
    y: {scale: 'y', field: 'value', offset: 24},
    text: {field: 'text'}, fontSize: {value: 11}, fill: {value: ink},
  }},
});

function scalingPanel(placement, index, place, {x, y}) {
  const {colour} = placement, shape = {scale: 'end', field: 'series'};
  return panel({...place, title: placement.title(index), x, y,
    data: ['states', 'boxes', 'fits', 'slopes'].map((name) => rowsOf(name, index)),
    marks: [
      points(`states_${index}`, 'delta_phi', 'value', {colour, shape, size: 22, opacity: 0.75, hollow: 'datum.excluded',
        tooltip: {replicate: 'name', modes: 'series', '$Δφ$': 'delta_phi', '$⟨ω⟩$': 'value'}}),
      ...uprightBoxes(`boxes_${index}`, 'delta_phi', {colour,
        tooltip: {modes: 'series', '$Δφ$': 'delta_phi', ...boxTooltip}}),
      lines(`fits_${index}`, 'delta_phi', 'value', {by: 'series', colour: {value: ink}, width: 1.4, style: 'ink'}),
      slopeLabels(`slopes_${index}`),
    ]});
}

const scalingText = 'Mean frequency of the lowest ($⟨ω_l⟩$) and of the highest modes ($⟨ω_h⟩$) against the ' +
  'distance to jamming';

function scalingTogether(data, rows, {id, title, keys, above}) {
  const made = meansTogether(data, rows, {keys, titles: [''], yType: 'log', above, yTitle: '$⟨ω_l⟩$, $⟨ω_h⟩$'});
  return {
    id, title, datasets: made.datasets,
    note: `${scalingText}: medians and quartiles over ${countedText(data)} at common distances, slightly displaced; ` +
      'open symbols without a line are single replicates. The upper curves are the highest modes. Compare ' +
      'Figure 1(b) of the paper.',
    spec: (width) => made.spec(width, 'Mean frequencies of the softest and stiffest modes of all solids, both axes ' +
      'logarithmic.'),
  };
}

function scalingFigure(data, choices) {
  const title = 'Softest and stiffest modes against distance to jamming', id = 'scaling';
  const keys = Object.keys(endKeys), above = 0, rows = rowsWith(data, keys, above);
  if (rows.length === 0) return modesAbsent(id, title);
  if (choices.together) return scalingTogether(data, rows, {id, title, keys, above});
  const placement = placementOf(data, rows, choices);
  const {points: states, boxes} = stateEntries(data, keys, {tag: placement.tag, above, yType: 'log'});
  const datasets = {states, boxes, ...scalingFits(data, placement.tag)};
  const counted = deciding(states, choices, boxes), deciders = deciding(boxes, choices, states);
  const x = {type: 'log', title: '$Δφ$',
    domain: domainOf([...counted, ...deciders].map((row) => row.delta_phi), {type: 'log'})};
  const y = {type: 'log', title: '$⟨ω⟩$', domain: domainOf([...counted.map((row) => row.value),
    ...deciders.flatMap(({low, high}) => [low, high])], {type: 'log', margin: 0.09})};
  return {
    id, title, datasets,
    note: `${scalingText}, for every state of every replicate. Lines: power laws fitted to the states of ` +
      `${countedText(data)} with $Δφ$ ≤ 0.02. Compare Figure 1(b) of the paper.${boxText(boxes, 'at common $Δφ$')}` +
      outsideText(states, [['delta_phi', x.domain], ['value', y.domain]], boxes),
    spec: (width) => placedSpec(placement, {
      description: 'Mean frequencies of the softest and stiffest modes, both axes logarithmic.', width, datasets,
      height: 220,
      scales: [{name: 'end', type: 'ordinal', domain: ['omega_h', 'omega_l'], range: ['triangle-up', 'circle']}],
      legends: [{shape: 'end', symbolStrokeColor: ink,
        texts: {omega_h: 'highest modes, $⟨ω_h⟩$', omega_l: 'lowest modes, $⟨ω_l⟩$'}}],
      panelAt: (index, place) => scalingPanel(placement, index, place, {x, y})}),
  };
}
