'use strict';

/// A solid of the report as flat arrays: corners and normals of its triangles, ends of its edges, body frame.
function solidMesh(shape) {
  const corners = [], normals = [], edges = [];
  for (const face of shape.faces) {
    const [a, b, c] = face.map((vertex) => new THREE.Vector3(...shape.vertices[vertex]));
    const normal = b.clone().sub(a).cross(c.clone().sub(a)).normalize();
    for (let k = 1; k + 1 < face.length; k += 1) {
      for (const vertex of [face[0], face[k], face[k + 1]]) {
        corners.push(...shape.vertices[vertex]);
        normals.push(normal.x, normal.y, normal.z);
      }
    }
  }
  for (const edge of shape.edges) for (const vertex of edge) edges.push(...shape.vertices[vertex]);
  return {corners, normals, edges};
}

/// The rotation of a unit quaternion (w, x, y, z), row by row.
function rotationOf([w, x, y, z]) {
  return [
    1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y),
    2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x),
    2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y),
  ];
}

/// exp(θ)·q for a rotation vector θ.
function turned([w, x, y, z], turn) {
  const angle = Math.hypot(...turn);
  if (angle === 0) return [w, x, y, z];
  const s = Math.sin(angle / 2) / angle, c = Math.cos(angle / 2);
  const [a, b, d] = turn.map((component) => component * s);
  return [
    c * w - a * x - b * y - d * z, c * x + a * w + b * z - d * y,
    c * y - a * z + b * w + d * x, c * z + a * y - b * x + d * w,
  ];
}

/// Writes rotation·v + shift for all vectors of `from` into `into` at `offset`; returns the offset behind them.
function place(into, offset, from, r, [tx, ty, tz]) {
  let at = offset;
  for (let k = 0; k < from.length; k += 3) {
    const x = from[k], y = from[k + 1], z = from[k + 2];
    into[at] = r[0] * x + r[1] * y + r[2] * z + tx;
    into[at + 1] = r[3] * x + r[4] * y + r[5] * z + ty;
    into[at + 2] = r[6] * x + r[7] * y + r[8] * z + tz;
    at += 3;
  }
  return at;
}

const viridisStops = [
  '#440154', '#482878', '#3e4989', '#31688e', '#26828e', '#1f9e89', '#35b779', '#6ece58', '#b5de2b', '#fde725',
];

/// Colour of a share between 0 and 1, even in lightness.
function viridis(share) {
  const at = Math.max(0, Math.min(1, share)) * (viridisStops.length - 1);
  const k = Math.min(viridisStops.length - 2, Math.floor(at));
  return new THREE.Color(viridisStops[k]).lerp(new THREE.Color(viridisStops[k + 1]), at - k);
}

const clusterColours = seriesColours.slice(0, 6);
const smallClusters = '#8d99a6', loneParticles = '#e2e0d8', unknownColour = '#b5b4ad';

/// Colours by cluster: the six largest in colours of their own, then the smaller ones, then lone particles.
function clusterColouring(labels) {
  if (!labels) return null;
  const sizes = new Map();
  for (const label of labels) sizes.set(label, (sizes.get(label) ?? 0) + 1);
  const ordered = [...sizes].filter(([, size]) => size > 1).sort((a, b) => b[1] - a[1] || a[0] - b[0]);
  const colours = new Map(ordered.map(([label], rank) => [label, clusterColours[rank] ?? smallClusters]));
  const key = ordered.slice(0, clusterColours.length).map(([, size], rank) =>
    ({colour: clusterColours[rank], text: `${size} particles`}));
  const smaller = ordered.length - key.length;
  if (smaller > 0) key.push({colour: smallClusters, text: `${smaller} smaller clusters`});
  const lone = [...sizes.values()].filter((size) => size === 1).length;
  if (lone > 0) key.push({colour: loneParticles, text: `${lone} particles without face-face contact`});
  return {colours: labels.map((label) => new THREE.Color(colours.get(label) ?? loneParticles)), key};
}

/// Colours by a number per particle.
function numberColouring(values, digits) {
  const known = values.filter((value) => value !== null);
  if (known.length === 0) return null;
  const low = Math.min(...known), high = Math.max(...known);
  const share = (value) => (high > low ? (value - low) / (high - low) : 0.5);
  return {
    colours: values.map((value) => (value === null ? new THREE.Color(unknownColour) : viridis(share(value)))),
    ramp: {
      low: low.toFixed(digits), middle: ((low + high) / 2).toFixed(digits || 1), high: high.toFixed(digits),
    },
  };
}

/// Colours by kind: those of the solids, or different ones if several kinds have the same solid.
function kindColouring(view, solid) {
  const names = (solid.shapes ?? [{name: view.solid}]).map(({name}, k) => name ?? `kind ${k + 1}`);
  const distinct = unique(names).length === names.length && names.every((name) => name in solidColours);
  const colours = names.map((name, k) => (distinct ? solidColours[name] : seriesColours[k % seriesColours.length]));
  const count = (k) => view.positions.filter((_, index) => (view.kind?.[index] ?? 0) === k).length;
  return {
    colours: view.positions.map((_, index) => new THREE.Color(colours[view.kind?.[index] ?? 0])),
    key: names.map((name, k) => ({colour: colours[k], text: `${k + 1}: ${name}, ${count(k)} particles`})),
  };
}

function colouringOf(view, kind, solid) {
  if (kind === 'kind') return kindColouring(view, solid);
  if (kind === 'clusters') return clusterColouring(view.clusters);
  if (kind === 'contacts') return numberColouring(view.contacts, 0);
  return numberColouring(view.local_Q6, 2);
}
