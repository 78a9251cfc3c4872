'use strict';

function spectrumData(data) {
  const density = [], ends = [];
  for (const {name, row, density_of_states: spectrum, lowest, highest} of data.replicates) {
    if (spectrum?.log10_omega && spectrum?.density) {
      spectrum.density.forEach((value, k) =>
        density.push({row, name, omega: 10 ** spectrum.log10_omega[k], density: value}));
      density.push({row, name, omega: 10 ** spectrum.log10_omega.at(-1), density: 0});
    }
    for (const [end, list] of [['lowest', lowest], ['highest', highest]]) {
      for (const omega of list) if (omega > 0) ends.push({row, name, end, omega});
    }
  }
  return {density, ends};
}

/// Ticks at the foot of a panel, one for each frequency.
function frequencyTicks(from, colour) {
  return {
    type: 'rule', from: {data: from},
    encode: {enter: {
      x: {scale: 'x', field: 'omega'}, y: {signal: 'height'}, y2: {signal: 'height - 7'}, stroke: colour,
      strokeWidth: {value: 0.7}, opacity: {value: 0.5},
      tooltip: tooltipOf({replicate: 'name', end: 'end', 'ω': 'omega'}),
    }},
  };
}

const modesAbsent = (id, title) => ({
  id, title, absent: 'This sweep has no vibrations: add "modes" to the manifest’s "measure".',
});

function spectrumFigure(data) {
  const title = 'Vibrational spectra', id = 'spectrum';
  const raw = spectrumData(data);
  if (raw.ends.length === 0) return modesAbsent(id, title);
  const {present, renumbered} = panelsFor(data, raw.ends);
  const datasets = {density: renumbered(raw.density), ends: renumbered(raw.ends)};
  const x = {type: 'log', title: 'frequency ω',
    domain: domainOf([...datasets.ends, ...datasets.density].map((row) => row.omega), {type: 'log', margin: 0.03})};
  const top = domainOf(datasets.density.map((row) => row.density));
  const y = {domain: [0, top ? top[1] : 1], title: 'modes per decade, share of all', ticks: 4};
  const panelAt = (index, place) => {
    const colour = {value: solidColours[present[index].solid]};
    return panel({...place, title: present[index].label, x, y,
      data: [rowsOf('density', index), rowsOf('ends', index)],
      marks: [
        lines(`density_${index}`, 'omega', 'density', {by: 'name', colour, width: 1.2, opacity: 0.8, step: true}),
        frequencyTicks(`ends_${index}`, colour),
      ]});
  };
  return {
    id, title, datasets,
    note: 'Density of states of the packing nearest jamming, one line for each replicate (packings of up to 150 ' +
      'particles); ticks at the foot are its lowest and highest frequencies. Units: V_p = Y = ρ = 1. Figure 1(a) of ' +
      'the paper.',
    spec: (width) => panelSpec({description: 'Vibrational densities of states against frequency, logarithmic.',
      width, count: present.length, datasets, panelAt}),
  };
}

function scalingData(data) {
  const states = [], fits = [], slopes = [];
  for (const {name, row, states: all} of data.replicates) {
    for (const state of all) {
      for (const [key, end] of [['omega_l', 'lowest'], ['omega_h', 'highest']]) {
        if (state.delta_phi > 0 && state[key] > 0)
          states.push({row, name, end, delta_phi: state.delta_phi, omega: state[key]});
      }
    }
  }
  data.rows.forEach(({scaling}, row) => {
    for (const [key, end] of [['omega_l', 'lowest'], ['omega_h', 'highest']]) {
      const law = scaling[key];
      if (!law || !(law.to > law.from)) continue;
      const at = (distance) => law.prefactor * distance ** law.exponent;
      for (const delta_phi of [law.from, law.to]) fits.push({row, end, delta_phi, omega: at(delta_phi)});
      const half = law.ci95_half_width === null ? '' : ` ± ${law.ci95_half_width.toFixed(2)}`;
      slopes.push({row, end, exponent: law.exponent, ci95_half_width: law.ci95_half_width,
        delta_phi: law.to, omega: at(law.to), text: `slope ${law.exponent.toFixed(2)}${half}`.replace('-', '−')});
    }
  });
  return {states, fits, slopes};
}

/// Below the end of the line, where points that rise leave room.
const slopeLabels = (from) => ({
  type: 'text', from: {data: from},
  encode: {enter: {
    x: {scale: 'x', field: 'delta_phi', offset: 10}, y: {scale: 'y', field: 'omega',
      offset: 24},
    text: {field: 'text'}, fontSize: {value: 11}, fill: {value: ink},
  }},
});

function scalingFigure(data) {
  const title = 'Softest and stiffest vibrations on the way to jamming', id = 'scaling';
  const raw = scalingData(data);
  if (raw.states.length === 0) return modesAbsent(id, title);
  const {present, renumbered} = panelsFor(data, raw.states);
  const datasets = {states: renumbered(raw.states), fits: renumbered(raw.fits), slopes: renumbered(raw.slopes)};
  const x = {type: 'log', title: 'Δφ', domain: domainOf(datasets.states.map((row) => row.delta_phi), {type: 'log'})};
  const y = {type: 'log', title: '⟨ω⟩',
    domain: domainOf(datasets.states.map((row) => row.omega), {type: 'log', margin: 0.09})};
  const shape = {scale: 'end', field: 'end'};
  const panelAt = (index, place) => {
    const colour = {value: solidColours[present[index].solid]};
    return panel({...place, title: present[index].label, x, y,
      data: [rowsOf('states', index), rowsOf('fits', index), rowsOf('slopes', index)],
      marks: [
        points(`states_${index}`, 'delta_phi', 'omega', {colour, shape, size: 22, opacity: 0.75,
          tooltip: {replicate: 'name', modes: 'end', 'Δφ': 'delta_phi', '⟨ω⟩': 'omega'}}),
        lines(`fits_${index}`, 'delta_phi', 'omega', {by: 'end', colour: {value: ink}, width: 1.4, style: 'ink'}),
        slopeLabels(`slopes_${index}`),
      ]});
  };
  return {
    id, title, datasets,
    note: 'Mean frequency of the lowest and of the highest modes against the distance above jamming, every state of ' +
      `every replicate. Lines: power laws through the states of ${countedText(data)} with Δφ ≤ 0.02. Figure 1(b) of ` +
      'the paper.',
    spec: (width) => panelSpec({
      description: 'Mean frequencies of the softest and stiffest modes, both axes logarithmic.', width,
      count: present.length, datasets, panelAt, height: 220,
      scales: [{name: 'end', type: 'ordinal', domain: ['highest', 'lowest'], range: ['triangle-up', 'circle']}],
      legends: [{shape: 'end', title: 'modes', symbolStrokeColor: ink}]}),
  };
}
