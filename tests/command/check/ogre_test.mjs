// OGRE, by the script that stands in the docs: its stencil shadow volumes are right but at edges, and
// where they are not, what is wrong with them is named.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { scratch, shadowproof } from '../shadowproof.mjs';

const script = fileURLToPath(new URL('../../../docs/recipes/ogre.py', import.meta.url));

function checked(scene, twin = '{unlit}', env = {}) {
  const run = shadowproof(['check', scene, '--name', 'ogre', '--out', 'checked', '--renderer',
    `xvfb-run -a /usr/bin/python3 '${script}' {scene} {view} {out} ${twin}`], { env });
  assert.ok(run.code <= 1, run.out + run.err);
  const { scenes: [{ techniques: [cell] }] } =
    JSON.parse(readFileSync(join(scratch, 'checked/results.json'), 'utf8'));
  return { ...run, cell, wrong: cell.falsely_lit + cell.falsely_shadowed };
}

for (const scene of ['ordinary', 'sun', 'overlapping', 'near_plane', 'far_plane', 'eye_inside', 'long_shadow',
                     'cube_edge'])
  test(`OGRE's volumes are right on ${scene}, but at edges`, () => {
    for (const twin of ['{unlit}', '']) {
      const { cell, wrong, out } = checked(scene, twin);
      assert.equal(wrong, 0, out);
      assert.ok(cell.differing < 10, out);
      assert.ok(cell.undecidable < 0.01 * cell.pixels, out);
    }
  });

test('its counter of eight bits wraps in 256 volumes', () => {
  const { cell: { diagnosis: [best] }, wrong, out } = checked('nested');
  assert.deepEqual([best?.hypothesis, best?.parameters.bits], ['stencil_bits', 8], out);
  assert.deepEqual([best.explained, best.contradicted], [wrong, 0]);
});

test('casters that are open cast with their fronts alone', () => {
  const { cell: { diagnosis: [best] }, out } = checked('open_lid');
  assert.deepEqual([best?.hypothesis, best?.parameters.front], ['one_sided_casters', 1], out);
});
