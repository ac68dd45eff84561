// Noise is no shadow: a right picture stays right however noisy it is, until light and shadow cannot
// be told from each other; what is wrong is still found.
import assert from 'node:assert/strict';
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { grayPng, readPng } from '../png.mjs';
import { scratch, shadowproof } from '../shadowproof.mjs';

const side = 256;
const size = ['--size', `${side}x${side}`];
const path = (name) => join(scratch, name);
const [lit, shadowed] = [255, 64];
const shadows = 60;

/** The class map of a scene's file. */
function rendered(scene) {
  const run = shadowproof(['render', scene, ...size, '-o', 'classes.png', '-q']);
  assert.equal(run.code, 0, run.err);
  const png = readPng(path('classes.png'));
  return (x, y) => png.at(x, y)[0];
}

/** Normal numbers (Box and Muller 1958), the same for the same seed. */
function normalNumbers(seed) {
  let state = seed;
  const even = () => (state = state * 48271 % 2147483647) / 2147483647;
  return () => Math.sqrt(-2 * Math.log(even())) * Math.cos(2 * Math.PI * even());
}

/** Writes values of 0 to 255 with noise of so many steps, in 8 bits. */
function noisy(name, value, steps, seed) {
  const normal = normalNumbers(seed);
  writeFileSync(path(name), grayPng(side, side, (x, y) =>
    257 * Math.min(255, Math.max(0, Math.round(value(x, y) + steps * normal())))));
}

/** A picture of the classes and both of its twins; light adds so many steps. */
function writePictures(truth, classes, light, noise) {
  const is = (x, y) => truth(x, y) !== 0;
  noisy('mine.png', (x, y) => (!is(x, y) ? 20 : shadows + (classes(x, y) === lit ? light : 0)), noise, 11);
  noisy('off.png', (x, y) => (is(x, y) ? shadows : 20), noise, 12);
  noisy('bare.png', (x, y) => (is(x, y) ? shadows + light : 20), noise, 13);
}

const ways = [['--unlit', 'off.png', '--unshadowed', 'bare.png'], ['--unlit', 'off.png'],
              ['--unshadowed', 'bare.png']];

function checked(scene, way) {
  const run = shadowproof(['check', scene, 'mine.png', ...way, '--no-alignment', '--out', 'checked']);
  const cell = run.code > 1 ? null
    : JSON.parse(readFileSync(path('checked/results.json'))).scenes[0].techniques[0];
  return { ...run, cell };
}

for (const scene of ['ordinary', 'near_plane', 'overlapping', 'height_field'])
  for (const noise of [1, 2, 4])
    test(`a right picture of ${scene} with noise of ${noise} steps has no wrong pixel`, () => {
      const truth = rendered(scene);
      writePictures(truth, truth, 130, noise);
      for (const way of ways) {
        const { code, out, err, cell } = checked(scene, way);
        assert.equal(code, 0, out + err);
        assert.equal(cell.falsely_lit + cell.falsely_shadowed, 0);
        assert.ok(cell.undecidable < 0.03 * side * side, out);
      }
    });

test('light that is lost in noise is not told from shadow', () => {
  const truth = rendered('ordinary');
  writePictures(truth, truth, 16, 4);
  for (const way of ways) {
    const { code, out } = checked('ordinary', way);
    assert.equal(code, 3, `${way.join(' ')}: ${out}`);
    assert.match(out, /tells light from shadow at|does not tell light from shadow/);
  }
});

test('a caster without its shadow is found in noise', () => {
  const gltf = JSON.parse(readFileSync(join(process.env.SHADOWPROOF_SCENES, 'ordinary.gltf'), 'utf8'));
  gltf.nodes.find(({ name }) => name === 'torus').extras = { shadowproof: { casts: false } };
  writeFileSync(path('changed.gltf'), JSON.stringify(gltf));
  writePictures(rendered('ordinary'), rendered('changed.gltf'), 130, 2);
  for (const way of ways) {
    const { code, out, cell } = checked('ordinary', way);
    assert.equal(code, 1, out);
    assert.equal(cell.diagnosis[0].words, 'torus casts no shadow');
    assert.equal(cell.diagnosis[0].explained, cell.falsely_lit + cell.falsely_shadowed, out);
  }
});
