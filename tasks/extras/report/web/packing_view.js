'use strict';

/// Amplitude of an animated mode, in V_p^(1/3) and radians: large enough to see, too small to pass through others.
const modeAmplitude = 0.22, modePeriod = 1800;

function option(value, text) {
  return element('option', {value}, text);
}

function labelled(text, control) {
  return element('label', {}, text, control);
}

function modeText({end, omega}, k) {
  const value = omega === null ? 'no restoring force' : `ω = ${formatted(omega, 3)}`;
  return `${end} ${k}: ${value}`;
}

function modeOptions(view) {
  const counts = {};
  return [option('', 'none'), ...view.modes.map((mode, index) => {
    counts[mode.end] = (counts[mode.end] ?? 0) + 1;
    return option(String(index), modeText(mode, counts[mode.end]));
  })];
}

/// The particles to draw: all in their cell, or the largest cluster unwrapped, moved along a mode by `phase`.
function particlesOf(view, {colouring, alone, mode, phase}) {
  const members = alone && view.largest ? view.largest.members : view.positions.map((_, index) => index);
  const displacement = view.modes[mode]?.u;
  return members.map((index, k) => {
    const at = alone && view.largest ? view.largest.positions[k] : view.positions[index];
    const colour = colouring?.colours[index] ?? new THREE.Color(unknownColour);
    const orientation = view.orientations[index];
    const still = {index, at, orientation, colour, kind: view.kind?.[index] ?? 0, size: view.size?.[index] ?? 1};
    if (!displacement || phase === 0) return still;
    const part = (offset) => displacement.slice(6 * index + offset, 6 * index + offset + 3)
      .map((x) => x * phase * modeAmplitude);
    return {...still, at: part(0).map((x, c) => x + at[c]), orientation: turned(orientation, part(3))};
  });
}

function keyOf(colouring, kind) {
  const key = element('div', {className: 'key', attributes: {'aria-label': 'Key of the colours'}});
  const swatch = (colour) => {
    const box = element('i');
    box.style.background = colour;
    return box;
  };
  const names = {
    clusters: 'Clusters of face-face contacts:', contacts: 'Contacts of the particle:',
    local_Q6: '$Q_6$ of the particle’s contacts:', kind: 'Kind:',
  };
  key.append(element('span', {}, element('span', {}, ...rich(names[kind]))));
  for (const {colour, text} of colouring?.key ?? []) key.append(element('span', {}, swatch(colour), text));
  if (colouring?.ramp) {
    const ramp = element('i', {className: 'ramp'});
    ramp.style.background = `linear-gradient(to right, ${viridisStops.join(', ')})`;
    const {low, middle, high} = colouring.ramp;
    key.append(element('span', {}, low, ramp, high), element('span', {}, `middle ${middle}`));
  }
  return key;
}

function viewControls(data, views) {
  const replicateText = (view) => {
    const entry = data.replicates.find(({name}) => name === view.name);
    const flags = entry.flags.length > 0 ? ` (${entry.flags.join(', ')})` : '';
    return `${data.rows[entry.row].label}, replicate ${entry.replicate}${flags}`;
  };
  const controls = {
    replicate: element('select', {id: 'view-replicate'},
      ...views.map((view, index) => option(String(index), replicateText(view)))),
    colour: element('select', {id: 'view-colour'}, option('clusters', 'face-face cluster'),
      option('contacts', 'contact number'), option('local_Q6', 'Q₆, local'), option('kind', 'kind of particle')),
    alone: element('input', {type: 'checkbox', id: 'view-alone'}),
    forces: element('input', {type: 'checkbox', id: 'view-forces'}),
    mode: element('select', {id: 'view-mode'}),
    start: element('button', {type: 'button', id: 'view-start'}, 'Start'),
    phase: element('input', {type: 'range', min: -1, max: 1, step: 0.05, value: 0, id: 'view-phase'}),
  };
  controls.bar = element('div', {className: 'controls'}, labelled('Replicate', controls.replicate),
    labelled('Colour', controls.colour), labelled('Largest cluster alone', controls.alone),
    labelled('Contact forces', controls.forces));
  controls.modeBar = element('div', {className: 'controls'}, labelled('Vibration', controls.mode), controls.start,
    labelled('Displacement', controls.phase));
  return controls;
}

function statusText(data, view) {
  const parts = [`$φ$ = ${formatted(view.density, 5)}`, `${view.positions.length} particles`,
    `${view.forces.length / 6} contacts, the largest force ${formatted(view.largest_force, 3)}`];
  if (view.largest) parts.push(`largest cluster of face-face contacts: ${view.largest.members.length} particles` +
    (view.largest.winding_rank > 0 ? ', closed through the boundary' : ''));
  else parts.push(view.clusters ? 'no face-face contact' : `no clusters: ${view.clusters_reason}`);
  return `${parts.join('; ')}.`;
}

/// Runs a callback with the phase of an oscillation until stopped; nobody who asked for less motion is shown any.
function oscillator(onPhase) {
  const reduced = matchMedia('(prefers-reduced-motion: reduce)');
  let running = false, begun = 0;
  const tick = (now) => {
    if (!running) return;
    begun ||= now;
    onPhase(Math.sin((2 * Math.PI * (now - begun)) / modePeriod));
    requestAnimationFrame(tick);
  };
  return {
    reduced,
    isRunning: () => running,
    start() { [running, begun] = [!reduced.matches, 0]; if (running) requestAnimationFrame(tick); },
    stop() { running = false; },
  };
}

function connect(data, views, controls, scene, {key, status}) {
  let phase = 0, colouring = null;
  const current = () => views[Number(controls.replicate.value)];
  const state = () => ({colouring, alone: controls.alone.checked, mode: controls.mode.value, phase});
  const update = () => scene.update(particlesOf(current(), state()));
  const motion = oscillator((value) => { phase = value; controls.phase.value = value; update(); });
  const settle = () => {
    motion.stop();
    [phase, controls.phase.value] = [0, 0];
    controls.start.textContent = 'Start';
    controls.phase.disabled = controls.mode.value === '';
    controls.start.disabled = controls.mode.value === '' || motion.reduced.matches;
  };
  const rebuild = (keepCamera) => {
    const view = current();
    colouring = colouringOf(view, controls.colour.value, data.solids[view.solid]);
    key.replaceChildren(keyOf(colouring, controls.colour.value));
    const solid = data.solids[view.solid];
    const forces = controls.forces.checked ? forceHalves(view) : [];
    scene.show(solid.shapes ?? [solid], view, particlesOf(view, state()), {forces, keepCamera});
  };
  const choose = (keepCamera) => {
    const view = current();
    controls.mode.replaceChildren(...modeOptions(view));
    controls.modeBar.hidden = view.modes.length === 0;
    controls.alone.disabled = !view.largest;
    controls.alone.checked = controls.alone.checked && Boolean(view.largest);
    status.replaceChildren(...rich(statusText(data, view)));
    settle();
    rebuild(keepCamera);
  };
  controls.replicate.addEventListener('change', () => choose(false));
  controls.colour.addEventListener('change', () => rebuild(true));
  for (const box of [controls.alone, controls.forces]) box.addEventListener('change', () => rebuild(true));
  controls.bar.append(button('Save PNG', () => save(`${current().name}.png`, scene.picture())));
  controls.mode.addEventListener('change', () => { settle(); update(); });
  controls.phase.addEventListener('input', () => {
    motion.stop();
    controls.start.textContent = 'Start';
    phase = Number(controls.phase.value);
    update();
  });
  controls.start.addEventListener('click', () => {
    if (motion.isRunning()) motion.stop(); else motion.start();
    controls.start.textContent = motion.isRunning() ? 'Stop' : 'Start';
  });
  choose(false);
}

/// Which packings the view has, and why not all.
function choiceText(data, views) {
  const done = data.replicates.filter(({status}) => status === 'done').length;
  const {chosen = views.length, most_particles: most} = data.viewable ?? {};
  if (views.length === done) return `All ${done} packings are included.`;
  const small = done > chosen ? ` ${done - chosen} are left out to keep this file small: it contains one packing ` +
    `of each sweep point, and others up to ${most} particles in total, unflagged ones first.` : '';
  const missing = chosen > views.length ? ` ${chosen - views.length} have no packing in the results directory.` : '';
  return `${views.length} of ${done} packings are included.${small}${missing} Run “isojam export” for the others.`;
}

function drawPackings(data, section) {
  const rowOf = ({name}) => data.replicates.find((replicate) => replicate.name === name).row;
  const views = [...data.views].sort((a, b) => rowOf(a) - rowOf(b));
  if (views.length === 0) {
    section.append(element('p', {className: 'note'}, 'No replicate has a packing to show.'));
    return;
  }
  const kind = webglKind();
  if (!kind) {
    section.append(element('p', {className: 'note', id: 'no-webgl'},
      'This browser has no WebGL, so it cannot draw packings.'));
    return;
  }
  const controls = viewControls(data, views);
  const canvas = element('canvas', {id: 'packing', tabIndex: 0, attributes: {role: 'application',
    'aria-label': 'Packing in its periodic cell. Arrow keys rotate it, plus and minus zoom, Home resets.'}});
  const key = element('div'), status = element('p', {className: 'note', attributes: {'aria-live': 'polite'}});
  const still = matchMedia('(prefers-reduced-motion: reduce)').matches ?
    ' Animation is off because this system requests reduced motion; use the slider to displace the particles.' : '';
  section.append(element('p', {className: 'note', id: 'view-choice'}, choiceText(data, views)), controls.bar,
    element('div', {className: 'stage'}, canvas), key, controls.modeBar, status,
    element('p', {className: 'note help'}, 'Drag or use the arrow keys to rotate. Use + and −, or the wheel after a ' +
      'click on the view, to zoom; Home resets the view. The box is the periodic cell; particles whose centre is ' +
      'inside are drawn whole. Bars show contact forces, from the centre to where the force acts; their thickness ' +
      'is the force.' +
      still));
  connect(data, views, controls, packingScene(canvas, kind === 'hardware'), {key, status});
}
