// A run of `shadowproof bench` that is stopped keeps what it has, and goes on.
import assert from 'node:assert/strict';
import { existsSync, readdirSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { scratch, shadowproof } from '../shadowproof.mjs';
import { assertValid, benched, interrupted, least, pointOf, write, written } from './runs.mjs';

const shadows = benched('shadows.json', ['near_plane']);

test('a run that was stopped goes on: what is finished is not measured again', () => {
  const half = structuredClone(shadows);
  half.finished = false;
  half.scenes[0].finished = false;
  half.points = half.points.filter(({ technique }) => technique !== 'auto');
  write('half.json', half);
  const args = ['bench', 'near_plane', ...least, '--json', 'half.json', '--resume'];
  assert.equal(shadowproof(args).code, 0);
  const whole = written('half.json');
  assertValid(whole);
  assert.ok(whole.finished);
  assert.equal(whole.points.length, shadows.points.length);
  // One sample is all that was allowed, and all but one point had it.
  for (const point of half.points)
    assert.deepEqual(pointOf(whole, point), point);
  // Finished: nothing is measured at all.
  assert.equal(shadowproof(args).code, 0);
  assert.deepEqual(written('half.json'), whole);
});

/** Points of two runs without their commands' order: by scene, technique and settings. */
const named = ({ scene, technique, settings }) => `${scene} ${technique} ${JSON.stringify(settings)}`;
function assertHolds(whole, part) {
  const points = new Map(whole.points.map((point) => [named(point), point]));
  for (const point of part.points) assert.deepEqual(points.get(named(point)), point, named(point));
}

test('a run that goes on keeps scenes, techniques and lines that it does not name', () => {
  const two = ['--technique', 'zfail,zpass', ...least, '--json', 'many.json'];
  const many = shadowproof(['bench', 'near_plane', 'thin_caster', ...two]);
  assert.equal(many.code, 0, many.err);
  const before = written('many.json');
  // Another technique of one scene, and another scene.
  const more = (args) => {
    const run = shadowproof(['bench', ...args, ...least, '--json', 'many.json', '--resume', '--out', 'many']);
    assert.equal(run.code, 0, run.err);
    const whole = written('many.json');
    assertValid(whole);
    assertHolds(whole, before);
    assert.ok(whole.finished && whole.scenes.every(({ finished }) => finished));
    assert.deepEqual(written('many/results.json'), whole);
    return whole;
  };
  const added = more(['near_plane', '--technique', 'zp_plus']);
  assert.equal(added.points.length, before.points.length + 1);
  const another = more(['idle_casters', '--technique', 'zfail']);
  assert.deepEqual(another.scenes.map(({ name }) => name).sort(),
                   ['idle_casters', 'near_plane', 'thin_caster']);
  // What is there is not measured again, in whatever order it is named.
  assert.deepEqual(more(['thin_caster', 'near_plane', '--technique', 'zpass']).points.length,
                   another.points.length);
});

test('a run that goes on keeps the points of a scene that is now another, and does not mix them', () => {
  const changed = structuredClone(shadows);
  changed.scenes[0].digest = '0000000000000000';
  write('changed.json', changed);
  const run = shadowproof(['bench', 'near_plane', 'thin_caster', '--technique', 'zfail', ...least,
                           '--json', 'changed.json', '--resume']);
  assert.equal(run.code, 3);
  assert.match(run.err, /changed\.json: cannot be gone on with: the content, size or light of its scene near_plane/);
  const whole = written('changed.json');
  assertHolds(whole, changed);
  assert.ok(whole.points.some(({ scene }) => scene === 'thin_caster'));
});

test('a run that is interrupted while it goes on loses nothing of what was there', async () => {
  write('going.json', { ...shadows, finished: false });
  const args = ['bench', 'thin_caster', '--technique', 'zfail', '--quick', '--size', '48x48', '--no-pictures',
                '--json', 'going.json', '--resume', '--out', 'going', '--repeats', '10000', '--seconds', '100000', '-q'];
  await interrupted(args, () => written('going.json').scenes.length > 1); // it is replaced whole
  const part = written('going.json');
  assertValid(part);
  assertHolds(part, shadows);
  assert.equal(part.finished, false);
  assert.deepEqual(part.scenes.map(({ name, finished }) => [name, finished]),
                   [['thin_caster', false], ['near_plane', true]]);
  assert.ok(part.points.some(({ scene }) => scene === 'thin_caster'));
});

test('a run that is interrupted keeps what it has, whole, and leaves nothing else', async () => {
  const args = ['bench', 'near_plane', '--quick', '--size', '48x48', '--json', 'stopped.json',
                '--out', 'stopped'];
  const isThere = () => existsSync(join(scratch, 'stopped.json'));
  await interrupted([...args, '--repeats', '10000', '--seconds', '100000', '-q'], isThere);
  assert.ok(isThere());
  const part = written('stopped.json');
  assertValid(part);
  assert.equal(part.finished, false);
  assert.ok(part.points.length > 0);
  assert.deepEqual(readdirSync(scratch).filter((name) => /^stopped/.test(name)), ['stopped.json']);
  assert.equal(shadowproof([...args, '--repeats', '1', '--resume', '-q']).code, 0);
  const whole = written('stopped.json');
  assert.ok(whole.finished);
  assert.equal(whole.points.length, shadows.points.length);
  for (const point of part.points) assert.deepEqual(pointOf(whole, point).ms, point.ms);
});

test('another run is not gone on with', () => {
  write('other.json', { ...shadows, version: '0' });
  const run = shadowproof(['bench', 'near_plane', ...least, '--json', 'other.json', '--resume']);
  assert.equal(run.code, 3);
  assert.match(run.err, /other\.json: cannot be gone on with: its version is 0, and now/);
});
