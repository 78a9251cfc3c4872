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

/// A proportion with both ends of Wilson's interval, which is not symmetric.
function proportionCell({mean, ci95, half_width: half, n}) {
  const decimals = Math.max(2, decimalsFor({mean, half_width: half}));
  const [low, high] = ci95.map((end) => end.toFixed(decimals));
  return element('td', {title: `95 % confidence interval (Wilson) over n = ${n} replicates`}, mean.toFixed(decimals),
    element('span', {className: 'half-width'}, ` [${low}, ${high}]`));
}

/// A small mean and its half width with one power of ten for both.
function smallCell(mean, half, n) {
  if (half === null) return element('td', {title: `n = ${n}: no confidence interval`}, formatted(mean, 3));
  const power = Math.floor(Math.log10(Math.abs(mean))), unit = 10 ** power;
  const decimals = decimalsFor({mean: mean / unit, half_width: half / unit});
  return element('td', {title: `95 % confidence interval over n = ${n} replicates`},
    `(${(mean / unit).toFixed(decimals).replace('-', '−')}`,
    element('span', {className: 'half-width'}, ` ± ${halfWidthText(half / unit, decimals)}`), `)·${powerOfTen(power)}`);
}

function estimateCell(estimate) {
  if (!estimate || estimate.mean === null) return element('td', {title: estimate?.reason ?? 'not measured'}, '–');
  const {mean, n} = estimate;
  if (estimate.interval === 'wilson' && estimate.ci95) return proportionCell(estimate);
  // What rounding alone leaves of equal numbers is no spread.
  const half = estimate.half_width !== null && estimate.half_width < Math.abs(mean) * 1e-12 ? 0 : estimate.half_width;
  // A count without spread.
  if (!half && Number.isInteger(mean)) return element('td', {title: `n = ${n}`}, formatted(mean, 6));
  if (half === 0) {
    return element('td', {title: `all ${n} values are equal`}, formatted(mean, 3),
      element('span', {className: 'half-width'}, ' (equal)'));
  }
  if (mean !== 0 && Math.abs(mean) < 1e-3) return smallCell(mean, half, n);
  const decimals = decimalsFor(estimate);
  const text = mean.toFixed(decimals).replace('-', '−');
  if (half === null) return element('td', {title: `n = ${n}: no confidence interval`}, text);
  return element('td', {title: `95 % confidence interval over n = ${n} replicates`}, text,
    element('span', {className: 'half-width'}, ` ± ${halfWidthText(half, decimals)}`));
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
    '95 % confidence interval (Student t), for the state nearest jamming. The quantity of a stopping rule has Stein’s ' +
    'interval instead, and a proportion has both ends of Wilson’s. The copies contain all measured ' +
    'quantities; the CSV copy also contains standard deviations and bootstrap intervals.'));
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
