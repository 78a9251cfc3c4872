'use strict';

/// States of every replicate under load, and those that a drop led to.
function shearData(data) {
  const states = [], drops = [];
  for (const {name, row, shear} of data.replicates) {
    for (const {strain, stress, dropped} of shear) {
      if (strain === null || stress === null) continue;
      states.push({row, name, strain, stress});
      if (dropped) drops.push({row, name, strain, stress});
    }
  }
  return {states, drops};
}

function shearFigure(data) {
  const title = 'Under shear', id = 'shear';
  const raw = shearData(data);
  if (raw.states.length === 0)
    return {id, title, absent: 'This sweep has no shear: add "shear" to the manifest’s "measure".'};
  const {present, renumbered} = panelsFor(data, raw.states);
  const datasets = {states: renumbered(raw.states), drops: renumbered(raw.drops)};
  const x = {title: 'strain γ', domain: domainOf(datasets.states.map((row) => row.strain)), ticks: 4};
  const y = {title: 'shear stress over pressure', domain: domainOf(datasets.states.map((row) => row.stress))};
  const panelAt = (index, place) => {
    const colour = {value: solidColours[present[index].solid]};
    return panel({...place, title: present[index].label, x, y,
      data: [rowsOf('states', index), rowsOf('drops', index)],
      marks: [
        lines(`states_${index}`, 'strain', 'stress', {by: 'name', colour, width: 1.2, opacity: 0.8}),
        points(`states_${index}`, 'strain', 'stress', {colour, size: 7, opacity: 0.8,
          tooltip: {replicate: 'name', 'γ': 'strain', 's/p': 'stress'}}),
        points(`drops_${index}`, 'strain', 'stress', {colour, shape: 'triangle-down', size: 26, opacity: 0.9,
          tooltip: {replicate: 'name', 'γ': 'strain', 's/p': 'stress'}}),
      ]});
  };
  return {
    id, title, datasets,
    note: 'Shear stress over pressure against strain, for the packing nearest jamming of every replicate; triangles ' +
      'are states that the packing came to by giving way. A packing jammed in a cube has some shear stress before it ' +
      'is strained.',
    spec: (width) => panelSpec({description: 'Shear stress over pressure against strain.', width,
      count: present.length, datasets, panelAt, height: 200}),
  };
}
