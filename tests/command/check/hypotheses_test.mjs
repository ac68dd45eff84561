// Hypotheses where there is more than one to choose from: any number of meshes, a mesh that hides
// others or the background, one that alone shows no shadows, the far plane of a cube's faces, and what
// no renderer can be told to have done.
import assert from 'node:assert/strict';
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { before, test } from 'node:test';
import { grayPng, readPng } from '../png.mjs';
import { scratch, shadowproof } from '../shadowproof.mjs';

const side = 256;
const size = ['--size', `${side}x${side}`];
const path = (name) => join(scratch, name);
const [lit, shadowed] = [255, 64];
const half = 4; // of the floor: boxes at its border stand out
const light = [5.5, 4, 5.5];
const eye = [0, 12, 0.001];

/** A floor and seven rows of seven boxes, seen from above; `change(nodes)` may change its nodes. */
function boxes(change = () => {}) {
  const corners = [0, 1, 2, 3, 4, 5, 6, 7].map((i) => [i & 1, i >> 1 & 1, i >> 2].map((bit) => bit - 0.5));
  const faces = [0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6,
                 1, 3, 5, 3, 7, 5];
  const floor = [[-half, 0, -half], [half, 0, -half], [-half, 0, half], [half, 0, half]];
  const data = Buffer.concat([Buffer.from(Float32Array.from([...corners, ...floor].flat()).buffer),
                              Buffer.from(Uint16Array.from([...faces, 0, 2, 1, 1, 2, 3]).buffer)]);
  const view = (byteOffset, byteLength) => ({ buffer: 0, byteOffset, byteLength });
  const box = { attributes: { POSITION: 0 }, indices: 2 };
  const nodes = [{ name: 'eye', camera: 0, translation: eye, rotation: [-Math.SQRT1_2, 0, 0, Math.SQRT1_2] },
                 { name: 'lamp', translation: light, extensions: { KHR_lights_punctual: { light: 0 } } },
                 { name: 'floor', mesh: 0 }];
  for (let i = 0; i < 49; ++i)
    nodes.push({ name: `box ${i}`, mesh: 1 + i, scale: [0.5, 0.6, 0.5],
                 translation: [1.3 * (i % 7 - 3), 0.3, 1.3 * (Math.floor(i / 7) - 3)] });
  change(nodes);
  return {
    asset: { version: '2.0' }, extensionsUsed: ['KHR_lights_punctual'], scene: 0,
    scenes: [{ nodes: nodes.map((_, i) => i) }], nodes,
    extensions: { KHR_lights_punctual: { lights: [{ name: 'lamp', type: 'point' }] } },
    cameras: [{ type: 'perspective', perspective: { yfov: 1, znear: 1, zfar: 40 } }],
    meshes: [{ name: 'floor', primitives: [{ attributes: { POSITION: 1 }, indices: 3 }] },
             ...Array.from({ length: 49 }, (_, i) => ({ name: `box ${i}`, primitives: [box] }))],
    accessors: [
      { bufferView: 0, componentType: 5126, count: 8, type: 'VEC3', min: [-0.5, -0.5, -0.5], max: [0.5, 0.5, 0.5] },
      { bufferView: 1, componentType: 5126, count: 4, type: 'VEC3', min: [-half, 0, -half], max: [half, 0, half] },
      { bufferView: 2, componentType: 5123, count: 36, type: 'SCALAR' },
      { bufferView: 3, componentType: 5123, count: 6, type: 'SCALAR' }],
    bufferViews: [view(0, 96), view(96, 48), view(144, 72), view(216, 12)],
    buffers: [{ byteLength: data.length, uri: `data:application/octet-stream;base64,${data.toString('base64')}` }],
  };
}

/** The class map of a scene, as (x, y) => 0, 64 or 255. */
function rendered(gltf) {
  writeFileSync(path('changed.gltf'), JSON.stringify(gltf));
  const run = shadowproof(['render', 'changed.gltf', ...size, '-o', 'classes.png', '-q']);
  assert.equal(run.code, 0, run.err);
  const png = readPng(path('classes.png'));
  return (x, y) => png.at(x, y)[0];
}

let truth;
before(() => {
  truth = rendered(boxes());
  writeFileSync(path('boxes.gltf'), JSON.stringify(boxes()));
});

/** The hypotheses on a mask, and how many pixels of it are wrong. */
function diagnosed(classes, scene = 'boxes.gltf') {
  writeFileSync(path('mask.png'), grayPng(side, side, (x, y) => (classes(x, y) === lit ? 65535 : 0)));
  const run = shadowproof(['check', scene, 'mask.png', '--mask', 'mask.png', '--out', 'checked']);
  assert.equal(run.code, 1, run.out + run.err);
  const [cell] = JSON.parse(readFileSync(path('checked/results.json'))).scenes[0].techniques;
  return { out: run.out, all: cell.diagnosis, best: cell.diagnosis[0],
           wrong: cell.falsely_lit + cell.falsely_shadowed };
}

const without = (name) => (nodes) => { nodes.find((node) => node.name === name).extras = { shadowproof: { casts: false } }; };

test('a caster without its shadow is named, wherever in the file it is', () => {
  for (const i of [3, 30, 46]) {
    const { best, wrong, out } = diagnosed(rendered(boxes(without(`box ${i}`))));
    assert.equal(best.words, `box ${i} casts no shadow`, out);
    assert.deepEqual([best.explained, best.contradicted], [wrong, 0], out);
  }
});

test('a mesh that is not drawn is named, though its gap shows light and shadow of others', () => {
  const gone = (nodes) => { delete nodes.find(({ name }) => name === 'box 48').mesh; };
  const { best, wrong, out } = diagnosed(rendered(boxes(gone)));
  assert.equal(best.words, 'box 48 is not drawn', out);
  assert.deepEqual([best.explained, best.contradicted], [wrong, 0], out);
});

test('a receiver without shadows comes before a scene without any, where others show theirs', () => {
  const bare = (nodes) => { nodes.find(({ name }) => name === 'floor').extras = { shadowproof: { receives: false } }; };
  const { best, wrong, out } = diagnosed(rendered(boxes(bare)));
  assert.equal(best.words, 'floor shows no shadows', out);
  assert.deepEqual([best.explained, best.contradicted], [wrong, 0], out);
});

test('light that leaks onto one mesh is not the mesh missing', () => {
  // Of what box 24 shadows of itself and of the floor around it, every other line is lit.
  const isLeaking = (x, y) => y % 2 === 0 && truth(x, y) === shadowed && x > side / 2 - 20 && x < side / 2 + 20;
  const { all, out } = diagnosed((x, y) => (isLeaking(x, y) ? lit : truth(x, y)));
  assert.ok(all.every(({ hypothesis }) => hypothesis !== 'mesh_missing'), out);
});

test('the far plane of a cube’s faces is told along their axes', () => {
  const far = 6.5;
  const slope = Math.tan(0.5); // of the camera, which looks down
  const isBeyond = (x, y) => {
    const across = (2 * (x + 0.5) / side - 1) * slope * eye[1];
    const down = (2 * (y + 0.5) / side - 1) * slope * eye[1];
    return Math.max(Math.abs(across - light[0]), light[1], Math.abs(eye[2] + down - light[2])) > far;
  };
  const { best, wrong, out } = diagnosed((x, y) => (isBeyond(x, y) && truth(x, y) ? lit : truth(x, y)));
  assert.equal(best.hypothesis, 'shadow_map', out);
  assert.ok(Math.abs(best.parameters.far - far) < 0.02 * far, out);
  assert.ok(best.explained >= 0.95 * wrong, out);
  assert.ok(best.contradicted <= 0.01 * wrong, out);
});

test('false shadows are no rays’ epsilon, though by rounding some points lie behind themselves', () => {
  const own = rendered(JSON.parse(readFileSync(join(process.env.SHADOWPROOF_SCENES, 'ordinary.gltf'), 'utf8')));
  const isDark = (x, y) => own(x, y) === lit && (x >> 4) % 2 === 1;
  const { all, out } = diagnosed((x, y) => (isDark(x, y) ? shadowed : own(x, y)), 'ordinary');
  assert.ok(all.every(({ hypothesis }) => hypothesis !== 'ray_epsilon'), out);
});
