// Ten million decisions of the truth at the stress points of a small scene, made again by the exact
// tracer that shares no code with it. It goes through all triangles for each pixel, so that a scene of
// a few is what it can decide so often.
import assert from 'node:assert/strict';
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { dataUri } from './hostile.mjs';
import { scratch, shadowproof } from './shadowproof.mjs';

const side = Number(process.env.SHADOWPROOF_WITNESS_SIDE ?? 224); // pixels

/** A floor, a box, an octahedron that leans into it, and a tetrahedron behind. */
const shapes = [
  { corners: [[-3, 0, -3], [-3, 0, 3], [3, 0, 3], [3, 0, -3]], faces: [[0, 1, 2], [0, 2, 3]] },
  { corners: [[-1, 0.25, -0.5], [0, 0.25, -0.5], [0, 0.25, 0.5], [-1, 0.25, 0.5],
              [-1, 1.25, -0.5], [0, 1.25, -0.5], [0, 1.25, 0.5], [-1, 1.25, 0.5]],
    faces: [[0, 1, 2], [0, 2, 3], [4, 6, 5], [4, 7, 6], [0, 5, 1], [0, 4, 5],
            [1, 6, 2], [1, 5, 6], [2, 7, 3], [2, 6, 7], [3, 4, 0], [3, 7, 4]] },
  { corners: [[-0.2, 1, 0.3], [1.1, 0.9, 0.4], [0.4, 1.7, 0.2], [0.5, 0.3, 0.5], [0.3, 1.1, 1],
              [0.6, 0.8, -0.3]],
    faces: [[0, 4, 2], [4, 1, 2], [1, 5, 2], [5, 0, 2], [4, 0, 3], [1, 4, 3], [5, 1, 3], [0, 5, 3]] },
  { corners: [[1, 0.1, -1.5], [2, 0.2, -1.2], [1.4, 0.1, -2.4], [1.5, 1.3, -1.6]],
    faces: [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]] },
];

function scene() {
  const corners = [];
  const indices = [];
  for (const shape of shapes) {
    indices.push(...shape.faces.flat().map((corner) => corner + corners.length));
    corners.push(...shape.corners);
  }
  const bytes = Buffer.concat([Buffer.from(new Float32Array(corners.flat()).buffer),
                               Buffer.from(new Uint16Array(indices).buffer)]);
  const least = [0, 1, 2].map((axis) => Math.min(...corners.map((corner) => corner[axis])));
  const most = [0, 1, 2].map((axis) => Math.max(...corners.map((corner) => corner[axis])));
  const start = 12 * corners.length;
  return {
    asset: { version: '2.0' },
    extensionsUsed: ['KHR_lights_punctual'],
    extensions: { KHR_lights_punctual: { lights: [{ type: 'point' }] } },
    scene: 0,
    scenes: [{ nodes: [0, 1, 2] }],
    nodes: [
      { mesh: 0 },
      { translation: [2.5, 4, 2], extensions: { KHR_lights_punctual: { light: 0 } } },
      { camera: 0, translation: [0, 2.5, 5], rotation: [-0.2079117, 0, 0, 0.9781476] },
    ],
    cameras: [{ type: 'perspective', perspective: { yfov: 0.8, znear: 0.1, aspectRatio: 1 } }],
    meshes: [{ primitives: [{ attributes: { POSITION: 0 }, indices: 1 }] }],
    accessors: [
      { bufferView: 0, componentType: 5126, count: corners.length, type: 'VEC3', min: least, max: most },
      { bufferView: 1, componentType: 5123, count: indices.length, type: 'SCALAR' },
    ],
    bufferViews: [{ buffer: 0, byteLength: start },
                  { buffer: 0, byteOffset: start, byteLength: bytes.length - start }],
    buffers: [{ byteLength: bytes.length, uri: dataUri(bytes) }],
  };
}

test('the witness agrees on ten million decisions over all stress points', () => {
  writeFileSync(join(scratch, 'solids.gltf'), JSON.stringify(scene()));
  const told = shadowproof(['stress', 'solids.gltf', '--technique', 'traced_skip', '--no-pictures',
                            '--size', `${side}x${side}`, '--witness', `${side * side}`,
                            '--json', 'stress.json', '--out', 'stress'], { seconds: 1700 });
  assert.equal(told.code, 0, told.out + told.err);
  const { points } = JSON.parse(readFileSync(join(scratch, 'stress.json')));
  const truths = points.filter(({ technique, refused }) => technique === 'truth' && !refused);
  const asked = truths.reduce((sum, { witness }) => sum + witness.asked, 0);
  console.log(`${asked} decisions at ${truths.length} points`);
  for (const { parameter, value, witness } of truths)
    assert.equal(witness.disagreements, 0, `${parameter} ${value}`);
  assert.ok(asked >= 10e6, `${asked}`);
});
