'use strict';

// Jamming density for settings of the protocol: a row for each setting, with its cost and its density side by side.

const rowHeight = 22, rowLabels = 162;

/// "−0.0011 ± 0.0005": to two digits of the half width.
function withHalfWidth(value, half) {
  const decimals = half > 0 ? Math.max(0, 1 - Math.floor(Math.log10(half))) : 1;
  const text = (number) => (decimals > 5 ? number.toExponential(1) : number.toFixed(decimals));
  return `${text(value)} ± ${text(half)}`.replaceAll('-', '−');
}

/// Settings as rows, the first one first. Bars farther out belong to means relative to that of the first setting.
function protocolRows(family) {
  const first = family.points.find(({further}) => further.phi_j !== null)?.further.phi_j ?? null;
  return family.points.map(({setting, seconds, stopped, failed, further}) => {
    const off = further.phi_j === null || first === null ? null : further.phi_j - first;
    const ends = (middle, half) => (middle === null || half === null ? [null, null] : [middle - half, middle + half]);
    const [low, high] = ends(off, further.half_width);
    const [paired_low, paired_high] = ends(further.difference, further.difference_half_width);
    const paired = further.difference !== null;
    const [told, half] = paired ? [further.difference, further.difference_half_width] : [off, further.half_width];
    return {
      setting, seconds: seconds?.median ?? null, failed, stopped: failed ? `failed: ${stopped}` : '',
      phi_j: further.phi_j, replicates: further.replicates, off, low, high,
      difference: further.difference, difference_half_width: further.difference_half_width, paired_low, paired_high,
      told: off === null ? '' : withHalfWidth(told, half),
    };
  });
}

const protocolTooltip = {
  setting: 'setting', seconds: 'seconds', φ_J: 'phi_j', replicates: 'replicates',
  'difference from the first setting': 'off',
  'paired difference': 'difference', '± 95 %': 'difference_half_width', '': 'stopped',
};

const settingY = {scale: 'y', field: 'setting', band: 0.5};
const plainInk = {value: hues.blue};

function settingRule(name, low, high, width) {
  return {
    type: 'rule', from: {data: name}, encode: {enter: {
      y: settingY, x: {scale: 'x', field: low}, x2: {scale: 'x', field: high}, stroke: plainInk,
      strokeWidth: {value: width}, strokeOpacity: {value: width > 2 ? 0.45 : 1},
    }},
  };
}

function settingMark(name, x, shape = 'circle') {
  return {
    name: `setting_${name}`, type: 'symbol', from: {data: name},
    encode: {enter: {
      y: settingY, x, size: {value: 52}, stroke: plainInk, tooltip: tooltipOf(protocolTooltip), shape: {value: shape},
      strokeWidth: {value: 1.8}, fill: shape === 'circle' ? plainInk : {value: 'transparent'},
    }},
  };
}

/// Numbers for the widest bar of a row, whose ends may lie within its dot.
const numbers = (width) => ({
  name: 'setting_numbers', type: 'text', from: {data: 'known'}, encode: {enter: {
    y: settingY, x: {value: width - 4}, align: {value: 'right'}, baseline: {value: 'middle'}, fontSize: {value: 11},
    fill: {value: ink}, text: {field: 'told'},
  }},
});

/// Crosses for settings that failed, at their means or at the edge; those without a mean have the reason beside them.
const failedMarks = () => [
  settingMark('failed', [{test: 'isValid(datum.off)', scale: 'x', field: 'off'}, {value: 8}], crossPath),
  {
    type: 'text', from: {data: 'missing'}, encode: {enter: {
      y: settingY, x: {value: 18}, baseline: {value: 'middle'}, fontSize: {value: 10}, fill: {value: ink},
      text: {field: 'stopped'},
    }},
  },
];

const zeroLine = (height) => ({
  type: 'rule', encode: {enter: {
    x: {scale: 'x', value: 0}, y: {value: 0}, y2: {value: height}, stroke: {value: hues.grey},
    strokeDash: {value: [3, 3]},
  }},
});

function protocolPanel({title, width, height, x, settings, data, marks, showY}) {
  const made = panel({title, width, height, x, y: {domain: [0, 1]}, data, marks});
  made.scales[1] = {name: 'y', type: 'band', domain: settings, range: [0, height]};
  made.axes[1] = {
    orient: 'left', scale: 'y', domain: false, ticks: false, grid: true, bandPosition: 0.5, labels: showY,
    labelLimit: rowLabels - 10,
  };
  return made;
}

function protocolFigure(family) {
  const rows = protocolRows(family);
  const id = family.name, title = familyTitles[id];
  if (rows.length === 0) return {id, title, absent: `No point was measured.${endings[family.ended]}`};
  const settings = rows.map(({setting}) => setting), height = rowHeight * rows.length;
  const most = Math.max(...rows.map(({seconds}) => seconds ?? 0), 1e-9);
  const ends = rows.flatMap(({low, high, paired_low: a, paired_high: b}) => [low, high, a, b, 0]);
  const [least, greatest] = domainOf(ends, {margin: 0.06});
  const wide = (width) => width > 330;
  // Numbers have a column of their own if the page is wide enough.
  const off = (width) => [least, wide(width) ? least + (greatest - least) / (1 - 125 / width) : greatest];
  const known = 'isValid(datum.off)', ticks = (width) => (width < 300 ? 3 : 6);
  const panels = (place) => [
    {
      title: `cost, ${family.points[0].case}`, x: {title: 'seconds', domain: [0, 1.06 * most], ticks: ticks(place.width)},
      data: [], marks: [settingMark('settings', {scale: 'x', field: 'seconds'})],
    },
    {
      title: 'mean jamming density',
      x: {title: 'difference from the first setting', domain: off(place.width), ticks: ticks(place.width)},
      data: [filtered('known', 'settings', known), filtered('paired', 'settings', 'isValid(datum.paired_low)'),
        filtered('good', 'settings', `!datum.failed && ${known}`), filtered('failed', 'settings', 'datum.failed'),
        filtered('missing', 'settings', `!${known}`)],
      marks: [zeroLine(height), settingRule('paired', 'paired_low', 'paired_high', 7),
        settingRule('known', 'low', 'high', 1.5), settingMark('good', {scale: 'x', field: 'off'}), ...failedMarks(),
        ...(wide(place.width) ? [numbers(place.width)] : [])],
    },
  ].map((each) => ({...each, ...place, settings}));
  return {
    id, title, note: family.note + endings[family.ended], datasets: {settings: rows},
    spec: (width) => panelSpec({
      description: `${title}: cost and difference of each setting of the protocol, one row each.`, width, count: 2,
      height, datasets: {settings: rows}, grid: {least: 200, most: 2, left: rowLabels},
      panelAt: (index, place) => protocolPanel(panels({...place, showX: true})[index]),
    }),
  };
}
