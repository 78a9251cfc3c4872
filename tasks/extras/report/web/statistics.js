'use strict';

/// Groups of more replicates are drawn as boxes or swarms: so many points or lines would hide each other.
const mostDrawn = 30;

/// The number below which this share of sorted numbers lies, interpolated between the two beside it.
function quantile(sorted, share) {
  const at = share * (sorted.length - 1), below = Math.floor(at);
  return sorted[below] + (at - below) * ((sorted[below + 1] ?? sorted[below]) - sorted[below]);
}

const boxShares = {low: 0.025, q1: 0.25, median: 0.5, q3: 0.75, high: 0.975};

/// Median, quartiles, and between which 95 % of the values lie.
function boxOf(values) {
  const sorted = [...values].sort((a, b) => a - b);
  const box = Object.entries(boxShares).map(([name, share]) => [name, quantile(sorted, share)]);
  return {...Object.fromEntries(box), n: sorted.length};
}

const scaleMaps = {linear: [(x) => x, (x) => x], log: [Math.log, Math.exp]};

/// y of a curve [[x, y], ...] at x, straight between the points beside it; null beyond the curve. Types of the scales.
function valueAt(curve, x, type = 'linear', yType = 'linear') {
  const sorted = [...curve].sort((a, b) => a[0] - b[0]);
  const next = sorted.findIndex(([at]) => at >= x);
  if (next < 0 || (next === 0 && sorted[0][0] > x)) return null;
  if (sorted[next][0] === x) return sorted[next][1];
  const [map] = scaleMaps[type], [yMap, yBack] = scaleMaps[yType];
  const [[x0, y0], [x1, y1]] = [sorted[next - 1], sorted[next]];
  return yBack(yMap(y0) + ((map(x) - map(x0)) / (map(x1) - map(x0))) * (yMap(y1) - yMap(y0)));
}

/// Boxes [{at, low, q1, median, q3, high, n}] over curves at each of `levels` that a share of them, `least`, reach.
function boxesOver(curves, levels, {type, yType, least = 0.25}) {
  const boxes = [];
  for (const at of levels) {
    const values = curves.map((curve) => valueAt(curve, at, type, yType)).filter((value) => value !== null);
    if (values.length >= Math.max(1, least * curves.length)) boxes.push({at, ...boxOf(values)});
  }
  return boxes;
}

/// `count` numbers from the least to the greatest x of any curve, evenly spaced on a scale of this type.
function evenLevels(curves, count, type) {
  const [map, back] = scaleMaps[type ?? 'linear'];
  const [low, high] = (domainOf(curves.flat().map(([x]) => x), {type, margin: 0}) ?? [1, 1]).map(map);
  return Array.from({length: count}, (_, k) => back(low + ((k + 0.5) / count) * (high - low)));
}

/// Δφ at which solids are compared, those of the tables.
const seriesDistances = [0.005, 0.01, 0.02, 0.04, 0.08, 0.16];

const isNumber = (value) => typeof value === 'number';

/// What charts draw of the curves [[x, y], ...] of every sweep point's replicates, of those that count and of the
/// excluded ones: points, or boxes at common x where there are more than mostDrawn.
///   curveOf(replicate)  its curve;  tag(row)  what every entry gets;  names  of x and y in the entries
function pointsOrBoxes(data, {curveOf, tag, names: [xName, yName], type, yType, least}) {
  const points = [], boxes = [];
  for (const {row, excluded, members} of groupsOf(data)) {
    const curves = members.map((replicate) => ({name: replicate.name, curve: curveOf(replicate)}))
      .filter(({curve}) => curve.length > 0);
    if (curves.length <= mostDrawn) {
      for (const {name, curve} of curves)
        for (const [x, y] of curve) points.push({...tag(row), name, excluded, [xName]: x, [yName]: y});
      continue;
    }
    const all = curves.map(({curve}) => curve);
    for (const {at, ...box} of boxesOver(all, evenLevels(all, 8, type), {type, yType, least}))
      boxes.push({...tag(row), excluded, [xName]: at, ...box});
  }
  return {points, boxes};
}

/// Of every sweep point the replicates that count, and the excluded ones.
function groupsOf(data) {
  return data.rows.flatMap((_, row) => [false, true].map((excluded) => ({row, excluded,
    members: data.replicates.filter((replicate) => replicate.row === row && replicate.excluded === excluded)})));
}

/// The entries that decide how far axes reach: those that count; all if the reader asks, or if neither of them nor of
/// `others` in the same chart any counts.
function deciding(entries, {everything}, others = []) {
  const counts = ({excluded}) => !excluded;
  return everything || ![...entries, ...others].some(counts) ? entries : entries.filter(counts);
}

/// How many excluded replicates lie outside of the domains of the fields, and whether boxes of some do, in words.
function outsideText(entries, fields, boxes = [], domainOfBox = () => fields.at(-1)[1]) {
  const inside = (value, [low, high]) => value >= low && value <= high;
  const beyond = entries.filter((entry) =>
    entry.excluded && fields.some(([name, domain]) => !inside(entry[name], domain)));
  const count = new Set(beyond.map(({name}) => name)).size;
  const boxBeyond = boxes.some((box) => box.excluded &&
    !(inside(box.low, domainOfBox(box)) && inside(box.high, domainOfBox(box))));
  return (count > 0 ? ` The axes do not show all of ${counted(count, 'excluded replicate')}.` : '') +
    (boxBeyond ? ' Some excluded replicates are beyond the axes.' : '');
}
