'use strict';

/// Symbols in the order in which methods come, like the colours of the palette.
const methodShapes = ['circle', 'square', 'triangle-up', 'diamond', 'triangle-down', 'triangle-right', 'stroke'];

const endings = {complete: '', cut: ' Interrupted by the time limit before everything was measured.',
  interrupted: ' Interrupted by a signal before everything was measured.'};

const unique = (values) => [...new Set(values)];

/// Points that a log scale can show: an error of 0 is drawn at the least of the others.
function plotted(family) {
  const errors = family.points.flatMap(({error}) => (error ? [error.median, error.least, error.greatest] : []));
  const positive = errors.filter((value) => value > 0);
  const least = positive.length > 0 ? Math.min(...positive) : 1e-16;
  const shown = (value) => (value > 0 ? value : least);
  return family.points.filter(({seconds}) => seconds).map((point) => ({
    task: point.case, method: point.method, setting: point.setting, stopped: point.stopped, failed: point.failed,
    on_front: point.on_front,
    x: point.seconds.median, x_least: point.seconds.least, x_greatest: point.seconds.greatest,
    seconds_n: point.seconds.n, y: point.error ? shown(point.error.median) : null,
    y_least: point.error ? shown(point.error.least) : null,
    y_greatest: point.error ? shown(point.error.greatest) : null,
    error: point.error?.median ?? null, error_greatest: point.error?.greatest ?? null, error_n: point.error?.n ?? 0,
  }));
}

const pointTooltip = {
  method: 'method', setting: 'setting', stopped: 'stopped', seconds: 'x', 'times, n': 'seconds_n', error: 'error',
  'largest error': 'error_greatest', 'errors, n': 'error_n',
};

const byMethod = {scale: 'colour', field: 'method'};

/// A line of text below the upper edge of a panel gives the reasons for failures. Below it, above a rule, stand failed
/// points without an error, if a family has some.
const reasonLine = 9, edge = 23, edgeHeight = 32, textHeight = 18;

const crossPath = 'M-1,-1L1,1M-1,1L1,-1';

/// Each failure once: at its error or, without an error, at the edge.
function failureMarks(source) {
  return {
    name: `failure_${source}`, type: 'symbol', from: {data: source},
    encode: {enter: {
      x: {scale: 'x', field: 'x'}, shape: {value: crossPath}, size: {value: 44},
      y: [{test: 'isValid(datum.y)', scale: 'y', field: 'y'}, {value: edge}],
      stroke: byMethod, strokeWidth: {value: 1.8}, fill: {value: 'transparent'}, tooltip: tooltipOf(pointTooltip),
    }},
  };
}

/// Reasons of the failed points of a panel, at its upper edge.
function reasonText(failed, width) {
  const plain = (why) => why.replace(/( in \d+ of \d+.*| \d+)$/, '');
  const reasons = unique(failed.flatMap(({stopped}) => stopped.split(', ').map(plain)))
    .filter((why) => !['residual_reached', 'energy_change', 'converged'].includes(why));
  return {type: 'text', encode: {enter: {
    x: {value: 4}, y: {value: reasonLine}, baseline: {value: 'middle'}, fontSize: {value: 10}, fill: {value: ink},
    limit: {value: width - 8}, text: {value: reasons.length > 0 ? `failed: ${reasons.join(', ')}` : ''},
  }}};
}

function edgeLine(width) {
  return {type: 'rule', encode: {enter: {
    x: {value: 0}, x2: {value: width}, y: {value: edgeHeight}, stroke: {value: hues.grey}, strokeDash: {value: [3, 3]},
    strokeWidth: {value: 0.8},
  }}};
}

const bar = (source, position) => ({
  type: 'rule', from: {data: source}, encode: {enter: {
    ...position, stroke: byMethod, strokeWidth: {value: 1}, opacity: {value: 0.6},
  }},
});

function successMarks(source) {
  const y = {scale: 'y', field: 'y'};
  return [
    bar(source, {x: {scale: 'x', field: 'x_least'}, x2: {scale: 'x', field: 'x_greatest'}, y}),
    bar(source, {
      x: {scale: 'x', field: 'x'}, y: {scale: 'y', field: 'y_least'}, y2: {scale: 'y', field: 'y_greatest'},
    }),
    {
      type: 'symbol', from: {data: source},
      encode: {enter: {
        x: {scale: 'x', field: 'x'}, y, shape: {scale: 'shape', field: 'method'}, size: {value: 42}, fill: byMethod,
        stroke: byMethod, fillOpacity: {value: 0.55}, tooltip: tooltipOf(pointTooltip),
      }},
    },
  ];
}

function frontMark(source) {
  return {
    name: `ink_front_${source}`, type: 'line', from: {data: source},
    encode: {enter: {
      x: {scale: 'x', field: 'x'}, y: {scale: 'y', field: 'y'}, stroke: {value: ink}, strokeWidth: {value: 1.2},
      strokeDash: {value: [5, 3]},
    }},
  };
}

const filtered = (name, source, expression, sort) => ({
  name, source, transform: [{type: 'filter', expr: expression},
    ...(sort ? [{type: 'collect', sort: {field: 'x'}}] : [])],
});

/// Height above the scale of errors for the reasons and for failures without an error.
function roomAbove(rows) {
  if (!rows.some(({failed, y}) => failed || y === null)) return 0;
  return rows.some(({y}) => y === null) ? edgeHeight + 4 : textHeight;
}

/// The domain of errors with this height above it.
function errorDomain(rows, height) {
  const [low, high] = domainOf(rows.flatMap(({y, y_least: least, y_greatest: greatest}) => [y, least, greatest]),
    {type: 'log', margin: 0.04}) ?? [1e-16, 1];
  const share = roomAbove(rows) / height;
  return [low, low * (high / low) ** (1 / (1 - share))];
}

/// A row of panels for each solid, as far as they fit.
function panelsPerRow(tasks) {
  const ofFirst = tasks.filter((task) => task.split(',')[0] === tasks[0].split(',')[0]).length;
  return ofFirst === 1 ? 4 : Math.min(4, ofFirst);
}

function familyFigure(family) {
  const rows = plotted(family);
  const id = family.name, title = familyTitles[family.name] ?? family.name;
  const note = family.note + endings[family.ended];
  if (rows.length === 0) return {id, title, absent: `No point was measured.${endings[family.ended]}`};
  const tasks = unique(rows.map(({task}) => task)), methods = unique(rows.map(({method}) => method));
  const height = 244;
  const x = {type: 'log', title: 'seconds', domain: domainOf(rows.flatMap((row) => [row.x_least, row.x_greatest]),
    {type: 'log', margin: 0.06})};
  const y = {type: 'log', title: family.error_is, domain: errorDomain(rows, height)};
  const edged = roomAbove(rows) > textHeight, grid = {least: 240, most: panelsPerRow(tasks)};
  const panelAt = (index, place) => {
    const here = `datum.task === ${JSON.stringify(tasks[index])}`;
    const names = ['good', 'failed', 'front'].map((name) => `${name}_${index}`);
    return panel({
      ...place, title: tasks[index], x, y,
      data: [
        filtered(names[0], 'points', `${here} && !datum.failed && isValid(datum.y)`),
        filtered(names[1], 'points', `${here} && (datum.failed || !isValid(datum.y))`),
        filtered(names[2], 'points', `${here} && datum.on_front`, true),
      ],
      marks: [
        ...(edged ? [edgeLine(place.width)] : []),
        reasonText(rows.filter((row) => row.task === tasks[index] && row.failed), place.width),
        frontMark(names[2]), ...successMarks(names[0]), failureMarks(names[1]),
      ],
    });
  };
  return {
    id, title, note, datasets: {points: rows},
    spec: (width) => panelSpec({
      description: `${title}: error against time on logarithmic scales, a panel for each case.`, width,
      count: tasks.length, height, datasets: {points: rows}, panelAt, grid,
      legends: [{fill: 'colour', shape: 'shape'}],
      scales: [
        {name: 'colour', type: 'ordinal', domain: methods, range: seriesColours},
        {name: 'shape', type: 'ordinal', domain: methods, range: methodShapes},
      ],
    }),
  };
}

const familyTitles = {
  equilibrium: 'Equilibrium', bias: 'Effect on the jamming density', hessian: 'Hessian', modes: 'Lowest modes',
  overlap: 'Overlap of two solids',
};
