// Scenes of any number of triangles, as files, and what a run on one takes; for the benchmarks.
import { spawnSync } from 'node:child_process';

/** A closed ball with bumps, that shadows itself: rings of quads, and a fan at each pole. */
export function bumpyBall(rings, sectors, { centre = [0, 0.5, 0], radius = 1 } = {}) {
  const around = rings - 1;
  const positions = new Float32Array(3 * (2 + around * sectors));
  const indices = new Uint32Array(6 * around * sectors);
  const set = (vertex, x, y, z) =>
    positions.set([centre[0] + radius * x, centre[1] + radius * y, centre[2] + radius * z],
                  3 * vertex);
  set(0, 0, 1, 0);
  for (let i = 1; i < rings; ++i)
    for (let k = 0; k < sectors; ++k) {
      const theta = Math.PI * i / rings;
      const phi = 2 * Math.PI * k / sectors;
      const out = 1 + 0.08 * Math.sin(9 * theta) * Math.sin(12 * phi);
      set(1 + (i - 1) * sectors + k, out * Math.sin(theta) * Math.cos(phi), out * Math.cos(theta),
          out * Math.sin(theta) * Math.sin(phi));
    }
  const last = 1 + around * sectors;
  set(last, 0, -1, 0);
  const at = (i, k) => 1 + (i - 1) * sectors + k % sectors;
  let next = 0;
  const add = (...corners) => {
    indices.set(corners, next);
    next += corners.length;
  };
  for (let k = 0; k < sectors; ++k) {
    add(0, at(1, k + 1), at(1, k), last, at(rings - 1, k), at(rings - 1, k + 1));
    for (let i = 1; i + 1 < rings; ++i)
      add(at(i, k), at(i, k + 1), at(i + 1, k), at(i + 1, k), at(i, k + 1), at(i + 1, k + 1));
  }
  return { positions, indices };
}

/** Hills, as a square grid of `side` by `side` quads, 20 wide. */
export function hills(side) {
  const positions = new Float32Array(3 * (side + 1) ** 2);
  const indices = new Uint32Array(6 * side ** 2);
  for (let i = 0; i <= side; ++i)
    for (let k = 0; k <= side; ++k) {
      const [x, z] = [20 * i / side - 10, 20 * k / side - 10];
      const y = 0.3 * Math.sin(1.3 * x) * Math.cos(1.7 * z) +
                0.05 * Math.sin(9 * x + 2 * z) * Math.sin(7 * z) +
                0.004 * Math.sin(91 * x) * Math.sin(83 * z);
      positions.set([x, y, z], 3 * (i * (side + 1) + k));
    }
  for (let i = 0; i < side; ++i)
    for (let k = 0; k < side; ++k) {
      const a = i * (side + 1) + k;
      const c = a + side + 1;
      indices.set([a, a + 1, c, a + 1, c + 1, c], 6 * (i * side + k));
    }
  return { positions, indices };
}

/** Of meshes by name, under a light, seen by a camera that is turned down by `tilt` (its sine). */
export function glb(meshes, { eye, tilt, yfov, light }) {
  const names = Object.keys(meshes);
  const arrays = Object.values(meshes).flatMap(({ positions, indices }) => [positions, indices]);
  let byteOffset = 0;
  const bufferViews = arrays.map(({ byteLength }) => {
    const view = { buffer: 0, byteOffset, byteLength };
    byteOffset += byteLength;
    return view;
  });
  const bounds = (positions) => {
    const [min, max] = [[Infinity, Infinity, Infinity], [-Infinity, -Infinity, -Infinity]];
    positions.forEach((value, i) => {
      min[i % 3] = Math.min(min[i % 3], value);
      max[i % 3] = Math.max(max[i % 3], value);
    });
    return { min, max };
  };
  const accessors = Object.values(meshes).flatMap(({ positions, indices }, i) => [
    { bufferView: 2 * i, componentType: 5126, count: positions.length / 3, type: 'VEC3',
      ...bounds(positions) },
    { bufferView: 2 * i + 1, componentType: 5125, count: indices.length, type: 'SCALAR' }]);
  const json = {
    asset: { version: '2.0' }, scene: 0,
    scenes: [{ nodes: Array.from({ length: names.length + 2 }, (_, i) => i) }],
    extensionsUsed: ['KHR_lights_punctual'],
    extensions: { KHR_lights_punctual: { lights: [{ type: 'point', intensity: 100 }] } },
    cameras: [{ type: 'perspective', perspective: { yfov, znear: 0.1 } }],
    nodes: [...names.map((name, mesh) => ({ mesh, name })),
            { camera: 0, translation: eye, rotation: [-tilt, 0, 0, Math.sqrt(1 - tilt * tilt)] },
            { translation: light, extensions: { KHR_lights_punctual: { light: 0 } } }],
    meshes: names.map((_, i) => ({
      primitives: [{ attributes: { POSITION: 2 * i }, indices: 2 * i + 1 }] })),
    accessors, bufferViews, buffers: [{ byteLength: byteOffset }],
  };
  let text = JSON.stringify(json);
  text += ' '.repeat((4 - text.length % 4) % 4);
  const header = (words) => Buffer.from(Uint32Array.from(words).buffer);
  return Buffer.concat([
    header([0x46546c67, 2, 12 + 8 + text.length + 8 + byteOffset]),
    header([text.length, 0x4e4f534a]), Buffer.from(text), header([byteOffset, 0x4e4942]),
    ...arrays.map(({ buffer }) => Buffer.from(buffer))]);
}

/**
 * Runs the program: its exit status, its output, its seconds, and the peak of resident memory in
 * bytes, of that of its processes which takes most.
 */
export function measured(args) {
  const { status, stdout, stderr } = spawnSync(
    '/usr/bin/time', ['-f', 'took %e s, peak %M KB', process.env.SHADOWPROOF, ...args],
    { encoding: 'utf8', stdio: ['ignore', 'pipe', 'pipe'] });
  const [, seconds, peak] = /^took ([\d.]+) s, peak (\d+) KB$/m.exec(stderr);
  return { code: status, out: stdout, err: stderr, seconds: Number(seconds), peak: 1024 * peak };
}
