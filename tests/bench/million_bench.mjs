// Verifies a caster of a million triangles at 1920x1080 with every technique, and says what memory
// and time that takes. Fails where it takes more than 2 GB or a cell does not pass.
//   SHADOWPROOF=build/release/shadowproof node tests/bench/million_bench.mjs [TECHNIQUE,...]
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { bumpyBall, glb, measured } from './big_scenes.mjs';

const floor = { positions: Float32Array.from([-4, -0.6, -4, -4, -0.6, 4, 4, -0.6, 4, 4, -0.6, -4]),
                indices: Uint32Array.from([0, 1, 2, 0, 2, 3]) };

const folder = mkdtempSync(join(tmpdir(), 'shadowproof-million-'));
const scene = join(folder, 'million.glb');
writeFileSync(scene, glb({ ball: bumpyBall(708, 708), floor },
                         { eye: [0, 1.5, 5], tilt: 0.15, yfov: 0.8, light: [2.5, 4, 1.5] }));
const techniques = process.argv[2] ? ['--technique', process.argv[2]] : [];
const run = measured(['verify', scene, '--size', '1920x1080', '--out', join(folder, 'report'),
                      ...techniques]);
rmSync(folder, { recursive: true });
console.log(`${run.out}peak ${(run.peak / 1e9).toFixed(2)} GB resident, ` +
            `${run.seconds.toFixed(1)} s, exit ${run.code}`);
process.exitCode = run.code !== 0 || run.peak > 2e9 ? 1 : 0;
