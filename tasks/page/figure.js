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

/// Figures are saved for paper, whatever the screen: on white, at one width.
const savedWidth = 900;

async function savePicture(figure, kind) {
  const view = viewOf({...figure.spec(savedWidth), background: '#ffffff'});
  await view.runAsync();
  if (kind === 'svg') save(`${figure.id}.svg`, await view.toSVG(), 'image/svg+xml');
  else save(`${figure.id}.png`, await view.toImageURL('png', 2));
  view.finalize();
}

function chartControls(figure) {
  const named = (label, action) => {
    const made = button(label, action);
    made.setAttribute('aria-label', `${label}: ${figure.title}`);
    return made;
  };
  return element('div', {className: 'controls'},
    named('Save SVG', () => savePicture(figure, 'svg')),
    named('Save PNG', () => savePicture(figure, 'png')),
    named('Save specification', () => save(`${figure.id}.vg.json`,
      `${JSON.stringify(figure.spec(savedWidth), null, 1)}\n`, 'application/json')),
    named('Save data', () => save(`${figure.id}.csv`, csvOf(figure.datasets), 'text/csv')));
}

/// Draws, and draws again when the width changes by what a reader would see.
function drawFigure(figure, place) {
  const chart = element('div', {className: 'chart', id: `chart-${figure.id}`});
  place.append(element('figure', {attributes: {'aria-labelledby': `title-${figure.id}`}},
    element('h3', {id: `title-${figure.id}`}, figure.title), element('figcaption', {}, ...rich(figure.note)), chart,
    chartControls(figure)));
  let drawn = 0, view = null;
  const draw = async () => {
    const width = chart.clientWidth;
    if (width === 0 || Math.abs(width - drawn) < 8) return;
    drawn = width;
    view?.finalize();
    view = viewOf(figure.spec(width), {renderer: 'svg', container: chart, hover: false, tooltip: handleTooltip});
    await view.runAsync();
    chart.querySelector('svg').setAttribute('role', 'img');
    chart.querySelector('svg').setAttribute('aria-label', figure.spec(width).description);
    chart.dataset.drawn = 'yes';
  };
  let waiting = 0;
  new ResizeObserver(() => {
    clearTimeout(waiting);
    waiting = setTimeout(draw, drawn ? 150 : 0);
  }).observe(chart);
}
