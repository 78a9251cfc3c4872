'use strict';

const randomColours = {
  'random, edge in face': hues.grey, 'random, unconstrained': '#aaa9a2',
};
const randomDashes = {
  'random, edge in face': [8, 4], 'random, unconstrained': [2, 3],
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
      if (below.length > 0 && !critical.some((entry) => entry.solid === tag.solid && entry.row === tag.row &&
        entry.topology === topology)) critical.push({...tag, topology, theta: angle, c: below.at(-1)[1]});
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

/// Lanes above the axis for symbols at `at` pixels, so that no two in a lane are nearer than `size`.
function lanesOf(at, size) {
  const ends = [], lanes = new Array(at.length);
  for (const k of at.map((_, index) => index).sort((a, b) => at[a] - at[b] || a - b)) {
    const free = ends.findIndex((end) => at[k] - end >= size);
    lanes[k] = free < 0 ? ends.length : free;
    ends[lanes[k]] = at[k];
  }
  return lanes;
}

/// Critical angles of all panels with their lanes.
function laned(critical, x, width) {
  const position = positionAlong(x, width);
  return unique(critical.map(({row}) => row)).flatMap((row) => {
    const own = critical.filter((entry) => entry.row === row);
    const lanes = lanesOf(own.map(({theta}) => position(theta)), 12);
    return own.map((entry, k) => ({...entry, lane: lanes[k]}));
  });
}

function anglePanel(placement, index, place, {x, y, kind, datasets, symbol}) {
  const {together, colour} = placement;
  const random = together ? colour : {scale: 'random', field: 'which'};
  const region = kind === 'face_face' && datasets.regions.some((entry) => entry.row === index);
  const shade = together ? 0.18 / datasets.regions.length : 0.18;
  const cdf = lines(`cdf_${index}`, 'theta', 'c', {by: 'group', colour, width: together ? 1.5 : 1.8, step: true});
  const ideal = lines(`random_${index}`, 'theta', 'c', {by: 'line', colour: random, width: together ? 1 : 1.3});
  ideal.marks[0].encode.enter.strokeDash = {scale: 'dash', field: 'which'};
  const tooltip = {'': 'group', 'critical angle of': 'topology', 'degrees': 'theta', [`$c(${symbol})$`]: 'c'};
  return panel({...place, title: placement.title(index), x, y,
    data: Object.keys(datasets).map((name) => rowsOf(name, index)),
    marks: [
      ...(region ? [regionMark(`regions_${index}`, shade)] : []), ideal, cdf,
      ...(together ? [points(`symbols_${index}`, 'theta', 'c', {colour, shape: placement.shape, size: 30,
        tooltip: {'': 'group', degrees: 'theta', [`$c(${symbol})$`]: 'c'}})] : []),
      criticalMark(`critical_${index}`, {colour: together ? colour : {value: ink}, tooltip, together}),
    ]});
}

/// Critical angles in lanes above the axis, where they cover neither each other nor the curves.
function criticalMark(from, {colour, tooltip, together}) {
  const mark = points(from, 'theta', 'c', {colour, size: 45, hollow: 'true', tooltip,
    ...(together ? {} : {style: 'ink'}), shape: {scale: 'topology', field: 'topology'}});
  mark.name ??= `symbol_${from}`;
  mark.encode.enter.y = {signal: 'height - 8 - 12 * datum.lane'};
  return mark;
}

function angleNote(data, kind, symbol, together) {
  return `Cumulative distribution of $${symbol}$ over all contacts nearest jamming, from ${countedText(data)}, and ` +
    `distributions of random contacts${together ? ' of each solid' : ''}. Hollow symbols above the axis mark the ` +
    `critical angles of the topologies${together ? '; filled symbols distinguish the curves' : ''}. ` +
    (kind === 'face_face' ? 'Shaded: region 1, below the cut-off of face-face contacts (median over replicates). ' +
      'Compare Figure 2(b) of the paper.' : 'Compare Figure 2(a) of the paper.');
}

function angleFigure(data, choices, kind, {title, id, symbol}) {
  const rows = data.rows.flatMap((row, index) => (row.angles?.[kind] ? [index] : []));
  if (rows.length === 0) {
    return {id, title, absent: 'no alignment angles were measured; run "isojam measure DIR --add contacts".'};
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
  const randomLegend = {stroke: 'random', strokeDash: 'dash', symbolType: 'stroke', symbolSize: 1600,
    symbolStrokeWidth: 1.6, longSymbol: true};
  const dashLegend = {...randomLegend, stroke: undefined, symbolStrokeColor: ink};
  return {
    id, title, datasets, note: angleNote(data, kind, symbol, choices.together),
    spec: (width) => placedSpec(placement, {
      description: `${title}: cumulative distributions, both axes logarithmic.`, width, height: 220,
      datasets: {...datasets, critical: laned(datasets.critical, x, panelGrid(width, placement.count, placement.grid).width)},
      scales: [
        {name: 'dash', type: 'ordinal', domain: Object.keys(randomDashes), range: Object.values(randomDashes)},
        {name: 'random', type: 'ordinal', domain: Object.keys(randomColours), range: Object.values(randomColours)},
        {name: 'topology', type: 'ordinal', domain: topologies, range: topologies.map((name) => topologyShapes[name])},
      ],
      legends: [choices.together ? dashLegend : randomLegend,
        {shape: 'topology', symbolStrokeColor: ink, symbolFillColor: 'transparent',
          texts: Object.fromEntries(topologies.map((name) => [name, `critical angle, ${name}`]))}],
      panelAt: (index, place) => anglePanel(placement, index, place, {x, y, kind, datasets, symbol}),
    }),
  };
}
