'use strict';

/// 'hardware', 'software' or null where there is no WebGL at all.
function webglKind() {
  const context = document.createElement('canvas').getContext('webgl');
  if (!context) return null;
  const info = context.getExtension('WEBGL_debug_renderer_info');
  const name = info ? context.getParameter(info.UNMASKED_RENDERER_WEBGL) : '';
  context.getExtension('WEBGL_lose_context')?.loseContext();
  return /swiftshader|llvmpipe|software/i.test(name) ? 'software' : 'hardware';
}

function buffer(length) {
  const attribute = new THREE.BufferAttribute(new Float32Array(length), 3);
  attribute.setUsage?.(THREE.DynamicDrawUsage);
  return attribute;
}

/// All particles as one geometry for the faces and one for the edges: two draw calls whatever N is.
function particleObjects(meshes, particles) {
  const faces = new THREE.BufferGeometry(), edges = new THREE.BufferGeometry();
  const total = (part) => particles.reduce((sum, {kind}) => sum + meshes[kind][part].length, 0);
  for (const name of ['position', 'normal', 'color']) faces.setAttribute(name, buffer(total('corners')));
  edges.setAttribute('position', buffer(total('edges')));
  const solid = new THREE.Mesh(faces, new THREE.MeshLambertMaterial({
    vertexColors: THREE.VertexColors, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1}));
  const outline = new THREE.LineSegments(edges,
    new THREE.LineBasicMaterial({color: 0x1c1c1a, transparent: true, opacity: 0.55}));
  solid.frustumCulled = outline.frustumCulled = false;
  return {solid, outline};
}

/// Writes poses and colours of the particles shown into the two geometries.
function fill({solid, outline}, meshes, particles) {
  const {position, normal, color} = solid.geometry.attributes;
  const ends = outline.geometry.attributes.position;
  let corner = 0, turnedNormal = 0, end = 0, tint = 0;
  for (const {at, orientation, colour, kind, size} of particles) {
    const rotation = rotationOf(orientation), mesh = meshes[kind];
    const stretched = size === 1 ? rotation : rotation.map((x) => x * size);
    corner = place(position.array, corner, mesh.corners, stretched, at);
    turnedNormal = place(normal.array, turnedNormal, mesh.normals, rotation, [0, 0, 0]);
    end = place(ends.array, end, mesh.edges, stretched, at);
    for (let k = 0; k < mesh.corners.length; k += 3) {
      color.array.set([colour.r, colour.g, colour.b], tint);
      tint += 3;
    }
  }
  for (const attribute of [position, normal, color, ends]) attribute.needsUpdate = true;
}

/// The point with these coordinates along the vectors of the cell.
function inCell(cell, s) {
  return [0, 1, 2].map((c) => s[0] * cell[0][c] + s[1] * cell[1][c] + s[2] * cell[2][c]);
}

/// The twelve edges of the cell: from every corner along every vector that leads on.
function cellOutline(cell) {
  const ends = [];
  for (const corner of [0, 1, 2, 3, 4, 5, 6, 7]) {
    const s = [corner & 1, (corner >> 1) & 1, corner >> 2];
    for (const along of [0, 1, 2]) {
      if (s[along] === 0) ends.push(...inCell(cell, s), ...inCell(cell, s.map((x, c) => (c === along ? 1 : x))));
    }
  }
  const edges = new THREE.BufferGeometry();
  edges.setAttribute('position', new THREE.BufferAttribute(new Float32Array(ends), 3));
  return new THREE.LineSegments(edges, new THREE.LineBasicMaterial({color: 0x888888}));
}

function dispose(objects) {
  for (const object of objects) {
    object.geometry.dispose();
    object.material.dispose();
  }
}

/// The camera, moved by mouse, touch and keys; `moved` is called when it did.
function orbitCamera(canvas, moved) {
  const camera = new THREE.PerspectiveCamera(32, 1, 0.1, 1000);
  const light = new THREE.DirectionalLight(0xffffff, 0.62);
  light.position.set(0.4, 0.7, 1);
  camera.add(light);
  const controls = new THREE.OrbitControls(camera, canvas);
  Object.assign(controls, {enableKeys: false, enableZoom: false, enablePan: false, rotateSpeed: 0.7});
  controls.addEventListener('change', moved);
  // The wheel scrolls the page unless the view has the focus.
  canvas.addEventListener('focus', () => { controls.enableZoom = true; });
  canvas.addEventListener('blur', () => { controls.enableZoom = false; });
  canvas.addEventListener('pointerdown', () => canvas.focus());
  const moveTo = (spherical) => {
    spherical.makeSafe();
    camera.position.setFromSpherical(spherical).add(controls.target);
    controls.update();
    moved();
  };
  const spherical = () => new THREE.Spherical().setFromVector3(camera.position.clone().sub(controls.target));
  return {
    camera,
    turn(theta, phi, zoom) {
      const now = spherical();
      moveTo(new THREE.Spherical(now.radius * zoom, now.phi + phi, now.theta + theta));
    },
    reset(cell, side) {
      controls.target.set(...inCell(cell, [0.5, 0.5, 0.5]));
      Object.assign(controls, {minDistance: side * 0.4, maxDistance: side * 8});
      Object.assign(camera, {near: side * 0.05, far: side * 12});
      moveTo(new THREE.Spherical(side * 3.3, 1.15, 0.6));
    },
  };
}

/// Ends of edges that a processor alone can draw at some ten frames a second.
const slowOutlines = 12000;

const keyTurns = {
  ArrowLeft: [-0.09, 0, 1], ArrowRight: [0.09, 0, 1], ArrowUp: [0, -0.09, 1], ArrowDown: [0, 0.09, 1],
  '+': [0, 0, 0.9], '=': [0, 0, 0.9], '-': [0, 0, 1.11],
};

/// Fits the view to the width of its frame, now and whenever that changes.
function followWidth(canvas, renderer, camera, draw) {
  new ResizeObserver(() => {
    const width = canvas.parentElement.clientWidth, height = Math.round(Math.min(width * 0.62, 560));
    renderer.setSize(width, height, false);
    canvas.style.height = `${height}px`;
    camera.aspect = width / height;
    camera.updateProjectionMatrix();
    draw();
  }).observe(canvas.parentElement);
}

/// Glass shows what is within the particles.
function setGlass({solid, outline}, glass) {
  Object.assign(solid.material, {transparent: glass, opacity: glass ? 0.16 : 1, depthWrite: !glass});
  outline.material.opacity = glass ? 0.2 : 0.55;
}

/// What is drawn as PNG, on white, at twice the size of the screen at least.
function pictureOf(canvas, renderer, render) {
  const ratio = renderer.getPixelRatio(), {width, height} = renderer.getSize(new THREE.Vector2());
  const sized = (pixels) => { renderer.setPixelRatio(pixels); renderer.setSize(width, height, false); render(); };
  sized(Math.max(2, ratio));
  const copy = element('canvas', {width: canvas.width, height: canvas.height}), context = copy.getContext('2d');
  context.fillStyle = '#ffffff';
  context.fillRect(0, 0, copy.width, copy.height);
  context.drawImage(canvas, 0, 0);
  sized(ratio);
  return copy.toDataURL('image/png');
}

/// A canvas with a scene that is drawn only when something changed. `show` takes the shapes of the kinds, the cell
/// ({cell, side}), the particles ({index, at, orientation, colour, kind, size}) and the halves of the forces to draw;
/// `update` the same particles elsewhere; `picture` gives a PNG.
function packingScene(canvas, antialias) {
  const renderer = new THREE.WebGLRenderer({canvas, antialias, alpha: true, preserveDrawingBuffer: true});
  renderer.setPixelRatio(antialias ? Math.min(devicePixelRatio, 2) : 1);
  const scene = new THREE.Scene();
  let waiting = false, objects = null, meshes = null, box = null, shown = null, frames = 0, resting = 0, halves = [];
  let sparing = false;
  const orbit = orbitCamera(canvas, () => move());
  const draw = () => {
    if (waiting) return;
    waiting = true;
    requestAnimationFrame(() => {
      waiting = false;
      renderer.render(scene, orbit.camera);
      frames += 1;
      canvas.dataset.frames = frames;
    });
  };
  // Where outlines would cost most of a frame they are left out until the motion ends.
  const move = () => {
    if (sparing) {
      objects.outline.visible = false;
      clearTimeout(resting);
      resting = setTimeout(() => { objects.outline.visible = true; draw(); }, 200);
    }
    draw();
  };
  scene.add(orbit.camera, new THREE.HemisphereLight(0xffffff, 0xb8b4a8, 0.55));
  followWidth(canvas, renderer, orbit.camera, draw);
  canvas.addEventListener('keydown', (event) => {
    if (event.key === 'Home') orbit.reset(shown.cell, shown.side);
    else if (keyTurns[event.key]) orbit.turn(...keyTurns[event.key]);
    else return;
    event.preventDefault();
  });
  const fillAll = (particles) => {
    fill(objects, meshes, particles);
    if (halves.length > 0) fillBars(objects.bars, halves, new Map(particles.map(({index, at}) => [index, at])));
  };
  return {
    picture: () => pictureOf(canvas, renderer, () => renderer.render(scene, orbit.camera)),
    show(shapes, view, particles, {forces, keepCamera}) {
      if (objects) {
        const old = [objects.solid, objects.outline, objects.bars, box];
        scene.remove(...old);
        dispose(old);
      }
      [meshes, shown] = [shapes.map(solidMesh), view];
      [objects, box, halves] = [particleObjects(meshes, particles), cellOutline(view.cell), forces];
      objects.bars = forceBars(halves);
      setGlass(objects, halves.length > 0);
      scene.add(objects.solid, objects.outline, objects.bars, box);
      sparing = !antialias && objects.outline.geometry.attributes.position.count > slowOutlines;
      fillAll(particles);
      if (!keepCamera) orbit.reset(view.cell, view.side);
      draw();
    },
    update(particles) {
      fillAll(particles);
      move();
    },
  };
}
