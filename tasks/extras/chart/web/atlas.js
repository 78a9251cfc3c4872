'use strict';

/// Verdicts are shown by sign and word; colour is additional.
const verdictSigns = {holds: '✓', refuses: '–', fails: '✗'};

const groupedBy = (rows, key) => {
  const groups = new Map();
  for (const row of rows) {
    if (!groups.has(row[key])) groups.set(row[key], []);
    groups.get(row[key]).push(row);
  }
  return [...groups];
};

const count = (rows, verdict) => rows.filter((row) => row.verdict === verdict).length;

const countsText = (rows) =>
  `${count(rows, 'holds')} cells hold, ${count(rows, 'refuses')} refuse, ${count(rows, 'fails')} fail. `;

/// Prevents a line break at the sign of a number.
const unbroken = (text) => text.replaceAll('-', '\u2011');

function atlasCell(row) {
  const text = `${row.verdict}: ${row.figure}; ${row.reason}`;
  const cell = element('td', {className: `cell ${row.verdict}`},
    element('span', {attributes: {'aria-hidden': 'true'}}, verdictSigns[row.verdict]),
    element('span', {className: 'unseen'}, text));
  const shown = {setting: row.setting, verdict: row.verdict, measured: row.figure, reason: row.reason};
  cell.addEventListener('mousemove', (event) => tooltip.show(event, shown));
  cell.addEventListener('mouseleave', () => tooltip.hide());
  return cell;
}

/// A row of settings, and below it a row of cells for each method.
function regimeTable(regime, rows) {
  const settings = [...new Set(rows.map(({setting}) => setting))];
  const head = element('tr', {}, element('th', {className: 'text', attributes: {scope: 'col'}}, ''),
    ...settings.map((setting) => element('th', {attributes: {scope: 'col'}}, unbroken(setting))));
  const body = groupedBy(rows, 'method').map(([method, cells]) => element('tr', {},
    element('th', {className: 'text', attributes: {scope: 'row'}}, cells[0].standard ? `${method}\u00a0*` : method),
    ...settings.map((setting) => {
      const row = cells.find((cell) => cell.setting === setting);
      return row ? atlasCell(row) : element('td', {}, '');
    })));
  return element('div', {className: settings.length > 8 ? 'scroll regime wide' : 'scroll regime'}, element('table', {}, element('caption', {}, ...rich(regime)),
    element('thead', {}, head), element('tbody', {}, ...body)));
}

const cellColumns = ['regime', 'method', 'setting', 'verdict', 'figure', 'reason'];

/// Every figure and reason as text.
function cellList(label, rows) {
  const head = element('tr', {}, ...cellColumns.map((name) =>
    element('th', {className: 'text', attributes: {scope: 'col'}}, name)));
  const body = rows.map((row) => element('tr', {}, ...cellColumns.map((name) =>
    element('td', {className: name === 'verdict' ? `text ${row.verdict}` : 'text'}, ...rich(row[name])))));
  return element('details', {}, element('summary', {}, label), element('div', {className: 'scroll'},
    element('table', {className: 'cells'}, element('thead', {}, head), element('tbody', {}, ...body))));
}

function drawAtlas(atlas, place) {
  place.hidden = false;
  place.append(element('p', {className: 'note'}, countsText(atlas.rows),
    'Each regime has one difficulty, which increases from left to right. ✓ (holds): the result is right. – (refuses): ',
    'the method ends with a reason instead of a result. ✗ (fails): the result is wrong or missing. * marks the ',
    'methods of isojam.',
    endings[atlas.ended]));
  const other = atlas.rows.filter(({verdict}) => verdict !== 'holds');
  place.append(element('div', {className: 'regimes'},
    ...groupedBy(atlas.rows, 'regime').map(([regime, rows]) => regimeTable(regime, rows))),
    cellList(`The ${other.length} cells that refuse or fail, with reasons`, other),
    cellList(`The ${atlas.rows.length - other.length} cells that hold`,
      atlas.rows.filter(({verdict}) => verdict === 'holds')));
}
