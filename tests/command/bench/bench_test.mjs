// `shadowproof bench` as its users meet it. No test holds a time, nor an order of times, which
// tests/bench/results_page.mjs measures: all that is judged is recorded, or does not depend on the clock.
import assert from 'node:assert/strict';
import { existsSync, readFileSync, rmSync, symlinkSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { timeOf } from '../../viewer/bench_run.mjs';
import { filesBelow, isForPointLights, scratch, shadowproof } from '../shadowproof.mjs';
import { assertReport, assertValid, benched, least, pointOf, write, written } from './runs.mjs';

const shadows = benched('shadows.json', ['near_plane', '--csv', 'shadows.csv']);
const bumpy = benched('bumpy.json', ['bumpy_torus']);
const colors = benched('colors.json', ['bumpy_torus', '--technique', 'bump_one_pass,zfail']);

test('what it writes is valid by its schema', () => {
  assertValid(shadows);
  assertValid(colors);
});

test('every technique that suits the scene is there, and the truth', () => {
  const { techniques } = JSON.parse(shadowproof(['list', '--json']).out);
  const plain = techniques.filter(isForPointLights).map(({ name }) => name);
  const own = shadows.points.filter(({ settings }) => Object.keys(settings).length === 0);
  assert.deepEqual(own.map(({ technique }) => technique), ['truth', ...plain]);
  assert.equal(shadows.points[0].differing, 0);
});

test('its errors are those of verify', () => {
  shadowproof(['verify', 'near_plane', '--size', '48x48', '--json', 'verified.json', '-q']);
  const [scene] = written('verified.json').scenes;
  for (const cell of scene.techniques) {
    const point = pointOf(shadows, { technique: cell.name, settings: {} });
    assert.deepEqual(point.causes, cell.causes, cell.name);
    assert.equal(point.differing, cell.differing, cell.name);
  }
});

test('settings are swept one at a time, each but the technique\'s own', () => {
  const swept = colors.points.filter(({ technique }) => technique === 'bump_one_pass');
  const [own, ...others] = swept;
  assert.deepEqual(own.settings, {});
  assert.deepEqual(own.own, { normalise: 'cube-map', 'cube-size': '64', bumps: 'normal-map',
                               vectors: 'at-vertices', tangents: 'vertices' });
  const sweptWords = others.map(({ settings }) =>
    Object.entries(settings).map((each) => each.join('=')).join(' '));
  assert.deepEqual(sweptWords.filter((words) => !words.startsWith('bumps')),
                   ['normalise=exact', 'normalise=newton-raphson',
                    ...[8, 16, 32, 128, 256].map((size) => `cube-size=${size}`),
                    ...[0, 2, 3].map((steps) => `normalise=newton-raphson newton-steps=${steps}`),
                    'vectors=per-pixel', 'vectors=unit-at-vertices', 'tangents=polygons']);
  for (const { settings, own: made } of others)
    for (const [name, value] of Object.entries(settings)) {
      assert.notEqual(value, own.own[name]);
      assert.equal(made[name], value);
    }
  // A normal map is no height field: that is said, and is no failure.
  assert.deepEqual(colors.left_out.map(({ settings }) => settings), [{ bumps: 'height-field' }]);
  assert.ok(colors.points.every(({ technique, color }) =>
    Boolean(color) === (technique === 'bump_one_pass')));
});

test('each point has the command that measures it again', () => {
  for (const { command } of colors.points) assert.match(command, /^shadowproof bench bumpy_torus/);
  // With one setting that is swept each technique, and each setting once.
  const tried = new Set();
  for (const { technique, settings, command } of colors.points) {
    const names = [technique, ...Object.keys(settings)];
    if (technique === 'truth' || names.every((name) => tried.has(name))) continue;
    for (const name of names) tried.add(name);
    const args = command.split(' ').slice(1);
    const run = shadowproof([...args, '--repeats', '1', '-q', '--json', 'again.json']);
    assert.equal(run.code, 0, run.err);
    const again = written('again.json').points.find((point) => point.technique === technique &&
      JSON.stringify(point.settings) === JSON.stringify(settings));
    assert.ok(again, command);
  }
});

test('the CSV has a line for each point', () => {
  const [head, ...lines] = readFileSync(join(scratch, 'shadows.csv'), 'utf8').trim().split('\r\n');
  assert.equal(lines.length, shadows.points.length);
  assert.match(head, /,ms_volumes,ms_surface,ms_counting,ms_classes,/);
});

test('a frame\'s stages are told for each sample', () => {
  const stagesOf = (technique) => Object.keys(pointOf(shadows, { technique, settings: {} }).stages);
  assert.deepEqual(stagesOf('zfail'), ['volumes', 'surface', 'counting', 'classes']);
  assert.deepEqual(stagesOf('cube_map_six_pass'), ['map', 'surface', 'classes']);
  assert.deepEqual(stagesOf('traced_epsilon'), ['hierarchy', 'rays']);
  for (const { technique, ms, stages } of shadows.points.filter(({ stages }) => stages))
    for (const { samples } of Object.values(stages))
      assert.equal(samples.length, ms.samples.length, technique);
});

const wrongPixels = ({ differing, causes }) => differing - (causes.edge ?? 0);

/** Not one wrong pixel more at each setting than at the one before. */
function assertFalls(technique, name, values) {
  const usual = ownOf(technique);
  const wrong = values.map((value) => wrongPixels(shadows.points.find((point) =>
    point.technique === technique && point.own[name] === value &&
    Object.entries(point.own).every(([key, each]) => key === name || each === usual[key]))));
  wrong.forEach((pixels, i) => assert.ok(i === 0 || pixels <= wrong[i - 1], wrong.join(' ')));
  assert.ok(wrong.at(-1) < wrong[0], wrong.join(' '));
}
const ownOf = (technique) => pointOf(shadows, { technique, settings: {} }).own;

const rmseOf = (name, words) => bumpy.points.find(({ technique, settings }) => technique === name &&
  Object.entries(settings).map((each) => each.join('=')).join(' ') === words).color.rmse;

test('the mean of more rays over the pixel is nearer to that of most, and has no classes of its own', () => {
  assertValid(bumpy);
  const means = bumpy.points.filter(({ technique, settings }) => technique === 'truth' && settings.samples);
  assert.deepEqual(means.map(({ settings }) => settings.samples), ['1', '4', '16', '64']); // with --quick
  means.forEach(({ color }, i) => assert.ok(i === 0 || color.rmse < means[i - 1].color.rmse));
  assert.equal(means.at(-1).color.rmse, 0);
  assert.ok(means.every(({ differing, color }) => differing === 0 && color.p999 <= color.largest));
  // None where a technique is named, which they would outlast, nor where no colours are lit.
  for (const { points } of [colors, shadows])
    assert.equal(points.filter(({ technique }) => technique === 'truth').length, 1);
});

test('errors come in the order that theory gives', () => {
  const map = 'cube_map_six_pass';
  assertFalls(map, 'map-size', ['64', '256', '1024', '4096']);
  assertFalls(map, 'map-bias', ['0', '0.01', ownOf(map)['map-bias']]); // acne, up to what it must be
  // What the cube map's rounding and mixing cost falls with its size, and Newton's steps each square
  // their error. The technique is right but for these where it lights in floats.
  const rmse = (words) => rmseOf('bump_tangent_space', words);
  const falls = (names) => names.map(rmse).forEach((error, i, all) =>
    assert.ok(i === 0 || error < all[i - 1], all.join(' ')));
  falls([8, 16, 32].map((size) => `normalise=cube-map cube-size=${size}`));
  falls([0, 2].map((steps) => `normalise=newton-raphson newton-steps=${steps}`));
  assert.ok(rmse('normalise=newton-raphson') < rmse('normalise=newton-raphson newton-steps=0'));
  assert.ok(rmse('normalise=newton-raphson newton-steps=2') < rmse('normalise=newton-raphson'));
  const lengths = shadows.points.filter(({ technique }) => technique === 'zfail_truncated')
    .map(({ own }) => own.extrusion).sort((a, b) => Number(a) - Number(b));
  assert.equal(lengths.length, 6);
  assertFalls('zfail_truncated', 'extrusion', lengths);
});

test('wrong usage and bad input are named, with a remedy', () => {
  const fails = (args, code, words) => {
    const run = shadowproof(['bench', ...args]);
    assert.equal(run.code, code, run.out + run.err);
    assert.match(run.err, words);
  };
  fails(['ordinary', '--repeats', '0'], 2, /--repeats/);
  fails(['ordinary', '--technique', 'zwrong'], 2, /there is no technique 'zwrong'; there are/);
  fails(['nowhere.gltf', ...least], 3, /nowhere\.gltf/);
  fails(['ordinary', ...least, '--technique', 'zfail', '--json', 'none/x.json'], 3, /none\/x\.json/);
  fails(['ordinary', ...least, '--json', 'same', '--csv', 'same'], 3, /named for two outputs/);
  fails(['ordinary', ...least, '--technique', 'bump_one_pass'], 3, /ordinary\.gltf: has no bump map/);
});

test('a run redraws its plot without measuring, and its folder gives the same again', () => {
  const redraw = (from, out) => {
    const run = shadowproof(['bench', '--from', from, '--out', out, '--json', `${out}.json`]);
    assert.equal(run.code, 0, run.err);
    return readFileSync(join(scratch, `${out}.json`), 'utf8');
  };
  const first = redraw('shadows.json', 'plot');
  assert.equal(first, readFileSync(join(scratch, 'shadows.json'), 'utf8'));
  assert.equal(redraw('plot', 'plot'), first);
  for (const file of ['index.html', 'results.js', 'results.json', 'manifest.json'])
    assert.ok(existsSync(join(scratch, 'plot', file)), file);
});

test('each point leads to its pictures, which move with the folder of the plot', () => {
  const measured = shadowproof(['bench', 'near_plane', '--technique', 'zpass,cube_map_six_pass',
    '--quick', '--size', '48x48', '--repeats', '1', '--out', 'seen', '-q']);
  assert.equal(measured.code, 0, measured.err);
  const run = written('seen/results.json');
  assertValid(run);
  const report = written('seen/pictures/results.json');
  assertReport(report);
  const drawn = run.points.filter(({ technique }) => technique !== 'truth');
  assert.ok(drawn.some(({ settings }) => settings['map-size'] === '64'));
  const addresses = drawn.map(({ pictures }) => pictures);
  assert.equal(new Set(addresses).size, drawn.length);
  for (const { technique, pictures, causes, settings } of drawn) {
    const [folder, name] = pictures.replace('pictures/index.html#', '').split('/');
    const cell = report.scenes.find((scene) => scene.folder === folder)
      .techniques.find((each) => each.name === name);
    assert.equal(name, technique);
    assert.deepEqual(cell.causes, causes);
    for (const [flag, value] of Object.entries(settings))
      assert.match(cell.command, new RegExp(`^shadowproof verify near_plane .*--${flag} ${value} `));
    for (const picture of Object.values(cell.images))
      assert.ok(existsSync(join(scratch, 'seen/pictures', picture)), picture);
  }

  const redraw = (from, out, ...more) =>
    shadowproof(['bench', '--from', from, '--out', out, '-q', ...more]);
  // What somebody else put there is not taken along, nor followed.
  writeFileSync(join(scratch, 'seen/pictures/notes.txt'), 'mine');
  symlinkSync('/etc/hostname', join(scratch, 'seen/pictures/link'));
  assert.equal(redraw('seen', 'moved').code, 0);
  rmSync(join(scratch, 'seen/pictures/notes.txt'));
  rmSync(join(scratch, 'seen/pictures/link'));
  assert.deepEqual(filesBelow(join(scratch, 'moved/pictures')), filesBelow(join(scratch, 'seen/pictures')));
  assert.deepEqual(written('moved/results.json').points, run.points);
  // In its own place too, named as a folder or by its results.
  for (const from of ['seen', 'seen/results.json']) {
    assert.equal(redraw(from, 'seen').code, 0);
    assert.deepEqual(filesBelow(join(scratch, 'seen')), filesBelow(join(scratch, 'moved')));
    assert.deepEqual(written('seen/results.json').points, run.points);
  }
  assert.equal(redraw('seen', 'without', '--no-pictures').code, 0);
  assert.ok(!existsSync(join(scratch, 'without/pictures')));
  // A cell that somebody changed is no longer led to.
  const [changed] = drawn[0].pictures.split('#').slice(1);
  writeFileSync(join(scratch, 'moved/pictures', `${changed}.cell.js`), 'changed');
  assert.equal(redraw('moved', 'lacking').code, 0);
  assert.deepEqual(written('lacking/results.json').points.map(({ pictures }) => pictures),
                   run.points.map(({ pictures }) => (pictures === drawn[0].pictures ? undefined : pictures)));
  // A run that goes on has those of the points that it knew, too.
  write('known.json', run);
  const resumed = shadowproof(['bench', 'near_plane', '--technique', 'zpass,cube_map_six_pass',
    '--quick', '--size', '48x48', '--repeats', '1', '--json', 'known.json', '--resume', '--out', 'resumed', '-q']);
  assert.equal(resumed.code, 0, resumed.err);
  assert.deepEqual(written('resumed/results.json').points, run.points);
  assert.deepEqual(filesBelow(join(scratch, 'resumed')), filesBelow(join(scratch, 'seen')));
  // A file alone has none.
  write('alone.json', run);
  assert.equal(redraw('alone.json', 'bare').code, 0);
  assert.ok(written('bare/results.json').points.every(({ pictures }) => pictures === undefined));
  assert.ok(!existsSync(join(scratch, 'bare/pictures')));
  // Nor does a file lead a reader of the plot anywhere else.
  for (const address of ['javascript:alert(1)', 'https://example.com/', '../../etc/passwd',
                         'pictures/index.html#', 'pictures/index.html#a/', 'pictures/index.html#/b',
                         'pictures/index.html#a/b/c', 'pictures/index.html#a/b"onclick="x']) {
    run.points[1].pictures = address;
    write('hostile.json', run);
    const refused = redraw('hostile.json', 'hostile');
    assert.equal(refused.code, 3);
    assert.match(refused.err, /\/points\/1\/pictures must be the address of a cell/);
  }
});

test('a folder keeps what the program did not write', () => {
  writeFileSync(join(scratch, 'plot', 'notes.txt'), 'mine');
  const run = shadowproof(['bench', '--from', 'colors.json', '--out', 'plot']);
  assert.equal(run.code, 0, run.err);
  assert.match(run.out, /kept notes\.txt/);
  assert.equal(readFileSync(join(scratch, 'plot', 'notes.txt'), 'utf8'), 'mine');
  writeFileSync(join(scratch, 'foreign.txt'), '');
  const refused = shadowproof(['bench', '--from', 'colors.json', '--out', '.']);
  assert.equal(refused.code, 3);
});

/** `shadows` as if each sample had been taken so many times. */
function repeatedRun(count) {
  const run = structuredClone(shadows);
  for (const point of run.points) {
    point.ms = timeOf(Array(count).fill(point.ms.median));
    for (const stage of Object.values(point.stages ?? {})) stage.samples = Array(count).fill(stage.median);
  }
  return run;
}

/** The same with every time of one technique multiplied. */
function changedRun(technique, factor, { count = 6, more = () => {} } = {}) {
  const run = repeatedRun(count);
  const point = run.points.find((each) => each.technique === technique);
  point.ms = timeOf(Array(count).fill(factor * point.ms.median));
  more(point);
  return run;
}

test('a loss beyond both intervals exits with 1 and is named; a gain does not', () => {
  write('repeated.json', repeatedRun(6));
  const against = (run, from = 'repeated.json') => {
    write('older.json', run);
    return shadowproof(['bench', '--from', from, '--against', 'older.json', '--out', 'plot']);
  };
  const same = against(repeatedRun(6));
  assert.equal(same.code, 0, same.out + same.err);
  const slower = against(changedRun('zfail', 0.5));
  assert.equal(slower.code, 1);
  assert.match(slower.out, /^loss: near_plane zfail: .* ms/m);
  const quicker = against(changedRun('zfail', 2));
  assert.equal(quicker.code, 0);
  assert.match(quicker.out, /^gain: near_plane zfail: .* ms/m);
  assert.match(quicker.out, /^order: near_plane \w.* is quicker than .* now, and was slower/m);
  // Without both intervals a time is neither.
  for (const few of [against(changedRun('zfail', 0.5, { count: 5 })),
                     against(changedRun('zfail', 0.5), 'shadows.json')]) {
    assert.equal(few.code, 0, few.out);
    assert.doesNotMatch(few.out, /^(loss|gain|order):/m);
    assert.match(few.out, /^note: the times of [\d,]+ points are not compared: fewer than 6 samples/m);
  }
  const wrong = against(changedRun('zpass', 1, { more: (point) => {
    point.causes.near_plane -= 1;
    point.differing -= 1;
    point.falsely_lit = Math.max(0, point.falsely_lit - 1);
    point.falsely_shadowed = Math.max(0, point.falsely_shadowed - 1);
  } }));
  assert.equal(wrong.code, 1);
  assert.match(wrong.out, /^loss: near_plane zpass: [\d,]+ pixels wrong, was /m);
});

test('damaged files are refused with the place and a remedy', () => {
  const refused = (text, words) => {
    writeFileSync(join(scratch, 'damaged.json'), text);
    const run = shadowproof(['bench', '--from', 'damaged.json', '--out', 'plot']);
    assert.equal(run.code, 3);
    assert.match(run.err, words);
  };
  refused('', /damaged\.json: is empty; give the whole file that bench --json wrote/);
  refused('{"schema"', /damaged\.json: is cut off after byte 9/);
  refused('{"schema":"shadowproof/results/1"}', /\/schema must be "shadowproof\/bench\/1"/);
  refused(JSON.stringify({ ...shadows, points: [{}] }), /\/points\/0 lacks "scene"/);
  const usage = shadowproof(['bench', 'ordinary', '--from', 'shadows.json']);
  assert.equal(usage.code, 2);
  assert.equal(shadowproof(['bench', 'ordinary', '--resume']).code, 2);
  assert.match(shadowproof(['bench', '--from', 'nothing.json']).err, /there is no such file/);
});
