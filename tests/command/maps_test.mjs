// Shadow maps at their usual size: how many answers the judge leaves open.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { scratch, shadowproof } from './shadowproof.mjs';

const maps = ['cube_map_six_pass', 'cube_map_geometry_shader', 'cube_map_pcf', 'spot_map', 'spot_map_pcf',
  'spot_map_stencil', 'spot_map_dual_texture', 'sun_map'];

test('fewer than 2 % of a picture\'s lookups may fall on either of two texels, on every bundled scene', () => {
  const { code, out, err } = shadowproof(['verify', '--technique', maps.join(','), '--size', '512x512',
    '--json', 'maps.json', '--out', 'maps']);
  assert.equal(code, 0, out + err);
  const tried = new Set();
  for (const { name, techniques } of JSON.parse(readFileSync(join(scratch, 'maps.json'))).scenes)
    for (const { name: technique, map } of techniques) {
      tried.add(technique);
      assert.equal(map.size, 1024);
      assert.equal(map.texels_unexplained, 0, `${name}/${technique}`);
      assert.ok(map.straddling < 0.02 * 512 * 512, `${name}/${technique}: ${map.straddling}`);
    }
  assert.deepEqual([...tried].sort(), [...maps].sort());
});
