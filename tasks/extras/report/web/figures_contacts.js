'use strict';

const contactSeries = {
  C: {colour: hues.vermilion, label: 'constraints $C$', shape: 'circle'},
  Z: {colour: hues.blue, label: 'contacts $Z$', shape: 'square'},
  Z_ff: {colour: hues.green, label: 'face-face contacts $Z_{ff}$', shape: 'diamond'},
};

const labelsOf = (series) => Object.fromEntries(Object.entries(series).map(([key, {label}]) => [key, label]));

/// Curves of the quantity `key` of a state above jamming, positive where `above` is given.
const stateCurve = (key, above = -Infinity) => ({states}) => states
  .filter((state) => state.delta_phi > 0 && isNumber(state[key]) && state[key] > above)
  .map((state) => [state.delta_phi, state[key]]);

/// Points or boxes of several quantities of states against Δφ.
function stateEntries(data, keys, {tag, above, yType}) {
  const all = {points: [], boxes: []};
  for (const key of keys) {
    const found = pointsOrBoxes(data, {curveOf: stateCurve(key, above), type: 'log', yType,
      tag: (row) => ({...tag(row), series: key}), names: ['delta_phi', 'value']});
    all.points.push(...found.points);
    all.boxes.push(...found.boxes);
  }
  return all;
}

/// Means of the tables at common Δφ; `tag(row, place of the key)`.
function meanEntries(data, keys, {tag}) {
  const means = [];
  data.rows.forEach(({series}, row) => keys.forEach((key, place) => {
    const along = series.filter((point) => isNumber(point[key]?.mean))
      .map((point) => ({...point[key], delta_phi: point.delta_phi}));
    for (const {mean, ci95, n, delta_phi} of along.length > 0 ? along : nearestEntry(data, row, key)) {
      const [low, high] = ci95 ?? [mean, mean];
      means.push({...tag(row, place), series: key, delta_phi, value: mean, low, high, n});
    }
  }));
  return means;
}

/// Mean nearest jamming, for sweep points that have none at a common Δφ.
function nearestEntry(data, row, key) {
  const estimate = data.rows[row][key];
  const nearest = data.replicates.filter((replicate) => replicate.row === row && !replicate.excluded)
    .map((replicate) => Math.min(...stateCurve(key)(replicate).map(([distance]) => distance))).filter(Number.isFinite);
  if (!isNumber(estimate?.mean) || nearest.length === 0) return [];
  return [{...estimate, delta_phi: nearest.reduce((a, b) => a + b) / nearest.length}];
}

/// Medians and quartiles at common Δφ, or nearest jamming where there is none: of quantities that grow as powers, which
/// are interpolated in logarithms.
function medianEntries(data, keys, {tag, above}) {
  const entries = [];
  data.rows.forEach((_, row) => keys.forEach((key, place) => {
    const curves = data.replicates.filter((replicate) => replicate.row === row && !replicate.excluded)
      .map(stateCurve(key, above)).filter((curve) => curve.length > 0);
    const along = boxesOver(curves, seriesDistances, {type: 'log', yType: 'log', least: 0});
    const nearest = curves.map((curve) => curve.reduce((a, b) => (a[0] < b[0] ? a : b)));
    const ends = curves.length === 0 ? [] : [{...boxOf(nearest.map(([, value]) => value)),
      at: boxOf(nearest.map(([distance]) => distance)).median}];
    for (const {at, median, q1, q3, n} of along.length > 0 ? along : ends)
      entries.push({...tag(row, place), series: key, delta_phi: at, value: median, low: q1, high: q3, n});
  }));
  return entries;
}

/// Rows of `data` of which some replicate has a state with one of these quantities.
const rowsWith = (data, keys, above) => data.replicates
  .filter((replicate) => keys.some((key) => stateCurve(key, above)(replicate).length > 0)).map(({row}) => row);

const meanTooltip = {'': 'group', '$Δφ$': 'delta_phi', value: 'value', from: 'low', to: 'high', n: 'n'};

/// Means with intervals and the lines that join them.
function meanMarks(index, {colour, shape, by, dash, size = 36}) {
  const from = `means_${index}`;
  const marks = [
    lines(from, 'delta_phi', 'value', {by, colour, width: 1.2, defined: 'datum.n > 1'}),
    errorBars(from, 'delta_phi', 'low', 'high', {colour}),
    points(from, 'delta_phi', 'value', {colour, shape, size, hollow: ofOne, tooltip: meanTooltip}),
  ];
  if (!dash) return marks;
  marks[0].marks[0].encode.enter.strokeDash = dash;
  marks[0].marks[0].encode.enter.x = marks[1].encode.enter.x = marks[2].encode.enter.x = dodged('delta_phi');
  return marks;
}

/// C = 12, twice the degrees of freedom of a particle.
const isostaticLine = () => ({
  type: 'rule', name: 'ink_isostatic', encode: {enter: {
    x: {value: 0}, x2: {signal: 'width'}, y: {scale: 'y', value: 12}, stroke: {value: ink}, strokeDash: {value: [2, 2]},
  }},
});

function topologyPanel(placement, index, place, {x, y, boxes}) {
  const colour = {scale: 'series', field: 'series'}, shape = {scale: 'seriesShape', field: 'series'};
  return panel({...place, title: placement.title(index), x, y,
    data: [rowsOf('states', index), rowsOf('boxes', index), rowsOf('means', index)],
    marks: [
      isostaticLine(),
      points(`states_${index}`, 'delta_phi', 'value', {colour, size: 9, opacity: 0.3, hollow: 'datum.excluded',
        tooltip: {replicate: 'name', '': 'series', '$Δφ$': 'delta_phi', value: 'value'}}),
      ...uprightBoxes(`boxes_${index}`, 'delta_phi', {colour, width: 11,
        tooltip: {'': 'series', '$Δφ$': 'delta_phi', ...boxTooltip}}),
      ...meanMarks(index, {colour, shape, by: 'series', size: boxes.some(({row}) => row === index) ? 12 : 36}),
    ]});
}

const contactsAbsent = 'no contact numbers were measured; run "isojam measure DIR --add contacts".';
const contactsTitle = 'Contacts and constraints against distance to jamming';

function topologyFigure(data, choices) {
  const title = contactsTitle, id = 'topology', keys = Object.keys(contactSeries);
  const rows = rowsWith(data, keys);
  if (rows.length === 0) return {id, title, absent: contactsAbsent};
  if (choices.together) return topologyTogether(data, rows);
  const placement = placementOf(data, rows, choices);
  const {points: states, boxes} = stateEntries(data, keys, placement);
  const means = meanEntries(data, keys, placement).filter(({row}) => row >= 0);
  const counted = deciding(states, choices, boxes), deciders = deciding(boxes, choices, states);
  const x = {type: 'log', title: '$Δφ$',
    domain: domainOf([...counted, ...deciders, ...means].map((row) => row.delta_phi), {type: 'log'})};
  const highest = Math.max(14, ...counted.map((row) => row.value), ...[...means, ...deciders].map((row) => row.high));
  const y = {title: 'mean per particle', ticks: 6,
    domain: [Math.min(0, ...means.map((row) => row.low)), highest * 1.03]};
  const series = Object.values(contactSeries);
  return {
    id, title, datasets: {means, states, boxes},
    note: `Dots: every state. Larger symbols: means over ${countedText(data)} with 95 % confidence intervals, ` +
      'interpolated at common distances above jamming; open symbols without a line are single replicates. Dotted ' +
      `line: $C$ = 12, the isostatic number. Compare Figure 3 of the paper.${boxText(boxes, 'at common $Δφ$')}` +
      outsideText(states, [['delta_phi', x.domain], ['value', y.domain]], boxes),
    spec: (width) => placedSpec(placement, {
      description: 'Contacts, face-face contacts and constraints per particle against distance to jamming.',
      width, datasets: {means, states, boxes}, height: 240,
      scales: [
        {name: 'series', type: 'ordinal', domain: keys, range: series.map(({colour}) => colour)},
        {name: 'seriesShape', type: 'ordinal', domain: keys, range: series.map(({shape}) => shape)},
      ],
      legends: [{fill: 'series', stroke: 'series', shape: 'seriesShape', texts: labelsOf(contactSeries)}],
      panelAt: (index, place) => topologyPanel(placement, index, place, {x, y, boxes}),
    }),
  };
}

/// Means of several quantities against Δφ, or medians on a logarithmic axis, each in a chart for all solids.
function meansTogether(data, rows, {keys, titles, yType, above, yTitle, more = () => [], zero = false}) {
  const placement = placementOf(data, rows, {together: true}, titles);
  const tag = (row, place) => placement.tag(row, Math.min(place, titles.length - 1));
  const means = (yType === 'log' ? medianEntries : meanEntries)(data, keys, {tag, above})
    .map((entry) => ({...entry, line: `${entry.group} ${entry.series}`}));
  const x = {type: 'log', title: '$Δφ$',
    domain: domainOf(means.map((row) => row.delta_phi), {type: 'log', margin: 0.09}) ?? [0.01, 0.1]};
  const yOf = (index) => {
    const own = means.filter(({row}) => row === index).flatMap(({low, high}) => [low, high]);
    const domain = domainOf(zero ? [0, ...own] : own, {type: yType, margin: 0.06}) ?? [0.1, 1];
    return {type: yType, title: yTitle, domain: zero ? [Math.min(0, ...own), domain[1]] : domain};
  };
  const dash = {signal: `(${JSON.stringify(Object.fromEntries(
    rows.map((row) => [data.rows[row].label, placement.dash(data.rows[row].label)])))})[datum.group]`};
  return {
    datasets: {means},
    spec: (width, description) => placedSpec(placement, {width, description, datasets: {means},
      panelAt: (index, place) => panel({...place, showX: true, showY: true, title: placement.title(index), x,
        y: yOf(index), data: [rowsOf('means', index)],
        marks: [...more(index), ...meanMarks(index, {...placement, by: 'line', dash})]})}),
  };
}

function topologyTogether(data, rows) {
  const keys = ['Z', 'C', 'Z_ff'];
  const made = meansTogether(data, rows, {keys, titles: keys.map((key) => contactSeries[key].label), zero: true,
    more: (index) => (keys[index] === 'C' ? [isostaticLine()] : [])});
  return {
    id: 'topology', title: contactsTitle, datasets: made.datasets,
    note: `Means over ${countedText(data)} with 95 % confidence intervals, interpolated at common distances above ` +
      'jamming and slightly displaced; open symbols without a line are single replicates. Dotted line: $C$ = 12, the ' +
      'isostatic number. Compare Figure 3(a) to (c) of the paper.',
    spec: (width) => made.spec(width, 'Contacts, constraints and face-face contacts of all solids against distance ' +
      'above jamming.'),
  };
}
