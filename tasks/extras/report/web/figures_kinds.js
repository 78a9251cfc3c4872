'use strict';

/// Partial contact numbers of the mixtures, one entry for each pair of kinds.
function kindEntries(data) {
  const entries = [];
  for (const row of data.rows) {
    for (let of = 1; of <= 4; of += 1) {
      for (let other = 1; other <= 4; other += 1) {
        const estimate = row[`Z_${of}${other}`];
        if (!isNumber(estimate?.mean)) continue;
        const [low, high] = estimate.ci95 ?? [estimate.mean, estimate.mean];
        entries.push({label: row.label, of: `kind ${of}`, other: `kind ${other}`, z: estimate.mean, low, high, n: estimate.n,
          mixing: row.mixing?.mean ?? null});
      }
    }
  }
  return entries;
}

/// In the band of a sweep point, a lane for each pair of kinds.
function kindsFigure(data) {
  const id = 'kinds', title = 'Contacts between the kinds of a mixture', entries = kindEntries(data);
  const mixtures = data.rows.some(({solid}) => data.solids[solid].shapes);
  if (entries.length === 0) {
    return {id, title, absent: mixtures ?
      'no contact numbers were measured; add "contacts" to "measure" in the manifest.' : 'no sweep point is a mixture.'};
  }
  const kinds = unique(entries.map(({of}) => of)), others = unique(entries.map(({other}) => other));
  const means = entries.map((entry) => ({...entry,
    lane: kinds.indexOf(entry.of) * (others.length + 1) + others.indexOf(entry.other) + 1}));
  const lanes = kinds.length * (others.length + 1);
  const x = (field) => ({scale: 'x', field});
  const y = {signal: `scale('y', datum.label) + bandwidth('y') - 14 * (${lanes} - datum.lane)`};
  const tooltip = tooltipOf({'': 'label', 'per particle of': 'of', 'contacts with': 'other', 'contact number': 'z',
    from: 'low', to: 'high', n: 'n', 'mixing of the sweep point': 'mixing'});
  const colour = {scale: 'other', field: 'other'};
  const marks = [
    {type: 'rule', from: {data: 'means'}, encode: {enter: {x: x('low'), x2: x('high'), y, stroke: colour,
      strokeWidth: {value: 1.6}}}},
    {type: 'symbol', from: {data: 'means'}, encode: {enter: {x: x('z'), y, shape: {scale: 'of', field: 'of'},
      size: {value: 55}, fill: colour, stroke: colour, tooltip}}},
  ];
  return {
    id, title, datasets: {means},
    note: 'Mean number of contacts of a particle of one kind (symbol) with particles of another kind (colour), with 95 % ' +
      'confidence intervals. The kinds have the order of the manifest. The tooltips and the tables have the mixing, which ' +
      'is 1 if contacts do not depend on the kind.',
    spec: (width) => bandSpec({
      description: 'Partial contact numbers of mixtures.', width, labels: unique(means.map(({label}) => label)),
      datasets: () => ({means}), marks, bandHeight: 14 * lanes + (width < 560 ? 24 : 0),
      x: {domain: domainOf([0, ...means.flatMap(({low, high}) => [low, high])]), title: 'contacts per particle'},
      scales: [ordinalScale('other', Object.fromEntries(others.map((name, k) => [name, seriesColours[k]]))),
        ordinalScale('of', Object.fromEntries(kinds.map((name, k) => [name, variantShapes[k]])))],
      legends: [{fill: 'other', symbolType: 'square', texts: Object.fromEntries(others.map((name) =>
        [name, `contacts with ${name}`]))},
      {shape: 'of', symbolStrokeColor: ink, symbolFillColor: 'transparent', texts: Object.fromEntries(kinds.map((name) =>
        [name, `per particle of ${name}`]))}],
    }),
  };
}
