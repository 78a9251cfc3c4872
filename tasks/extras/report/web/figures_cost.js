'use strict';

const costKinds = {evaluations: {title: 'evaluations of the energy'}, cpu_seconds: {title: 'CPU seconds'}};

function costFigure(data, key, id) {
  const title = key === 'cpu_seconds' ? 'Time per replicate' : 'Evaluations per replicate';
  const replicates = data.replicates.filter((replicate) => replicate[key] > 0).map((replicate) => ({
    label: data.rows[replicate.row].label, solid: data.rows[replicate.row].solid, name: replicate.name,
    status: replicate.status, cost: replicate[key],
  }));
  if (replicates.length === 0) return {id, title, absent: 'the records do not contain this cost.'};
  const tall = hasSwarm(replicates);
  const domain = domainOf(replicates.map((row) => row.cost), {type: 'log', margin: 0.06});
  const mark = {
    type: 'symbol', from: {data: 'replicates'},
    encode: {enter: {
      x: {scale: 'x', field: 'cost'}, y: {scale: 'y', field: 'label', band: 0.5, offset: {field: 'offset'}},
      size: {field: 'size'},
      shape: [{test: "datum.status === 'failed'", value: 'cross'}, {scale: 'shape', field: 'solid'}],
      fill: solidColour, stroke: solidColour, fillOpacity: {value: 0.5},
      tooltip: tooltipOf({replicate: 'name', status: 'status', [costKinds[key].title]: 'cost'}),
    }},
  };
  return {
    id, title, datasets: {replicates},
    note: (key === 'cpu_seconds' ? 'CPU time of each replicate.' :
      'Evaluations of energy and forces of each replicate, a cost that does not depend on the machine.') +
      ` Crosses are failed replicates.${swarmText(tall)}`,
    spec: (width) => bandSpec({
      description: `${title}, by sweep point.`, width, labels: data.rows.map((row) => row.label),
      datasets: (position, height) => ({replicates: swarmed(replicates, ({label}) => label,
        ({cost}) => position(cost), height * 0.4 - (width < 560 ? 6 : 0))}),
      x: {type: 'log', domain, title: costKinds[key].title}, marks: [mark],
      bandHeight: (width < 560 ? 44 : 30) * (tall ? 2 : 1), scales: [solidScale(), shapeScale()],
    }),
  };
}

/// Equilibria in blue and green, what is not one in warm colours.
const reasonColours = {
  residual_reached: hues.blue, precision_floor: hues.sky, unjammed: hues.green, energy_change: hues.yellow,
  budget: hues.orange, line_search_failed: hues.vermilion, not_finite: hues.purple, interrupted: hues.grey,
  not_called: '#aaaaaa',
};

function stopRows(data) {
  const counts = new Map();
  for (const {row, stops} of data.replicates) {
    for (const {stage, reason, count} of stops) {
      const key = JSON.stringify([row, stage, reason]);
      counts.set(key, (counts.get(key) ?? 0) + count);
    }
  }
  return [...counts].map(([key, count]) => {
    const [row, stage, reason] = JSON.parse(key);
    return {label: data.rows[row].label, stage, reason, count};
  });
}

function stopFigure(data) {
  const title = 'Stop reasons of minimisations', id = 'stops';
  const all = stopRows(data);
  const stops = all.filter((row) => row.stage === 'decompression');
  if (stops.length === 0) return {id, title, absent: 'no replicate reached its decompression.'};
  const reasons = Object.keys(reasonColours).filter((reason) => stops.some((row) => row.reason === reason));
  const others = [...new Set(stops.map((row) => row.reason))].filter((reason) => !reasons.includes(reason)).sort();
  const domainOfReasons = [...reasons, ...others];
  const order = new Map(domainOfReasons.map((reason, place) => [reason, place]));
  const sums = new Map();
  const rows = stops.sort((a, b) => order.get(a.reason) - order.get(b.reason)).map((row) => {
    const from = sums.get(row.label) ?? 0;
    sums.set(row.label, from + row.count);
    return {...row, from, to: from + row.count};
  });
  const most = Math.max(...sums.values());
  const bar = {
    type: 'rect', from: {data: 'stops'}, encode: {enter: {
      x: {scale: 'x', field: 'from'}, x2: {scale: 'x', field: 'to'}, yc: {scale: 'y', field: 'label', band: 0.5},
      height: {value: 16}, fill: {scale: 'reason', field: 'reason'},
      tooltip: tooltipOf({'': 'label', reason: 'reason', minimisations: 'count'}),
    }},
  };
  const number = {
    type: 'text', from: {data: 'stops'}, encode: {enter: {
      x: {signal: "(scale('x', datum.from) + scale('x', datum.to)) / 2"},
      y: {scale: 'y', field: 'label', band: 0.5, offset: 19}, text: {field: 'count'}, align: {value: 'center'},
      fontSize: {value: 10}, fill: {value: ink},
    }},
  };
  return {
    id, title, datasets: {stops: rows},
    note: 'Minimisations of the decompression, summed over all replicates of a sweep point. Forces are balanced for ' +
      'residual_reached and for precision_floor, the rounding limit of the residual. The others yield no state.',
    spec: (width) => bandSpec({
      description: 'Minimisations of the decompressions by stop reason.', width,
      labels: data.rows.map((row) => row.label).filter((label) => sums.has(label)), datasets: () => ({stops: rows}),
      x: {domain: [0, most], title: 'minimisations'}, marks: [bar, number], bandHeight: width < 560 ? 66 : 44,
      scales: [{name: 'reason', type: 'ordinal', domain: domainOfReasons,
        range: domainOfReasons.map((reason) => reasonColours[reason] ?? hues.grey)}],
      legends: [{fill: 'reason', symbolType: 'square'}],
    }),
  };
}
