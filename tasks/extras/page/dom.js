'use strict';

/// An element with properties, attributes (`attributes`) and children. Texts become text nodes, never markup.
function element(name, options = {}, ...children) {
  const {attributes = {}, ...properties} = options;
  const made = Object.assign(document.createElement(name), properties);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  made.append(...children.filter((child) => child !== null && child !== undefined));
  return made;
}

const raised = {0: '⁰', 1: '¹', 2: '²', 3: '³', 4: '⁴', 5: '⁵', 6: '⁶', 7: '⁷', 8: '⁸', 9: '⁹', '-': '⁻', '/': 'ᐟ'};

/// The letters of a text as superscripts, where such characters exist.
const raisedText = (text) => [...text].map((letter) => raised[letter] ?? letter).join('');

const powerOfTen = (power) => `10${raisedText(String(power))}`;

/// Text of a number with `digits` significant digits; an en dash if there is none.
function formatted(value, digits = 4) {
  if (value === null || value === undefined) return '–';
  if (typeof value !== 'number') return String(value);
  if (value !== 0 && (Math.abs(value) < 1e-3 || Math.abs(value) >= 1e5)) {
    const [front, power] = value.toExponential(digits - 1).split('e');
    return `${front.replace('-', '−')}·${powerOfTen(Number(power))}`;
  }
  return String(Number(value.toPrecision(digits))).replace('-', '−');
}

/// Saves a text or a data URL as a file, by the browser's download.
function save(name, content, type) {
  const address = type ? URL.createObjectURL(new Blob([content], {type})) : content;
  const link = element('a', {href: address, download: name});
  document.body.append(link);
  link.click();
  link.remove();
  if (type) setTimeout(() => URL.revokeObjectURL(address), 1000);
}

/// Copies to the clipboard. If the browser refuses, as it may for pages from disk, a selected text is copied instead.
async function copy(text) {
  try {
    await navigator.clipboard.writeText(text);
  } catch {
    const area = element('textarea', {value: text});
    document.body.append(area);
    area.select();
    document.execCommand('copy');
    area.remove();
  }
}

/// A button that confirms its action for a moment.
function button(label, action) {
  const made = element('button', {type: 'button'}, label);
  made.addEventListener('click', async () => {
    await action();
    made.textContent = `${label} ✓`;
    setTimeout(() => { made.textContent = label; }, 1200);
  });
  return made;
}

function csvField(value) {
  if (value === null || value === undefined) return '';
  const text = String(value);
  return /[",\r\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
}

/// Keys of a row that only the drawing needs.
const drawingKeys = ['dodge', 'line'];

/// Rows of all data sets one below the other, with their names in the first column.
function csvOf(datasets) {
  const names = [...new Set(Object.values(datasets).flat().flatMap((row) => Object.keys(row)))]
    .filter((name) => !drawingKeys.includes(name));
  const lines = [['dataset', ...names].map(csvField).join(',')];
  for (const [dataset, rows] of Object.entries(datasets)) {
    for (const row of rows) lines.push([dataset, ...names.map((name) => row[name])].map(csvField).join(','));
  }
  return `${lines.join('\n')}\n`;
}
