// Somebody else's glTF: every asset of Debian's assimp-testmodels, sound and malformed, verifies
// or is refused with one sentence. Never a signal, never a hang.
import assert from 'node:assert/strict';
import { existsSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { filesBelow, shadowproof } from './shadowproof.mjs';

const folders = ['/usr/share/assimp/models/glTF2', '/usr/share/assimp/models/glTF'];

for (const folder of folders) {
  test(`the package assimp-testmodels is installed: ${folder}`, () => assert.ok(existsSync(folder)));
  const assets = existsSync(folder)
    ? filesBelow(folder).filter((file) => /\.(gltf|glb)$/.test(file)) : [];
  for (const asset of assets)
    test(`${asset} verifies, or is refused with one sentence`, () => {
      const run = shadowproof(['verify', join(folder, asset), '--size', '96x96', '-q',
                                 '--technique', 'zpass_capped,zfail_half_edge,zfail_geometry_shader,auto'],
                              { seconds: 300 });
      assert.equal(run.signal, null, `ended by ${run.signal}`);
      assert.ok([0, 1, 3].includes(run.code), `exit code ${run.code}`);
      if (run.code !== 3) return;
      const sentences = run.err.trim().split('\n');
      assert.equal(sentences.length, 1, run.err);
      assert.match(sentences[0], /^shadowproof: .*(: .+; .+|not enough memory)/);
    });
}
