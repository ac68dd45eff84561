// POV-Ray, by the script that stands in the docs: a tracer that shares nothing with this program agrees
// with its truth at every pixel, in pairs of pictures and in pictures alone.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { scratch, shadowproof } from '../shadowproof.mjs';

const script = fileURLToPath(new URL('../../../docs/recipes/povray.mjs', import.meta.url));
const env = { MODULES: fileURLToPath(new URL('../..', import.meta.url)) };

function checked(args) {
  const run = shadowproof(['check', ...args, '--out', 'checked'], { env });
  assert.ok(run.code <= 1, run.out + run.err);
  const { scenes: [{ techniques: [cell] }] } =
    JSON.parse(readFileSync(join(scratch, 'checked/results.json'), 'utf8'));
  return { ...run, cell };
}

for (const scene of ['ordinary', 'sun', 'spot', 'near_plane', 'eye_inside', 'nested', 'open_lid', 'in_metres'])
  test(`POV-Ray agrees on ${scene}`, () => {
    for (const twin of ['{unlit}', '']) {
      const { cell, out } = checked([scene, '--name', 'povray', '--renderer',
                                     `${process.execPath} '${script}' {scene} {view} {out} ${twin}`]);
      assert.equal(cell.differing, 0, out);
      assert.ok(cell.undecidable < 0.01 * cell.pixels, out);
    }
  });

for (const scene of ['ordinary', 'sun', 'spot', 'nested'])
  test(`POV-Ray agrees on ${scene}, seen by an orthographic camera`, () => {
    const { cell, out } = checked([scene, '--ortho', '8', '--name', 'povray', '--renderer',
                                   `${process.execPath} '${script}' {scene} {view} {out} {unlit}`]);
    assert.equal(cell.differing, 0, out);
    assert.ok(cell.undecidable < 0.01 * cell.pixels, out);
  });

test('where its light is moved by a hundredth of the way, that is told', () => {
  const view = JSON.parse(shadowproof(['export-view', 'ordinary']).out);
  const by = [0.1, 0, 0.02];
  view.light.position = view.light.position.map((x, k) => x + by[k]);
  writeFileSync(join(scratch, 'moved.json'), JSON.stringify(view));
  const scene = join(process.env.SHADOWPROOF_SCENES, 'ordinary.gltf');
  const run = spawnSync(process.execPath, [script, scene, 'moved.json', 'moved.png', 'off.png'],
                        { cwd: scratch, env: { ...process.env, ...env }, encoding: 'utf8' });
  assert.equal(run.status, 0, run.stderr);
  const { cell: { diagnosis: [best] } } = checked(['ordinary', 'moved.png', '--unlit', 'off.png']);
  assert.equal(best.hypothesis, 'light_moved');
  for (const [k, axis] of ['x', 'y', 'z'].entries())
    assert.ok(Math.abs(best.parameters[axis] - by[k]) < 0.05, JSON.stringify(best.parameters));
});
