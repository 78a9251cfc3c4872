'use strict';

/// Sweep points of which `rows` has an entry, and the rows renumbered to the panels they then have.
function panelsFor(data, rows) {
  const present = [...new Set(rows.map((row) => row.row))].sort((a, b) => a - b);
  const place = new Map(present.map((row, index) => [row, index]));
  return {
    present: present.map((row) => data.rows[row]),
    renumbered: (list) => list.filter((row) => place.has(row.row)).map((row) => ({...row, row: place.get(row.row)})),
  };
}

/// "without replicates flagged crystalline, not_balanced", if any are left out.
const exclusionText = ({exclude}) => (exclude.length > 0 ? `without replicates flagged ${exclude.join(', ')}` : '');

/// What a mean is over, for the captions of charts.
const countedText = ({exclude}) => `replicates${exclude.length > 0 ? ` not flagged ${exclude.join(' or ')}` : ''}`;

/// A mean of one replicate is drawn open: it has no interval.
const ofOne = 'datum.n === 1';

function densityData(data) {
  const replicates = data.replicates.filter((replicate) => replicate.phi_j !== null).map((replicate) => ({
    label: data.rows[replicate.row].label, solid: data.rows[replicate.row].solid, name: replicate.name,
    kind: replicate.excluded ? 'excluded' : 'counted', flags: replicate.flags.join(', '), phi_j: replicate.phi_j,
    fit_half_width: replicate.fit_half_width,
  }));
  const means = [], paper = [];
  for (const row of data.rows) {
    const {mean, ci95, n} = row.phi_j;
    if (mean !== null) means.push({label: row.label, solid: row.solid, phi_j: mean, low: ci95 ? ci95[0] : mean,
      high: ci95 ? ci95[1] : mean, n});
    if (!row.paper) continue;
    const {phi_j: value, half_width: half} = row.paper;
    paper.push({label: row.label, phi_j: value, low: value - half, high: value + half});
  }
  return {replicates, means, paper};
}

/// Rules, ticks or symbols in the lane `offset` (−1 to 1) of a sweep point's band.
function laneMark(type, from, offset, extra, style) {
  return {
    type, from: {data: from}, ...styled(style, type, from),
    encode: {enter: {y: {scale: 'y', field: 'label', band: 0.5 + offset * 0.5}, ...extra}},
  };
}

const solidColour = {scale: 'solid', field: 'solid'};
const ordinalScale = (name, values) => (
  {name, type: 'ordinal', domain: Object.keys(values), range: Object.values(values)});
const solidScale = () => ordinalScale('solid', solidColours);
const shapeScale = () => ordinalScale('shape', solidShapes);

function densityMarks() {
  const x = (field) => ({scale: 'x', field});
  return [
    laneMark('symbol', 'replicates', -0.4, {
      x: x('phi_j'), size: {value: 40}, shape: {scale: 'shape', field: 'solid'}, stroke: solidColour,
      fill: [{test: "datum.kind === 'excluded'", value: 'transparent'}, solidColour], fillOpacity: {value: 0.55},
      tooltip: tooltipOf({replicate: 'name', 'φ_J': 'phi_j', '± (fit)': 'fit_half_width', flags: 'flags'}),
    }),
    laneMark('rule', 'means', 0.08, {x: x('low'), x2: x('high'), stroke: {value: ink}, strokeWidth: {value: 2}}, 'ink'),
    laneMark('symbol', 'means', 0.08, {
      x: x('phi_j'), size: {value: 70}, shape: [{test: ofOne, value: 'circle'}, {value: 'stroke'}],
      angle: {value: 90}, fill: {value: 'transparent'}, stroke: {value: ink},
      strokeWidth: {value: 2.5}, tooltip: tooltipOf({'': 'label', mean: 'phi_j', from: 'low', to: 'high', n: 'n'}),
    }, 'ink'),
    laneMark('rule', 'paper', 0.5, {x: x('low'), x2: x('high'), stroke: {value: '#777777'}, strokeWidth: {value: 2}}),
    laneMark('symbol', 'paper', 0.5, {
      x: x('phi_j'), size: {value: 45}, shape: {value: 'diamond'}, fill: {value: '#777777'},
      tooltip: tooltipOf({'': 'label', paper: 'phi_j', from: 'low', to: 'high'}),
    }),
  ];
}

/// Horizontal bands, one for each sweep point; labels stand above the bands where the page is narrow.
function bandSpec({description, width, labels, datasets, x, marks, bandHeight, scales = [], legends = []}) {
  const narrow = width < 560;
  const texts = Object.fromEntries(labels.map((label) => [label, wrapped(label, narrow ? 52 : 34)]));
  const longest = Math.max(...Object.values(texts).flat().map((line) => line.length));
  const most = Math.max(...Object.values(texts).map((lines) => lines.length));
  const left = narrow ? 8 : 30 + 6.3 * longest;
  const height = narrow ? bandHeight + 28 * (most - 1) : Math.max(bandHeight, 14 * most + 8);
  const linesOfLabel = `(${JSON.stringify(texts)})[datum.value]`;
  const text = {signal: linesOfLabel};
  const axis = {scale: 'y', orient: 'left', grid: false, ticks: false, domain: false, labelLimit: 420};
  return {
    $schema: 'https://vega.github.io/schema/vega/v5.json', description, padding: 4, config: configFor(width),
    width: Math.max(160, width - left - 40), height: labels.length * height,
    data: Object.entries(datasets).map(([name, values]) => ({name, values})),
    scales: [
      {name: 'x', type: x.type ?? 'linear', domain: x.domain, range: 'width', zero: false},
      {name: 'y', type: 'band', domain: labels, range: 'height'}, ...scales,
    ],
    axes: [
      {scale: 'x', orient: 'bottom', grid: true, title: x.title,
        ...(x.type === 'log' ? logAxis(x.domain) : {tickCount: narrow ? 4 : 8})},
      narrow ? {...axis, zindex: 1, labelAlign: 'left', labelPadding: -2, encode: {labels: {update: {
        text, y: {scale: 'y', field: 'value', band: 0}, baseline: {value: 'top'}}}}} :
        {...axis, encode: {labels: {update: {text, dy: {signal: `-6.5 * (${linesOfLabel}.length - 1)`}}}}},
    ],
    legends: legends.map((legend) => horizontal(legend, width)),
    marks,
  };
}

function densityFigure(data) {
  const datasets = densityData(data);
  const all = [...datasets.replicates, ...datasets.means.flatMap(({low, high}) => [{phi_j: low}, {phi_j: high}]),
    ...datasets.paper.flatMap(({low, high}) => [{phi_j: low}, {phi_j: high}])];
  const domain = domainOf(all.map((row) => row.phi_j), {margin: 0.04});
  const note = 'Every replicate (hollow: excluded from the mean) in the colour and shape of its solid; below it the ' +
    `mean of ${countedText(data)} with its 95 % interval, open if of one alone; and in grey the value of the paper’s ` +
    'Table I for that N, where it has one.';
  if (!domain) return {id: 'density', title: 'Jamming density', absent: 'No replicate reached a jamming density.'};
  return {
    id: 'density', title: 'Jamming density', note, datasets,
    spec: (width) => bandSpec({
      description: 'Jamming density of every replicate, means with 95 % intervals, and the values of the paper.',
      width, labels: data.rows.filter((row) => (row.all ?? row).phi_j.mean !== null).map((row) => row.label), datasets,
      x: {domain, title: 'jamming density'}, marks: densityMarks(), bandHeight: width < 560 ? 66 : 52,
      scales: [solidScale(), shapeScale()],
    }),
  };
}

/// Farther from jamming the sixth root bends.
const extrapolationReach = 0.07;

function extrapolationData(data) {
  const states = [], extrapolation = [];
  for (const {name, row, states: all, line} of data.replicates) {
    for (const {phi, root, delta_phi} of all) {
      if (root !== null && delta_phi < extrapolationReach) states.push({row, name, phi, root, delta_phi});
    }
    if (line) extrapolation.push(...[line.from, line.to].map(([phi, root]) => ({row, name, phi, root})));
  }
  return {states, extrapolation};
}

function extrapolationFigure(data) {
  const title = 'Extrapolation to jamming', id = 'extrapolation';
  const raw = extrapolationData(data);
  if (raw.states.length === 0) return {id, title, absent: 'No replicate has an equilibrium above jamming.'};
  const {present, renumbered} = panelsFor(data, raw.states);
  const datasets = {states: renumbered(raw.states), extrapolation: renumbered(raw.extrapolation)};
  const every = [...datasets.states, ...datasets.extrapolation];
  const y = {domain: [0, domainOf(every.map((row) => row.root))[1]], title: '(E/N)¹ᐟ⁶', ticks: 4};
  const panelAt = (index, place) => {
    const colour = {value: solidColours[present[index].solid]};
    // Every solid jams at a density of its own.
    const own = every.filter(({row}) => row === index).map(({phi}) => phi);
    const x = {domain: domainOf(own), title: 'density φ', ticks: 4};
    return panel({...place, showX: true, title: present[index].label, x, y,
      data: [rowsOf('states', index), rowsOf('extrapolation', index)],
      marks: [
        lines(`extrapolation_${index}`, 'phi', 'root', {by: 'name', colour: {value: ink}, dash: [4, 3], width: 1,
          style: 'ink'}),
        points(`states_${index}`, 'phi', 'root', {colour, size: 16, opacity: 0.8,
          shape: solidShapes[present[index].solid],
          tooltip: {replicate: 'name', 'φ': 'phi', 'Δφ': 'delta_phi', '(E/N)¹ᐟ⁶': 'root'}}),
      ]});
  };
  return {
    id, title, datasets,
    note: 'Energy grows as Δφ⁶: its sixth root is a straight line in φ, and φ_J is where the line through the states ' +
      'nearest jamming (dashed, of every replicate) meets zero.',
    spec: (width) => panelSpec({description: 'Sixth root of the energy per particle against density, by replicate.',
      width, count: present.length, datasets, panelAt}),
  };
}
