'use strict';

// Forces of contacts as bars: half a line from either centre to where the force acts, as thick as the force is large.
// No half leaves its particle, so that contacts through the boundary of the cell need no second image.

const barSides = 5, thinnestBar = 0.006, thickestBar = 0.11;

/// Coordinates of a vector along those of the cell.
function alongCell([a, b, c], v) {
  const cross = (x, y) => [x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]];
  const dot = (x, y) => x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
  const volume = dot(a, cross(b, c));
  return [dot(v, cross(b, c)) / volume, dot(v, cross(c, a)) / volume, dot(v, cross(a, b)) / volume];
}

/// The halves of all contacts: {particle, offset (from its centre), share (of the largest force)}.
function forceHalves({forces, positions, cell}) {
  const halves = [];
  for (let k = 0; k < forces.length; k += 6) {
    const [a, b, parts] = forces.slice(k, k + 3), place = forces.slice(k + 3, k + 6).map((x) => x / 100);
    // A cell is so wide that the image of b that touches is the one nearest to where it does.
    const apart = place.map((x, c) => positions[a][c] + x - positions[b][c]);
    const s = alongCell(cell, apart);
    const nearest = inCell(cell, s.map((x) => x - Math.round(x)));
    halves.push({particle: a, offset: place, share: parts / 1000}, {particle: b, offset: nearest, share: parts / 1000});
  }
  return halves;
}

/// Two vectors of length 1 across `v` and each other.
function across(v) {
  const along = v.clone().normalize();
  const other = Math.abs(along.x) < 0.8 ? new THREE.Vector3(1, 0, 0) : new THREE.Vector3(0, 1, 0);
  const first = other.cross(along).normalize();
  return [first, along.clone().cross(first)];
}

/// A mesh of bars for the halves.
function forceBars(halves) {
  const length = halves.length * barSides * 18;
  const position = new Float32Array(length), normal = new Float32Array(length);
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', new THREE.BufferAttribute(position, 3));
  geometry.setAttribute('normal', new THREE.BufferAttribute(normal, 3));
  const mesh = new THREE.Mesh(geometry, new THREE.MeshLambertMaterial({color: 0xb2182b}));
  mesh.frustumCulled = false;
  mesh.visible = halves.length > 0;
  return mesh;
}

/// Writes the bars of the particles shown, which may have moved; `at` is the place of each by its number.
function fillBars(mesh, halves, at) {
  const {position, normal} = mesh.geometry.attributes;
  let k = 0;
  const put = (corner, [x, y, z], facing) => {
    position.array.set([corner.x + x, corner.y + y, corner.z + z], k);
    normal.array.set([facing.x, facing.y, facing.z], k);
    k += 3;
  };
  for (const {particle, offset, share} of halves) {
    const start = at.get(particle), to = new THREE.Vector3(...offset);
    if (!start) continue;
    const radius = (thinnestBar + (thickestBar - thinnestBar) * share) / 2, [u, v] = across(to);
    const ring = Array.from({length: barSides + 1}, (_, side) => {
      const angle = (2 * Math.PI * side) / barSides;
      return u.clone().multiplyScalar(Math.cos(angle)).addScaledVector(v, Math.sin(angle));
    });
    for (let side = 0; side < barSides; side += 1) {
      const [n, m] = [ring[side], ring[side + 1]];
      const [near, beside] = [n, m].map((x) => x.clone().multiplyScalar(radius));
      const [far, farBeside] = [near, beside].map((x) => x.clone().add(to));
      for (const [corner, facing] of [[near, n], [beside, m], [farBeside, m], [near, n], [farBeside, m], [far, n]])
        put(corner, start, facing);
    }
  }
  position.array.fill(0, k);
  position.needsUpdate = normal.needsUpdate = true;
}
