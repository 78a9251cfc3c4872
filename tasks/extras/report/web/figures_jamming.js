'use strict';

/// "Excluded from means: crystalline (2), not_balanced (0)", with numbers of replicates; empty if no flag excludes.
const exclusionText = ({exclude, replicates}) => (exclude.length === 0 ? '' : `Excluded from means: ${exclude
  .map((flag) => `${flag} (${replicates.filter(({flags}) => flags.includes(flag)).length})`).join(', ')}`);

/// What a mean is over, for the captions of charts.
const countedText = ({exclude}) => `replicates${exclude.length > 0 ? ` without the flags ${exclude.join(', ')}` : ''}`;

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

/// The lanes of a sweep point's band, which are higher where some of them hold swarms.
const laneOffsets = (tall) => (tall ? {replicates: -0.3, means: 0.56, paper: 0.84} :
  {replicates: -0.4, means: 0.08, paper: 0.5});

/// Excluded replicates beyond the axis, counted at its ends.
function beyondEnds(entries, [low, high]) {
  const counts = new Map();
  for (const {label, solid, phi_j: value} of entries) {
    const side = value < low ? -1 : value > high ? 1 : 0, key = JSON.stringify([label, solid, side]);
    if (side !== 0) counts.set(key, (counts.get(key) ?? 0) + 1);
  }
  return [...counts].map(([key, count]) => {
    const [label, solid, side] = JSON.parse(key);
    return {label, solid, side, count, text: side < 0 ? `◁ ${count}` : `${count} ▷`};
  });
}

/// How many replicates lie beyond an end of the axis.
const beyondMark = (from, lane) => laneMark('text', from, lane, {
  x: {signal: 'datum.side < 0 ? 0 : width'}, align: {signal: "datum.side < 0 ? 'left' : 'right'"},
  baseline: {value: 'middle'}, text: {field: 'text'}, fontSize: {value: 11}, fill: {value: ink},
  tooltip: tooltipOf({'': 'label', 'excluded replicates beyond the axis': 'count'})});

function densityMarks(tall) {
  const x = (field) => ({scale: 'x', field}), lanes = laneOffsets(tall);
  const tooltip = tooltipOf({replicate: 'name', '$φ_J$': 'phi_j', '± (fit)': 'fit_half_width', flags: 'flags'});
  const band = {scale: 'y', field: 'label', band: 0.5 + lanes.replicates * 0.5, offset: {field: 'offset'}};
  return [
    laneMark('symbol', 'replicates', lanes.replicates, {
      x: x('phi_j'), y: band, size: {field: 'size'}, shape: {scale: 'shape', field: 'solid'}, stroke: solidColour,
      fill: [{test: "datum.kind === 'excluded'", value: 'transparent'}, solidColour], fillOpacity: {value: 0.55},
      tooltip}),
    laneMark('rule', 'means', lanes.means, {x: x('low'), x2: x('high'), stroke: {value: ink}, strokeWidth: {value: 2}},
      'ink'),
    laneMark('symbol', 'means', lanes.means, {
      x: x('phi_j'), size: {value: 70}, shape: [{test: ofOne, value: 'circle'}, {value: 'stroke'}],
      angle: {value: 90}, fill: {value: 'transparent'}, stroke: {value: ink},
      strokeWidth: {value: 2.5}, tooltip: tooltipOf({'': 'label', mean: 'phi_j', from: 'low', to: 'high', n: 'n'}),
    }, 'ink'),
    laneMark('rule', 'paper', lanes.paper, {x: x('low'), x2: x('high'), stroke: {value: hues.grey},
      strokeWidth: {value: 2}}),
    laneMark('symbol', 'paper', lanes.paper, {
      x: x('phi_j'), size: {value: 45}, shape: {value: 'diamond'}, fill: {value: hues.grey},
      tooltip: tooltipOf({'': 'label', paper: 'phi_j', from: 'low', to: 'high'}),
    }),
    beyondMark('beyond', lanes.replicates - 0.2),
  ];
}

/// Where a number stands along an axis of so many pixels.
function positionAlong({type, domain}, pixels) {
  const map = type === 'log' ? Math.log : (value) => value, [low, high] = domain.map(map);
  return (value) => ((map(value) - low) / (high - low)) * pixels;
}

/// Horizontal bands, one for each sweep point; labels stand above the bands where the page is narrow. `datasets` is
/// called with the place of a number along x and the height of a band, both in pixels.
function bandSpec({description, width, labels, datasets, x, marks, bandHeight, scales = [], legends = []}) {
  const narrow = width < 560;
  const texts = Object.fromEntries(labels.map((label) => [label, wrapped(label, narrow ? 52 : 34)]));
  const longest = Math.max(...Object.values(texts).flat().map((line) => line.length));
  const most = Math.max(...Object.values(texts).map((lines) => lines.length));
  const left = narrow ? 8 : 30 + 6.3 * longest;
  const height = narrow ? bandHeight + 28 * (most - 1) : Math.max(bandHeight, 14 * most + 8);
  const across = Math.max(160, width - left - 40);
  const {legends: placed, beside} = placedLegends(legends, scales, across);
  const linesOfLabel = `(${JSON.stringify(texts)})[datum.value]`;
  const text = {signal: linesOfLabel};
  const axis = {scale: 'y', orient: 'left', grid: false, ticks: false, domain: false, labelLimit: 420,
    labelFlush: false};
  return {
    $schema: 'https://vega.github.io/schema/vega/v5.json', description, padding: 4, config: configFor(beside),
    width: across, height: labels.length * height,
    data: Object.entries(datasets(positionAlong(x, across), height)).map(([name, values]) => ({name, values})),
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
    legends: placed, marks,
  };
}

/// Whether some sweep point has more entries than are drawn one beside the other.
const hasSwarm = (entries) => unique(entries.map(({label}) => label))
  .some((label) => entries.filter((entry) => entry.label === label).length > mostDrawn);

const swarmText = (tall) => (tall ?
  ` More than ${mostDrawn} replicates of a sweep point are drawn as a swarm.` : '');

function densityFigure(data, choices) {
  const id = 'density', title = 'Jamming density', datasets = densityData(data);
  const ends = ({low, high}) => [low, high];
  const told = datasets.replicates.map((entry) => ({...entry, excluded: entry.kind === 'excluded'}));
  const deciders = deciding(told, choices);
  const domain = domainOf([...deciders.map((row) => row.phi_j), ...datasets.means.flatMap(ends),
    ...datasets.paper.flatMap(ends)], {margin: 0.04});
  if (!domain) return {id, title, absent: 'No replicate reached a jamming density.'};
  const isBeyond = ({phi_j: value}) => value < domain[0] || value > domain[1];
  const inside = datasets.replicates.filter((entry) => !isBeyond(entry));
  const beyond = beyondEnds(datasets.replicates, domain);
  const tall = hasSwarm(datasets.replicates);
  const note = 'Coloured symbols: every replicate; hollow ones are excluded from the mean. Below them: the mean over ' +
    `${countedText(data)} with its 95 % confidence interval; an open circle is the value of a single replicate. ` +
    `Grey diamonds: the paper’s Table I for the same $N$.${swarmText(tall)}` +
    (beyond.length > 0 ? ' Numbers at the ends count excluded replicates beyond the axis.' : '');
  return {
    id, title, note, datasets,
    spec: (width) => bandSpec({
      description: 'Jamming density of every replicate, means with 95 % confidence intervals, and values of the paper.',
      width, labels: data.rows.filter((row) => (row.all ?? row).phi_j.mean !== null).map((row) => row.label),
      datasets: (position, height) => ({...datasets, beyond,
        replicates: swarmed(inside, ({label}) => label, ({phi_j: value}) => position(value), height * 0.27)}),
      x: {domain, title: 'jamming density $φ_J$'}, marks: densityMarks(tall),
      bandHeight: (width < 560 ? 66 : 52) * (tall ? 2 : 1), scales: [solidScale(), shapeScale()],
    }),
  };
}
