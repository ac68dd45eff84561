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
// A sanitizer makes a run some twenty times as long, and controllers are much like each other: some of
// them are tried often, the rest in the long run.
const sanitized = Boolean(process.env.SHADOWPROOF_SANITIZED);
const rest = Boolean(process.env.SHADOWPROOF_OTHER_ASSETS);
const often = sanitized ? 10 : 5;
const techniques = sanitized ? 'zfail_geometry_shader' : 'zpass_capped,zfail_half_edge,zfail_geometry_shader,auto';
const size = sanitized ? '32x32' : '96x96';
const folders = ['/usr/share/assimp/models/glTF2', '/usr/share/assimp/models/glTF', controllers];

for (const folder of folders) {
  test(`the package of test assets is installed: ${folder}`, () => assert.ok(existsSync(folder)));
  const assets = existsSync(folder)
    ? filesBelow(folder).filter((file) => /\.(gltf|glb)$/.test(file)) : [];
  const isOften = (i) => folder !== controllers || i % often === 0;
  for (const asset of assets.filter((_, i) => isOften(i) !== rest))
    test(`${asset} verifies, or is refused with one sentence`, () => {
      const run = shadowproof(['verify', join(folder, asset), '--size', size, '-q', '--technique', techniques],
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
