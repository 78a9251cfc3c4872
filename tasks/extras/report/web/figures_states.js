'use strict';

// Quantities of states against the distance to jamming. Contacts, moduli and frequencies differ in their descriptions.

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

/// What a chart of states and its caption say beside their description: a panel for each sweep point, or a chart for each
/// quantity. `summary(placement)` gives the data sets beside states and boxes, `yAxis` an axis from the numbers drawn, and
/// `marks` those of a panel.
function stateFigure(data, choices, figure) {
  const {id, title, keys, above, yType, yTitle, absent} = figure, rows = rowsWith(data, keys, above);
  if (rows.length === 0) return {id, title, absent};
  if (choices.together) return statesTogether(data, rows, figure);
  const placement = placementOf(data, rows, choices);
  const {points: states, boxes} = stateEntries(data, keys, {tag: placement.tag, above, yType});
  const summary = figure.summary(placement), datasets = {states, boxes, ...summary};
  const counted = deciding(states, choices, boxes), deciders = deciding(boxes, choices, states);
  const x = {type: 'log', title: '$Δφ$',
    domain: domainOf([...counted, ...deciders, ...summary.means ?? []].map((row) => row.delta_phi), {type: 'log'})};
  const y = {type: yType, title: yTitle, ...figure.yAxis(counted, deciders, summary)};
  return {
    id, title, datasets,
    note: figure.note + boxText(boxes, 'at common $Δφ$') +
      outsideText(states, [['delta_phi', x.domain], ['value', y.domain]], boxes),
    spec: (width) => placedSpec(placement, {
      description: figure.description, width, datasets, height: figure.height, scales: figure.scales,
      legends: figure.legends,
      panelAt: (index, place) => panel({...place, title: placement.title(index), x, y,
        data: Object.keys(datasets).map((name) => rowsOf(name, index)), marks: figure.marks(index, placement, boxes)})}),
  };
}

function statesTogether(data, rows, {id, title, keys, above, yType, yTitle, together}) {
  const made = meansTogether(data, rows, {keys, yType, above, yTitle, ...together});
  return {id, title, datasets: made.datasets, note: together.note,
    spec: (width) => made.spec(width, together.description)};
}

/// Colours and symbols by quantity.
const bySeries = (series) => ({
  scales: [
    {name: 'series', type: 'ordinal', domain: Object.keys(series), range: Object.values(series).map(({colour}) => colour)},
    {name: 'seriesShape', type: 'ordinal', domain: Object.keys(series), range: Object.values(series).map(({shape}) => shape)},
  ],
  legends: [{fill: 'series', stroke: 'series', shape: 'seriesShape', texts: labelsOf(series)}],
});
const seriesColour = {scale: 'series', field: 'series'}, seriesShape = {scale: 'seriesShape', field: 'series'};

/// A logarithmic axis of the states drawn.
const logarithmic = (margin) => (counted, deciders) => ({domain: domainOf([...counted.map((row) => row.value),
  ...deciders.flatMap(({low, high}) => [low, high])], {type: 'log', ...(margin ? {margin} : {})})});

/// States and boxes of a panel.
const stateMarks = (index, {colour, name = '', valueTitle = 'value', width, ...look}) => [
  points(`states_${index}`, 'delta_phi', 'value', {colour, hollow: 'datum.excluded', ...look,
    tooltip: {replicate: 'name', [name]: 'series', '$Δφ$': 'delta_phi', [valueTitle]: 'value'}}),
  ...uprightBoxes(`boxes_${index}`, 'delta_phi', {colour, width,
    tooltip: {[name]: 'series', '$Δφ$': 'delta_phi', ...boxTooltip}}),
];

// ---- Contacts -------------------------------------------------------------------------------------------------------

const contactSeries = {
  C: {colour: hues.vermilion, label: 'constraints $C$', shape: 'circle'},
  Z: {colour: hues.blue, label: 'contacts $Z$', shape: 'square'},
  Z_ff: {colour: hues.green, label: 'face-face contacts $Z_{ff}$', shape: 'diamond'},
};

/// C = 12, twice the degrees of freedom of a particle.
const isostaticLine = () => ({
  type: 'rule', name: 'ink_isostatic', encode: {enter: {
    x: {value: 0}, x2: {signal: 'width'}, y: {scale: 'y', value: 12}, stroke: {value: ink}, strokeDash: {value: [2, 2]},
  }},
});

function topologyFigure(data, choices) {
  const keys = Object.keys(contactSeries), charts = ['Z', 'C', 'Z_ff'], over = `over ${countedText(data)}`;
  return stateFigure(data, choices, {
    id: 'topology', title: 'Contacts and constraints against distance to jamming', keys, yTitle: 'mean per particle', height: 240,
    absent: 'no contact numbers were measured; run "isojam measure DIR --add contacts".', ...bySeries(contactSeries),
    description: 'Contacts, face-face contacts and constraints per particle against distance to jamming.',
    note: `Dots: every state. Larger symbols: means ${over} with 95 % confidence intervals, interpolated at common ` +
      'distances above jamming; open symbols without a line are single replicates. Dotted line: $C$ = 12, the isostatic ' +
      'number. Compare Figure 3 of the paper.',
    summary: (placement) => ({means: meanEntries(data, keys, placement).filter(({row}) => row >= 0)}),
    yAxis(counted, deciders, {means}) {
      const highest = Math.max(14, ...counted.map((row) => row.value), ...[...means, ...deciders].map((row) => row.high));
      return {ticks: 6, domain: [Math.min(0, ...means.map((row) => row.low)), highest * 1.03]};
    },
    marks: (index, placement, boxes) => [
      isostaticLine(), ...stateMarks(index, {colour: seriesColour, size: 9, opacity: 0.3, width: 11}),
      ...meanMarks(index, {colour: seriesColour, shape: seriesShape, by: 'series',
        size: boxes.some(({row}) => row === index) ? 12 : 36}),
    ],
    together: {
      keys: charts, titles: charts.map((key) => contactSeries[key].label), zero: true, yTitle: undefined,
      more: (index) => (charts[index] === 'C' ? [isostaticLine()] : []),
      note: `Means ${over} with 95 % confidence intervals, interpolated at common distances above jamming and slightly ` +
        'displaced; open symbols without a line are single replicates. Dotted line: $C$ = 12, the isostatic number. Compare ' +
        'Figure 3(a) to (c) of the paper.',
      description: 'Contacts, constraints and face-face contacts of all solids against distance above jamming.',
    },
  });
}

// ---- Moduli ---------------------------------------------------------------------------------------------------------

const modulusSeries = {
  K: {colour: hues.blue, label: 'bulk modulus $K$', shape: 'circle'},
  G: {colour: hues.vermilion, label: 'mean shear modulus $G$', shape: 'triangle-up'},
};

function moduliFigure(data, choices) {
  const keys = Object.keys(modulusSeries), above = 0, over = `over ${countedText(data)}`;
  const text = 'Moduli include the relaxation of particles, in units of $Y$. Only positive moduli are shown.';
  return stateFigure(data, choices, {
    id: 'moduli', title: 'Elastic moduli against distance to jamming', keys, above, yType: 'log', yTitle: 'modulus', height: 220,
    absent: 'no moduli were measured; run "isojam measure DIR --add moduli".', ...bySeries(modulusSeries),
    description: 'Bulk and shear modulus against distance to jamming.',
    note: `Bulk modulus and mean shear modulus of every state; lines join medians ${over}. ${text}`,
    summary: ({tag}) => ({medians: medianEntries(data, keys, {tag, above}).filter(({row}) => row >= 0)}),
    yAxis: logarithmic(),
    marks: (index) => [
      ...stateMarks(index, {colour: seriesColour, shape: seriesShape, size: 18, opacity: 0.6}),
      lines(`medians_${index}`, 'delta_phi', 'value', {by: 'series', colour: seriesColour, width: 1.2, defined: 'datum.n > 1'}),
    ],
    together: {
      titles: keys.map((key) => modulusSeries[key].label),
      note: `Medians and quartiles ${over}, interpolated at common distances above jamming and slightly displaced; open ` +
        `symbols without a line are single replicates. ${text}`,
      description: 'Bulk and shear moduli of all solids against distance to jamming.',
    },
  });
}

// ---- Frequencies ----------------------------------------------------------------------------------------------------

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

function scalingFigure(data, choices) {
  const id = 'scaling', title = 'Softest and stiffest modes against distance to jamming', over = countedText(data);
  const text = 'Mean frequency of the lowest ($⟨ω_l⟩$) and of the highest modes ($⟨ω_h⟩$) against the distance to jamming';
  const shape = {scale: 'end', field: 'series'};
  return stateFigure(data, choices, {
    ...modesAbsent(id, title), keys: Object.keys(endKeys), above: 0, yType: 'log', yTitle: '$⟨ω⟩$', height: 220,
    scales: [{name: 'end', type: 'ordinal', domain: ['omega_h', 'omega_l'], range: ['triangle-up', 'circle']}],
    legends: [{shape: 'end', symbolStrokeColor: ink,
      texts: {omega_h: 'highest modes, $⟨ω_h⟩$', omega_l: 'lowest modes, $⟨ω_l⟩$'}}],
    description: 'Mean frequencies of the softest and stiffest modes, both axes logarithmic.',
    note: `${text}, for every state of every replicate. Lines: power laws fitted to the states of ${over} with $Δφ$ ≤ 0.02. ` +
      'Compare Figure 1(b) of the paper.',
    summary: ({tag}) => scalingFits(data, tag), yAxis: logarithmic(0.09),
    marks: (index, {colour}) => [
      ...stateMarks(index, {colour, shape, size: 22, opacity: 0.75, name: 'modes', valueTitle: '$⟨ω⟩$'}),
      lines(`fits_${index}`, 'delta_phi', 'value', {by: 'series', colour: {value: ink}, width: 1.4, style: 'ink'}),
      slopeLabels(`slopes_${index}`),
    ],
    together: {
      titles: [''], yTitle: '$⟨ω_l⟩$, $⟨ω_h⟩$',
      note: `${text}: medians and quartiles over ${over} at common distances, slightly displaced; open symbols without a ` +
        'line are single replicates. The upper curves are the highest modes. Compare Figure 1(b) of the paper.',
      description: 'Mean frequencies of the softest and stiffest modes of all solids, both axes logarithmic.',
    },
  });
}
