'use strict';

const columns = [
  ['case', ({case: task}) => task], ['method', ({method}) => method], ['setting', ({setting}) => setting],
  ['seconds', ({seconds}) => formatted(seconds?.median, 3)], ['n', ({seconds}) => formatted(seconds?.n)],
  ['error', ({error}) => formatted(error?.median, 3)], ['largest', ({error}) => formatted(error?.greatest, 3)],
  ['n', ({error}) => formatted(error?.n)], ['stopped', ({stopped}) => stopped],
];

/// Names of further numbers in a family's points.
const furtherNames = (family) => [...new Set(family.points.flatMap(({further}) => Object.keys(further)))];

function pointTable(family) {
  const further = furtherNames(family).map((name) => [name, (point) => formatted(point.further[name], 3)]);
  const all = [...columns, ...further];
  const isText = (name) => ['case', 'method', 'setting', 'stopped'].includes(name);
  const head = element('tr', {}, ...all.map(([name]) =>
    element('th', {className: isText(name) ? 'text' : '', attributes: {scope: 'col'}}, name)));
  const rows = family.points.map((point) => element('tr', {}, ...all.map(([name, value]) => {
    const failed = name === 'stopped' && point.failed ? ' failed' : '';
    return element('td', {className: (isText(name) ? 'text' : '') + failed}, failed ? 'failed: ' : '', value(point));
  })));
  return element('details', {className: 'points'}, element('summary', {}, `${family.points.length} points`),
    element('div', {className: 'scroll'}, element('table', {}, element('thead', {}, head),
      element('tbody', {}, ...rows))));
}

function drawFamily(family, place) {
  const figure = familyFigure(family);
  const section = element('section', {});
  place.append(section);
  if (figure.absent) {
    section.append(element('h3', {}, figure.title), element('p', {className: 'note'}, figure.absent));
    return;
  }
  drawFigure(figure, section);
  section.append(pointTable(family));
}

{
  const data = JSON.parse(document.getElementById('data').textContent);
  const {version, git, compiler} = data.program;
  document.getElementById('origin').textContent = `isojam ${version} (git ${git}), ${compiler}, one thread.`;
  for (const family of data.families) drawFamily(family, document.getElementById('charts'));
  if (data.atlas) drawAtlas(data.atlas, document.getElementById('atlas'));
  addEventListener('beforeprint', () => document.querySelectorAll('details').forEach((part) => { part.open = true; }));
  document.documentElement.dataset.ready = 'yes';
}
