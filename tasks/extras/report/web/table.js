'use strict';

/// Decimals that show two digits of the half width, but at most six digits of the mean.
function decimalsFor({mean, half_width: half}) {
  const scale = half || Math.abs(mean) * 1e-3 || 1e-3;
  const largest = 5 - Math.floor(Math.log10(Math.max(Math.abs(mean), scale)));
  return Math.min(12, Math.max(0, Math.min(1 - Math.floor(Math.log10(scale)), largest)));
}

/// A half width is at least one unit of the last decimal.
function halfWidthText(half, decimals) {
  return Math.max(half, 10 ** -decimals).toFixed(decimals);
}

/// The number of replicates behind an estimate.
const countText = (n) => element('span', {className: 'half-width'}, ` (${n})`);

/// A cell with a mean, the rest of its text, and the number of replicates.
function meanCell(estimate, title, ...texts) {
  const [mean, ...others] = texts;
  return element('td', {title: `${title} over n = ${estimate.n} replicates`}, mean, ...others, countText(estimate.n));
}

const quietText = (text) => element('span', {className: 'half-width'}, text);

/// A proportion with both ends of Wilson's interval, which is not symmetric.
function proportionCell(estimate) {
  const decimals = Math.max(2, decimalsFor(estimate));
  const [low, high] = estimate.ci95.map((end) => end.toFixed(decimals));
  return meanCell(estimate, '95 % confidence interval (Wilson)', estimate.mean.toFixed(decimals), quietText(` [${low}, ${high}]`));
}

/// A small mean and its half width with one power of ten for both.
function smallCell(estimate, half) {
  const {mean} = estimate;
  if (half === null) return meanCell(estimate, 'no confidence interval', formatted(mean, 3));
  const power = Math.floor(Math.log10(Math.abs(mean))), unit = 10 ** power;
  const decimals = decimalsFor({mean: mean / unit, half_width: half / unit});
  return meanCell(estimate, '95 % confidence interval', `(${(mean / unit).toFixed(decimals).replace('-', '−')}`,
    quietText(` ± ${halfWidthText(half / unit, decimals)}`), `)·${powerOfTen(power)}`);
}

function estimateCell(estimate) {
  if (!estimate || estimate.mean === null) return element('td', {title: estimate?.reason ?? 'not measured'}, '–');
  const {mean} = estimate;
  if (estimate.interval === 'wilson' && estimate.ci95) return proportionCell(estimate);
  // What rounding alone leaves of equal numbers is no spread.
  const half = estimate.half_width !== null && estimate.half_width < Math.abs(mean) * 1e-12 ? 0 : estimate.half_width;
  // A count without spread.
  if (!half && Number.isInteger(mean)) return meanCell(estimate, 'equal values', formatted(mean, 6));
  if (half === 0) return meanCell(estimate, 'equal values', formatted(mean, 3), quietText(' equal'));
  if (mean !== 0 && Math.abs(mean) < 1e-3) return smallCell(estimate, half);
  const decimals = decimalsFor(estimate), text = mean.toFixed(decimals).replace('-', '−');
  if (half === null) return meanCell(estimate, 'no confidence interval', text);
  return meanCell(estimate, '95 % confidence interval', text, quietText(` ± ${halfWidthText(half, decimals)}`));
}

/// A column: heading nodes, the value to sort by (number, text or null), the cell of a row.
function leadingColumns({parameters}) {
  const plain = (heading, value, text = false) => ({
    heading: [heading], text, value,
    cell: (row) => element(text ? 'th' : 'td', {className: text ? 'text' : '', ...(text ? {scope: 'row'} : {})},
      formatted(value(row))),
  });
  return [
    plain('solid', (row) => row.solid, true),
    plain(element('i', {}, 'N'), (row) => row.particles),
    ...Object.entries(parameters).map(([name, heading]) => plain(heading, (row) => row.parameters[name] ?? null)),
  ];
}

function countColumn() {
  // Where all that are flagged are excluded, the latter says it.
  const told = (row) => ['failed', ...(row.flagged > row.excluded ? ['flagged'] : []), 'excluded'];
  const reservations = (row) => told(row).filter((name) => row[name] > 0).map((name) => `, ${row[name]} ${name}`)
    .join('');
  return {
    heading: ['replicates'], value: (row) => row.replicates,
    cell: (row) => element('td', {}, String(row.replicates),
      element('span', {className: 'half-width'}, reservations(row))),
  };
}

function estimateColumn(column) {
  return {
    heading: formulaNodes(column.latex), estimate: true, name: column.name, unit: column.unit,
    value: (row) => row[column.name]?.mean ?? null,
    cell: (row) => estimateCell(row[column.name]),
  };
}

function paperColumn() {
  const value = (row) => row.paper?.phi_j ?? null;
  return {
    heading: [...formulaNodes('\\phi_J'), ', paper'], value,
    cell: (row) => (row.paper ? element('td', {}, String(row.paper.phi_j),
      element('span', {className: 'half-width'}, ` ± ${row.paper.half_width}`)) : element('td', {}, '–')),
  };
}

/// A sweep point, and beneath it the same of all replicates if some are excluded.
function rowBody(row, columns) {
  const body = element('tbody', {}, element('tr', {}, ...columns.map((column) => column.cell(row))));
  if (row.all) {
    const cells = columns.map((column, index) => {
      if (index === 0) return element('th', {className: 'text', scope: 'row'}, 'all');
      return column.estimate ? estimateCell(row.all[column.name]) : element('td');
    });
    body.append(element('tr', {className: 'all'}, ...cells));
  }
  return body;
}

/// The leading columns as one, for narrow pages: in the order of the data.
function mergedColumn({rows}) {
  return {
    heading: ['sweep point'], text: true, value: (row) => rows.indexOf(row),
    cell: (row) => element('th', {className: 'text merged', scope: 'row'},
      ...rich(row.label.replaceAll(' = ', '\u00a0=\u00a0'))),
  };
}

function sortableTable(data, columns, caption) {
  const leading = leadingColumns(data);
  return fittedTable({rows: data.rows, columns: [...leading, ...columns], leading: leading.length,
    merged: mergedColumn(data), caption, rowBody});
}

/// A further table of the rows that have `part`, such as the goal. Its columns read this part of a row.
function partTable(data, part, columns, caption) {
  const rows = data.rows.filter((row) => row[part]);
  const leading = leadingColumns(data);
  return fittedTable({rows, columns: [...leading, ...columns], leading: leading.length, merged: mergedColumn(data), caption,
    rowBody: (row, shown) => element('tbody', {}, element('tr', {}, ...shown.map((column) => column.cell(row))))});
}

const textColumn = (heading, value) => ({heading: [heading], value, cell: (row) => element('td', {}, formatted(value(row), 3))});

/// The goal of the stopping rule, and how far each sweep point reached it.
function drawGoal(data, place) {
  if (!data.rows.some(({goal}) => goal)) return;
  const ended = ({goal}) => (goal.met ? 'reached' : goal.needed === null ? 'more replicates needed' : 'not reached');
  place.append(element('h3', {}, 'Goal of the stopping rule'), partTable(data, 'goal', [
    textColumn('quantity', ({goal}) => goal.quantity), textColumn('goal, half width', ({goal}) => goal.aim),
    textColumn('half width', ({goal}) => goal.reached),
    textColumn('half width / goal', ({goal}) => (goal.reached === null ? null : goal.reached / goal.aim)),
    textColumn('replicates used', ({goal}) => goal.needed), textColumn('goal is', ended),
  ], 'Goal of the stopping rule'));
}

/// Paired differences from the base row, of the quantities that the first table has too.
function drawDifferences(data, place) {
  if (!data.base || !data.rows.some(({differences}) => differences)) return;
  const shown = ['phi_j', 'Z', 'Z_ff', 'C'].map((name) => data.columns.find((column) => column.name === name))
    .map((column) => ({...estimateColumn(column), value: (row) => row.differences[column.name]?.mean ?? null,
      cell: (row) => estimateCell(row.differences[column.name])}));
  place.append(element('h3', {}, data.base.replace(/^d/, 'D')),
    partTable(data, 'differences', [textColumn('pairs', ({differences}) => differences.pairs), ...shown], data.base));
}

/// Columns of a group that some row has a value for.
function columnsOf(data, group) {
  const shown = (column) => data.rows.some((row) => (row.all ?? row)[column.name]?.n > 0);
  return data.columns.filter((column) => column.group === group && shown(column));
}

/// Note above the first table.
function exclusionNote(data) {
  const text = exclusionText(data);
  if (text === '') return '';
  return element('p', {className: 'note'}, `${text}. A second line of a row includes all replicates.`);
}

function drawMainTable(data, place) {
  const paper = data.rows.some((row) => row.paper) ? [paperColumn()] : [];
  const [density] = data.columns;
  const contacts = columnsOf(data, density.group).filter((column) => column !== density);
  place.append(exclusionNote(data), sortableTable(data, [estimateColumn(density), ...paper,
    ...contacts.map(estimateColumn), countColumn()], 'Jamming density, contacts, constraints'));
  place.append(element('div', {className: 'controls'}, button('Copy as CSV', () => copy(data.csv)),
    button('Copy as LaTeX', () => copy(data.latex))));
  place.append(element('p', {className: 'note'}, 'Each entry is the mean over replicates ± the half width of its ' +
    '95 % confidence interval (Student t), and in parentheses the number of replicates, for the state nearest jamming. The quantity of a stopping rule has Stein’s ' +
    'interval instead, and a proportion has both ends of Wilson’s. The copies contain all measured ' +
    'quantities; the CSV copy also contains standard deviations and bootstrap intervals.'));
  drawGoal(data, place);
  drawDifferences(data, place);
}

/// The other groups of quantities, if any were measured.
function drawFurtherTables(data, section) {
  const [, ...groups] = [...new Set(data.columns.map((column) => column.group))];
  for (const group of groups) {
    const columns = columnsOf(data, group);
    if (columns.length === 0) continue;
    section.append(element('details', {}, element('summary', {}, group),
      sortableTable(data, columns.map(estimateColumn), group)));
    section.hidden = false;
  }
}
