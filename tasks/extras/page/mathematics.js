'use strict';

// Typesets mathematics in texts: in HTML, in SVG and as plain letters elsewhere. A formula stands between dollars:
// letters, \greek, _x, ^x, _{xy}, ^{xy}. Outside of dollars the N of "N = 100" and φ_J, a letter with a one-letter
// index, are formulae too.

const macros = {phi: 'φ', omega: 'ω', langle: '⟨', rangle: '⟩', gamma: 'γ', epsilon: 'ε', sigma: 'σ', max: 'max'};

/// End of the argument that begins at `from`: a brace or a single letter.
function argumentEnd(text, from) {
  if (text[from] !== '{') return from + 1;
  let depth = 0;
  for (let at = from; at < text.length; at += 1) {
    depth += (text[at] === '{') - (text[at] === '}');
    if (depth === 0) return at + 1;
  }
  return text.length;
}

/// Formula as runs: {text, italic} and {script: 'sub' or 'sup', runs}. Words, Δ and everything except letters are
/// upright.
function formulaRuns(formula) {
  const text = formula.replace(/\\([a-z]+)/gi, (whole, macro) => macros[macro] ?? whole);
  const runs = [];
  for (let at = 0; at < text.length;) {
    if (text[at] === '_' || text[at] === '^') {
      const end = argumentEnd(text, at + 1);
      const inner = text.slice(at + 1, end).replace(/^\{(.*)\}$/s, '$1');
      runs.push({script: text[at] === '_' ? 'sub' : 'sup', runs: formulaRuns(inner)});
      at = end;
    } else {
      const [part] = text.slice(at).match(/^(?:\p{Script=Latin}+|[α-ω]+|[^_^α-ω\p{Script=Latin}]+)/u) ?? [text[at]];
      const word = /^\p{Script=Latin}{3,}$/u.test(part);
      runs.push({text: part, italic: !word && /^[α-ω\p{Script=Latin}]/u.test(part)});
      at += part.length;
    }
  }
  return runs;
}

const formulas = /\$([^$]+)\$|(?<![\p{L}\d_])(N)(?=[ \u00a0]=[ \u00a0]\d)|(?<![\p{L}_])(\p{L}_\p{L})(?![\p{L}_])/gu;

/// Text as runs.
function runsOf(text) {
  const runs = [];
  let done = 0;
  for (const found of text.matchAll(formulas)) {
    if (found.index > done) runs.push({text: text.slice(done, found.index), italic: false});
    runs.push(...formulaRuns(found[1] ?? found[2] ?? found[3]));
    done = found.index + found[0].length;
  }
  if (done < text.length) runs.push({text: text.slice(done), italic: false});
  return runs;
}

const htmlOf = (runs) => runs.map(({text, italic, script, runs: inner}) => {
  if (script) return element(script, {}, ...htmlOf(inner));
  return italic ? element('i', {}, text) : text;
});

/// Nodes of a text with its mathematics typeset. The text is never interpreted as markup.
const rich = (text) => htmlOf(runsOf(text));

/// Nodes of a formula.
const formulaNodes = (formula) => htmlOf(formulaRuns(formula));

const lettersOf = (runs) => runs.map(({text, script, runs: inner}) => {
  if (!script) return text;
  const letters = lettersOf(inner);
  if (script === 'sup' && [...letters].every((letter) => letter in raised)) return raisedText(letters);
  return `${script === 'sup' ? '^' : '_'}${letters}`;
}).join('');

/// The text in plain letters, for exported files.
const plainText = (text) => text.replace(/\$([^$]+)\$/g, (whole, formula) => lettersOf(formulaRuns(formula)));

/// Appends the runs as tspans. Scripts are smaller and shifted in user units, which all SVG viewers support.
function appendRuns(line, runs, size, scale = 1, level = 0) {
  const shifts = {sub: 0.25, sup: -0.36};
  for (const {text, italic, script, runs: inner} of runs) {
    if (script) {
      appendRuns(line, inner, size, scale * 0.75, level + shifts[script] * scale);
      continue;
    }
    const span = document.createElementNS('http://www.w3.org/2000/svg', 'tspan');
    span.textContent = text;
    if (italic) span.setAttribute('font-style', 'italic');
    if (scale !== 1) span.setAttribute('font-size', `${(size * scale).toFixed(2)}px`);
    const shift = (level - Number(line.dataset.level ?? 0)) * size;
    if (shift !== 0) span.setAttribute('dy', shift.toFixed(2));
    line.dataset.level = level;
    line.append(span);
  }
}

/// Typesets the mathematics in the texts of a drawn chart and in its description for screen readers.
function setMathematics(svg) {
  for (const told of svg.querySelectorAll('[aria-label*="$"]'))
    told.setAttribute('aria-label', plainText(told.getAttribute('aria-label')));
  for (const line of svg.querySelectorAll('text, tspan')) {
    if (line.children.length > 0) continue;
    const text = line.textContent, runs = runsOf(text);
    if (runs.length < 2 && !runs[0]?.italic) continue;
    const size = parseFloat(line.closest('text').getAttribute('font-size')) || 11;
    line.textContent = '';
    appendRuns(line, runs, size);
    delete line.dataset.level;
  }
}
