'use strict';

function counted(number, noun) {
  return `${number} ${noun}${number === 1 ? '' : 's'}`;
}

function drawHeader(data) {
  const name = data.manifest.name ?? 'Unnamed sweep';
  document.title = `${name} – isojam report`;
  document.getElementById('name').textContent = name;
  const failed = data.replicates.filter((replicate) => replicate.status === 'failed').length;
  const flagged = data.replicates.filter((replicate) => replicate.flags.length > 0).length;
  const excluded = data.replicates.filter((replicate) => replicate.excluded).length;
  document.getElementById('summary').textContent =
    `${counted(data.rows.length, 'sweep point')}, ${counted(data.replicates.length, 'replicate')}: ` +
    `${data.replicates.length - failed} done, ${failed} failed, ${flagged} flagged, ${excluded} excluded from means.`;
  if (data.chart) {
    document.getElementById('summary').append(' ',
      element('a', {href: 'chart.html'}, 'Chart of accuracy against speed'));
  }
}

function drawProvenance(data) {
  const list = element('dl');
  const put = (term, value) => list.append(element('dt', {}, term), element('dd', {}, value ?? 'unknown'));
  put('Sweep', data.manifest.name);
  put('Seed', data.manifest.seed);
  put('Measures', data.measures.map(String).join(', ') || 'none besides the jamming density');
  if (data.addable.length > 0) {
    const only = data.keeps_paths ? '' : ' (only for the states nearest jamming, because "keep_path" was false)';
    put('Can be added', `${data.addable.join(', ')}; run "isojam measure DIR --add ${data.addable[0]}"${only}`);
  }
  for (const build of data.builds) {
    put('Program', `isojam ${build.version} (git ${build.git})`);
    put('Compiler', build.compiler);
  }
  list.append(element('dt', {}, 'Units'), element('dd', {}, ...rich('$Y$ = 1, $V_p$ = 1, $ρ$ = 1')));
  document.getElementById('provenance').append(list);
}

{
  const data = JSON.parse(document.getElementById('data').textContent);
  drawHeader(data);
  drawMainTable(data, document.getElementById('table'));
  drawFurtherTables(data, document.getElementById('further'));
  drawCharts(data, document.getElementById('charts'));
  drawPackings(data, document.getElementById('view'));
  drawReservations(data);
  drawProvenance(data);
  // Closed tables are for screens.
  addEventListener('beforeprint', () => document.querySelectorAll('details').forEach((part) => { part.open = true; }));
  document.documentElement.dataset.ready = 'yes';
}
