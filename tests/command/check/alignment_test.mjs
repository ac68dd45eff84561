// Pictures of another view than the scene's: named, and refused unless told to go on. A picture that
// is right, or whose shadows are wrong, is never taken for one of another view.
import assert from 'node:assert/strict';
import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { grayPng, readPng } from '../png.mjs';
import { scratch, shadowproof } from '../shadowproof.mjs';

const size = 240;
const shade = { 0: 20, 64: 60, 255: 190 };

function truthOf(scene, more = [], side = size) {
  const run = shadowproof(['render', scene, '--size', `${side}x${side}`, ...more, '-o', 'truth.png', '-q']);
  assert.equal(run.code, 0, run.err);
  const png = readPng(join(scratch, 'truth.png'));
  return { ...png, at: (x, y) => png.at(x, y)[0] };
}

function checked(scene, valueAt, ...more) {
  writeFileSync(join(scratch, 'mine.png'), grayPng(size, size, (x, y) => 257 * valueAt(x, y)));
  return shadowproof(['check', scene, 'mine.png', '--no-diagnosis', '--out', 'checked', ...more]);
}

const refused = (run, words) => {
  assert.equal(run.code, 3, run.out + run.err);
  assert.match(run.out + run.err, words);
  assert.match(run.out + run.err, /--no-alignment judges it as it is/);
};

for (const scene of ['ordinary', 'near_plane', 'eye_inside', 'spot']) {
  test(`flips of ${scene} are named`, () => {
    const truth = truthOf(scene);
    const last = size - 1;
    refused(checked(scene, (x, y) => shade[truth.at(last - x, y)]), /mine\.png: is mirrored left to right; /);
    refused(checked(scene, (x, y) => shade[truth.at(x, last - y)]), /mine\.png: is upside down; /);
    refused(checked(scene, (x, y) => shade[truth.at(last - x, last - y)]), /mine\.png: is turned by half; /);
  });
}

test('half a pixel is named, with the way that the picture went', () => {
  const fine = truthOf('ordinary', [], 4 * size);
  // 4 x + 3 has its centre at x + 0.875: three eighths to the right of the pixel's centre.
  refused(checked('ordinary', (x, y) => shade[fine.at(4 * x + 3, 4 * y + 3)]),
          /is shifted by about half a pixel to the left up: /);
  const centred = checked('ordinary', (x, y) => shade[fine.at(4 * x + 2, 4 * y + 2)]);
  assert.notEqual(centred.code, 3, centred.out);
});

const yfovOf = (scene) => JSON.parse(shadowproof(['export-view', scene]).out).camera.yfov * 180 / Math.PI;
const numberIn = (run, words) => {
  const found = (run.out + run.err).match(words);
  assert.ok(found, run.out + run.err);
  return Number(found[1]);
};

for (const scene of ['ordinary', 'near_plane'])
  for (const factor of [0.95, 1.05])
    test(`a field of view ${factor} times that of ${scene} is fitted`, () => {
      const degrees = factor * yfovOf(scene);
      const truth = truthOf(scene, ['--fov', String(degrees)]);
      const run = checked(scene, (x, y) => shade[truth.at(x, y)]);
      refused(run, /has a field of view of/);
      const found = numberIn(run, /has a field of view of ([\d.]+) degrees/);
      assert.ok(Math.abs(found - degrees) <= 0.02 * degrees, `${found}, ${degrees}`);
      assert.notEqual(checked(scene, (x, y) => shade[truth.at(x, y)], '--no-alignment').code, 3);
      assert.equal(checked(scene, (x, y) => shade[truth.at(x, y)], '--fov', String(degrees)).code, 0);
    });

test('a camera that is turned is told by how much, and about what', () => {
  const { camera: { matrix } } = JSON.parse(shadowproof(['export-view', 'ordinary']).out);
  const angle = 2.1 / 180 * Math.PI;
  // Right and back, turned to the left about up.
  const turned = matrix.map((m, i) => i < 3 ? Math.cos(angle) * m - Math.sin(angle) * matrix[i + 8]
    : i >= 8 && i < 11 ? Math.cos(angle) * m + Math.sin(angle) * matrix[i - 8] : m);
  const truth = truthOf('ordinary', ['--camera-matrix', turned.join()]);
  const run = checked('ordinary', (x, y) => shade[truth.at(x, y)]);
  refused(run, /turned by/);
  const found = numberIn(run, /turned by ([-\d.]+) degrees about its up axis/);
  assert.ok(Math.abs(found - 2.1) < 0.05, `${found}`);
});

test('an orthographic picture that is moved, turned, larger or of a field of view is told from a right one', () => {
  const ortho = ['--ortho', '7'];
  const right = truthOf('ordinary', ortho);
  assert.equal(checked('ordinary', (x, y) => shade[right.at(x, y)], ...ortho).code, 0);
  const last = size - 1;
  refused(checked('ordinary', (x, y) => shade[right.at(last - x, y)], ...ortho), /is mirrored left to right; /);
  const larger = truthOf('ordinary', ['--ortho', '7.35']);
  const run = checked('ordinary', (x, y) => shade[larger.at(x, y)], ...ortho);
  refused(run, /shows [\d.]+ from top to bottom, the scene's camera 7[;\n]/);
  assert.ok(Math.abs(numberIn(run, /shows ([\d.]+) from top/) - 7.35) < 0.02 * 7.35);
  // To the right by 0.2, along the first column of the camera's matrix.
  const { camera: { matrix } } = JSON.parse(shadowproof(['export-view', 'ordinary', ...ortho]).out);
  const aside = matrix.map((m, i) => i >= 12 && i < 15 ? m + 0.2 * matrix[i - 12] : m);
  const moved = truthOf('ordinary', [...ortho, '--camera-matrix', aside.join()]);
  const told = checked('ordinary', (x, y) => shade[moved.at(x, y)], ...ortho);
  refused(told, /its camera is [\d.]+ too far to the right/);
  assert.ok(Math.abs(numberIn(told, /camera is ([\d.]+) too far/) - 0.2) < 0.01);
  const seen = truthOf('ordinary');
  refused(checked('ordinary', (x, y) => shade[seen.at(x, y)], ...ortho), /mine\.png: /);
});

const flags = (technique) => technique === 'cube_map_six_pass' ? ['--map-size', '64'] : [];
for (const [scene, technique] of [
  ['ordinary', 'cube_map_six_pass'], ['near_plane', 'zpass'], ['far_plane', 'zfail'],
  ['eye_inside', 'zpass'], ['overlapping', 'invert'], ['long_shadow', 'zfail_truncated']])
  test(`shadows as wrong as those of ${technique} on ${scene} are no other view`, () => {
    const run = shadowproof(['verify', scene, '--size', `${size}x${size}`, '--technique', technique,
                             ...flags(technique), '--out', 'claims', '-q']);
    assert.ok(run.code <= 1, run.err);
    const claim = readPng(join(scratch, `claims/${scene}/${technique}.claim.png`));
    assert.equal(checked(scene, (x, y) => shade[claim.at(x, y)[0]]).code, 1);
  });

for (const scene of ['sun', 'spot', 'nested', 'overlapping', 'many_lights', 'cube_edge', 'low_light',
                     'open_lid', 'slivers', 'thin_caster', 'far_light', 'walking_figure'])
  test(`a right picture of ${scene} is no other view, nor one without shadows, nor with all of them`, () => {
    const truth = truthOf(scene);
    const right = checked(scene, (x, y) => shade[truth.at(x, y)]);
    assert.doesNotMatch(right.out + right.err, /--no-alignment/);
    const none = checked(scene, (x, y) => truth.at(x, y) ? 190 : 20);
    assert.doesNotMatch(none.out + none.err, /--no-alignment/);
    const inverse = checked(scene, (x, y) => shade[{ 0: 0, 64: 255, 255: 64 }[truth.at(x, y)]]);
    assert.doesNotMatch(inverse.out + inverse.err, /--no-alignment/);
  });

/// Twins, by what the camera sees: 0 the background, else surfaces.
const twins = { unlit: (seen) => seen ? 40 : 0, unshadowed: (seen) => seen ? 190 : 0 };

function checkedWith(twin, scene, valueAt) {
  const truth = truthOf(scene);
  writeFileSync(join(scratch, 'twin.png'), grayPng(size, size, (x, y) => 257 * valueAt(x, y)));
  return checked(scene, (x, y) => ({ 0: 0, 64: 40, 255: 190 }[truth.at(x, y)]), `--${twin}`, 'twin.png');
}

/// Whole numbers, the same each time.
function noiseFrom(least, end) {
  let state = 1;
  return () => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return least + Math.floor((end - least) * state / 2 ** 32);
  };
}

for (const [twin, value] of Object.entries(twins)) {
  test(`a picture given as --${twin} that is of another view is named`, () => {
    const zoomed = truthOf('ordinary', ['--fov', String(1.05 * yfovOf('ordinary'))]);
    refused(checkedWith(twin, 'ordinary', (x, y) => value(zoomed.at(x, y))),
            /twin\.png: has a field of view of/);
    const truth = truthOf('ordinary');
    refused(checkedWith(twin, 'ordinary', (x, y) => value(truth.at(size - 1 - x, y))),
            /twin\.png: is mirrored left to right; /);
  });

  for (const scene of ['ordinary', 'sun', 'spot', 'nested', 'many_lights', 'slivers'])
    test(`a right --${twin} of ${scene} is no other view, noisy or not`, () => {
      const truth = truthOf(scene);
      assert.equal(checkedWith(twin, scene, (x, y) => value(truth.at(x, y))).code, 0);
      const noise = noiseFrom(-8, 8);
      const run = checkedWith(twin, scene, (x, y) => truth.at(x, y) ? value(255) + noise() : 0);
      assert.doesNotMatch(run.out + run.err, /--no-alignment/);
    });
}

test('an unlit twin that shows nothing but noise is no other view', () => {
  for (const scene of ['ordinary', 'sun', 'spot', 'nested', 'cube_edge', 'far_light']) {
    const run = checkedWith('unlit', scene, noiseFrom(0, 5));
    assert.doesNotMatch(run.out + run.err, /--no-alignment/);
  }
});

test('twins that are darker or brighter than they can be are of other pictures', () => {
  const wrongOrder = (run, words) => {
    assert.equal(run.code, 3, run.out + run.err);
    assert.match(run.out + run.err, words);
  };
  const other = truthOf('thin_caster');
  wrongOrder(checkedWith('unshadowed', 'far_plane', (x, y) => twins.unshadowed(other.at(x, y))),
             /twin\.png: lacks shadows, but is darker than mine\.png in \d+ % of what is seen; /);
  const truth = truthOf('ordinary');
  wrongOrder(checkedWith('unlit', 'ordinary', (x, y) => twins.unshadowed(truth.at(x, y))),
             /twin\.png: lacks light, but is brighter than mine\.png in \d+ % of what is seen; /);
  // Behind all surfaces each may show what it likes.
  assert.equal(checkedWith('unlit', 'ordinary', () => 40).code, 0);
});
