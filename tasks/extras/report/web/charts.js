'use strict';

const allFigures = (data, choices) => [
  densityFigure(data, choices),
  topologyFigure(data, choices),
  angleFigure(data, choices, 'edge_face', {id: 'edge-face', title: 'Edge-face alignment', symbol: 'θ_{ef}'}),
  angleFigure(data, choices, 'face_face', {id: 'face-face', title: 'Face-face alignment', symbol: 'θ_{ff}'}),
  angleHistogram(data, choices, 'edge_face', {id: 'edge-face-histogram', title: 'Edge-face angles', symbol: 'θ_{ef}'}),
  angleHistogram(data, choices, 'face_face', {id: 'face-face-histogram', title: 'Face-face angles', symbol: 'θ_{ff}'}),
  kindsFigure(data),
  forceFigure(data, choices),
  pairFigure(data, choices),
  exponentFigure(data, choices),
  extrapolationFigure(data, choices),
  spectrumFigure(data, choices),
  scalingFigure(data, choices),
  moduliFigure(data, choices),
  shearFigure(data, choices),
  stopFigure(data),
  costFigure(data, 'evaluations', 'evaluations'),
  costFigure(data, 'cpu_seconds', 'time'),
];

/// The two choices a reader has for all charts, where there is something to choose.
function choiceBar(data, changed) {
  const together = element('input', {type: 'checkbox', id: 'choose-together'});
  const everything = element('input', {type: 'checkbox', id: 'choose-everything'});
  const bar = element('div', {className: 'controls choices'});
  const several = data.rows.length > 1, excluded = data.replicates.filter((replicate) => replicate.excluded).length;
  if (several) bar.append(element('label', {}, together, 'All solids in one chart'));
  if (excluded > 0) {
    bar.append(element('label', {}, everything, `Extend axes to ${counted(excluded, 'excluded replicate')}`));
  }
  const tell = () => changed({together: together.checked, everything: everything.checked});
  for (const box of [together, everything]) box.addEventListener('change', tell);
  bar.hidden = !several && excluded === 0;
  return bar;
}

function drawCharts(data, place) {
  nameSolids(unique([...Object.keys(data.solids),
    ...Object.values(data.solids).flatMap(({shapes}) => (shapes ?? []).map(({name}) => name))]));
  const figures = allFigures(data, {together: false, everything: false});
  const drawn = new Map();
  place.append(choiceBar(data, (choices) => {
    for (const figure of allFigures(data, choices)) drawn.get(figure.id)?.set(figure);
  }));
  for (const figure of figures.filter(({absent}) => !absent)) drawn.set(figure.id, drawFigure(figure, place));
  const absent = figures.filter((figure) => figure.absent);
  if (absent.length === 0) return;
  place.append(element('div', {className: 'absent'}, element('h3', {}, 'Not shown'),
    ...absent.map(({title, absent: why}) => element('p', {className: 'note'}, `${title}: ${why}`))));
}
