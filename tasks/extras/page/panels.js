'use strict';

// Small multiples as complete Vega specifications: one group mark per panel, all with the same scales.

/// Okabe and Ito's colours, which can be distinguished with any colour vision, and symbols for prints in black. The
/// palette is that of all pages and of the Python module.
const hues = palette.colours, seriesColours = palette.series.map((name) => hues[name]);
const solidColours = {}, solidShapes = {};

/// Assigns a colour and a symbol to these solids; other solids than those of the palette get them in this order.
function nameSolids(names) {
  const others = names.filter((name) => !(name in palette.solids));
  for (const name of names) {
    const {colour, symbol} = palette.solids[name] ?? palette.others[others.indexOf(name) % palette.others.length];
    [solidColours[name], solidShapes[name]] = [hues[colour], symbol];
  }
}

/// On dark paper, dark colours are lighter.
document.head.append(Object.assign(document.createElement('style'), {textContent: `@media screen and (prefers-color-scheme: dark) {
${Object.entries(palette.dark).map(([name, colour]) => `.chart [fill="${hues[name]}"] { fill: ${colour}; }
  .chart [stroke="${hues[name]}"] { stroke: ${colour}; }`).join('\n')}}`}));

const ink = '#222222', faint = '#d9d8d2';

const chartConfig = {
  background: null,
  font: 'system-ui, "Segoe UI", "Noto Sans", "DejaVu Sans", sans-serif',
  axis: {
    domainColor: hues.grey, tickColor: hues.grey, gridColor: faint, gridOpacity: 0.6, labelColor: ink, titleColor: ink,
    labelFontSize: 11, titleFontSize: 12, titleFontWeight: 'normal', titlePadding: 6, tickSize: 4,
    labelSeparation: 3, labelFlush: 5,
  },
  title: {color: ink, fontSize: 12, fontWeight: 600, anchor: 'start', offset: 6},
  legend: {labelColor: ink, titleColor: ink, labelFontSize: 11, titleFontSize: 11, labelLimit: 320},
};

/// Four to eight round numbers, evenly spaced.
function evenTicks([low, high]) {
  const rough = (high - low) / 8;
  const decade = 10 ** Math.floor(Math.log10(rough));
  const step = decade * [1, 2, 5, 10].find((digit) => digit * decade >= rough);
  const ticks = [];
  for (let k = Math.ceil(low / step); k * step <= high; k += 1) ticks.push(Number((k * step).toPrecision(6)));
  return ticks;
}

/// Decades, or 1, 2, 5 of each if there are few.
function logTicks([low, high]) {
  const [first, last] = [Math.floor(Math.log10(low)), Math.ceil(Math.log10(high))];
  const decades = Math.log10(high / low);
  if (decades < 0.9) return evenTicks([low, high]);
  const digits = decades > 2.3 ? [1] : [1, 2, 5];
  const step = Math.max(1, Math.ceil(decades / 6));
  const ticks = [];
  for (let power = first; power <= last; power += 1) {
    if ((power - last) % step === 0) ticks.push(...digits.map((digit) => Number(`${digit}e${power}`)));
  }
  return ticks.filter((tick) => tick >= low * 0.999 && tick <= high * 1.001);
}

function logAxis(domain) {
  const values = logTicks(domain);
  const plain = values.every((value) => value >= 1e-3 && value < 1e5);
  const text = (value) => (plain ? String(value) : powerOfTen(Math.round(Math.log10(value))));
  const texts = Object.fromEntries(values.map((value) => [value, text(value)]));
  return {values, labelOverlap: 'greedy', encode: {labels: {update: {text: {
    signal: `(${JSON.stringify(texts)})[datum.value] || ''`}}}}};
}

/// The range of values with a margin, logarithmic for a log scale; null without values.
function domainOf(values, {type = 'linear', margin = 0.05} = {}) {
  const usable = values.filter((value) => typeof value === 'number' && (type !== 'log' || value > 0));
  if (usable.length === 0) return null;
  const map = type === 'log' ? Math.log : (x) => x;
  const back = type === 'log' ? Math.exp : (x) => x;
  let [low, high] = [Infinity, -Infinity];
  for (const value of usable) [low, high] = [Math.min(low, map(value)), Math.max(high, map(value))];
  const room = (high - low) * margin || (type === 'log' ? 0.5 : Math.abs(high) * 0.05 || 1);
  return [back(low - room), back(high + room)];
}

/// Number of columns of panels that fit, and the width of each, with `left` and `right` pixels for labels.
function panelGrid(width, panels, {least = 215, most = 4, widest = Infinity, left = 76, right = 26, gap = 18} = {}) {
  const fits = Math.floor((width - left + gap) / (least + gap));
  const columns = Math.max(1, Math.min(most, panels, fits));
  return {columns, width: Math.min(widest, Math.floor((width - left - right - gap * (columns - 1)) / columns))};
}

function panelAxes({x, y}, {showX, showY}) {
  const axis = (orient, scale, {type, domain, title, format, ticks}, labelled) => ({
    orient, scale, grid: true, ...(format ? {format} : {}),
    ...(type === 'log' ? logAxis(domain) : {tickCount: ticks ?? 5}),
    ...(labelled ? {title} : {labels: false, ticks: false}),
  });
  return [axis('bottom', 'x', x, showX), axis('left', 'y', y, showY)];
}

/// Breaks a text into lines of at most `most` characters if its words allow it; "N = 28" counts as one word.
function wrapped(text, most) {
  const lines = [];
  for (const word of text.replaceAll(' = ', '\u00a0=\u00a0').split(' ')) {
    const last = lines.at(-1);
    if (last !== undefined && last.length + 1 + word.length <= most) lines[lines.length - 1] = `${last} ${word}`;
    else lines.push(word);
  }
  return lines.map((line) => line.replaceAll('\u00a0', ' '));
}

/// One panel: its own scales of the common domains, with the marks inside.
function panel({title, width, height, x, y, data = [], marks, showX = true, showY = true}) {
  const scale = (name, range, {type = 'linear', domain}) => ({name, type, domain, range, zero: false, clamp: false});
  return {
    type: 'group',
    ...(title ? {title: {text: wrapped(title, width / 6.9), limit: width, frame: 'group'}} : {}),
    encode: {enter: {width: {value: width}, height: {value: height}}},
    signals: [{name: 'width', value: width}, {name: 'height', value: height}],
    scales: [scale('x', [0, width], x), scale('y', [height, 0], y)],
    data, axes: panelAxes({x, y}, {showX, showY}), marks,
  };
}

/// Width of a legend entry in pixels. Vega also reserves space for the unformatted text of formulae.
const entryWidth = (text) => 30 + 6.6 * text.length;

/// Legends above the chart with entries `texts`: side by side if they fit, otherwise one below the other.
function placedLegends(legends, scales, width) {
  const widths = [];
  const placed = legends.map(({texts, longSymbol = false, ...legend}) => {
    const scale = legend.fill ?? legend.stroke ?? legend.shape ?? legend.strokeDash;
    const {domain} = scales.find(({name}) => name === scale);
    const entries = domain.map((value) => entryWidth(texts?.[value] ?? String(value)) + (longSymbol ? 32 : 0));
    const sum = entries.reduce((total, one) => total + one, legend.title ? 20 : 0);
    widths.push(sum);
    const columns = sum <= width ? 0 : Math.max(1, Math.floor(width / Math.max(...entries)));
    const labels = texts ? {encode: {labels: {update: {text: {
      signal: `(${JSON.stringify(texts)})[datum.value]`}}}}} : {};
    return {orient: 'top', direction: 'horizontal', columns, ...labels, ...legend};
  });
  return {legends: placed, beside: widths.reduce((total, one) => total + one + 14, 0) <= width};
}

/// Configuration of a chart whose legends are side by side or one below the other.
const configFor = (beside) => ({
  ...chartConfig,
  legend: {...chartConfig.legend, layout: {top: {direction: beside ? 'horizontal' : 'vertical', anchor: 'start'}}},
});

/// A specification of panels in a grid. `panelsOf(grid)` is called with the position of each panel.
function panelSpec({description, width, count, height = 190, datasets, legends = [], scales = [], panelAt, grid = {}}) {
  const {columns, width: panelWidth} = panelGrid(width, count, grid);
  const marks = [];
  for (let index = 0; index < count; index += 1) {
    marks.push(panelAt(index, {
      width: panelWidth, height, showY: index % columns === 0, // Below each other, the labels of the last panel would be screens away from the first.
      showX: columns === 1 || index + columns >= count,
    }));
  }
  const {legends: placed, beside} = placedLegends(legends, scales, width - 84);
  return {
    $schema: 'https://vega.github.io/schema/vega/v5.json', description, padding: 4, config: configFor(beside),
    scales, legends: placed,
    data: Object.entries(datasets).map(([name, values]) => ({name, values})),
    layout: {columns, bounds: 'full', align: 'all', padding: {row: 16, column: 12}},
    marks,
  };
}

/// Rows of a data set that belong to a panel, under a separate name.
const rowsOf = (source, index) => ({
  name: `${source}_${index}`, source, transform: [{type: 'filter', expr: `datum.row === ${index}`}],
});

/// A tooltip: the fields named, as an object; see charts.js.
function tooltipOf(fields) {
  const entries = Object.entries(fields).map(([label, field]) =>
    `${JSON.stringify(label)}: datum[${JSON.stringify(field)}]`);
  return {signal: `{${entries.join(', ')}}`};
}

/// A mark's name becomes a class of its elements, by which the style sheet recolours ink. Names are unique.
const styled = (style, type, from) => (style ? {name: `${style}_${type}_${from}`} : {});

const inPanel = (fieldX, fieldY) => ({x: {scale: 'x', field: fieldX}, y: {scale: 'y', field: fieldY}});

function points(from, x, y, {colour, shape = 'circle', size = 30, hollow = 'false', tooltip, opacity = 1, style}) {
  return {
    type: 'symbol', from: {data: from}, clip: true, ...styled(style, 'symbol', from),
    encode: {enter: {
      ...inPanel(x, y), size: {value: size}, shape: typeof shape === 'string' ? {value: shape} : shape,
      fill: [{test: hollow, value: 'transparent'}, colour], stroke: colour, strokeWidth: {value: 1.3},
      opacity: {value: opacity}, ...(tooltip ? {tooltip: tooltipOf(tooltip)} : {}),
    }},
  };
}

/// A line for each value of `by`, in the order of the rows, interrupted where the test `defined` fails.
function lines(from, x, y, {by, colour, width = 1.3, dash = [], opacity = 1, style, step = false, defined = 'true'}) {
  return {
    type: 'group', from: {facet: {name: `${from}_${by}`, data: from, groupby: by}},
    encode: {enter: {width: {signal: 'width'}, height: {signal: 'height'}}},
    marks: [{
      type: 'line', clip: true, from: {data: `${from}_${by}`}, ...styled(style, 'line', from),
      encode: {enter: {
        ...inPanel(x, y), stroke: colour, strokeWidth: {value: width}, strokeDash: {value: dash},
        opacity: {value: opacity}, interpolate: {value: step ? 'step-after' : 'linear'},
        defined: {signal: defined},
      }},
    }],
  };
}

/// A vertical bar from `low` to `high`.
function errorBars(from, x, low, high, {colour, style}) {
  return {
    type: 'rule', from: {data: from}, clip: true, ...styled(style, 'rule', from),
    encode: {enter: {
      x: {scale: 'x', field: x}, y: {scale: 'y', field: low}, y2: {scale: 'y', field: high},
      stroke: colour, strokeWidth: {value: 1.5},
    }},
  };
}
