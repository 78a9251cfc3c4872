'use strict';

// Tables that are never wider than the page: columns that do not fit stand in further blocks below, each with the
// leading columns again, and all are sorted together.

/// Pixels that the columns need, measured out of sight.
function naturalWidths(columns, rows, rowBody) {
  const head = element('tr', {}, ...columns.map((column) => element('th', {}, ...headingOf(column))));
  const table = element('table', {}, element('thead', {}, head), ...rows.map((row) => rowBody(row, columns)));
  const hidden = element('div', {className: 'measured'}, table);
  document.querySelector('main').append(hidden);
  const widths = [...head.cells].map((cell) => cell.getBoundingClientRect().width);
  hidden.remove();
  return widths;
}

/// What a heading needs beside its text: the arrow that says how the table is sorted.
const headingOf = (column) => [...htmlCopies(column.heading), '\u2002'];
const htmlCopies = (nodes) => nodes.map((node) => (typeof node === 'string' ? node : node.cloneNode(true)));

/// Indices of columns in blocks that fit into `width`, `leading` of them in each.
function greedyBlocks(widths, leading, width) {
  const first = widths.slice(0, leading).reduce((sum, one) => sum + one, 0);
  const blocks = [];
  let left = -1;
  widths.slice(leading).forEach((one, k) => {
    if (left < one) {
      blocks.push([...widths.keys()].slice(0, leading));
      left = width - first;
    }
    blocks.at(-1).push(leading + k);
    left -= one;
  });
  return blocks.length > 0 ? blocks : [[...widths.keys()]];
}

/// As many blocks as there must be, of about the same width.
function evenBlocks(widths, leading, width) {
  let blocks = greedyBlocks(widths, leading, width);
  for (let limit = width - 10; limit > width / 3; limit -= 10) {
    const narrower = greedyBlocks(widths, leading, limit);
    if (narrower.length > blocks.length) break;
    blocks = narrower;
  }
  return blocks;
}

/// Rows without a value stay last whichever way the others are sorted.
function compare(a, b, sign) {
  if (a === null || b === null) return (a === null) - (b === null);
  if (typeof a === 'number' && typeof b === 'number') return sign * (a - b);
  return sign * (String(a) < String(b) ? -1 : Number(String(a) > String(b)));
}

/// A block: its table, and what sorts it.
function tableBlock(columns, rows, {caption, rowBody, onSort}) {
  const headings = columns.map((column) => {
    const unit = column.unit && column.unit !== '1' ? `, in ${column.unit}` : '';
    const sorter = element('button', {type: 'button', title: `Sort by this column${unit}`},
      ...htmlCopies(column.heading));
    sorter.addEventListener('click', () => onSort(column));
    return element('th', {className: column.text ? 'text' : '', scope: 'col', attributes: {'aria-sort': 'none'}},
      sorter);
  });
  const bodies = new Map(rows.map((row) => [row, rowBody(row, columns)]));
  const table = element('table', {attributes: {'aria-label': caption}},
    element('thead', {}, element('tr', {}, ...headings)), ...bodies.values());
  return {
    table,
    sort(order, by, direction) {
      headings.forEach((heading, k) => heading.setAttribute('aria-sort', columns[k] === by ? direction : 'none'));
      table.append(...order.map((row) => bodies.get(row)));
    },
  };
}

/// Which columns stand for the leading ones: themselves, or one where they would take most of the width.
function chosenColumns({rows, columns, leading, merged, rowBody}, width) {
  const widths = naturalWidths(columns, rows, rowBody);
  const sum = (list) => list.reduce((total, one) => total + one, 0);
  if (sum(widths) <= width || sum(widths.slice(0, leading)) <= width * 0.4)
    return {shown: columns, widths, first: leading};
  const shown = [merged, ...columns.slice(leading)], others = naturalWidths(shown, rows, rowBody);
  // Its text may be broken.
  const room = Math.max(90, Math.min(width * 0.4, width - Math.max(...others.slice(1))));
  return {shown, widths: [Math.min(others[0], room), ...others.slice(1)], first: 1};
}

const fittedTables = [];

/// A table of `rows` with `columns` ({heading, value, text, unit, ...}), made by `rowBody(row, columns)`; where the
/// `leading` columns would take most of the width `merged` stands for them.
function fittedTable(parts) {
  const place = element('div', {className: 'fitted'});
  let by = null, direction = 'none', drawn = 0, blocks = [];
  const sort = () => {
    const sign = direction === 'ascending' ? 1 : -1;
    const order = by ? [...parts.rows].sort((a, b) => compare(by.value(a), by.value(b), sign)) : parts.rows;
    for (const block of blocks) block.sort(order, by, direction);
  };
  const onSort = (column) => {
    direction = by === column && direction === 'ascending' ? 'descending' : 'ascending';
    by = column;
    sort();
  };
  const fit = (width = place.clientWidth) => {
    if (width <= 0 || Math.abs(width - drawn) <= 1) return;
    drawn = width;
    const {shown, widths, first} = chosenColumns(parts, width);
    blocks = evenBlocks(widths, first, width).map((block) =>
      tableBlock(block.map((index) => shown[index]), parts.rows, {...parts, onSort}));
    place.replaceChildren(...blocks.map(({table}) => table));
    sort();
  };
  fit(document.getElementById('table').clientWidth);
  new ResizeObserver(() => fit()).observe(place);
  fittedTables.push(fit);
  return place;
}

/// What a sheet of paper is wide, in pixels of the page.
const paperWidth = 690;
addEventListener('beforeprint', () => fittedTables.forEach((fit) => fit(paperWidth)));
addEventListener('afterprint', () => fittedTables.forEach((fit) => fit()));
