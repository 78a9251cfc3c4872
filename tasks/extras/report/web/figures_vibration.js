'use strict';

const modesAbsent = (id, title) => ({
  id, title, absent: 'no modes were measured; run "isojam measure DIR --add modes".',
});

/// Edges of bins in log₁₀ ω, and how wide spectra of several replicates have them in common.
const binWidth = 0.2;

/// A density of states, a step function of log₁₀ ω, averaged over each of the common bins: {bin: density}.
function rebinned({log10_omega: edges, density}) {
  const bins = new Map();
  density.forEach((value, k) => {
    for (let bin = Math.floor(edges[k] / binWidth); bin * binWidth < edges[k + 1]; bin += 1) {
      const shared = Math.min(edges[k + 1], (bin + 1) * binWidth) - Math.max(edges[k], bin * binWidth);
      if (shared > 0) bins.set(bin, (bins.get(bin) ?? 0) + (value * shared) / binWidth);
    }
  });
  return bins;
}

/// What replicates have in each common bin, zero where a spectrum does not reach.
function binnedValues(spectra) {
  const all = spectra.map(rebinned), bins = unique(all.flatMap((one) => [...one.keys()])).sort((a, b) => a - b);
  return bins.map((bin) => ({omega: 10 ** ((bin + 0.5) * binWidth), values: all.map((one) => one.get(bin) ?? 0)}));
}

const hasSpectrum = ({density_of_states: spectrum}) => Boolean(spectrum?.log10_omega && spectrum?.density);

/// The mean line of those that count, for a chart of all solids.
function meanSpectra(data, tag) {
  return groupsOf(data).filter(({excluded}) => !excluded).flatMap(({row, members}) =>
    binnedValues(members.filter(hasSpectrum).map((replicate) => replicate.density_of_states)).map(({omega, values}) =>
      ({...tag(row), omega, density: values.reduce((a, b) => a + b) / values.length, n: values.length})));
}

/// Lines of single replicates, boxes where there are many, one mean line in a chart of all solids.
function spectrumData(data, {tag, together}) {
  const density = [], boxes = [], ends = [], endBoxes = [];
  if (together) return {density, boxes, means: meanSpectra(data, tag), ends, endBoxes};
  for (const {row, excluded, members} of groupsOf(data)) {
    if (members.length <= mostDrawn) {
      for (const replicate of members) addSpectrum(replicate, tag(row), density, ends);
      continue;
    }
    const spectra = members.filter(hasSpectrum).map((replicate) => replicate.density_of_states);
    for (const {omega, values} of binnedValues(spectra)) boxes.push({...tag(row), excluded, omega, ...boxOf(values)});
    for (const end of ['lowest', 'highest']) {
      const omegas = members.flatMap((replicate) => replicate[end].filter((omega) => omega > 0));
      if (omegas.length > 0) endBoxes.push({...tag(row), excluded, end, ...boxOf(omegas)});
    }
  }
  return {density, boxes, means: [], ends, endBoxes};
}

function addSpectrum(replicate, tag, density, ends) {
  const {name, excluded, density_of_states: spectrum} = replicate;
  if (hasSpectrum(replicate)) {
    spectrum.density.forEach((value, k) =>
      density.push({...tag, name, excluded, omega: 10 ** spectrum.log10_omega[k], density: value}));
    density.push({...tag, name, excluded, omega: 10 ** spectrum.log10_omega.at(-1), density: 0});
  }
  for (const end of ['lowest', 'highest'])
    for (const omega of replicate[end]) if (omega > 0) ends.push({...tag, name, excluded, end, omega});
}

/// Ticks at the foot of a panel, one for each frequency.
function frequencyTicks(from, colour) {
  return {
    type: 'rule', from: {data: from}, clip: true,
    encode: {enter: {
      x: {scale: 'x', field: 'omega'}, y: {signal: 'height'}, y2: {signal: 'height - 7'}, stroke: colour,
      strokeWidth: {value: 0.7}, opacity: {value: 0.5},
      tooltip: tooltipOf({replicate: 'name', end: 'end', '$ω$': 'omega'}),
    }},
  };
}

/// Boxes at the foot of a panel, one for either end of the spectra.
const endMarks = (from, colour) => lyingBoxes(from, 'foot', {colour, width: 6,
  tooltip: {frequencies: 'end', ...boxTooltip}}).map((mark) => {
  const {y, y2, yc} = mark.encode.enter, at = (by) => ({signal: `height - 5 + (${by})`});
  Object.assign(mark.encode.enter, yc ? {yc: at(0)} : y2 ? {y: at(-3), y2: at(3)} : y ? {y: at(0)} : {});
  return mark;
});

function spectrumPanel(placement, index, place, {x, y, names}) {
  const {colour} = placement;
  const line = lines(`density_${index}`, 'omega', 'density', {by: 'name', colour, width: 1.2, opacity: 0.8,
    step: true});
  line.marks[0].encode.enter.strokeDash = {signal: 'datum.excluded ? [2, 2] : []'};
  const means = lines(`means_${index}`, 'omega', 'density', {by: 'group', colour, width: 1.5});
  return panel({...place, title: placement.title(index), x, y, data: names.map((name) => rowsOf(name, index)),
    marks: [
      line, means,
      points(`means_${index}`, 'omega', 'density', {colour, shape: placement.shape, size: 26,
        tooltip: {'': 'group', '$ω$': 'omega', density: 'density', n: 'n'}}),
      ...uprightBoxes(`boxes_${index}`, 'omega', {colour, width: 5, tooltip: {'$ω$': 'omega', ...boxTooltip}}),
      frequencyTicks(`ends_${index}`, colour), ...endMarks(`endBoxes_${index}`, colour),
    ]});
}

function spectrumFigure(data, choices) {
  const title = 'Vibrational spectra', id = 'spectrum';
  const rows = data.replicates.filter(({lowest, highest}) => [...lowest, ...highest].some((omega) => omega > 0))
    .map(({row}) => row);
  if (rows.length === 0) return modesAbsent(id, title);
  const placement = placementOf(data, rows, choices);
  const datasets = spectrumData(data, placement), {density, boxes, means, ends, endBoxes} = datasets;
  const one = [...density, ...ends], many = [...boxes, ...endBoxes];
  const drawn = [...deciding(one, choices, many), ...deciding(boxes, choices, one), ...means];
  const omegas = [...drawn.map((row) => row.omega),
    ...deciding(endBoxes, choices, one).flatMap(({low, high}) => [low, high])];
  const x = {type: 'log', title: 'frequency $ω$',
    domain: domainOf(omegas, {type: 'log', margin: 0.03}) ?? [0.1, 1]};
  const top = domainOf(drawn.map((row) => row.density ?? row.high));
  const y = {domain: [0, top ? top[1] : 1], title: 'modes per decade, fraction of all', ticks: 4};
  const what = placement.together ? `mean over ${countedText(data)} in bins of ${binWidth} decades` :
    'one line for each replicate, dotted if excluded from means';
  return {
    id, title, datasets,
    note: `Density of states of the packing nearest jamming, ${what} (packings of up to 150 particles). ` +
      `${placement.together ? '' : 'Ticks at the bottom mark the lowest and highest frequencies. '}Units: ` +
      `$V_p$ = $Y$ = $ρ$ = 1. Compare Figure 1(a) of the paper.` +
      boxText(boxes, 'in common bins and, at the bottom, for the lowest and highest frequencies') +
      outsideText(one, [['omega', x.domain]], endBoxes),
    spec: (width) => placedSpec(placement, {
      description: 'Vibrational densities of states against frequency, logarithmic.', width, datasets,
      panelAt: (index, place) => spectrumPanel(placement, index, place, {x, y, names: Object.keys(datasets)})}),
  };
}
