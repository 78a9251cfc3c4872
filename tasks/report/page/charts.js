'use strict';

const allFigures = (data) => [
  densityFigure(data),
  topologyFigure(data),
  angleFigure(data, 'edge_face', {id: 'edge-face', title: 'Edge-face alignment', symbol: 'θ edge-face'}),
  angleFigure(data, 'face_face', {id: 'face-face', title: 'Face-face alignment', symbol: 'θ face-face'}),
  extrapolationFigure(data),
  spectrumFigure(data),
  scalingFigure(data),
  shearFigure(data),
  costFigure(data, 'evaluations', 'evaluations'),
  costFigure(data, 'cpu_seconds', 'time'),
  stopFigure(data),
];

function drawCharts(data, place) {
  nameSolids(Object.keys(data.solids));
  const figures = allFigures(data);
  for (const figure of figures.filter(({absent}) => !absent)) drawFigure(figure, place);
  const absent = figures.filter((figure) => figure.absent);
  if (absent.length === 0) return;
  place.append(element('div', {className: 'absent'}, element('h3', {}, 'Not shown'),
    ...absent.map(({title, absent: why}) => element('p', {className: 'note'}, `${title}: ${why}`))));
}
