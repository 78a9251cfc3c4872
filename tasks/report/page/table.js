'use strict';

const greek = {phi: 'φ', omega: 'ω', langle: '⟨', rangle: '⟩'};

/// Nodes of a column's LaTeX name: letters, Greek macros, _x, _{xy}, ^{xy}.
function symbolNodes(latex) {
  const plain = latex.replace(/\\([a-z]+)/gi, (whole, macro) => greek[macro] ?? whole);
  const nodes = [];
  for (const part of plain.matchAll(/([_^])(?:\{([^{}]*(?:_[^{}])?[^{}]*(?:\{[^{}]*\})?)\}|(.))|([^_^]+)/g)) {
    if (part[4]) nodes.push(element('i', {}, part[4]));
    else nodes.push(element(part[1] === '_' ? 'sub' : 'sup', {}, (part[2] ?? part[3]).replace(/[_{}]/g, '')));
  }
  return nodes;
}

/// Decimals that show the half width with two digits.
function decimalsFor(estimate) {
  const scale = estimate.half_width || Math.abs(estimate.mean) * 1e-3 || 1e-3;
  return Math.min(12, Math.max(0, 1 - Math.floor(Math.log10(scale))));
}

function estimateCell(estimate) {
  if (!estimate || estimate.mean === null) return element('td', {title: estimate?.reason ?? 'not measured'}, '–');
  const {mean, half_width: half, n} = estimate;
  // A count without spread.
  if (!half && Number.isInteger(mean)) return element('td', {title: `n = ${n}`}, formatted(mean, 6));
  if (half === 0 || (mean !== 0 && Math.abs(mean) < 1e-3)) {
    return element('td', {title: `n = ${n}`}, formatted(mean, 3), half === null ? null :
      element('span', {className: 'half-width'}, ` ± ${formatted(half, 2)}`));
  }
  const decimals = decimalsFor(estimate);
  const text = mean.toFixed(decimals).replace('-', '−');
  if (half === null) return element('td', {title: `n = ${n}: no interval`}, text);
  return element('td', {title: `95 % interval over n = ${n} replicates`}, text,
    element('span', {className: 'half-width'}, ` ± ${half.toFixed(decimals)}`));
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
    plain('N', (row) => row.particles),
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
    heading: symbolNodes(column.latex), estimate: true, name: column.name, unit: column.unit,
    value: (row) => row[column.name]?.mean ?? null,
    cell: (row) => estimateCell(row[column.name]),
  };
}

function paperColumn() {
  const value = (row) => row.paper?.phi_j ?? null;
  return {
    heading: [...symbolNodes('\\phi_J'), ', paper'], value,
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

/// Rows without a value stay last whichever way the others are sorted.
function compare(a, b, sign) {
  if (a === null || b === null) return (a === null) - (b === null);
  if (typeof a === 'number' && typeof b === 'number') return sign * (a - b);
  return sign * (String(a) < String(b) ? -1 : Number(String(a) > String(b)));
}

function sortBy(table, bodies, column, heading) {
  const ascending = heading.getAttribute('aria-sort') !== 'ascending';
  for (const other of table.tHead.rows[0].cells) other.setAttribute('aria-sort', 'none');
  heading.setAttribute('aria-sort', ascending ? 'ascending' : 'descending');
  const sorted = [...bodies].sort((a, b) => compare(column.value(a.row), column.value(b.row), ascending ? 1 : -1));
  table.append(...sorted.map(({body}) => body));
}

function sortableTable(rows, columns, caption) {
  const head = element('tr');
  const table = element('table', {attributes: {'aria-label': caption}}, element('thead', {}, head));
  const bodies = rows.map((row) => ({row, body: rowBody(row, columns)}));
  for (const column of columns) {
    const unit = column.unit && column.unit !== '1' ? `, in ${column.unit}` : '';
    const sorter = element('button', {type: 'button', title: `Sort by this column${unit}`}, ...column.heading);
    const heading = element('th', {className: column.text ? 'text' : '', scope: 'col',
      attributes: {'aria-sort': 'none'}}, sorter);
    sorter.addEventListener('click', () => sortBy(table, bodies, column, heading));
    head.append(heading);
  }
  table.append(...bodies.map(({body}) => body));
  return element('div', {className: 'scroll'}, table);
}

/// Columns of a group that some row has a value for.
function columnsOf(data, group) {
  const shown = (column) => data.rows.some((row) => (row.all ?? row)[column.name]?.n > 0);
  return data.columns.filter((column) => column.group === group && shown(column));
}

/// What the tables' first lines leave out.
function exclusionNote(data) {
  const text = exclusionText(data);
  if (text === '') return null;
  return element('p', {className: 'note'}, `Means are ${text}; a second line, where there is one, is of all.`);
}

function drawMainTable(data, place) {
  const leading = leadingColumns(data);
  const paper = data.rows.some((row) => row.paper) ? [paperColumn()] : [];
  const [density] = data.columns;
  const contacts = columnsOf(data, density.group).filter((column) => column !== density);
  place.append(exclusionNote(data) ?? '', sortableTable(data.rows, [...leading, estimateColumn(density), ...paper,
    ...contacts.map(estimateColumn), countColumn()], 'Jamming density, contacts, constraints'));
  place.append(element('div', {className: 'controls'}, button('Copy as CSV', () => copy(data.csv)),
    button('Copy as LaTeX', () => copy(data.latex))));
  place.append(element('p', {className: 'note'}, 'Means over replicates with 95 % intervals (Student t) of the state ' +
    'nearest jamming. Both copies hold every quantity measured, with standard deviations and bootstrap intervals.'));
}

/// The other groups of quantities, if any were measured.
function drawFurtherTables(data, section) {
  const [, ...groups] = [...new Set(data.columns.map((column) => column.group))];
  for (const group of groups) {
    const columns = columnsOf(data, group);
    if (columns.length === 0) continue;
    section.append(element('details', {}, element('summary', {}, group),
      exclusionNote(data), sortableTable(data.rows, [...leadingColumns(data), ...columns.map(estimateColumn)], group)));
    section.hidden = false;
  }
}
