'use strict';

// Growth of costs with the number of particles: a panel for each solid, a line for each timed quantity, both axes
// logarithmic, with the fitted power beside its line.

/// "N^1.62 ± 0.10" in plain text, whose minus and superscripts every font has.
function powerLabel({exponent, half_width: half}) {
  return `∝ N^${exponent.toFixed(2)}${half === null ? '' : ` ± ${half.toFixed(2)}`}`;
}

function growthRows(family) {
  return family.points.filter(({seconds}) => seconds).map(({case: task, method, setting, seconds, stopped, failed, further}) => ({
    task, method, setting, failed, stopped, particles: further.particles, x: seconds.median, x_least: seconds.least,
    x_greatest: seconds.greatest, seconds_n: seconds.n,
  }));
}

/// Both ends of every fitted line, and the label at the right one.
function growthLines(family, rows) {
  return family.fits.flatMap((fit) => {
    const sizes = rows.filter(({task, method}) => task === fit.case && method === fit.method)
      .map(({particles}) => particles);
    const ends = [Math.min(...sizes), Math.max(...sizes)];
    return ends.map((particles, index) => ({
      task: fit.case, method: fit.method, particles, seconds: fit.prefactor * particles ** fit.exponent,
      power: index === 1 ? powerLabel(fit) : '',
    }));
  });
}

const growthTooltip = {
  'quantity timed': 'method', particles: 'particles', seconds: 'x', least: 'x_least', greatest: 'x_greatest',
  'times, n': 'seconds_n', stopped: 'stopped',
};

const sizeX = {scale: 'x', field: 'particles'};

function growthMarks(index) {
  const symbol = (name, shape, extra) => ({
    type: 'symbol', from: {data: name}, encode: {enter: {
      x: sizeX, y: {scale: 'y', field: 'x'}, size: {value: 46}, stroke: byMethod, shape,
      tooltip: tooltipOf(growthTooltip), ...extra,
    }},
  });
  return [
    lines(`fits_${index}`, 'particles', 'seconds', {by: 'method', colour: byMethod}),
    {
      type: 'rule', from: {data: `sizes_${index}`}, encode: {enter: {
        x: sizeX, y: {scale: 'y', field: 'x_least'}, y2: {scale: 'y', field: 'x_greatest'}, stroke: byMethod,
      }},
    },
    symbol(`good_sizes_${index}`, {scale: 'shape', field: 'method'}, {fill: byMethod, fillOpacity: {value: 0.55}}),
    symbol(`failed_sizes_${index}`, {value: crossPath}, {fill: {value: 'transparent'}, strokeWidth: {value: 1.8}}),
    {
      name: `power_${index}`, type: 'text', from: {data: `fits_${index}`}, encode: {enter: {
        x: sizeX, dx: {value: -4}, y: {scale: 'y', field: 'seconds'}, dy: {value: -9}, align: {value: 'right'},
        baseline: {value: 'bottom'}, fontSize: {value: 11}, fill: {value: ink}, text: {field: 'power'},
      }},
    },
  ];
}

function growthFigure(family) {
  const rows = growthRows(family);
  const id = family.name, title = familyTitles[id];
  if (rows.length === 0) return {id, title, absent: `No point was measured.${endings[family.ended]}`};
  const fits = growthLines(family, rows);
  const tasks = unique(rows.map(({task}) => task)), methods = unique(rows.map(({method}) => method));
  const seconds = [...rows.flatMap((row) => [row.x_least, row.x_greatest]), ...fits.map((fit) => fit.seconds)];
  const x = {type: 'log', title: 'particles, N', domain: domainOf(rows.map(({particles}) => particles), {type: 'log', margin: 0.08})};
  const y = {type: 'log', title: 'seconds', domain: domainOf(seconds, {type: 'log', margin: 0.08})};
  const panelAt = (index, place) => {
    const here = `datum.task === ${JSON.stringify(tasks[index])}`;
    return panel({
      ...place, title: tasks[index], x, y, showX: true,
      data: [filtered(`sizes_${index}`, 'sizes', here), filtered(`good_sizes_${index}`, 'sizes', `${here} && !datum.failed`),
        filtered(`failed_sizes_${index}`, 'sizes', `${here} && datum.failed`), filtered(`fits_${index}`, 'fits', here)],
      marks: growthMarks(index),
    });
  };
  return {
    id, title, note: family.note + endings[family.ended], datasets: {sizes: rows, fits},
    spec: (width) => panelSpec({
      description: `${title}: seconds against the number of particles on logarithmic scales, a panel for each solid.`,
      width, count: tasks.length, height: 300, datasets: {sizes: rows, fits}, panelAt,
      grid: {least: 240, most: tasks.length === 1 ? 2 : Math.min(4, tasks.length)},
      legends: [{fill: 'colour', shape: 'shape'}],
      scales: [
        {name: 'colour', type: 'ordinal', domain: methods, range: seriesColours},
        {name: 'shape', type: 'ordinal', domain: methods, range: methodShapes},
      ],
    }),
  };
}
