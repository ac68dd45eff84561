// Verifies a caster of a million triangles at 1920x1080 with every technique, and says what memory
// and time that takes. Fails where it takes more than 2 GB or a cell does not pass.
//   SHADOWPROOF=build/release/shadowproof node tests/bench/million_bench.mjs [TECHNIQUE,...]
import { spawn } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

/** A closed ball with bumps, that shadows itself: rings of quads, and a fan at each pole. */
function bumpyBall(rings, sectors) {
  const positions = [0, 1.5, 0];
  for (let i = 1; i < rings; ++i)
    for (let k = 0; k < sectors; ++k) {
      const theta = Math.PI * i / rings;
      const phi = 2 * Math.PI * k / sectors;
      const radius = 1 + 0.08 * Math.sin(9 * theta) * Math.sin(12 * phi);
      positions.push(radius * Math.sin(theta) * Math.cos(phi), 0.5 + radius * Math.cos(theta),
                     radius * Math.sin(theta) * Math.sin(phi));
    }
  positions.push(0, -0.5, 0);
  const last = positions.length / 3 - 1;
  const at = (i, k) => 1 + (i - 1) * sectors + k % sectors;
  const indices = [];
  for (let k = 0; k < sectors; ++k) {
    indices.push(0, at(1, k + 1), at(1, k), last, at(rings - 1, k), at(rings - 1, k + 1));
    for (let i = 1; i + 1 < rings; ++i)
      indices.push(at(i, k), at(i, k + 1), at(i + 1, k),
                   at(i + 1, k), at(i, k + 1), at(i + 1, k + 1));
  }
  return { positions: Float32Array.from(positions), indices: Uint32Array.from(indices) };
}

const floor = { positions: Float32Array.from([-4, -0.6, -4, -4, -0.6, 4, 4, -0.6, 4, 4, -0.6, -4]),
                indices: Uint32Array.from([0, 1, 2, 0, 2, 3]) };

function glb(meshes) {
  const arrays = meshes.flatMap(({ positions, indices }) => [positions, indices]);
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
  const accessors = meshes.flatMap(({ positions, indices }, i) => [
    { bufferView: 2 * i, componentType: 5126, count: positions.length / 3, type: 'VEC3',
      ...bounds(positions) },
    { bufferView: 2 * i + 1, componentType: 5125, count: indices.length, type: 'SCALAR' }]);
  const tilt = Math.sin(-0.15);
  const json = {
    asset: { version: '2.0' }, scene: 0, scenes: [{ nodes: [0, 1, 2, 3] }],
    extensionsUsed: ['KHR_lights_punctual'],
    extensions: { KHR_lights_punctual: { lights: [{ type: 'point', intensity: 100 }] } },
    cameras: [{ type: 'perspective', perspective: { yfov: 0.8, znear: 0.1 } }],
    nodes: [{ mesh: 0, name: 'ball' }, { mesh: 1, name: 'floor' },
            { camera: 0, translation: [0, 1.5, 5],
              rotation: [tilt, 0, 0, Math.sqrt(1 - tilt * tilt)] },
            { translation: [2.5, 4, 1.5],
              extensions: { KHR_lights_punctual: { light: 0 } } }],
    meshes: meshes.map((_, i) => ({
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

const folder = mkdtempSync(join(tmpdir(), 'shadowproof-million-'));
const scene = join(folder, 'million.glb');
writeFileSync(scene, glb([bumpyBall(708, 708), floor]));
const techniques = process.argv[2] ? ['--technique', process.argv[2]] : [];
const child = spawn(process.env.SHADOWPROOF, ['verify', scene, '--size', '1920x1080', '--out',
                                              join(folder, 'report'), ...techniques],
                    { stdio: 'inherit' });
let peak = 0; // kilobytes, that the kernel has seen so far
const watch = setInterval(() => {
  try {
    const status = readFileSync(`/proc/${child.pid}/status`, 'utf8');
    peak = Math.max(peak, Number(/VmHWM:\s+(\d+)/.exec(status)?.[1] ?? 0));
  } catch { /* it has ended */ }
}, 50);
child.on('exit', (code) => {
  clearInterval(watch);
  const { ms } = JSON.parse(readFileSync(join(folder, 'report/results.json'), 'utf8'));
  rmSync(folder, { recursive: true });
  console.log(`peak ${(peak / 1e6).toFixed(2)} GB resident, ${(ms / 1e3).toFixed(1)} s, exit ${code}`);
  process.exitCode = code !== 0 || peak > 2e6 ? 1 : 0;
});
