// Pictures of other renderers, made here from class maps: what is right agrees, what is wrong is
// counted and explained, what cannot be told is refused.
import assert from 'node:assert/strict';
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { grayPng, readPng } from '../png.mjs';
import { scratch, shadowproof } from '../shadowproof.mjs';

const size = ['--size', '200x200'];
const path = (name) => join(scratch, name);
const [lit, shadowed] = [255, 64];

/** The class map of a scene as { width, height, at(x, y) }. */
function truthOf(scene, pixels = size) {
  const file = path(`${scene}-${pixels[1]}.png`);
  const run = shadowproof(['render', scene, ...pixels, '-o', file, '-q']);
  assert.equal(run.code, 0, run.err);
  const png = readPng(file);
  return { ...png, at: (x, y) => png.at(x, y)[0] };
}

/** Writes a gray picture of a class map by a value for each pixel. */
function picture(name, { width, height, at }, value) {
  writeFileSync(path(name), grayPng(width, height, (x, y) => 257 * value(at(x, y), x, y)));
  return name;
}

function checked(...args) {
  const run = shadowproof(['check', ...args, '--out', 'checked']);
  const results = run.code > 1 ? null
    : JSON.parse(readFileSync(path('checked/results.json'), 'utf8'));
  return { ...run, cells: results?.scenes[0].techniques };
}

const shade = { 0: 20, [shadowed]: 60, [lit]: 190 };

/** The first place of 12 x 12 lit pixels, as a square of 8 x 8 in their middle. */
function litSquare(truth) {
  const isLit = (x, y) => Array.from({ length: 144 }, (_, i) =>
    truth.at(x + i % 12, y + Math.floor(i / 12))).every((value) => value === lit);
  for (let y = 0; y + 12 <= truth.height; ++y)
    for (let x = 0; x + 12 <= truth.width; ++x) if (isLit(x, y)) return [x + 2, y + 2];
  throw new Error('no place is lit');
}

for (const scene of ['ordinary', 'near_plane', 'sun', 'spot', 'overlapping'])
  test(`a right picture of ${scene} agrees: alone, with its twins, and as a mask`, () => {
    const truth = truthOf(scene);
    const alone = picture('alone.png', truth, (value) => shade[value]);
    const off = picture('off.png', truth, (value) => (value ? 60 : 20));
    const bare = picture('bare.png', truth, (value) => (value ? 190 : 20));
    const mask = picture('mask.png', truth, (value) => (value === lit ? 255 : 0));
    for (const more of [[], ['--unlit', off], ['--unshadowed', bare],
                        ['--unlit', off, '--unshadowed', bare], ['--mask', mask]]) {
      const { code, out, err, cells: [cell] } = checked(scene, alone, ...more);
      assert.equal(code, 0, out + err);
      assert.equal(cell.family, 'picture');
      assert.equal(cell.verdict, 'agrees');
      assert.equal(cell.falsely_lit + cell.falsely_shadowed, 0);
      assert.deepEqual(cell.diagnosis, []);
    }
  });

for (const [name, expose] of [
  ['half the exposure', (value) => value / 2], ['more exposure', (value) => Math.min(255, 1.3 * value)],
  ['linear light', (value) => 255 * (value / 255) ** 2.2],
  ['some ambient light', (value) => 60 + 0.7 * value],
  ['eight bits', (value) => Math.round(value)]])
  test(`a right picture with ${name} agrees, alone and with its twin`, () => {
    const truth = truthOf('ordinary');
    const round = (value) => Math.round(257 * expose(value)) / 257;
    const image = picture('exposed.png', truth, (value) => round(shade[value]));
    const off = picture('off.png', truth, (value) => round(value ? 60 : 20));
    for (const more of [[], ['--unlit', off]]) {
      const { code, out, cells: [cell] } = checked('ordinary', image, ...more);
      assert.equal(code, 0, out);
      // Where the light only grazes by some normals that the picture may have been shaded by.
      assert.ok(cell.undecidable < 2e-4 * cell.pixels, out);
    }
  });

test('a square of lit pixels that is dark is counted, and named by its first pixel', () => {
  const truth = truthOf('ordinary');
  const [left, top] = litSquare(truth);
  const off = picture('off.png', truth, (value) => (value ? 60 : 20));
  const image = picture('square.png', truth, (value, x, y) =>
    shade[x >= left && x < left + 8 && y >= top && y < top + 8 ? shadowed : value]);
  const { code, out, cells: [cell] } = checked('ordinary', image, '--unlit', off);
  assert.equal(code, 1);
  assert.equal(cell.falsely_shadowed, 64);
  assert.equal(cell.falsely_lit, 0);
  assert.deepEqual(cell.first, { x: left, y: top, cause: 'unexplained' });
  assert.match(out, new RegExp('square +ordinary +unexplained +64 of 40,000 \\(unexplained 64\\) ' +
                               ` +first \\(${left},${top}\\)`));
  assert.match(out, /reproduce: shadowproof check ordinary square\.png --unlit off\.png --size 200x200\n/);
});

test('with both twins a pixel tells by itself what light adds, however surfaces are shaded', () => {
  const truth = truthOf('ordinary');
  const [left, top] = litSquare(truth);
  // Values that no surface has: each pixel's light is its own.
  const noise = (x, y) => ((x * 7919 + y * 104729) % 97) / 97;
  const dark = (x, y) => 30 + 60 * noise(x, y);
  const bright = (x, y) => dark(x, y) + 20 + 100 * noise(y + 5, x);
  const round = (shaded) => (_, x, y) => Math.round(shaded(x, y));
  const off = picture('off.png', truth, round(dark));
  const bare = picture('bare.png', truth, round(bright));
  const both = ['--unlit', off, '--unshadowed', bare];
  const shown = (wrong) => picture('noisy.png', truth, (value, x, y) =>
    Math.round((value === lit && !wrong(x, y) ? bright : dark)(x, y)));
  const right = checked('ordinary', shown(() => false), ...both, '--no-alignment');
  assert.equal(right.code, 0, right.out + right.err);
  assert.equal(right.cells[0].undecidable, 0);
  const square = shown((x, y) => x >= left && x < left + 8 && y >= top && y < top + 8);
  const faulty = checked('ordinary', square, ...both, '--no-alignment');
  assert.equal(faulty.code, 1);
  assert.equal(faulty.cells[0].falsely_shadowed, 64);
  assert.equal(faulty.cells[0].falsely_lit, 0);
  assert.match(faulty.out, /reproduce: shadowproof check ordinary noisy\.png --unlit off\.png --unshadowed bare\.png /);
});

const claimOf = (scene, technique, ...settings) => {
  const run = shadowproof(['verify', scene, ...size, '--technique', technique, ...settings,
                           '--out', 'claims', '-q']);
  assert.ok(run.code <= 1, run.err);
  const png = readPng(path(`claims/${scene}/${technique}.claim.png`));
  return { ...png, at: (x, y) => png.at(x, y)[0] };
};

for (const [scene, technique, hypothesis] of [
  ['near_plane', 'zpass', 'zpass'], ['far_plane', 'zfail', 'zfail_far'],
  ['long_shadow', 'zfail_truncated', 'short_volumes'], ['ordinary', 'zfail_no_light_cap', 'missing_cap']])
  test(`what ${technique} makes of ${scene} is diagnosed as ${hypothesis}, by the picture alone`, () => {
    const image = picture('claim.png', claimOf(scene, technique), (value) => shade[value]);
    const { code, out, cells: [cell] } = checked(scene, image);
    assert.equal(code, 1, out);
    const [best] = cell.diagnosis;
    const wrong = cell.falsely_lit + cell.falsely_shadowed;
    assert.ok(wrong > 40, `${wrong}`);
    assert.equal(best.hypothesis, hypothesis, out);
    assert.ok(best.explained >= 0.95 * wrong, `${best.explained} of ${wrong}`);
    assert.ok(best.contradicted <= 0.001 * 200 * 200, `${best.contradicted}`);
  });

/** What the first hypothesis says of a picture of a technique's claim; it must explain nearly all. */
function diagnosed(scene, technique, ...settings) {
  const image = picture('claim.png', claimOf(scene, technique, ...settings), (value) => shade[value]);
  const { code, out, cells: [cell] } = checked(scene, image);
  assert.equal(code, 1, out);
  const [best] = cell.diagnosis;
  assert.ok(best, out);
  assert.ok(best.explained >= 0.95 * (cell.falsely_lit + cell.falsely_shadowed), out);
  assert.ok(best.contradicted <= 0.001 * 200 * 200, out);
  return best;
}

for (const [scene, texels, bias] of [['ordinary', 128, 0.15], ['ordinary', 256, 0.3],
                                     ['cube_edge', 64, 0.15]])
  test(`a cube map of ${texels} texels on ${scene} is told by its resolution and its bias`, () => {
    const { hypothesis, parameters } = diagnosed(scene, 'cube_map_six_pass', '--map-size', `${texels}`,
                                                 '--map-bias', `${bias}`);
    assert.equal(hypothesis, 'shadow_map');
    assert.equal(parameters.resolution, texels);
    assert.ok(Math.abs(parameters.bias - bias) <= 0.02 * bias, `${parameters.bias}`);
    assert.deepEqual(Object.keys(parameters), ['resolution', 'bias']);
  });

test('rays that miss what is close are told, and how close', () => {
  const { hypothesis, parameters } = diagnosed('ordinary', 'traced_epsilon', '--ray-epsilon', '0.2');
  assert.equal(hypothesis, 'ray_epsilon');
  assert.ok(Math.abs(parameters.epsilon - 0.2) < 0.02, `${parameters.epsilon}`);
});

test('a mesh that is not drawn, and one that casts no shadow, are told from each other', () => {
  const gltf = JSON.parse(readFileSync(join(process.env.SHADOWPROOF_SCENES, 'ordinary.gltf'), 'utf8'));
  const torus = gltf.nodes.find(({ name }) => name === 'torus');
  const firstOf = (file) => {
    const run = shadowproof(['render', file, ...size, '-o', 'changed.png', '-q']);
    assert.equal(run.code, 0, run.err);
    const png = readPng(path('changed.png'));
    const image = picture('changed.png', { ...png, at: (x, y) => png.at(x, y)[0] },
                          (value) => shade[value]);
    const { out, cells: [cell] } = checked('ordinary', image);
    assert.ok(cell.diagnosis.length > 0, out);
    return cell.diagnosis[0].words;
  };
  torus.extras = { shadowproof: { casts: false } };
  writeFileSync(path('no_caster.gltf'), JSON.stringify(gltf));
  assert.equal(firstOf('no_caster.gltf'), 'torus casts no shadow');
  delete torus.mesh;
  writeFileSync(path('no_mesh.gltf'), JSON.stringify(gltf));
  assert.equal(firstOf('no_mesh.gltf'), 'torus is not drawn');
});

test('controls are caught, or it is said why not; the picture is judged as without them', () => {
  const truth = truthOf('ordinary');
  const good = picture('good.png', truth, (value) => shade[value]);
  const { code, out, cells: [cell] } = checked('ordinary', good, '--controls');
  assert.equal(code, 0, out);
  const named = (control) => cell.controls.filter((one) => one.control === control);
  assert.deepEqual(named('caster_missing').map(({ words, caught }) => [words.split(' ')[0], caught]),
                   [['floor', false], ['box', true], ['torus', true], ['ball', true]]);
  assert.equal(named('caster_missing')[0].why_not, 'no shadow that it throws alone is in this view');
  assert.deepEqual(named('light_moved').map(({ caught }) => caught), [true, true, true]);
  const [one, two, five] = named('light_moved').map(({ wrong }) => wrong);
  assert.ok(one < two && two < five);
  for (const control of ['range', 'shadow_shifted', 'triangle_missing'])
    assert.equal(named(control).length, 1, control);
  assert.match(out, /control: caught: box casts no shadow, by [\d,]+ pixels/);
  assert.match(out, /controls: \d+ of 1\d caught; the smallest: /);
  const { cells: [without] } = checked('ordinary', good);
  assert.equal(without.controls, undefined);
});

test('a control that lies where the picture tells nothing is not caught, and that is why', () => {
  const truth = truthOf('ordinary');
  // The lower half is of one colour.
  const half = picture('half.png', truth, (value, x, y) => y < 100 ? shade[value] : 60);
  const off = picture('off.png', truth, (value, x, y) => y < 100 ? (value ? 60 : 20) : 60);
  const { cells: [cell] } = checked('ordinary', half, '--unlit', off, '--controls', '--no-diagnosis');
  for (const { caught, changed, wrong, why_not } of cell.controls) {
    assert.ok(wrong <= changed);
    assert.equal(why_not === undefined, caught);
  }
});

test('a picture without shadows, and one that ends them at a distance, are told by name', () => {
  const truth = truthOf('ordinary');
  const off = picture('off.png', truth, (value) => (value ? 60 : 20));
  const none = checked('ordinary', picture('none.png', truth, (value) => (value ? 190 : 20)),
                       '--unlit', off);
  assert.equal(none.code, 1);
  assert.equal(none.cells[0].diagnosis[0].hypothesis, 'no_shadow');
  assert.equal(none.cells[0].falsely_shadowed, 0);
});

test('what no hypothesis explains is told by its largest regions, with caster and receiver', () => {
  const truth = truthOf('ordinary');
  const off = picture('off.png', truth, (value) => (value ? 60 : 20));
  const [left, top] = litSquare(truth);
  // A square in the light that is dark, and one in a shadow, of the ball or the torus, that is lit.
  let hole;
  for (let y = 0; y < 196 && !hole; ++y)
    for (let x = 0; x < 196 && !hole; ++x)
      if ([0, 1, 2, 3, 4, 5].every((dy) => [0, 1, 2, 3, 4, 5].every((dx) =>
        truth.at(x + dx, y + dy) === shadowed))) hole = [x, y];
  const image = picture('holes.png', truth, (value, x, y) =>
    x >= left && x < left + 8 && y >= top && y < top + 8 ? shade[shadowed]
      : x >= hole[0] && x < hole[0] + 6 && y >= hole[1] && y < hole[1] + 6 ? shade[lit] : shade[value]);
  const { out, cells: [cell] } = checked('ordinary', image, '--unlit', off, '--no-diagnosis');
  const dark = cell.regions.find(({ caster }) => caster === '');
  assert.deepEqual([dark.pixels, dark.left, dark.top, dark.right, dark.bottom],
                   [64, left, top, left + 7, top + 7]);
  assert.match(dark.words, /is shadowed where nothing is between it and the light/);
  assert.match(out, /  left: 64 pixels from /);
  for (const { caster, words } of cell.regions.filter((region) => region.caster !== ''))
    assert.ok(words.includes(`the shadow of ${caster} on `), words);
  const right = checked('ordinary', picture('right.png', truth, (value) => shade[value]));
  assert.equal(right.cells[0].regions, undefined);
});

test('an antialiased picture differs at edges alone, and a shifted one does not pass', () => {
  const fine = truthOf('ordinary', ['--size', '400x400']);
  const mean = (x, y) => [0, 1, 2, 3].reduce(
    (sum, i) => sum + shade[fine.at(Math.min(2 * x + (i & 1), 399), Math.min(2 * y + (i >> 1), 399))], 0) / 4;
  const off = picture('off.png', truthOf('ordinary'), (value) => (value ? 60 : 20));
  const at = { width: 200, height: 200, at: () => 0 };
  const smooth = checked('ordinary', picture('smooth.png', at, (_, x, y) => Math.round(mean(x, y))),
                         '--unlit', off);
  assert.equal(smooth.code, 0, smooth.out);
  const moved = picture('moved.png', at, (_, x, y) => Math.round(mean(Math.min(x + 2, 199), y)));
  assert.equal(checked('ordinary', moved, '--unlit', off).code, 3);
  assert.equal(checked('ordinary', moved, '--unlit', off, '--no-alignment').code, 1);
});

test('several pictures of one scene make one report, which merges', () => {
  const truth = truthOf('ordinary');
  const first = picture('engine a.png', truth, (value) => shade[value]);
  const second = picture('engine-b.png', truth, (value) => 2 * shade[value] / 2 + 10);
  const { code, cells } = checked('ordinary', first, second);
  assert.equal(code, 0);
  assert.deepEqual(cells.map(({ name }) => name), ['engine_a', 'engine-b']);
  const merged = shadowproof(['merge', 'checked', '--out', 'merged', '-q']);
  assert.equal(merged.code, 0, merged.err);
});

test('what tells nothing is refused, with a sentence', () => {
  const truth = truthOf('ordinary');
  const good = picture('good.png', truth, (value) => shade[value]);
  const flat = picture('flat.png', truth, () => 90);
  const small = picture('small.png', { width: 50, height: 40, at: () => 0 }, (_, x) => x);
  const refused = (args, words) => {
    const { code, out, err } = checked(...args);
    assert.equal(code, 3, `${args}: ${code} ${out} ${err}`);
    assert.match(out + err, words);
  };
  refused(['ordinary', flat], /flat\.png: is of one colour, and shows no scene; render it again/);
  refused(['ordinary', good, '--unlit', small], /small\.png: is 50x40, where 200x200 belongs; /);
  refused(['ordinary', good, '--size', '100x100'], /good\.png: is 200x200, where 100x100 belongs; /);
  refused(['ordinary', 'missing.png'], /missing\.png: does not exist; /);
  refused(['missing.gltf', good], /missing\.gltf: /);
  assert.equal(shadowproof(['check', 'ordinary', good, good, '--unlit', flat]).code, 2);
  assert.equal(shadowproof(['check', 'ordinary']).code, 2);
  assert.equal(shadowproof(['check', 'ordinary', good, '--unlit', flat, '--mask', flat]).code, 2);
});
