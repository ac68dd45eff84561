// How `shadowproof bench --scaling` measures growth, and goes on with it.
import assert from 'node:assert/strict';
import { existsSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { scratch, shadowproof } from '../shadowproof.mjs';
import { assertValid, interrupted, write, written } from './runs.mjs';

test('growth has a line for each technique along each axis', () => {
  const run = shadowproof(['bench', 'near_plane', '--scaling', '--quick', '--size', '32x32', '-q',
                           '--technique', 'zfail,cube_map_six_pass', '--repeats', '1',
                           '--json', 'growth.json', '--out', 'growth']);
  assert.equal(run.code, 0, run.err);
  const { scaling, points, ...rest } = written('growth.json');
  assertValid({ scaling, points, ...rest });
  assert.deepEqual(points, []);
  assert.deepEqual(scaling.map(({ axis, technique }) => `${axis} ${technique}`),
                   [...['pixels', 'triangles', 'volumes', 'silhouette edges', 'lights'].flatMap((axis) =>
                     [`${axis} truth`, `${axis} zfail`, `${axis} cube_map_six_pass`]),
                    'texels cube_map_six_pass']);
  for (const { axis, scene, points: sizes } of scaling) {
    assert.equal(scene, { pixels: 'near_plane', triangles: 'dense', volumes: 'stacked',
                          'silhouette edges': 'parted', lights: 'lit', texels: 'near_plane' }[axis]);
    assert.ok(sizes.every(({ size }, i) => i === 0 || size > sizes[i - 1].size));
  }
  // What is there is not measured again.
  const before = readFileSync(join(scratch, 'growth.json'), 'utf8');
  const again = shadowproof(['bench', 'near_plane', '--scaling', '--quick', '--size', '32x32', '-q',
                             '--technique', 'zfail,cube_map_six_pass', '--repeats', '1',
                             '--json', 'growth.json', '--out', 'growth', '--resume']);
  assert.equal(again.code, 0, again.err);
  assert.deepEqual(JSON.parse(before).scaling, written('growth.json').scaling);
  // Sizes and lines that lack are measured, and those that are there are left as they are.
  const half = JSON.parse(before);
  half.finished = false;
  half.scaling = half.scaling.filter(({ axis }) => axis !== 'lights');
  const [cut] = half.scaling;
  cut.points = cut.points.slice(0, 2);
  for (const fitted of ['exponent', 'break']) delete cut[fitted];
  write('growth.json', half);
  const onward = shadowproof(['bench', 'near_plane', '--scaling', '--quick', '--size', '32x32', '-q', '--technique',
    'zfail,cube_map_six_pass', '--repeats', '1', '--json', 'growth.json', '--out', 'growth', '--resume', '--csv', 'growth.csv']);
  assert.equal(onward.code, 0, onward.err);
  const whole = written('growth.json').scaling;
  const key = ({ axis, technique }) => `${axis} ${technique}`;
  assert.deepEqual(whole.map(key), scaling.map(key));
  whole.forEach((growth, i) => {
    const isMeasured = i === 0 || growth.axis === 'lights';
    if (!isMeasured) assert.deepEqual(growth, scaling[i]);
    if (i === 0) assert.deepEqual(growth.points.slice(0, 2), scaling[i].points.slice(0, 2));
    // On a slow moment a line ends early, and says so: what both have is of the same sizes.
    const sizes = [growth, scaling[i]].map((line) => line.points.map(({ size }) => size));
    const both = Math.min(...sizes.map((each) => each.length));
    assert.ok(both > 0);
    assert.deepEqual(sizes[0].slice(0, both), sizes[1].slice(0, both));
  });
  assert.deepEqual(whole.map(({ family }) => family), whole.map(({ technique }) =>
    ({ truth: 'truth', zfail: 'stencil', cube_map_six_pass: 'map' })[technique]));
  const lines = readFileSync(join(scratch, 'growth.csv'), 'utf8').trim().split('\r\n');
  assert.equal(lines.length, 1 + whole.reduce((sum, { points: sizes }) => sum + sizes.length, 0));
});

test('growth that is interrupted keeps the sizes that it has', async () => {
  const args = ['bench', 'near_plane', '--scaling', '--size', '32x32', '-q', '--technique', 'zfail', '--repeats', '1',
                '--json', 'grows.json', '--out', 'grows'];
  await interrupted(args, () => existsSync(join(scratch, 'grows.json')));
  const part = written('grows.json');
  assertValid(part);
  assert.equal(part.finished, false);
  assert.ok(part.scaling.length > 0);
});
