// What theory says of the order of times, measured: the one test that does. It holds no time, and takes
// two techniques for ordered only where their intervals are apart.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { shadowproof } from '../shadowproof.mjs';
import { written } from './runs.mjs';

const volumes = ['zpass', 'zfail', 'zfail_clamp', 'zfail_infinite', 'zfail_reversed', 'zpass_eye_count', 'zp_plus',
  'zfail_no_dark_cap', 'auto'];
const scenes = ['near_plane', 'idle_casters', 'eye_inside'];

function measured(json) {
  const run = shadowproof(['bench', ...scenes, '--technique', volumes.join(','), '--quick', '--size', '256x256',
    '--repeats', '40', '--no-pictures', '-q', '--json', json]);
  assert.equal(run.code, 0, run.out + run.err);
  return written(json).points.filter(({ technique, settings }) =>
    technique !== 'truth' && Object.keys(settings).length === 0);
}

const wrong = ({ causes }) => Object.entries(causes).reduce((sum, [cause, n]) => sum + (cause === 'edge' ? 0 : n), 0);
const isSlower = (a, b) => a.ms.interval && b.ms.interval && a.ms.low > b.ms.high;

const first = measured('first.json');

test('auto is right, and not slower than the quickest technique that is right, beyond both intervals', () => {
  for (const scene of scenes) {
    const points = first.filter((point) => point.scene === scene);
    const auto = points.find(({ technique }) => technique === 'auto');
    assert.equal(wrong(auto), 0, scene);
    for (const other of points)
      if (other !== auto && wrong(other) === 0)
        assert.ok(!isSlower(auto, other), `${scene}: ${other.technique} ${JSON.stringify(other.ms)}, auto ${JSON.stringify(auto.ms)}`);
  }
});

test('a second run orders no two points the other way that are further apart than their intervals', () => {
  const again = measured('again.json');
  assert.equal(again.length, first.length);
  let ordered = 0;
  for (const [i, a] of first.entries())
    for (const [j, b] of first.entries())
      if (a.scene === b.scene && isSlower(a, b)) {
        ++ordered;
        assert.ok(!isSlower(again[j], again[i]), `${a.scene}: ${a.technique} and ${b.technique}`);
      }
  assert.ok(ordered > 0);
});
