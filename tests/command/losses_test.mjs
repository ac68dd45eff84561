// A crash or a hang in stress, bench and check, of the driver or of Embree: it loses the point or
// the picture in which it happens, and no other. guard_test.mjs has verify.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { scratch, shadowproof } from './shadowproof.mjs';

const size = ['--size', '48x48'];
const techniques = ['zpass', 'zfail', 'zfail_clamp'];
const resultsOf = (file) => JSON.parse(readFileSync(join(scratch, file), 'utf8'));
let marks = 0;

/** Settings of faulty_driver.cpp; `once`: only the first process that comes so far has the fault. */
const fault = (words, { once = true } = {}) => ({
  env: { LD_PRELOAD: process.env.FAULTY_DRIVER, SHADOWPROOF_FAULT: words,
         ASAN_OPTIONS: 'verify_asan_link_order=0',
         ...(once && { SHADOWPROOF_FAULT_ONCE: join(scratch, `mark-${++marks}`) }) },
});

const stress = (out, named = techniques) =>
  ['stress', 'near_plane', '--technique', named.join(), '--parameter', 'aspect', '--witness', '0',
   '--no-pictures', ...size, '--json', `${out}.json`, '--out', out];
const pointsOf = (file, technique) => resultsOf(file).points.filter((each) =>
  each.technique === technique);

test('a crash at a point of stress loses that technique there, and nothing else', () => {
  const plain = shadowproof(stress('calm'));
  assert.equal(plain.code, 0, plain.err);
  const run = shadowproof(stress('shaken'), fault('glReadPixels:30:11'));
  assert.equal(run.code, 3, run.out + run.err);
  assert.match(run.out + run.err, /^failed: near_plane, aspect=[^\n]*signal 11/m);
  const whole = resultsOf('calm.json').points;
  const shaken = resultsOf('shaken.json').points;
  const lost = shaken.filter(({ loss }) => loss);
  assert.equal(lost.length, 1);
  assert.equal(lost[0].loss, 'crashed');
  assert.match(lost[0].refused, /signal 11/);
  const same = ({ technique, value, causes, differing }) => ({ technique, value, causes, differing });
  // What is searched for may differ from there on; the ladder does not.
  const ladder = (points) => points.filter(({ searched, technique, value }) => !searched &&
    !(technique === lost[0].technique && value === lost[0].value)).map(same);
  assert.deepEqual(ladder(shaken), ladder(whole));
});

test('a crash in every process of stress loses one technique after the other, and the run ends', () => {
  const run = shadowproof(stress('worn', ['zpass', 'zfail']), fault('glReadPixels:1:11', { once: false }));
  assert.equal(run.code, 3, run.out + run.err);
  const drawn = resultsOf('worn.json').points.filter(({ technique }) => technique !== 'truth');
  assert.ok(drawn.length > 4);
  for (const { loss } of drawn) assert.equal(loss, 'crashed');
  const truths = pointsOf('worn.json', 'truth');
  assert.ok(truths.length > 2 && truths.every(({ ms }) => ms));
  // On the scene as it is, it is told from what is wrong there.
  const [{ parameters: [{ wrong_before: wrong }] }] = resultsOf('worn.json').scenes;
  assert.deepEqual(wrong, []);
  assert.match(run.out, /^ +1 +crashed +zpass: .*signal 11/m);
});

test('a technique that hangs at a point of stress is given up, and the run fails', () => {
  const run = shadowproof([...stress('given-up', ['zpass', 'zfail']), '--timeout', '8', '-q'],
                          fault('glReadPixels:1:hang'));
  assert.equal(run.code, 1, run.out + run.err);
  const lost = resultsOf('given-up.json').points.filter(({ loss }) => loss);
  assert.ok(lost.length > 0);
  for (const { loss, refused, technique } of lost) {
    assert.equal(loss, 'timed_out');
    assert.equal(technique, 'zpass');
    assert.match(refused, /took longer than --timeout 8/);
  }
  assert.ok(pointsOf('given-up.json', 'zfail').every(({ refused }) => !refused));
});

test('a point of stress whose truth is lost, be it the scene’s own, ends nothing', () => {
  for (const [words, loss] of [['rtcBuildBVH:2:hang', 'timed_out'], ['rtcBuildBVH:30:11', 'crashed']]) {
    const run = shadowproof([...stress('untraced', ['zfail']), '--timeout', '8', '-q'], fault(words));
    assert.equal(run.code, 3, run.out + run.err);
    const truths = pointsOf('untraced.json', 'truth');
    const lost = truths.filter((point) => point.loss);
    assert.deepEqual(lost.map((point) => point.loss), [loss]);
    assert.equal(Boolean(lost[0].own), loss === 'timed_out');
    for (const truth of truths.filter((point) => !point.loss)) assert.ok(truth.ms);
    assert.ok(pointsOf('untraced.json', 'zfail').some(({ ms }) => ms));
  }
});

const bench = (out, named = techniques) =>
  ['bench', 'near_plane', '--technique', named.join(), '--quick', '--repeats', '8', ...size,
   '--no-pictures', '--json', `${out}.json`, '--out', out];
const hasSamples = (points, name) =>
  points.some(({ technique, ms }) => technique === name && ms.samples.length > 0);

test('a crash in bench loses a point, the others are measured, and --resume measures it', () => {
  const run = shadowproof(bench('bench'), fault('glReadPixels:2:11'));
  assert.equal(run.code, 3, run.out + run.err);
  const { left_out: leftOut, points } = resultsOf('bench.json');
  const lost = leftOut.filter(({ loss }) => loss === 'crashed');
  assert.equal(lost.length, 1);
  assert.match(lost[0].why, /signal 11/);
  const measured = techniques.filter((name) => name !== lost[0].technique);
  assert.equal(measured.length, 2);
  for (const name of measured) assert.ok(hasSamples(points, name), name);
  const again = shadowproof([...bench('bench'), '--resume']);
  assert.equal(again.code, 0, again.out + again.err);
  const resumed = resultsOf('bench.json');
  assert.deepEqual(resumed.left_out.filter(({ loss }) => loss), []);
  for (const name of techniques) assert.ok(hasSamples(resumed.points, name), name);
  const samples = (from, name) => from.find(({ technique }) => technique === name).ms.samples;
  for (const name of measured)
    assert.deepEqual(samples(resumed.points, name).slice(0, 3), samples(points, name).slice(0, 3));
});

test('a crash while a point is measured keeps the samples of the others', () => {
  // Each technique is drawn and judged first, in some calls; samples make the many that follow.
  const run = shadowproof(bench('sampled'), fault('glFinish:60:11'));
  assert.equal(run.code, 3, run.out + run.err);
  const { left_out: leftOut, points } = resultsOf('sampled.json');
  const lost = leftOut.filter(({ loss }) => loss);
  assert.deepEqual(lost.map(({ loss }) => loss), ['crashed']);
  for (const name of techniques.filter((each) => each !== lost[0].technique))
    assert.ok(points.find(({ technique }) => technique === name).ms.samples.length >= 6, name);
  assert.match(run.out, /^failed: near_plane: .*signal 11/m);
});

test('a technique that hangs in bench is given up, and the run fails', () => {
  const run = shadowproof([...bench('hung'), '--timeout', '8', '-q'], fault('glReadPixels:1:hang'));
  assert.equal(run.code, 1, run.out + run.err);
  const { left_out: leftOut, points } = resultsOf('hung.json');
  const lost = leftOut.filter(({ loss }) => loss);
  assert.deepEqual(lost.map(({ loss, technique }) => [loss, technique]), [['timed_out', 'zpass']]);
  for (const name of ['zfail', 'zfail_clamp']) assert.ok(hasSamples(points, name), name);
});

test('a crash in growth ends that line alone, and --resume measures it', () => {
  const args = ['bench', '--scaling', '--quick', '--repeats', '2', '--technique', 'zfail', ...size,
                '--json', 'growth.json', '--out', 'growth', '-q'];
  const run = shadowproof(args, fault('glFinish:3:11'));
  assert.equal(run.code, 3, run.out + run.err);
  const { scaling: growth, left_out: leftOut } = resultsOf('growth.json');
  const lost = leftOut.filter(({ loss }) => loss);
  assert.deepEqual(lost.map(({ loss, technique }) => [loss, technique]), [['crashed', 'zfail']]);
  const lines = (all, name) => all.filter(({ technique }) => technique === name).length;
  assert.equal(lines(growth, 'truth'), 5);
  assert.equal(lines(growth, 'zfail'), 4);
  const again = shadowproof([...args, '--resume']);
  assert.equal(again.code, 0, again.out + again.err);
  const resumed = resultsOf('growth.json');
  assert.deepEqual(resumed.left_out.filter(({ loss }) => loss), []);
  assert.equal(lines(resumed.scaling, 'zfail'), 5);
});

assert.equal(shadowproof(['render', 'near_plane', '-o', 'right.png', ...size]).code, 0);

test('a crash while check traces the scene is said, and exit code 3', () => {
  const run = shadowproof(['check', 'near_plane', 'right.png', '--mask', 'right.png', '--out', 'checked'],
                          fault('rtcBuildBVH:1:6'));
  assert.equal(run.code, 3, run.out + run.err);
  assert.match(run.out + run.err, /signal 6/);
});

test('a crash while a picture is diagnosed loses that picture alone', () => {
  // Only a wrong picture is diagnosed, for which the scene is traced again, changed.
  const other = shadowproof(['render', 'ordinary', '-o', 'wrong.png', ...size]);
  assert.equal(other.code, 0, other.err);
  for (const [pictures, lostAt] of [[['wrong.png', 'right.png'], 0], [['right.png', 'wrong.png'], 1]]) {
    const run = shadowproof(['check', 'near_plane', ...pictures, '--out', 'pictures'],
                            fault('rtcBuildBVH:2:11'));
    assert.equal(run.code, 3, run.out + run.err);
    const [{ techniques: cells }] = resultsOf('pictures/results.json').scenes;
    assert.equal(cells.length, 2);
    assert.match(cells[lostAt].error, /signal 11/);
    assert.equal(cells[1 - lostAt].verdict, 'agrees');
  }
});

test('what takes longer than a minute is said', () => {
  for (const args of [['verify', 'near_plane', '--technique', 'zpass', '--out', 'slow'],
                      ['render', 'near_plane', '-o', 'slow.png'],
                      ['explain', 'near_plane', '--pixel', '3,3', '--technique', 'zpass']]) {
    const { env } = fault(args[0] === 'render' ? 'rtcBuildBVH:1:hang' : 'glReadPixels:1:hang');
    const run = shadowproof([...args, ...size, '--timeout', '4'],
                            { env: { ...env, SHADOWPROOF_SILENCE: '1' } });
    assert.match(run.out + run.err, /^[^\n]*near_plane[^\n]*: at it for [1-4] s$/m, args.join(' '));
    const calm = shadowproof([...args, ...size]);
    assert.doesNotMatch(calm.out + calm.err, /at it for/);
  }
});
