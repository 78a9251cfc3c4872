'use strict';

const classSeries = {
  all: {colour: hues.black, label: 'all contacts'},
  face_face: {colour: hues.green, label: 'face-face'},
  edge_face: {colour: hues.orange, label: 'edge-face'},
  lower_order: {colour: hues.sky, label: 'lower order'},
};

/// The curves of all sweep points that have the distribution `part`.
function distributionEntries(data, rows, {part, yType, least = 0}, {tag, together}) {
  const entries = [];
  for (const row of rows) {
    const {curves, states} = data.rows[row].distributions[part];
    for (const [series, curve] of Object.entries(curves)) {
      if (together && series !== 'all') continue;
      // A logarithmic axis has no place for an empty bin.
      for (const [x, y] of curve.filter((point) => point[0] >= least && (point[1] > 0 || yType !== 'log')))
        entries.push({...tag(row), series, line: `${data.rows[row].label} ${series}`, x, y, n: states});
    }
  }
  return entries;
}

/// A line at y = 1.
const unitLine = () => ({type: 'rule', name: 'ink_unit', encode: {enter: {
  x: {value: 0}, x2: {signal: 'width'}, y: {scale: 'y', value: 1}, stroke: {value: ink}, strokeDash: {value: [2, 2]}}}});

/// One point for the symbols of each curve of a chart of all solids, at every fourth bin.
const everyFourth = (entries) => entries.filter((_, k) => k % 4 === 0);

/// A figure of one distribution. In panels, each of several `series` has a colour; otherwise the solid has it.
function distributionFigure(data, choices, distribution) {
  const {id, title, part, note, absent, xTitle, yTitle, type, yType, unit = false} = distribution;
  const rows = data.rows.flatMap((row, index) => (row.distributions?.[part] ? [index] : []));
  if (rows.length === 0) return {id, title, absent};
  const placement = placementOf(data, rows, choices), {together} = placement;
  const entries = distributionEntries(data, rows, distribution, placement);
  const datasets = {curves: entries, ...(together ? {symbols: everyFourth(entries)} : {})};
  const names = Object.keys(classSeries).filter((name) => entries.some(({series}) => series === name));
  const bySeries = !together && names.length > 1;
  const colour = bySeries ? {scale: 'series', field: 'series'} : placement.colour;
  const x = {type, title: xTitle, domain: domainOf(entries.map((entry) => entry.x), {type, margin: 0.02})};
  const y = {type: yType, title: yTitle,
    domain: domainOf([...(unit || yType === 'log' ? [] : [0]), ...entries.map((entry) => entry.y)], {type: yType})};
  const tooltip = {'': 'group', [xTitle]: 'x', [yTitle]: 'y', n: 'n'};
  return {
    id, title, datasets, note: `${note} States nearest jamming of ${countedText(data)}.`,
    spec: (width) => placedSpec(placement, {
      description: `${title} of all sweep points.`, width, datasets,
      scales: bySeries ? [ordinalScale('series', Object.fromEntries(names.map((name) =>
        [name, classSeries[name].colour])))] : [],
      legends: bySeries ? [{stroke: 'series', symbolType: 'stroke', symbolSize: 600, symbolStrokeWidth: 2,
        texts: labelsOf(classSeries)}] : [],
      panelAt: (index, place) => panel({...place, title: placement.title(index), x, y,
        data: Object.keys(datasets).map((name) => rowsOf(name, index)),
        marks: [...(unit ? [unitLine()] : []),
          lines(`curves_${index}`, 'x', 'y', {by: 'line', colour, width: 1.5}),
          points(together ? `symbols_${index}` : `curves_${index}`, 'x', 'y', {colour, size: together ? 30 : 12, tooltip,
            shape: together ? placement.shape : 'circle'})]}),
    }),
  };
}

const gapsAbsent = 'no distributions were measured; add "gaps" to "measure" in the manifest.';

const forceFigure = (data, choices) => distributionFigure(data, choices, {
  id: 'forces', title: 'Contact forces', part: 'forces', absent: gapsAbsent, type: 'log', yType: 'log',
  xTitle: '$f/⟨f⟩$', yTitle: '$P(f)$', least: 1e-3,
  note: 'Probability density of the contact force divided by its mean in the packing. The curves of the contact classes ' +
    'add up to that of all contacts. Forces below 10⁻³ of the mean are left out.',
});

const pairFigure = (data, choices) => distributionFigure(data, choices, {
  id: 'pairs', title: 'Pair distribution', part: 'pairs', absent: gapsAbsent, type: 'linear', yType: 'linear',
  xTitle: '$r$', yTitle: '$g(r)$', unit: true,
  note: 'Number of centres at a distance $r$ from a centre, divided by the number in an ideal gas of the same density. ' +
    'The unit of $r$ is the cube root of the particle volume.',
});

const exponentFigure = (data, choices) => distributionFigure(data, choices, {
  id: 'exponents', title: 'Exponents of contacts', part: 'exponents', type: 'linear', yType: 'log',
  absent: 'no exponents were measured; add "exponents" to "measure" in the manifest.',
  xTitle: '$x$', yTitle: '$P(x)$',
  note: 'Probability density of the exponent $x$ of a contact, which is −5 for a face on a face, 0 for an edge in a face, ' +
    'and 1 for a vertex in a face and for crossed edges. The classes are divided at −2.5 and 0.5.',
});

const angleHistogram = (data, choices, kind, {id, title, symbol}) => distributionFigure(data, choices, {
  id, title, part: kind, type: 'log', yType: 'linear', xTitle: `$${symbol}$, degrees`, yTitle: 'probability per decade',
  absent: 'no histograms of angles were measured; add "contacts" to "measure" in the manifest.',
  note: `Histogram of $${symbol}$ of all contacts, with logarithmic bins.`,
});
