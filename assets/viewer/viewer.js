// The page of `looproot view`: one figure for each configuration, linked with the table, the dials and the sliders.
// It knows bodies and rigid poses only; how a mechanism moves is computed before.
import {
  AmbientLight, BoxGeometry, BufferAttribute, BufferGeometry, Color, CylinderGeometry, DirectionalLight, DoubleSide,
  GridHelper, Group, HemisphereLight, Mesh, MeshStandardMaterial, PCFShadowMap, PerspectiveCamera, PlaneGeometry, Quaternion,
  Raycaster, Scene, ShadowMaterial, SphereGeometry, Vector2, Vector3, WebGLRenderer,
} from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { mergeGeometries } from 'three/addons/utils/BufferGeometryUtils.js';

const embedded = (id) => JSON.parse(document.getElementById(id)?.textContent || 'null');
const $ = (selector) => document.querySelector(selector);
const all = (selector) => [...document.querySelectorAll(selector)];

// Poses travel as base64 of little-endian 16-bit integers, seven for every body: a quaternion in units of 1/32767, and a
// position in units of reach/32767.
let data = null;
let COUNT = 0;
function frames(text, reach) {
  const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
  const view = new DataView(bytes.buffer);
  const list = Float32Array.from({ length: bytes.length / 2 }, (_, k) => (
    (view.getInt16(2 * k, true) / 32767) * (k % 7 < 4 ? 1 : reach)));
  const count = list.length / (7 * COUNT);
  return Array.from({ length: count }, (_, k) => list.subarray(7 * COUNT * k, 7 * COUNT * (k + 1)));
}

// A track is what can be stood at: a mode has one frame, a family, a branch or a motion has many.
let tracks = [];
const state = { track: -1, frame: 0, overlay: true, grid: false, playing: false };

/** Takes what is to be seen. */
function take(found) {
  data = found;
  COUNT = data.scene ? data.scene.bodies.length : 0;
  tracks = data.tracks.map((track) => ({ ...track, frames: track.poses && COUNT ? frames(track.poses, track.reach) : [] }));
}
take(embedded('data'));

// ---- rigid poses -------------------------------------------------------------------------------------------------------

function placed(pose, body, [x, y, z]) {
  const at = 7 * body;
  const [w, a, b, c] = [pose[at], pose[at + 1], pose[at + 2], pose[at + 3]];
  const cross = (u, v, t) => [b * t - c * v, c * u - a * t, a * v - b * u];
  const once = cross(x, y, z);
  const twice = cross(once[0] + w * x, once[1] + w * y, once[2] + w * z);
  return [x + 2 * twice[0] + pose[at + 4], y + 2 * twice[1] + pose[at + 5], z + 2 * twice[2] + pose[at + 6]];
}

/** The points that must be seen: corners, joints, points of solids. */
function corners(pose) {
  const found = [];
  data.scene.bodies.forEach((body, index) => {
    const add = (point) => found.push(placed(pose, index, point));
    if (!body.parts.length) add([0, 0, 0]);
    for (const part of body.parts) {
      if (part.points) part.points.forEach(add);
      if (part.at) add(part.at);
      if (part.pose) add(part.pose.slice(4));
    }
  });
  for (const { from, to } of data.scene.connections) {
    found.push(placed(pose, from[0], from[1]), placed(pose, to[0], to[1]));
  }
  return found;
}

/** The paths of the points that are traced, along a track. */
function pathsOf(track) {
  if (!track || track.frames.length < 2) return [];
  return (data.scene?.traces || []).map(({ body, at }) => track.frames.map((frame) => placed(frame, body, at)));
}

function bounds(list) {
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  for (const pose of list) {
    for (const point of corners(pose)) {
      point.forEach((x, k) => { low[k] = Math.min(low[k], x); high[k] = Math.max(high[k], x); });
    }
  }
  if (!Number.isFinite(low[0])) return { centre: [0, 0, 0], radius: 1, low: [-1, -1, 0] };
  const centre = low.map((x, k) => (x + high[k]) / 2);
  return { centre, radius: Math.max(Math.hypot(...low.map((x, k) => high[k] - x)) / 2, 1e-9), low };
}

const TRACE = '#b0253a';

// ---- the flat figure: without WebGL, and on paper ----------------------------------------------------------------------

const PALETTE = ['#3f4652', '#2f6fb0', '#1f9e89', '#d0782a', '#8a5fb0', '#c14f63', '#6b8e23', '#3b8ea5', '#b58b1a', '#7a6a5a'];
const tint = (body) => (body === 0 ? PALETTE[0] : PALETTE[1 + ((body - 1) % (PALETTE.length - 1))]);

// Where the eye stands: in front, right and above; straight above what is flat.
const EYE = [0.62, -0.92, 0.46];

/** The directions of the first view: to the eye, to the right, and up. */
function sight() {
  if (data.scene?.flat) return { eye: new Vector3(0, 0, 1), right: new Vector3(1, 0, 0), up: new Vector3(0, 1, 0) };
  const eye = new Vector3(...EYE).normalize();
  const right = new Vector3(-eye.y, eye.x, 0).normalize();
  return { eye, right, up: eye.clone().cross(right) };
}

function drawFlat(pose) {
  const svg = $('#flat');
  if (!svg || !pose) return;
  // As the camera first stands: right, and down.
  const { right, up } = sight();
  const flat = ([x, y, z]) => [right.x * x + right.y * y, -(up.x * x + up.y * y + up.z * z)];
  const paths = pathsOf(tracks[state.track]);
  const points = [...corners(pose), ...paths.flat()].map(flat);
  const xs = points.map((p) => p[0]);
  const ys = points.map((p) => p[1]);
  const [x0, x1, y0, y1] = [Math.min(...xs), Math.max(...xs), Math.min(...ys), Math.max(...ys)];
  const scale = Math.min(360 / (x1 - x0 || 1), 260 / (y1 - y0 || 1));
  const at = (p) => {
    const [x, y] = flat(p);
    return `${(200 + scale * (x - (x0 + x1) / 2)).toFixed(1)},${(150 + scale * (y - (y0 + y1) / 2)).toFixed(1)}`;
  };
  const parts = [];
  const line = (list, colour, width) => parts.push(
    `<polyline points="${list.map(at).join(' ')}" fill="none" stroke="${colour}" stroke-width="${width}" stroke-linecap="round" stroke-linejoin="round"/>`);
  paths.forEach((path) => line(path, TRACE, 1.6));
  data.scene.bodies.forEach((body, index) => {
    for (const part of body.parts) {
      if (part.kind === 'support') {
        const [x, y] = at(placed(pose, index, part.at)).split(',').map(Number);
        parts.push(`<path d="M${x} ${y}l-8 13h16z M${x - 12} ${y + 13}h24" fill="#9aa3ae" stroke="#3f4652" stroke-width="1.4"/>`);
      }
      if (part.kind === 'hull') {
        for (const t of part.triangles) {
          const list = t.map((k) => at(placed(pose, index, part.points[k]))).join(' ');
          parts.push(`<polygon points="${list}" fill="${tint(index)}" fill-opacity="0.14" stroke="${tint(index)}" stroke-width="0.6"/>`);
        }
      }
      if (part.kind === 'link') line(part.points.map((p) => placed(pose, index, p)), tint(index), 5);
    }
  });
  for (const { kind, from, to } of data.scene.connections) {
    line([placed(pose, from[0], from[1]), placed(pose, to[0], to[1])], kind === 'bar' ? '#2f6fb0' : '#8a93a0', 3);
  }
  data.scene.bodies.forEach((body, index) => {
    for (const part of body.parts) {
      if (part.kind !== 'joint') continue;
      const [x, y] = at(placed(pose, index, part.at)).split(',');
      parts.push(`<circle cx="${x}" cy="${y}" r="5" fill="#fff" stroke="#222" stroke-width="1.6"/>`);
    }
  });
  svg.innerHTML = parts.join('');
}

// ---- the stage ---------------------------------------------------------------------------------------------------------

let stage = null;
const GHOSTS = 40;
const CELLS = 48;

function material(colour, opacity = 1) {
  const solid = new MeshStandardMaterial({ color: new Color(colour), roughness: 0.55, metalness: 0.08, side: DoubleSide });
  if (opacity < 1) Object.assign(solid, { transparent: true, opacity, depthWrite: false });
  return solid;
}

/** A cylinder from one point to another. */
function rod(a, b, radius, sides = 14) {
  const [from, to] = [new Vector3(...a), new Vector3(...b)];
  const geometry = new CylinderGeometry(radius, radius, from.distanceTo(to), sides);
  const turn = new Quaternion().setFromUnitVectors(new Vector3(0, 1, 0), to.clone().sub(from).normalize());
  geometry.applyQuaternion(turn);
  const middle = from.add(to).multiplyScalar(0.5);
  geometry.translate(middle.x, middle.y, middle.z);
  return geometry;
}

function ballAt(point, radius) {
  const geometry = new SphereGeometry(radius, 16, 12);
  geometry.translate(...point);
  return geometry;
}

function along(at, axis, length, radius, sides = 26) {
  const end = (sign) => at.map((x, k) => x + (sign * length * axis[k]) / 2);
  return rod(end(-1), end(1), radius, sides);
}

/** Every geometry without the attributes that only some have. */
function plain(geometry) {
  const bare = geometry.index ? geometry.toNonIndexed() : geometry;
  bare.deleteAttribute('uv');
  return bare;
}

function hullGeometry(part) {
  const list = [];
  for (const t of part.triangles) t.forEach((k) => list.push(...part.points[k]));
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(new Float32Array(list), 3));
  geometry.computeVertexNormals();
  return geometry;
}

/** The shapes of one body: of its links, of its joints, of its solids, and its frames. */
function shapes(body, unit) {
  const made = { link: [], joint: [], hull: [], axes: [[], [], []] };
  const near = new Set();
  for (const part of body.parts) {
    if (part.kind === 'link') {
      part.points.forEach((p, k) => {
        const key = p.map((x) => x.toFixed(7)).join();
        // An arc has no corners between its ends.
        const isEnd = part.points.length < 8 || k === 0 || k === part.points.length - 1;
        if (isEnd && !near.has(key)) made.link.push(ballAt(p, unit * 1.02));
        near.add(key);
        if (k > 0) made.link.push(rod(part.points[k - 1], p, unit));
      });
    } else if (part.kind === 'joint') {
      if (part.type === 'S') made.joint.push(ballAt(part.at, 2.3 * unit));
      else if (part.type === 'U') {
        const side = Math.abs(part.axis[2]) < 0.9 ? [0, 0, 1] : [1, 0, 0];
        const other = new Vector3(...part.axis).cross(new Vector3(...side)).normalize().toArray();
        made.joint.push(along(part.at, part.axis, 6 * unit, 1.2 * unit), along(part.at, other, 6 * unit, 1.2 * unit));
      } else if (part.type === 'P') {
        const box = new BoxGeometry(4 * unit, 7 * unit, 4 * unit);
        box.applyQuaternion(new Quaternion().setFromUnitVectors(new Vector3(0, 1, 0), new Vector3(...part.axis).normalize()));
        box.translate(...part.at);
        made.joint.push(box);
      } else made.joint.push(along(part.at, part.axis, (part.type === 'C' ? 7.6 : 4.8) * unit, 1.8 * unit));
    } else if (part.kind === 'support') {
      const foot = new CylinderGeometry(0.4 * unit, 3.4 * unit, 4.4 * unit, 4);
      foot.translate(part.at[0], part.at[1] - 2.2 * unit, part.at[2]);
      const plate = new BoxGeometry(8.4 * unit, 0.8 * unit, 4.8 * unit);
      plate.translate(part.at[0], part.at[1] - 4.6 * unit, part.at[2]);
      made.link.push(foot, plate);
    } else if (part.kind === 'hull') {
      made.hull.push(hullGeometry(part));
      part.points.forEach((p) => made.joint.push(ballAt(p, 1.25 * unit)));
    } else if (part.kind === 'frame') {
      const pose = part.pose;
      [[1, 0, 0], [0, 1, 0], [0, 0, 1]].forEach((axis, k) => {
        const end = placed(pose, 0, axis.map((x) => x * 7 * unit));
        const neck = placed(pose, 0, axis.map((x) => x * 5.4 * unit));
        made.axes[k].push(rod(pose.slice(4), neck, 0.34 * unit, 8));
        const tip = new CylinderGeometry(0, 0.9 * unit, 1.6 * unit, 12);
        tip.applyQuaternion(new Quaternion().setFromUnitVectors(
          new Vector3(0, 1, 0), new Vector3(...end).sub(new Vector3(...neck)).normalize()));
        const middle = neck.map((x, i) => (x + end[i]) / 2);
        tip.translate(...middle);
        made.axes[k].push(tip);
      });
    }
  }
  const merged = (list) => (list.length ? mergeGeometries(list.map(plain)) : null);
  return { link: merged(made.link), joint: merged(made.joint), hull: merged(made.hull), axes: made.axes.map(merged) };
}

/** One configuration as meshes; geometries are shared by all of them. */
function figure(parts, unit, ghost) {
  const group = new Group();
  const bodies = parts.map((part, index) => {
    const body = new Group();
    const add = (geometry, colour, opacity = 1) => {
      if (!geometry) return;
      const mesh = new Mesh(geometry, material(colour, ghost ? 0.13 : opacity));
      mesh.castShadow = !ghost;
      body.add(mesh);
    };
    add(part.link, tint(index));
    add(part.joint, '#232a35');
    add(part.hull, index === 0 ? '#56606e' : data.scene.flat ? tint(index) : '#2f6fb0', 0.42);
    if (!ghost) part.axes.forEach((geometry, k) => add(geometry, ['#d1495b', '#3a9d5d', '#2f6fb0'][k]));
    if (!data.scene.bodies[index].parts.length) add(stage.vertex, '#232a35');
    group.add(body);
    return body;
  });
  const rods = data.scene.connections.map(({ kind }) => {
    const colour = { leg: '#8b95a3', travel: '#9aa3ae', bar: '#2f6fb0' }[kind];
    const mesh = new Mesh(stage.rod, material(colour, ghost ? 0.13 : 1));
    mesh.castShadow = !ghost;
    group.add(mesh);
    return mesh;
  });
  return { group, bodies, rods, unit };
}

function pose(figure, frame) {
  figure.bodies.forEach((body, k) => {
    const at = 7 * k;
    body.quaternion.set(frame[at + 1], frame[at + 2], frame[at + 3], frame[at]);
    body.position.set(frame[at + 4], frame[at + 5], frame[at + 6]);
  });
  figure.rods.forEach((mesh, k) => {
    const { kind, from, to } = data.scene.connections[k];
    const [a, b] = [new Vector3(...placed(frame, ...from)), new Vector3(...placed(frame, ...to))];
    const length = a.distanceTo(b);
    mesh.visible = length > 1e-9;
    if (!mesh.visible) return;
    mesh.position.copy(a).add(b).multiplyScalar(0.5);
    mesh.quaternion.setFromUnitVectors(new Vector3(0, 1, 0), b.sub(a).divideScalar(length));
    const width = figure.unit * { leg: 0.75, travel: 0.6, bar: 0.62 }[kind];
    mesh.scale.set(width, length, width);
  });
}

function open3d() {
  const canvas = $('#canvas');
  if (!canvas || !COUNT || !(live || tracks.some((track) => track.frames.length))) return;
  // three.js complains on the console where there is no WebGL: ask first.
  const context = canvas.getContext('webgl2', { antialias: true, alpha: true, preserveDrawingBuffer: true });
  if (!context) return;
  const renderer = new WebGLRenderer({ canvas, context, antialias: true, alpha: true, preserveDrawingBuffer: true });
  renderer.setPixelRatio(Math.min(window.devicePixelRatio || 1, 2));
  renderer.shadowMap.enabled = true;
  renderer.shadowMap.type = PCFShadowMap;
  const scene = new Scene();
  const camera = new PerspectiveCamera(32, 1, 0.01, 100);
  camera.up.set(0, data.scene.flat ? 1 : 0, data.scene.flat ? 0 : 1);
  const controls = new OrbitControls(camera, canvas);
  controls.addEventListener('change', draw);
  controls.addEventListener('start', () => { stage.touched = true; });
  scene.add(new AmbientLight('#ffffff', 0.75), new HemisphereLight('#ffffff', '#b9c0cc', 1.1));
  const sun = new DirectionalLight('#ffffff', 1.9);
  sun.castShadow = true;
  sun.shadow.mapSize.set(1024, 1024);
  scene.add(sun, sun.target);
  stage = { renderer, scene, camera, controls, sun, ghosts: [], canvas };
  stage.rod = new CylinderGeometry(1, 1, 1, 14);
  document.body.classList.add('has-3d');
  fit();
  new ResizeObserver(resize).observe(canvas.parentElement);
  canvas.addEventListener('pointerdown', (event) => { stage.down = [event.clientX, event.clientY]; });
  canvas.addEventListener('click', pick);
  if (live) dragged(canvas);
}

/** How far a track reaches; tracks that reach much farther than the chosen one are not fitted into its view. */
const FARTHER = 4;
/** Frames of a track that the camera is fitted to. */
const FITTED = 48;

function thinned(track) {
  const stride = Math.ceil(track.frames.length / FITTED);
  return track.frames.filter((_, k) => k % stride === 0);
}

function reachOf(track) {
  if (track.size === undefined) track.size = bounds(thinned(track)).radius;
  return track.size;
}

/** The tracks that the view must hold: those of the case that are not much larger than the chosen one. */
function fitted() {
  const own = tracks[state.track]?.frames.length ? tracks[state.track] : tracks.find((track) => track.frames.length);
  if (!own) return [];
  const most = FARTHER * reachOf(own);
  const list = tracks.filter((track) => track.case === own.case && track.kind === own.kind && track.frames.length);
  return list.filter((track) => reachOf(track) <= most).slice(0, 600);
}

/** Builds the figures to the size of what is seen, and stands the camera before them. */
function fit() {
  const list = fitted();
  stage.fitted = list.map((track) => track.name).join();
  const seen = list.flatMap(thinned);
  const { centre, radius, low } = bounds(seen);
  const { scene, camera, sun } = stage;
  stage.centre = new Vector3(...centre);
  // Links keep their thickness unless what is seen is of quite another size.
  if (!stage.main || radius > 1.7 * stage.radius || radius < stage.radius / 1.7) build(radius);
  const floor = Math.min(low[2], 0) < low[2] - radius ? low[2] : Math.min(low[2], 0);
  if (stage.floor) scene.remove(stage.floor);
  const step = 10 ** Math.floor(Math.log10(radius));
  const cell = [0.2, 0.5, 1, 2].map((k) => k * step).find((k) => radius / k <= 7) || step;
  const half = Math.ceil((1.7 * radius) / cell);
  const grid = new GridHelper(2 * half * cell, 2 * half, '#9aa6b5', '#c9d1da');
  grid.rotation.x = Math.PI / 2;
  Object.assign(grid.material, { transparent: true, opacity: 0.55 });
  const shade = new Mesh(new PlaneGeometry(2 * half * cell, 2 * half * cell), new ShadowMaterial({ opacity: 0.16 }));
  shade.receiveShadow = true;
  stage.floor = new Group();
  stage.floor.add(grid, shade);
  stage.floor.position.set(Math.round(centre[0] / cell) * cell, Math.round(centre[1] / cell) * cell, floor - 0.004 * radius);
  scene.add(stage.floor);
  const reach = 1.5 * radius;
  sun.position.copy(stage.centre).add(new Vector3(0.8 * radius, -1.3 * radius, 3 * radius));
  sun.target.position.copy(stage.centre);
  Object.assign(sun.shadow.camera, { left: -reach, right: reach, top: reach, bottom: -reach, near: 0.1 * radius, far: 7 * radius });
  sun.shadow.camera.updateProjectionMatrix();
  sun.shadow.normalBias = 0.02 * radius;
  stage.standing = null;
  resize();
  const points = [...seen.flatMap(corners), ...list.slice(0, CELLS).flatMap((track) => pathsOf(track).flat())];
  stage.standing = (aspect) => standing(points, stage.centre, camera.fov, aspect);
  stage.touched = false;
  stand();
}

/** Stands the camera where the figures just fit into the frame. */
function stand() {
  const { camera, controls, radius } = stage;
  const { target, distance } = stage.standing(camera.aspect);
  controls.target.copy(target);
  camera.position.copy(target).add(sight().eye.multiplyScalar(distance));
  camera.near = distance / 100;
  camera.far = distance + 40 * radius;
  camera.updateProjectionMatrix();
  controls.update();
  draw();
}

/**
 * Where the camera looks, and from how far, so that all points are just inside the frame. With a point at (a, b) beside the
 * line of sight and d before the centre, the frame holds it where |a - x| and |b - y| are at most (distance - d) times the
 * slope of the frame: two bounds for each of x and y, linear in the distance.
 */
function standing(points, centre, fov, aspect) {
  const { eye, right, up } = sight();
  // Room for the thickness of links and for labels.
  const slope = 0.86 * Math.tan((fov * Math.PI) / 360);
  const slopes = [slope * aspect, slope];
  const most = [-Infinity, -Infinity, -Infinity, -Infinity];
  let nearest = 0;
  for (const [x, y, z] of points) {
    const p = new Vector3(x, y, z).sub(centre);
    const [d, a, b] = [p.dot(eye), p.dot(right), p.dot(up)];
    nearest = Math.max(nearest, d);
    [a, -a].forEach((value, k) => { most[k] = Math.max(most[k], value + d * slopes[0]); });
    [b, -b].forEach((value, k) => { most[2 + k] = Math.max(most[2 + k], value + d * slopes[1]); });
  }
  if (!points.length) return { target: centre.clone(), distance: 4 };
  const distance = Math.max((most[0] + most[1]) / (2 * slopes[0]), (most[2] + most[3]) / (2 * slopes[1]), 1.05 * nearest, 1e-9);
  const target = centre.clone().addScaledVector(right, (most[0] - most[1]) / 2).addScaledVector(up, (most[2] - most[3]) / 2);
  return { target, distance };
}

/** The figures with links of a thickness for this size. */
function build(radius) {
  const { scene } = stage;
  for (const old of [stage.main, ...stage.ghosts.map((ghost) => ghost.figure)]) if (old) scene.remove(old.group);
  stage.ghosts = [];
  const unit = stage.unit = Math.max(radius * 0.017, 1e-9);
  stage.radius = radius;
  stage.vertex = new SphereGeometry(1.2 * unit, 18, 14);
  stage.shapes = data.scene.bodies.map((body) => shapes(body, unit));
  stage.main = figure(stage.shapes, unit, false);
  scene.add(stage.main.group);
}

function currentCase() {
  return state.track < 0 ? data.case || 0 : tracks[state.track].case;
}

/** The tracks drawn with the chosen one: modes of the same case, or branches at the same input. */
function companions() {
  const own = tracks[state.track];
  if (!own) return [];
  return tracks.filter((track) => track !== own && track.case === own.case && track.frames.length && track.kind === own.kind);
}

function frameOf(track) {
  if (track.frames.length === 1) return track.frames[0];
  const own = tracks[state.track];
  if (track === own) return own.frames[state.frame];
  if (!track.inputs || !own.inputs) return null;
  const wanted = own.inputs[state.frame];
  const found = track.inputs.findIndex((input) => Math.abs(input - wanted) < 1e-9);
  return found < 0 ? null : track.frames[found];
}

function refresh() {
  if (!stage) return;
  const frame = tracks[state.track] && frameOf(tracks[state.track]);
  stage.main.group.visible = Boolean(frame);
  if (frame) pose(stage.main, frame);
  stage.ghosts.forEach((ghost) => { ghost.figure.group.visible = false; });
  if (state.overlay && !state.grid) {
    companions().slice(0, GHOSTS).forEach((track, k) => {
      const own = frameOf(track);
      if (!own) return;
      const ghost = stage.ghosts[k] || (stage.ghosts[k] = { figure: figure(stage.shapes, stage.unit, true) });
      if (!ghost.figure.group.parent) stage.scene.add(ghost.figure.group);
      ghost.track = track;
      ghost.figure.group.visible = true;
      ghost.figure.group.traverse((part) => { part.userData.track = track; });
      pose(ghost.figure, own);
    });
  }
  trace(tracks[state.track]);
  draw();
}

/** The paths of the traced points along a track, and where they are now. */
function trace(track) {
  if (stage.traced !== track) {
    if (stage.paths) stage.scene.remove(stage.paths);
    stage.traced = track;
    stage.paths = new Group();
    for (const path of pathsOf(track)) {
      if (track.closed) path.push(path[0]);
      const pieces = path.slice(1).map((p, k) => [path[k], p]).filter(([a, b]) => Math.hypot(...a.map((x, i) => x - b[i])) > 1e-9);
      if (!pieces.length) continue;
      const tube = mergeGeometries(pieces.map(([a, b]) => plain(rod(a, b, 0.42 * stage.unit, 6))));
      stage.paths.add(new Mesh(tube, material(TRACE)));
    }
    stage.marks = (data.scene.traces || []).map(() => {
      const mark = new Mesh(new SphereGeometry(1.5 * stage.unit, 18, 14), material(TRACE));
      stage.paths.add(mark);
      return mark;
    });
    stage.scene.add(stage.paths);
  }
  const frame = track && frameOf(track);
  (data.scene.traces || []).forEach(({ body, at }, k) => {
    stage.marks[k].visible = Boolean(frame);
    if (frame) stage.marks[k].position.set(...placed(frame, body, at));
  });
}

let wanted = false;
function draw() {
  if (!stage || wanted) return;
  wanted = true;
  requestAnimationFrame(() => { wanted = false; render(); });
}

function render() {
  const { renderer, scene, camera, canvas } = stage;
  const [width, height] = [canvas.clientWidth, canvas.clientHeight];
  const labels = $('#labels');
  if (!state.grid) {
    renderer.setScissorTest(false);
    renderer.setViewport(0, 0, width, height);
    camera.aspect = width / height;
    camera.zoom = 1;
    camera.updateProjectionMatrix();
    renderer.render(scene, camera);
    label(labels, width, height);
    return;
  }
  const own = tracks.filter((track) => track.case === currentCase() && track.frames.length && track.kind === tracks[state.track]?.kind);
  // Of many the neighbours of the chosen one: smaller figures could not be told from each other.
  const start = Math.max(0, Math.min(own.indexOf(tracks[state.track]) - CELLS / 2, own.length - CELLS));
  const cells = own.slice(start, start + CELLS);
  // As many columns as make the figures largest.
  const edge = (columns) => Math.min(width / columns, height / Math.ceil(cells.length / columns));
  const columns = Array.from({ length: cells.length }, (_, k) => k + 1).reduce((best, k) => (edge(k) > edge(best) ? k : best), 1);
  const rows = Math.ceil(cells.length / columns);
  const [w, h] = [width / columns, height / rows];
  camera.aspect = w / h;
  // As the camera stands, the whole frame is filled; a cell of another shape holds more or less of it.
  camera.zoom = stage.standing(width / height).distance / stage.standing(camera.aspect).distance;
  camera.updateProjectionMatrix();
  renderer.setScissorTest(true);
  labels.textContent = '';
  cells.forEach((track, k) => {
    const [x, y] = [(k % columns) * w, Math.floor(k / columns) * h];
    pose(stage.main, track.frames.length > 1 ? frameOf(track) || track.frames[0] : track.frames[0]);
    renderer.setViewport(x, height - y - h, w, h);
    renderer.setScissor(x, height - y - h, w, h);
    renderer.render(scene, camera);
    const name = document.createElement('button');
    name.className = `cell${track === tracks[state.track] ? ' chosen' : ''}`;
    Object.assign(name.style, { left: `${x}px`, top: `${y}px`, width: `${w}px`, height: `${h}px` });
    name.textContent = track.name;
    name.addEventListener('click', () => choose(tracks.indexOf(track)));
    labels.append(name);
  });
  const frame = tracks[state.track] && frameOf(tracks[state.track]);
  if (frame) pose(stage.main, frame);
}

/** The numbers of the joints beside them, the names of vertices at them. */
function label(labels, width, height) {
  const frame = tracks[state.track] && frameOf(tracks[state.track]);
  const list = [];
  if (frame) {
    data.scene.bodies.forEach((body, index) => {
      const joints = body.parts.filter((part) => part.kind === 'joint');
      joints.forEach((part) => list.push([part.label ?? part.joint, placed(frame, index, part.at), part.axis, index]));
      if (!body.parts.length) list.push([body.name, placed(frame, index, [0, 0, 0])]);
    });
  }
  // The names of many vertices would hide what they name.
  const few = list.length <= 24 ? list : [];
  // Several joints at one place share a label.
  const shown = [];
  for (const [name, point] of few) {
    const at = new Vector3(...point).project(stage.camera);
    const [x, y] = [((at.x + 1) * width) / 2, ((1 - at.y) * height) / 2];
    const same = shown.find((one) => Math.hypot(one.x - x, one.y - y) < 14);
    if (same) same.names.push(name); else shown.push({ x, y, names: [name] });
  }
  while (labels.children.length > shown.length) labels.lastChild.remove();
  shown.forEach(({ x, y, names }, k) => {
    const span = labels.children[k] || labels.appendChild(document.createElement('span'));
    span.className = 'tag';
    span.textContent = names.join(' ');
    span.style.transform = `translate(${x + 9}px, ${y - 20}px)`;
  });
}

function resize() {
  if (!stage) return;
  const { renderer, camera, canvas } = stage;
  const [width, height] = [canvas.parentElement.clientWidth, canvas.parentElement.clientHeight];
  if (!width || !height) return;
  renderer.setSize(width, height, false);
  camera.aspect = width / height;
  camera.updateProjectionMatrix();
  // The frame takes its shape while the page is laid out; who has turned the figure keeps his view.
  if (stage.standing && !stage.touched && !state.grid) stand(); else draw();
}

/** The line of sight through the pointer. */
function pointed(event) {
  const box = stage.canvas.getBoundingClientRect();
  const at = new Vector2(((event.clientX - box.left) / box.width) * 2 - 1, 1 - ((event.clientY - box.top) / box.height) * 2);
  const ray = new Raycaster();
  ray.setFromCamera(at, stage.camera);
  return ray;
}

/** A click that is no drag chooses the ghost under it. */
function pick(event) {
  if (!stage.down || Math.hypot(event.clientX - stage.down[0], event.clientY - stage.down[1]) > 4) return;
  const ray = pointed(event);
  const ghosts = stage.ghosts.filter((ghost) => ghost.figure.group.visible).map((ghost) => ghost.figure.group);
  const hit = ray.intersectObjects([...ghosts, stage.main.group], true)[0];
  if (hit && hit.object.userData.track) choose(tracks.indexOf(hit.object.userData.track));
}

// ---- choosing ----------------------------------------------------------------------------------------------------------

let [rows, buttons, marks] = [[], [], new Map()];

function choose(index, frame) {
  if (index < 0 || index >= tracks.length) return;
  const track = tracks[index];
  const before = currentCase();
  const fresh = index !== state.track;
  state.track = index;
  if (fresh) state.frame = track.frames.length > 1 ? Math.floor(track.frames.length / 4) : 0;
  if (frame !== undefined) state.frame = frame;
  for (const row of rows) {
    const is = row.dataset.track === String(index) ? 'true' : 'false';
    if (row.getAttribute('aria-selected') !== is) row.setAttribute('aria-selected', is);
  }
  for (const button of buttons) button.setAttribute('aria-pressed', button.dataset.track === String(index));
  for (const mark of all('[data-mark].chosen')) mark.classList.remove('chosen');
  // The chosen one lies above the others.
  for (const mark of marks.get(String(index)) || []) { mark.classList.add('chosen'); mark.parentElement.append(mark); }
  const row = rows.find((one) => one.dataset.track === String(index));
  if (row && fresh) {
    const holder = row.closest('.scroll');
    const [top, bottom] = [row.offsetTop - 34, row.offsetTop + row.offsetHeight];
    if (holder && (top < holder.scrollTop || bottom > holder.scrollTop + holder.clientHeight)) {
      holder.scrollTop = Math.max(0, top - holder.clientHeight / 3);
    }
  }
  for (const panel of all('[data-case]')) panel.hidden = panel.dataset.case !== String(track.case);
  slide(track);
  if (!track.frames.length) state.playing = false;
  // While a live page is moved, the camera stands still.
  if (stage && !state.moving && (before !== track.case || fitted().map((one) => one.name).join() !== stage.fitted)) fit();
  drawFlat(track.frames[state.frame]);
  refresh();
}

/** The slider of a track with many frames, and the cursors of its panels. */
function slide(track) {
  const range = $('#range');
  if (!range) return;
  const many = track.frames.length > 1 || (track.inputs || []).length > 1;
  $('#slider').hidden = !many;
  if (!many) return;
  range.max = Math.max(track.frames.length, (track.inputs || []).length) - 1;
  range.value = state.frame;
  const input = track.inputs ? track.inputs[state.frame] : null;
  $('#value').textContent = input === null ? `${state.frame + 1} of ${Number(range.max) + 1}` : `${track.variable} = ${input.toFixed(track.digits).replace('-', '\u2212')}${track.unit}`;
  for (const cursor of all('.cursor')) {
    if (input === null) continue;
    const [low, high, width] = cursor.dataset.scale.split(' ').map(Number);
    const x = ((input - low) / (high - low)) * width;
    cursor.setAttribute('x1', x);
    cursor.setAttribute('x2', x);
  }
}

function go(frame) {
  const track = tracks[state.track];
  if (!track) return;
  const count = Number($('#range').max) + 1;
  state.frame = ((frame % count) + count) % count;
  slide(track);
  drawFlat(track.frames[state.frame]);
  refresh();
}

/** Plays once a frame: a closed branch goes round, another one to and fro. */
let direction = 1;
function play() {
  const track = tracks[state.track];
  const button = $('#play');
  if (button) button.textContent = state.playing ? 'Pause' : 'Play';
  if (!state.playing || !track || track.frames.length < 2) { state.playing = false; return; }
  const last = track.frames.length - 1;
  if (track.closed) direction = 1;
  else if (state.frame >= last) direction = -1;
  else if (state.frame <= 0) direction = 1;
  go(state.frame + direction);
  setTimeout(() => requestAnimationFrame(play), Math.max(16, 5000 / (last + 1)));
}

function toggle(name) {
  if (name === 'play') { state.playing = !state.playing; play(); return; }
  if (name === 'reset') { if (stage) fit(); return; }
  state[name] = !state[name];
  for (const button of all(`button[data-key="${name}"]`)) button.setAttribute('aria-pressed', String(state[name]));
  refresh();
}

function step(by) {
  const listed = rows.filter((row) => row.dataset.track !== undefined && !row.hidden).map((row) => Number(row.dataset.track));
  const order = listed.length ? listed : tracks.map((_, k) => k);
  const at = order.indexOf(state.track);
  choose(order[Math.min(Math.max(at + by, 0), order.length - 1)]);
}

/** Finds the rows, marks and buttons of the tracks, and listens to them. */
function wire() {
  rows = all('table tbody tr');
  buttons = all('button[data-track]');
  marks = new Map();
  for (const mark of all('[data-mark]')) {
    const { mark: track } = mark.dataset;
    if (marks.has(track)) marks.get(track).push(mark); else marks.set(track, [mark]);
    mark.addEventListener('click', () => choose(Number(track)));
  }
  for (const row of rows) {
    if (row.dataset.track !== undefined) row.addEventListener('click', () => choose(Number(row.dataset.track)));
  }
  for (const button of buttons) button.addEventListener('click', () => choose(Number(button.dataset.track)));
  for (const head of all('th[data-sort]')) head.addEventListener('click', () => sort(head));
}

for (const button of all('button[data-key]')) button.addEventListener('click', () => toggle(button.dataset.key));
const range = $('#range');
if (range) range.addEventListener('input', () => { state.playing = false; play(); go(Number(range.value)); });
document.addEventListener('keydown', (event) => {
  if (event.ctrlKey || event.metaKey || event.altKey) return;
  const inSlider = event.target === range;
  const keys = {
    ArrowDown: () => step(1), ArrowUp: () => step(-1),
    ArrowRight: () => (tracks[state.track]?.frames.length > 1 ? go(state.frame + 1) : step(1)),
    ArrowLeft: () => (tracks[state.track]?.frames.length > 1 ? go(state.frame - 1) : step(-1)),
    Home: () => choose(0), o: () => toggle('overlay'), g: () => toggle('grid'), r: () => toggle('reset'), ' ': () => toggle('play'),
  };
  if (inSlider && event.key.startsWith('Arrow')) return;
  if (event.target.tagName === 'BUTTON' && event.key === ' ') return;
  const act = keys[event.key];
  if (!act) return;
  event.preventDefault();
  act();
});

/** Sorts by a column; a second click turns the order. */
function sort(head) {
  const column = [...head.parentElement.children].indexOf(head);
  const down = head.getAttribute('aria-sort') === 'ascending';
  for (const other of all('th[data-sort]')) other.removeAttribute('aria-sort');
  head.setAttribute('aria-sort', down ? 'descending' : 'ascending');
  const key = (row) => Number(row.children[column]?.dataset.value ?? row.children[column]?.textContent.replace('\u2212', '-'));
  const body = rows[0]?.parentElement;
  rows.sort((a, b) => (down ? key(b) - key(a) : key(a) - key(b)) || 0);
  rows.forEach((row) => body.append(row));
}

// ---- live: what is asked is moved, and all solutions follow -----------------------------------------------------------------

const live = embedded('live');

/** How far apart two configurations are: the farthest any body is moved, rotations as their effect on the size of the scene. */
function apart(a, b) {
  if (!a || !b) return Infinity;
  const turns = (k) => k % 7 < 4;
  return a.reduce((most, x, k) => Math.max(most, Math.abs(x - b[k]) * (turns(k) ? data.scene.size : 1)), 0);
}

/** Shows another answer; the solution nearest to the chosen one is chosen. */
function show(parts) {
  const before = tracks[state.track]?.frames[state.frame];
  const same = JSON.stringify(parts.data.scene) === JSON.stringify(data.scene);
  const scrolled = $('.scroll')?.scrollTop || 0;
  document.body.className = `${parts.tone}${stage ? ' has-3d' : ''}`;
  $('header').outerHTML = parts.header;
  $('footer').outerHTML = parts.footer;
  $('.side').innerHTML = parts.side;
  take(parts.data);
  wire();
  if ($('.scroll')) $('.scroll').scrollTop = scrolled;
  if (stage && !same && COUNT) build(stage.radius);
  Object.assign(state, { track: -1, frame: 0, moving: true });
  const nearest = tracks.reduce((best, track, k) => (
    track.frames.length && apart(track.frames[0], before) < apart(tracks[best]?.frames[0], before) ? k : best), -1);
  if (tracks.length) choose(nearest < 0 ? data.first || 0 : nearest); else refresh();
  state.moving = false;
}

/** Pixels within which the tool is taken. */
const NEAR_TOOL = 24;

/**
 * Drags what is asked: the tool of an arm and the plate of a platform follow the pointer in the plane that faces the camera, an
 * input follows the pointer to the right. The ground, and everything beside the figure, turns the camera as before.
 */
function dragged(canvas) {
  let drag = null;
  /** The origin of the tool, which is thin, where the pointer is near to it. */
  const toolBeside = ({ offsetX, offsetY }) => {
    const frame = frameOf(tracks[state.track]);
    const tool = data.scene.bodies[COUNT - 1].parts.find((part) => part.kind === 'frame');
    if (!frame || !tool) return null;
    const point = new Vector3(...placed(frame, COUNT - 1, tool.pose.slice(4)));
    const at = point.clone().project(stage.camera);
    const [x, y] = [((at.x + 1) * canvas.clientWidth) / 2, ((1 - at.y) * canvas.clientHeight) / 2];
    return Math.hypot(x - offsetX, y - offsetY) < NEAR_TOOL ? point : null;
  };
  const held = (event) => {
    if (state.grid || !stage.main.group.visible || !live.set) return null;
    const hit = pointed(event).intersectObject(stage.main.group, true)[0];
    const body = hit ? stage.main.bodies.indexOf(hit.object.parent) : -1;
    const places = live.controls.length > 1;
    const tool = places && toolBeside(event);
    if (tool) return { point: tool, places };
    return body > 0 && (!places || body === COUNT - 1) ? { point: hit.point, places } : null;
  };
  const asked = ({ point, places, values, legs, start, normal }, event) => {
    if (!places) {
      const { low, high } = live.controls[0];
      return [values[0] + ((high - low) * (event.clientX - start)) / canvas.clientWidth];
    }
    const { origin, direction } = pointed(event).ray;
    const way = origin.clone().addScaledVector(direction, point.clone().sub(origin).dot(normal) / direction.dot(normal)).sub(point);
    if (!legs.length) return values.map((value, k) => (k < 3 ? value + way.getComponent(k) : value));
    return values.map((_, k) => legs[k][1].clone().add(way).distanceTo(legs[k][0]));
  };
  canvas.addEventListener('pointerdown', (event) => {
    const found = event.button === 0 ? held(event) : null;
    if (!found) return;
    event.stopImmediatePropagation();
    stage.down = null;
    canvas.setPointerCapture(event.pointerId);
    const frame = frameOf(tracks[state.track]);
    const ends = data.scene.connections.filter(({ kind }) => kind === 'leg')
      .map(({ from, to }) => [from, to].map((end) => new Vector3(...placed(frame, ...end))));
    const legs = ends.length === live.controls.length ? ends : [];
    const normal = stage.camera.getWorldDirection(new Vector3());
    drag = { ...found, values: live.values(), legs, start: event.clientX, normal };
  }, true);
  canvas.addEventListener('pointermove', (event) => {
    if (drag) live.setAll(asked(drag, event));
    else if (!event.buttons) canvas.style.cursor = held(event) ? 'move' : '';
  });
  for (const end of ['pointerup', 'pointercancel']) canvas.addEventListener(end, () => { drag = null; });
}

/** Starts what solves: a worker with the program of this page, or the window around it. */
function solver(answered) {
  const text = (id) => document.getElementById(id)?.textContent;
  if (!text('module')) {
    window.addEventListener('message', ({ data: answer }) => { if (answer && 'code' in answer) answered(answer); });
    return { ready: Promise.resolve(), ask: (question) => window.parent.postMessage(question, '*') };
  }
  const bytes = globalThis.unpacked(text('module'));
  const worker = new Worker(URL.createObjectURL(new Blob([text('worker')], { type: 'text/javascript' })));
  const ready = new Promise((resolve, reject) => {
    worker.onmessage = ({ data: answer }) => {
      if ('ready' in answer) { if (answer.ready) resolve(); else reject(answer.error); } else answered(answer);
    };
  });
  worker.postMessage({ module: bytes, gzipped: true }, [bytes.buffer]);
  return { ready, ask: (question) => worker.postMessage(question) };
}

function startLive() {
  const place = $('#controls');
  const values = live.controls.map((control) => control.value);
  const outputs = [];
  const time = document.createElement('output');
  time.id = 'time';
  const started = performance.now();
  let [busy, next, count, sent] = [true, false, 0, 0];

  const number = (control, value) => `${value.toFixed(control.digits).replace('-', '\u2212')} ${control.unit === 'deg' ? '\u00b0' : control.unit}`;
  const question = () => {
    const argument = live.argument.replace(/\{(\d)\}/g, (_, k) => values[k].toFixed(live.controls[k].digits));
    return { args: [...live.arguments, argument], files: live.files };
  };
  const ask = () => {
    busy = true;
    next = false;
    sent = performance.now();
    own.ask({ id: ++count, ...question() });
  };
  const own = solver((answer) => {
    busy = false;
    const ms = performance.now() - sent;
    document.documentElement.dataset.answer = answer.id;
    document.documentElement.dataset.code = answer.code;
    try {
      show(JSON.parse(answer.stdout));
      time.textContent = `${ms.toFixed(0)} ms`;
      time.classList.remove('wrong');
    } catch {
      // What the program has to say about it, in its own words.
      time.textContent = answer.stderr.trim();
      time.classList.add('wrong');
    }
    if (next) ask();
  });
  const moved = () => { if (busy) next = true; else ask(); };
  const put = (k, value) => {
    values[k] = value;
    outputs[k].value.textContent = number(live.controls[k], value);
    outputs[k].range.value = value;
  };
  live.set = (k, value) => { put(k, value); moved(); };
  live.values = () => [...values];
  live.setAll = (list) => {
    list.forEach((value, k) => put(k, Math.min(live.controls[k].high, Math.max(live.controls[k].low, value))));
    moved();
  };

  live.controls.forEach((control, k) => {
    const label = document.createElement('label');
    const name = document.createElement('span');
    name.textContent = control.name;
    const range = document.createElement('input');
    Object.assign(range, { type: 'range', min: control.low, max: control.high, step: 'any', value: control.value });
    range.addEventListener('input', () => live.set(k, Math.round(Number(range.value) / control.step) * control.step));
    range.addEventListener('keydown', (event) => {
      const by = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1 }[event.key];
      if (!by) return;
      event.preventDefault();
      event.stopPropagation();
      live.set(k, Math.min(control.high, Math.max(control.low, values[k] + by * control.step)));
    });
    const value = document.createElement('output');
    value.textContent = number(control, control.value);
    outputs.push({ range, value });
    label.append(name, range, value);
    place.append(label);
  });
  place.append(time);
  time.textContent = 'the solver starts';
  own.ready.then(() => {
    busy = false;
    time.textContent = `ready after ${(performance.now() - started).toFixed(0)} ms`;
    document.documentElement.dataset.live = 'true';
    if (next) ask();
    else own.ask({ rehearse: true, ...question() });
  }, (error) => {
    time.textContent = `the solver does not start: ${error}`;
    time.classList.add('wrong');
  });
}

const begin = data.case || 0;
state.overlay = tracks.filter((track) => track.case === begin && track.frames.length).length <= 16;
for (const button of all('button[data-key="overlay"]')) button.setAttribute('aria-pressed', String(state.overlay));
wire();
open3d();
choose(data.first || 0);
document.documentElement.dataset.ready = 'true';
if (live) startLive();
