'use strict';

const randomColours = {'random, edge in face': '#777777', 'random, unconstrained': '#aaa9a2'};

function angleData(data, kind) {
  const cdf = [], random = [], critical = [], regions = [];
  data.rows.forEach((row, index) => {
    const pooled = row.angles?.[kind];
    if (!pooled) return;
    for (const [theta, c] of pooled.cdf) cdf.push({row: index, theta, c, series: 'packings'});
    if (pooled.cutoff !== null) regions.push({row: index, cutoff: pooled.cutoff});
    const {random: curves, critical: angles} = data.solids[row.solid];
    for (const {which, [kind]: curve} of curves ?? []) {
      for (const [theta, c] of curve) random.push({row: index, which, theta, c});
    }
    for (const {topology, angle} of angles?.[kind] ?? []) {
      const below = pooled.cdf.filter(([theta]) => theta <= angle);
      if (below.length > 0) critical.push({row: index, topology, theta: angle, c: below.at(-1)[1]});
    }
  });
  return {cdf, random, critical, regions};
}

/// Region 1 of the paper: angles below the fitted cut-off, face-face contacts proper.
const regionMark = (from) => ({
  type: 'rect', from: {data: from},
  encode: {enter: {
    x: {value: 0}, x2: {scale: 'x', field: 'cutoff'}, y: {value: 0}, y2: {signal: 'height'},
    fill: {value: '#888888'}, fillOpacity: {value: 0.18}, tooltip: tooltipOf({'cut-off, degrees': 'cutoff'}),
  }},
});

function anglePanel(data, row, index, place, {x, y, kind, datasets}) {
  const colour = {value: solidColours[row.solid]};
  const random = {scale: 'random', field: 'which'};
  const region = datasets.regions.some((entry) => entry.row === index);
  return panel({...place, title: row.label, x, y,
    data: ['cdf', 'random', 'critical', 'regions'].map((name) => rowsOf(name, index)),
    marks: [
      ...(region && kind === 'face_face' ? [regionMark(`regions_${index}`)] : []),
      lines(`random_${index}`, 'theta', 'c', {by: 'which', colour: random, width: 1.3, dash: [5, 3]}),
      lines(`cdf_${index}`, 'theta', 'c', {by: 'series', colour, width: 1.8, step: true}),
      points(`critical_${index}`, 'theta', 'c', {colour: {value: ink}, size: 45, hollow: 'true', style: 'ink',
        shape: {scale: 'topology', field: 'topology'},
        tooltip: {'critical angle of': 'topology', 'degrees': 'theta', 'c': 'c'}}),
    ]});
}

function angleFigure(data, kind, {title, id, symbol}) {
  const raw = angleData(data, kind);
  if (raw.cdf.length === 0) {
    return {id, title, absent: 'This sweep has no alignment angles: add "contacts" to the manifest’s "measure".'};
  }
  const {present, renumbered} = panelsFor(data, raw.cdf);
  const datasets = Object.fromEntries(Object.entries(raw).map(([name, list]) => [name, renumbered(list)]));
  const [least] = domainOf(datasets.cdf.map((row) => row.theta), {type: 'log'});
  const x = {type: 'log', domain: [Math.min(0.1, Math.max(1e-3, least)), 90], title: `${symbol}, degrees`};
  const y = {type: 'log', title: `c(${symbol})`, domain: [
    Math.max(1e-4, domainOf(datasets.cdf.map((row) => row.c), {type: 'log'})[0]), 1.15]};
  // Curves leave the window on the left where the random ones are still falling.
  datasets.random = datasets.random.filter((row) => row.theta >= x.domain[0] && row.c >= y.domain[0]);
  const shapes = {'vertex-face': 'triangle-up', 'edge-edge': 'cross', 'edge-face': 'square'};
  const topologies = Object.keys(shapes).slice(0, kind === 'face_face' ? 3 : 2);
  return {
    id, title, datasets,
    note: `Cumulative distribution of ${symbol} over all contacts nearest jamming of a sweep point’s ` +
      `${countedText(data)}, beside ideal random contacts; symbols mark the critical angles that the topologies ` +
      'allow. ' +
      (kind === 'face_face' ? 'Shaded: region 1, below the cut-off of face-face contacts (median of the ' +
        'replicates). Figure 2(b) of the paper.' : 'Figure 2(a) of the paper.'),
    spec: (width) => panelSpec({
      description: `${title}: cumulative distributions, both axes logarithmic.`, width, count: present.length, datasets,
      height: 220,
      scales: [
        {name: 'random', type: 'ordinal', domain: Object.keys(randomColours), range: Object.values(randomColours)},
        {name: 'topology', type: 'ordinal', domain: topologies, range: topologies.map((name) => shapes[name])},
      ],
      legends: [{stroke: 'random', symbolType: 'stroke', symbolStrokeWidth: 2},
        {shape: 'topology', symbolStrokeColor: ink, encode: {labels: {update: {text: {
          signal: "'critical angle, ' + datum.value"}}}}}],
      panelAt: (index, place) => anglePanel(data, present[index], index, place, {x, y, kind, datasets}),
    }),
  };
}

const contactSeries = {
  C: {colour: '#d55e00', label: 'constraints C', shape: 'circle'},
  Z: {colour: '#0072b2', label: 'contacts Z', shape: 'square'},
  Z_ff: {colour: '#009e73', label: 'face-face contacts', shape: 'diamond'},
};

function topologyData(data) {
  const states = [], means = [];
  for (const {name, row, states: all} of data.replicates) {
    for (const state of all) {
      for (const [key, {label}] of Object.entries(contactSeries)) {
        if (state.delta_phi > 0 && state[key] !== null) {
          states.push({row, name, series: label, delta_phi: state.delta_phi, value: state[key]});
        }
      }
    }
  }
  data.rows.forEach(({series}, row) => {
    for (const point of series) {
      for (const [key, {label}] of Object.entries(contactSeries)) {
        const estimate = point[key];
        if (!estimate || estimate.mean === null) continue;
        const [low, high] = estimate.ci95 ?? [estimate.mean, estimate.mean];
        means.push({row, series: label, delta_phi: point.delta_phi, value: estimate.mean, low, high, n: estimate.n});
      }
    }
  });
  return {states, means};
}

/// C = 12, twice the degrees of freedom of a particle.
const isostaticLine = () => ({
  type: 'rule', name: 'ink_isostatic', encode: {enter: {
    x: {value: 0}, x2: {signal: 'width'}, y: {scale: 'y', value: 12}, stroke: {value: ink}, strokeDash: {value: [2, 2]},
  }},
});

function topologyPanel(row, index, place, {x, y}) {
  const colour = {scale: 'series', field: 'series'}, shape = {scale: 'seriesShape', field: 'series'};
  return panel({...place, title: row.label, x, y, data: [rowsOf('states', index), rowsOf('means', index)],
    marks: [
      isostaticLine(),
      points(`states_${index}`, 'delta_phi', 'value', {colour, size: 9, opacity: 0.3,
        tooltip: {replicate: 'name', '': 'series', 'Δφ': 'delta_phi', value: 'value'}}),
      lines(`means_${index}`, 'delta_phi', 'value', {by: 'series', colour, width: 1.2, defined: 'datum.n > 1'}),
      errorBars(`means_${index}`, 'delta_phi', 'low', 'high', {colour}),
      points(`means_${index}`, 'delta_phi', 'value', {colour, shape, size: 36, hollow: ofOne,
        tooltip: {'': 'series', 'Δφ': 'delta_phi', mean: 'value', from: 'low', to: 'high', n: 'n'}}),
    ]});
}

function topologyFigure(data) {
  const title = 'Contacts and constraints on the way to jamming', id = 'topology';
  const raw = topologyData(data);
  if (raw.states.length === 0) {
    return {id, title, absent: 'This sweep has no contact numbers: add "contacts" to the manifest’s "measure".'};
  }
  const {present, renumbered} = panelsFor(data, raw.states);
  const datasets = {means: renumbered(raw.means), states: renumbered(raw.states)};
  const distances = [...datasets.states, ...datasets.means].map((row) => row.delta_phi);
  const x = {type: 'log', title: 'Δφ', domain: domainOf(distances, {type: 'log'})};
  const highest = Math.max(14, ...datasets.states.map((row) => row.value), ...datasets.means.map((row) => row.high));
  const low = Math.min(0, ...datasets.means.map((row) => row.low));
  const y = {domain: [low, highest * 1.03], title: 'mean per particle', ticks: 6};
  const series = Object.values(contactSeries);
  const labels = series.map(({label}) => label);
  return {
    id, title, datasets,
    note: `Every state (dots), and means over ${countedText(data)} with 95 % intervals, interpolated at common ` +
      'distances above jamming; open, and joined by no line, if of one replicate alone. Dotted line: C = 12, the ' +
      'isostatic number of constraints. Figure 3 of the paper.',
    spec: (width) => panelSpec({
      description: 'Contacts, face-face contacts and constraints per particle against distance above jamming.',
      width, count: present.length, datasets, height: 240,
      scales: [
        {name: 'series', type: 'ordinal', domain: labels, range: series.map(({colour}) => colour)},
        {name: 'seriesShape', type: 'ordinal', domain: labels, range: series.map(({shape}) => shape)},
      ],
      legends: [{fill: 'series', stroke: 'series', shape: 'seriesShape'}],
      panelAt: (index, place) => topologyPanel(present[index], index, place, {x, y}),
    }),
  };
}
