// Truth of colour as render writes it, and normal maps of height fields.
import assert from 'node:assert/strict';
import { readFileSync, readdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { grayPng, readPng } from './png.mjs';
import { scratch, shadowproof } from './shadowproof.mjs';

const small = ['--size', '64x48'];

function rendered(scene, file, more = []) {
  const run = shadowproof(['render', scene, '-o', file, ...small, ...more]);
  assert.equal(run.code, 0, run.err);
  return readFileSync(join(scratch, file));
}

test('colours are an 8-bit RGB PNG, black at background, the same for any number of threads', () => {
  const bytes = rendered('bumpy_torus', 'a.png', ['--aov', 'color']);
  assert.deepEqual(bytes, rendered('bumpy_torus', 'b.png', ['--aov', 'color', '--threads', '1']));
  const picture = readPng(join(scratch, 'a.png'));
  assert.deepEqual([picture.width, picture.height, picture.channels, picture.bits], [64, 48, 3, 8]);
  assert.deepEqual(picture.at(0, 0), [0, 0, 0]);
  const colors = new Set();
  for (let y = 0; y < 48; ++y)
    for (let x = 0; x < 64; ++x) colors.add(picture.at(x, y).join());
  assert.ok(colors.size > 500, `${colors.size}`);
});

test('the class map stays what --aov does not ask to change', () => {
  assert.deepEqual(rendered('bumpy_torus', 'a.png'),
                   rendered('bumpy_torus', 'b.png', ['--aov', 'visibility']));
  assert.equal(readPng(join(scratch, 'a.png')).channels, 1);
});

test('normals of the floor point up, and those of the torus all ways', () => {
  rendered('bumpy_torus', 'n.png', ['--aov', 'normal']);
  const picture = readPng(join(scratch, 'n.png'));
  assert.deepEqual(picture.at(32, 46), [128, 255, 128]);
  assert.notDeepEqual(picture.at(20, 20), picture.at(40, 20));
});

/** All colours but black are unit vectors, 0.5 + 0.5 v, and some hundreds. */
function holdsUnitVectors(picture) {
  let seen = 0;
  for (let y = 0; y < 48; ++y)
    for (let x = 0; x < 64; ++x) {
      if (picture.at(x, y).join() === '0,0,0') continue;
      ++seen;
      const length = Math.hypot(...picture.at(x, y).map((byte) => byte / 127.5 - 1));
      assert.ok(Math.abs(length - 1) < 0.01, `${x}, ${y}: ${length}`); // a step of 8 bits
    }
  assert.ok(seen > 200, `${seen}`);
}

test('tangents are unit vectors of a bump-mapped surface, and none of the floor', () => {
  rendered('bumpy_torus', 't.png', ['--aov', 'tangent']);
  const picture = readPng(join(scratch, 't.png'));
  assert.deepEqual(picture.at(32, 46), [0, 0, 0]);
  assert.deepEqual(picture.at(0, 0), [0, 0, 0]);
  holdsUnitVectors(picture);
});

/** The largest step of any channel between neighbours along a row, both of a bump-mapped surface. */
function largestStep(picture) {
  let largest = 0;
  for (let y = 0; y < picture.height; ++y)
    for (let x = 1; x < picture.width; ++x) {
      const [a, b] = [picture.at(x - 1, y), picture.at(x, y)];
      if (a.join() === '0,0,0' || b.join() === '0,0,0') continue;
      largest = Math.max(largest, ...a.map((value, k) => Math.abs(value - b[k])));
    }
  return largest;
}

test('tangents jump where mirrored halves meet', () => {
  rendered('mirrored_skin', 't.png', ['--aov', 'tangent']);
  assert.ok(largestStep(readPng(join(scratch, 't.png'))) > 200);
});

test('light and half-angle vector in tangent space are unit vectors, and jump at a mirrored skin', () => {
  for (const aov of ['light', 'half_angle']) {
    rendered('bumpy_torus', 'v.png', ['--aov', aov]);
    const picture = readPng(join(scratch, 'v.png'));
    assert.deepEqual(picture.at(0, 0), [0, 0, 0]);
    assert.deepEqual(picture.at(32, 46), [0, 0, 0]); // the floor has no bumps
    holdsUnitVectors(picture);
  }
  rendered('mirrored_skin', 'v.png', ['--aov', 'light']);
  assert.ok(largestStep(readPng(join(scratch, 'v.png'))) > 100);
});

test('more rays a pixel smooth silhouettes, and leave the inside of the floor as it was', () => {
  rendered('bumpy_sphere', 'one.png', ['--aov', 'color']);
  rendered('bumpy_sphere', 'many.png', ['--aov', 'color', '--samples', '4']);
  const [one, many] = ['one.png', 'many.png'].map((file) => readPng(join(scratch, file)));
  let changed = 0;
  for (let y = 0; y < 48; ++y)
    for (let x = 0; x < 64; ++x) changed += one.at(x, y).join() !== many.at(x, y).join();
  assert.ok(changed > 50, `${changed}`);
  for (let k = 0; k < 3; ++k)
    assert.ok(Math.abs(one.at(32, 46)[k] - many.at(32, 46)[k]) <= 1);
});

test('the EXR has colours where the scene has bump maps, and none elsewhere', () => {
  const channels = ['Albedo.R', 'Ns.X', 'T.Y', 'diffuse.G', 'specular.B', 'ambient.R',
                    'reflection.G'];
  const lit = rendered('bumpy_sphere', 'lit.exr').toString('latin1', 0, 2000);
  const plain = rendered('ordinary', 'plain.exr').toString('latin1', 0, 2000);
  for (const channel of channels) {
    assert.ok(lit.includes(channel), channel);
    assert.ok(!plain.includes(channel), channel);
  }
});

test('colours of a scene without bump maps end with 3 and say why', () => {
  const run = shadowproof(['render', 'ordinary', '-o', 'none.png', '--aov', 'color', ...small]);
  assert.equal(run.code, 3);
  assert.match(run.err, /ordinary\.gltf: has no bump map.*normalTexture/);
  assert.ok(!readdirSync(scratch).includes('none.png'));
});

const wrongUsage = [
  [['render', 'bumpy_torus', '-o', 'x.exr', '--aov', 'color'], /\.exr holds them all/],
  [['render', 'bumpy_torus', '-o', 'x.png', '--aov', 'colour'], /color/],
  [['render', 'bumpy_torus', '-o', 'x.png', '--samples', '4'], /--aov color/],
  [['render', 'bumpy_torus', '-o', 'x.png', '--aov', 'color', '--samples', '33'], /32/],
  [['normal-map'], /HEIGHT/],
  [['normal-map', 'h.png'], /output/],
  [['normal-map', 'h.png', '-o', 'n.jpg'], /\.png or \.exr/],
  [['normal-map', 'h.png', '-o', 'n.png', '--bits', '12'], /8.*16/],
  [['normal-map', 'h.png', '-o', 'n.png', '--scale', 'high'], /number/],
  [['normal-map', 'h.png', '-o', 'n.png', '--scale', 'nan'], /number/],
  [['normal-map', 'h.png', '-o', 'n.png', '--wrap', 'twice'], /clamp/],
  [['normal-map', 'h.png', '-o', 'n.png', '--level', '-1'], /level/],
];
for (const [args, sentence] of wrongUsage)
  test(`wrong usage ends with 2 and a remedy: ${args.join(' ')}`, () => {
    const run = shadowproof(args);
    assert.equal(run.code, 2, run.err);
    assert.match(run.err, sentence);
    assert.equal(run.out, '');
  });

/** The normal map of heights that value(x, y) gives. */
function normalMap(width, height, value, args = []) {
  writeFileSync(join(scratch, 'h.png'), grayPng(width, height, value));
  const run = shadowproof(['normal-map', 'h.png', '-o', 'n.png', ...args]);
  assert.equal(run.code, 0, run.err);
  return readPng(join(scratch, 'n.png'));
}

/** As bytes: of slopes to the right and down, in texels. */
function bytesOf(right, down, most = 255) {
  const length = Math.hypot(right, down, 1);
  return [-right / length, down / length, 1 / length, 1].map((value, k) =>
    Math.round((k < 3 ? 0.5 + 0.5 * value : value) * most));
}

test('a plain is 128 128 255, with nothing to denormalise', () => {
  const map = normalMap(5, 3, () => 4711);
  assert.deepEqual([map.width, map.height, map.channels, map.bits], [5, 3, 4, 8]);
  for (let y = 0; y < 3; ++y)
    for (let x = 0; x < 5; ++x) assert.deepEqual(map.at(x, y), [128, 128, 255, 255]);
});

test('a ramp leans against its slope, by the scale, in 8 bits and in 16', () => {
  const ramp = (x, y) => 2000 * x + 1000 * y;
  const [right, down] = [2000 / 65535 * 20, 1000 / 65535 * 20];
  const args = ['--scale', '20', '--wrap', 'clamp'];
  const eight = normalMap(8, 8, ramp, args);
  assert.deepEqual(eight.at(4, 4), bytesOf(right, down));
  assert.deepEqual(eight.at(0, 4), bytesOf(right / 2, down)); // the border repeats itself
  assert.deepEqual(normalMap(8, 8, ramp, [...args, '--green-down']).at(4, 4).slice(0, 3),
                   bytesOf(right, -down).slice(0, 3));
  const sixteen = normalMap(8, 8, ramp, [...args, '--bits', '16']);
  assert.equal(sixteen.bits, 16);
  bytesOf(right, down, 65535).forEach((value, k) =>
    assert.ok(Math.abs(sixteen.at(4, 4)[k] - value) <= 1));
  // Around the border the ramp falls from its end to its beginning.
  assert.deepEqual(normalMap(8, 8, ramp, ['--scale', '20']).at(0, 4),
                   bytesOf((2000 - 7 * 2000) / 2 / 65535 * 20, down));
});

test('levels above average the normals, and alpha holds what that takes from their length', () => {
  const ridge = (x) => (x % 4 === 0 ? 30000 : 0);
  const args = ['--scale', '6', '--level', '1'];
  const [rough, even] = [normalMap(16, 16, ridge, args), normalMap(16, 16, () => 0, args)];
  assert.deepEqual([rough.width, rough.height], [8, 8]);
  assert.deepEqual(even.at(3, 3), [128, 128, 255, 255]);
  assert.ok(rough.at(3, 3)[3] < 250, `${rough.at(3, 3)}`);
});

test('an EXR of normals is written, and each run writes the same bytes', () => {
  writeFileSync(join(scratch, 'h.png'), grayPng(4, 4, (x) => 9000 * x));
  const files = ['n.exr', 'm.exr'].map((file) => {
    assert.equal(shadowproof(['normal-map', 'h.png', '-o', file, '-q']).code, 0);
    return readFileSync(join(scratch, file));
  });
  assert.deepEqual(files[0], files[1]);
});

test('heights that cannot be read end with 3, and nothing is left behind', () => {
  writeFileSync(join(scratch, 'h.png'), grayPng(4, 4, () => 0));
  writeFileSync(join(scratch, 'text.png'), 'no picture');
  writeFileSync(join(scratch, 'short.png'), grayPng(64, 64, (x, y) => x * y).subarray(0, 90));
  const before = readdirSync(scratch);
  for (const [args, sentence] of [
    [['nowhere.png', '-o', 'left.png'], /nowhere\.png: does not exist; check the path/],
    [['text.png', '-o', 'left.png'], /text\.png/],
    [['short.png', '-o', 'left.png'], /short\.png/],
    [['h.png', '-o', 'left.png', '--level', '9'], /has 3 levels/],
    [['h.png', '-o', 'missing/left.png'], /missing\/left\.png: cannot be written/]]) {
    const run = shadowproof(['normal-map', ...args]);
    assert.equal(run.code, 3, args.join(' '));
    assert.match(run.err, sentence);
  }
  assert.deepEqual(readdirSync(scratch), before);
});
