// How truth grows with triangles and pixels, to ten million of both: seconds of tracing, beside the
// build of its trees, and the whole command's memory. Then `verify` of the largest, with a shadow
// volume and a cube map. Fails where the truth takes more than 8 GB, or `verify` more than 16 GB or
// does not pass.
//   SHADOWPROOF=build/release/shadowproof node tests/bench/large_bench.mjs
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { bumpyBall, glb, hills, measured } from './big_scenes.mjs';

const folder = mkdtempSync(join(tmpdir(), 'shadowproof-large-'));
const largest = 10_000_000;
const sizes = ['960x540', '1920x1080', '3840x2160'];

/** Hills with two hundredths of their triangles in each of 20 balls over them. */
function write(triangles) {
  const side = Math.round(Math.sqrt(0.6 * triangles / 2));
  const rings = Math.round(Math.sqrt(0.02 * triangles / 2));
  const meshes = { land: hills(side) };
  for (let i = 0; i < 20; ++i)
    meshes[`ball ${i}`] = bumpyBall(rings, rings, { centre: [3.6 * (i % 5) - 7.2, 1.5 + 0.1 * i,
                                                             4 * Math.floor(i / 5) - 7],
                                                    radius: 0.3 + 0.02 * i });
  const file = join(folder, 'large.glb');
  writeFileSync(file, glb(meshes, { eye: [0, 5, 11], tilt: Math.sin(0.25), yfov: 0.9,
                                    light: [3, 7, 2] }));
  return file;
}

/** The quickest of three. */
function truth(file, size) {
  const runs = [1, 2, 3].map(() => measured(['render', file, '--size', size, '-o',
                                             join(folder, 'truth.png')]));
  return { ms: Math.min(...runs.map(({ out }) => Number(/([\d.]+) ms$/m.exec(out)[1]))),
           peak: Math.max(...runs.map(({ peak }) => peak)) };
}

let failed = false;
const check = (holds) => { failed ||= !holds; };
console.log(`| triangles | ${sizes.map((size) => `${size}, ms`).join(' | ')} | memory at most |`);
console.log(`|---|${'---|'.repeat(sizes.length + 1)}`);
for (let triangles = 10_000; triangles <= largest; triangles *= 10) {
  const file = write(triangles);
  const results = sizes.map((size) => truth(file, size));
  const peak = Math.max(...results.map((result) => result.peak));
  check(peak <= 8e9);
  console.log(`| ${triangles.toLocaleString('en')} | ` +
              `${results.map(({ ms }) => ms.toFixed(0)).join(' | ')} | ` +
              `${(peak / 1e9).toFixed(2)} GB |`);
}
const run = measured(['verify', join(folder, 'large.glb'), '--size', sizes.at(-1), '--technique',
                      'zfail_reversed,cube_map_six_pass', '--out', join(folder, 'report')]);
rmSync(folder, { recursive: true });
check(run.code === 0 && run.peak <= 16e9);
console.log(`${run.out}verify: peak ${(run.peak / 1e9).toFixed(2)} GB, ${run.seconds.toFixed(0)} s, ` +
            `exit ${run.code}`);
process.exitCode = failed ? 1 : 0;
