'use strict';

const randomColours = {
  'random, edge in face': '#777777', 'random, unconstrained': '#aaa9a2', 'random, vertices and edges': '#8c8b86',
};
const randomDashes = {
  'random, edge in face': [5, 3], 'random, unconstrained': [1.5, 2.5], 'random, vertices and edges': [6, 2, 1.5, 2],
};
const topologyShapes = {'vertex-face': 'triangle-up', 'edge-edge': 'cross', 'edge-face': 'square'};

/// Random curves are those of a solid, so that in one chart each is drawn once.
function randomCurves(data, row, kind, tag) {
  const {random: curves} = data.solids[data.rows[row].solid];
  return (curves ?? []).flatMap(({which, [kind]: curve}) =>
    curve.map(([theta, c]) => ({...tag, which, line: `${tag.solid} ${which}`, theta, c})));
}

function angleData(data, kind, placement) {
  const cdf = [], random = [], critical = [], regions = [], seen = new Set();
  data.rows.forEach((row, index) => {
    const pooled = row.angles?.[kind];
    if (!pooled) return;
    const tag = placement.tag(index);
    for (const [theta, c] of pooled.cdf) cdf.push({...tag, theta, c});
    if (pooled.cutoff !== null) regions.push({...tag, cutoff: pooled.cutoff});
    if (!placement.together || !seen.has(row.solid)) random.push(...randomCurves(data, index, kind, tag));
    seen.add(row.solid);
    for (const {topology, angle} of data.solids[row.solid].critical?.[kind] ?? []) {
      const below = pooled.cdf.filter(([theta]) => theta <= angle);
      if (below.length > 0) critical.push({...tag, topology, theta: angle, c: below.at(-1)[1]});
    }
  });
  return {cdf, random, critical, regions};
}

/// Region 1 of the paper: angles below the fitted cut-off, face-face contacts proper.
const regionMark = (from, share) => ({
  type: 'rect', from: {data: from}, clip: true,
  encode: {enter: {
    x: {value: 0}, x2: {scale: 'x', field: 'cutoff'}, y: {value: 0}, y2: {signal: 'height'},
    fill: {value: '#888888'}, fillOpacity: {value: share},
    tooltip: tooltipOf({'': 'group', 'cut-off, degrees': 'cutoff'}),
  }},
});

/// Points on the curves of a chart of all solids, by whose shapes N is told.
function symbolsOnCurves(cdf, [low, high]) {
  const chosen = [];
  const heights = [0.003, 0.01, 0.03, 0.1, 0.3];
  for (const group of unique(cdf.map((row) => row.group))) {
    const curve = cdf.filter((row) => row.group === group && row.theta >= low && row.theta <= high);
    for (const height of heights) {
      const next = curve.find(({c}) => c >= height);
      if (next && next !== curve[0] && !chosen.includes(next)) chosen.push(next);
    }
  }
  return chosen;
}

function anglePanel(placement, index, place, {x, y, kind, datasets, symbol}) {
  const {together, colour} = placement;
  const random = together ? colour : {scale: 'random', field: 'which'};
  const region = kind === 'face_face' && datasets.regions.some((entry) => entry.row === index);
  const shade = together ? 0.18 / datasets.regions.length : 0.18;
  const cdf = lines(`cdf_${index}`, 'theta', 'c', {by: 'group', colour, width: together ? 1.5 : 1.8, step: true});
  const ideal = lines(`random_${index}`, 'theta', 'c', {by: 'line', colour: random, width: together ? 1 : 1.3});
  ideal.marks[0].encode.enter.strokeDash = {signal: `(${JSON.stringify(randomDashes)})[datum.which] || [5, 3]`};
  const tooltip = {'': 'group', 'critical angle of': 'topology', 'degrees': 'theta', [`$c(${symbol})$`]: 'c'};
  return panel({...place, title: placement.title(index), x, y,
    data: Object.keys(datasets).map((name) => rowsOf(name, index)),
    marks: [
      ...(region ? [regionMark(`regions_${index}`, shade)] : []), ideal, cdf,
      ...(together ? [points(`symbols_${index}`, 'theta', 'c', {colour, shape: placement.shape, size: 30,
        tooltip: {'': 'group', degrees: 'theta', [`$c(${symbol})$`]: 'c'}})] : []),
      points(`critical_${index}`, 'theta', 'c', {
        colour: together ? colour : {value: ink}, size: together ? 60 : 45, hollow: 'true',
        ...(together ? {} : {style: 'ink'}), shape: {scale: 'topology', field: 'topology'}, tooltip}),
    ]});
}

function angleNote(data, kind, symbol, together) {
  return `Cumulative distribution of $${symbol}$ over all contacts nearest jamming, from ${countedText(data)}, and ` +
    `distributions of random contacts${together ? ' of each solid (dashed: an edge in the face; dotted: a vertex ' +
      'touches; dash-dotted: weighted mean of vertices and edges)' : ''}. ` +
    `${together ? 'Hollow symbols' : 'Symbols'} mark the critical angles of the ` +
    `topologies${together ? '; filled symbols distinguish the curves' : ''}. ` +
    (kind === 'face_face' ? 'Shaded: region 1, below the cut-off of face-face contacts (median over replicates). ' +
      'Compare Figure 2(b) of the paper.' : 'Compare Figure 2(a) of the paper.');
}

function angleFigure(data, choices, kind, {title, id, symbol}) {
  const rows = data.rows.flatMap((row, index) => (row.angles?.[kind] ? [index] : []));
  if (rows.length === 0) {
    return {id, title, absent: 'no alignment angles were measured; add "contacts" to "measure" in the manifest.'};
  }
  const placement = placementOf(data, rows, choices);
  const datasets = angleData(data, kind, placement);
  const [least] = domainOf(datasets.cdf.map((row) => row.theta), {type: 'log'});
  const x = {type: 'log', domain: [Math.min(0.1, Math.max(1e-3, least)), 90], title: `$${symbol}$, degrees`};
  const y = {type: 'log', title: `$c(${symbol})$`, domain: [
    Math.max(1e-4, domainOf(datasets.cdf.map((row) => row.c), {type: 'log'})[0]), 1.15]};
  // Curves leave the window on the left where the random ones are still falling.
  datasets.random = datasets.random.filter((row) => row.theta >= x.domain[0] && row.c >= y.domain[0]);
  if (choices.together) datasets.symbols = symbolsOnCurves(datasets.cdf, x.domain);
  const topologies = Object.keys(topologyShapes).slice(0, kind === 'face_face' ? 3 : 2);
  const randomLegend = {stroke: 'random', symbolType: 'stroke', symbolStrokeWidth: 2};
  return {
    id, title, datasets, note: angleNote(data, kind, symbol, choices.together),
    spec: (width) => placedSpec(placement, {
      description: `${title}: cumulative distributions, both axes logarithmic.`, width, datasets, height: 220,
      scales: [
        {name: 'random', type: 'ordinal', domain: Object.keys(randomColours), range: Object.values(randomColours)},
        {name: 'topology', type: 'ordinal', domain: topologies, range: topologies.map((name) => topologyShapes[name])},
      ],
      legends: [...(choices.together ? [] : [randomLegend]),
        {shape: 'topology', symbolStrokeColor: ink, symbolFillColor: 'transparent',
          texts: Object.fromEntries(topologies.map((name) => [name, `critical angle, ${name}`]))}],
      panelAt: (index, place) => anglePanel(placement, index, place, {x, y, kind, datasets, symbol}),
    }),
  };
}
