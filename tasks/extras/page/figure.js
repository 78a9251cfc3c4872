'use strict';

const tooltip = {
  show(event, value) {
    const box = document.getElementById('tooltip');
    const known = Object.entries(value).filter(([, field]) => field !== '' && field !== undefined);
    box.replaceChildren(...known.map(([label, field]) =>
      element('div', {}, label ? element('b', {}, ...rich(label)) : null, formatted(field, 5))));
    box.hidden = false;
    const {width, height} = box.getBoundingClientRect();
    box.style.left = `${Math.max(4, Math.min(event.clientX + 14, innerWidth - width - 4))}px`;
    box.style.top = `${Math.max(4, Math.min(event.clientY + 14, innerHeight - height - 4))}px`;
  },
  hide() { document.getElementById('tooltip').hidden = true; },
};

function handleTooltip(handler, event, item, value) {
  if (value && typeof value === 'object') tooltip.show(event, value);
  else tooltip.hide();
}

const viewOf = (specification, options) =>
  new vega.View(vega.parse(specification), {logLevel: vega.Warn, renderer: 'none', ...options});

/// Saved figures are meant for paper: always on white and at one width.
const savedWidth = 900;

/// A specification for other programs, without typeset mathematics.
const specificationText = (figure) => `${JSON.stringify(figure.spec(savedWidth),
  (key, value) => (typeof value === 'string' ? plainText(value) : value), 1)}\n`;

async function svgText(figure) {
  const view = viewOf({...figure.spec(savedWidth), background: '#ffffff'});
  await view.runAsync();
  const text = await view.toSVG();
  view.finalize();
  const drawing = new DOMParser().parseFromString(text, 'image/svg+xml').documentElement;
  setMathematics(drawing);
  return {text: new XMLSerializer().serializeToString(drawing), width: Number(drawing.getAttribute('width')),
    height: Number(drawing.getAttribute('height'))};
}

/// The drawing as PNG, at twice its size.
async function pngAddress({text, width, height}) {
  const image = new Image();
  image.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(text)}`;
  await image.decode();
  const canvas = element('canvas', {width: 2 * width, height: 2 * height});
  canvas.getContext('2d').drawImage(image, 0, 0, canvas.width, canvas.height);
  return canvas.toDataURL('image/png');
}

async function savePicture(figure, kind) {
  const drawing = await svgText(figure);
  if (kind === 'svg') save(`${figure.id}.svg`, drawing.text, 'image/svg+xml');
  else save(`${figure.id}.png`, await pngAddress(drawing));
}

function chartControls(current) {
  const named = (label, action) => {
    const made = button(label, () => action(current()));
    made.setAttribute('aria-label', `${label}: ${current().title}`);
    return made;
  };
  return element('div', {className: 'controls'},
    named('Save SVG', (figure) => savePicture(figure, 'svg')),
    named('Save PNG', (figure) => savePicture(figure, 'png')),
    named('Save specification', (figure) =>
      save(`${figure.id}.vg.json`, specificationText(figure), 'application/json')),
    named('Save data', (figure) => save(`${figure.id}.csv`, plainText(csvOf(figure.datasets)), 'text/csv')));
}

/// Draws, and redraws if the width changes noticeably or another figure is set in its place.
function drawFigure(first, place) {
  let figure = first, drawn = 0, view = null, waiting = 0;
  const chart = element('div', {className: 'chart', id: `chart-${figure.id}`});
  const caption = element('figcaption', {}, ...rich(figure.note));
  place.append(element('figure', {attributes: {'aria-labelledby': `title-${figure.id}`}},
    element('h3', {id: `title-${figure.id}`}, figure.title), caption, chart, chartControls(() => figure)));
  const draw = async () => {
    const width = chart.clientWidth;
    if (width === 0 || Math.abs(width - drawn) < 8) return;
    drawn = width;
    view?.finalize();
    const spec = figure.spec(width);
    const own = view = viewOf(spec, {renderer: 'svg', container: chart, hover: false, tooltip: handleTooltip});
    await own.runAsync();
    if (own !== view) return;
    const svg = chart.querySelector('svg');
    setMathematics(svg);
    svg.setAttribute('role', 'img');
    svg.setAttribute('aria-label', plainText(spec.description));
    chart.dataset.drawn = 'yes';
  };
  new ResizeObserver(() => {
    clearTimeout(waiting);
    waiting = setTimeout(draw, drawn ? 150 : 0);
  }).observe(chart);
  return {
    set(other) {
      figure = other;
      caption.replaceChildren(...rich(figure.note));
      [drawn, chart.dataset.drawn] = [0, 'no'];
      return draw();
    },
  };
}
