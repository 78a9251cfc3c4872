'use strict';

/// Where a mark stands along x: at its place, moved aside by so many pixels where several would cover each other.
const dodged = (field, by = 0) => ({signal: `scale('x', datum[${JSON.stringify(field)}]) + datum.dodge + (${by})`});

/// Boxes of excluded replicates are empty and dashed.
const boxLook = {fillOpacity: {signal: 'datum.excluded ? 0 : 0.3'},
  strokeDash: {signal: 'datum.excluded ? [2, 2] : []'}, strokeWidth: {value: 1}};

/// Boxes over y: whiskers, quartiles, median.
function uprightBoxes(from, x, {colour, width = 8, tooltip}) {
  const y = (field) => ({scale: 'y', field});
  const mark = (type, encoding) => ({type, from: {data: from}, clip: true,
    encode: {enter: {stroke: colour, ...encoding, tooltip: tooltipOf(tooltip)}}});
  return [
    mark('rule', {x: dodged(x), y: y('low'), y2: y('high'), strokeWidth: {value: 1}}),
    mark('rect', {xc: dodged(x), width: {value: width}, y: y('q1'), y2: y('q3'), fill: colour,
      ...boxLook}),
    mark('rule', {x: dodged(x, -width / 2), x2: dodged(x, width / 2), y: y('median'), strokeWidth: {value: 2}}),
  ];
}

/// Boxes over x at heights `y`, moved up or down instead of aside.
function lyingBoxes(from, yField, {colour, width = 8, tooltip}) {
  const x = (field) => ({scale: 'x', field});
  const y = (by) => ({signal: `scale('y', datum[${JSON.stringify(yField)}]) + datum.dodge + (${by})`});
  const mark = (type, encoding) => ({type, from: {data: from}, clip: true,
    encode: {enter: {stroke: colour, ...encoding, tooltip: tooltipOf(tooltip)}}});
  return [
    mark('rule', {y: y(0), x: x('low'), x2: x('high'), strokeWidth: {value: 1}}),
    mark('rect', {yc: y(0), height: {value: width}, x: x('q1'), x2: x('q3'), fill: colour, ...boxLook}),
    mark('rule', {y: y(-width / 2), y2: y(width / 2), x: x('median'), strokeWidth: {value: 2}}),
  ];
}

const boxTooltip = {median: 'median', 'lower quartile': 'q1', 'upper quartile': 'q3', '2.5 %': 'low',
  '97.5 %': 'high', n: 'n'};

const boxText = (boxes, where) => (boxes.length > 0 ? ` Boxes replace more than ${mostDrawn} replicates ` +
  `${where}: median, quartiles, and whiskers around 95 % of them; dashed boxes are excluded from means.` : '');

/// Offsets from a line at which discs of diameter `size` with their centres at `at` along it do not overlap: each in
/// turn, from the left, as near to the line as it can be.
function swarmOffsets(at, size) {
  const order = at.map((_, k) => k).sort((a, b) => at[a] - at[b] || a - b);
  const offsets = new Array(at.length).fill(0);
  let first = 0;
  order.forEach((k, rank) => {
    while (at[k] - at[order[first]] >= size) first += 1;
    const near = order.slice(first, rank);
    const room = near.map((other) => Math.sqrt(size ** 2 - (at[k] - at[other]) ** 2));
    const places = [0, ...near.flatMap((other, i) => [offsets[other] - room[i], offsets[other] + room[i]])]
      .sort((a, b) => Math.abs(a) - Math.abs(b) || a - b);
    offsets[k] = places.find((place) =>
      near.every((other, i) => Math.abs(place - offsets[other]) >= room[i] * (1 - 1e-9))) ?? 0;
  });
  return offsets;
}

/// Entries with `offset` and `size` of their discs, groups of more than mostDrawn as swarms at most 2·`half` high.
function swarmed(entries, groupOf, position, half) {
  const groups = new Map();
  entries.forEach((entry, k) => groups.set(groupOf(entry), [...groups.get(groupOf(entry)) ?? [], k]));
  const placed = entries.map((entry) => ({...entry, offset: 0, size: 40}));
  for (const members of groups.values()) {
    if (members.length <= mostDrawn) continue;
    const at = members.map((k) => position(entries[k]));
    let size = 6, offsets = swarmOffsets(at, size);
    while (size > 1.5 && offsets.some((offset) => Math.abs(offset) > half)) {
      size *= 0.85;
      offsets = swarmOffsets(at, size);
    }
    members.forEach((k, i) => Object.assign(placed[k],
      {offset: Math.max(-half, Math.min(half, offsets[i])), size: size ** 2}));
  }
  return placed;
}
