// Somebody else's glTF: every asset of Debian's assimp-testmodels, sound and malformed, and of npm's
// @webxr-input-profiles/assets, which are sound, verifies or is refused with one sentence. Never a signal, never a hang.
import assert from 'node:assert/strict';
import { existsSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { filesBelow, shadowproof } from './shadowproof.mjs';

const controllers = fileURLToPath(
  new URL('../node_modules/@webxr-input-profiles/assets/dist/profiles', import.meta.url));
const folders = ['/usr/share/assimp/models/glTF2', '/usr/share/assimp/models/glTF', controllers];

for (const folder of folders) {
  test(`the package of test assets is installed: ${folder}`, () => assert.ok(existsSync(folder)));
  const assets = existsSync(folder)
    ? filesBelow(folder).filter((file) => /\.(gltf|glb)$/.test(file)) : [];
  for (const asset of assets)
    test(`${asset} verifies, or is refused with one sentence`, () => {
      const run = shadowproof(['verify', join(folder, asset), '--size', '96x96', '-q',
                                 '--technique', 'zpass_capped,zfail_half_edge,zfail_geometry_shader,auto'],
                              { seconds: 300 });
      assert.equal(run.signal, null, `ended by ${run.signal}`);
      assert.ok([0, 1, 3].includes(run.code), `exit code ${run.code}`);
      if (folder === controllers) assert.equal(run.code, 0, run.err);
      if (run.code !== 3) return;
      const sentences = run.err.trim().split('\n');
      assert.equal(sentences.length, 1, run.err);
      assert.match(sentences[0], /^shadowproof: .*(: .+; .+|not enough memory)/);
    });
}
