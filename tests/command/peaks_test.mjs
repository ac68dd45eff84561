// The figures behind a refusal, against what runs really take: what a run took, less a tenth, is
// refused, and three times what it took beside the program itself is enough.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { readFileSync, statSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { evenPng, textured, triangle } from './hostile.mjs';
import { copyReport } from './copied_report.mjs';
import { scratch, shadowproof } from './shadowproof.mjs';

const program = 250e6; // program_bytes in scenes/memory_budget.h: the most that it takes by itself
const least = 58e6; // what it takes where it does next to nothing

function peakOf(args) {
  const file = join(scratch, 'peak');
  const run = spawnSync('/usr/bin/time', ['-f', '%M', '-o', file, process.env.SHADOWPROOF, ...args],
                        { cwd: scratch, encoding: 'utf8' });
  assert.ok([0, 1].includes(run.status), run.stderr);
  return 1024 * Number(readFileSync(file, 'utf8').trim().split('\n').at(-1));
}

/** Triangles without a byte in the file, side by side. */
function manyTriangles(count) {
  const gltf = triangle();
  const positions = new Float32Array(9 * count);
  for (let i = 0; i < count; ++i)
    positions.set([i % 1000, 0, i / 1000, i % 1000 + 1, 0, i / 1000, i % 1000, 1, i / 1000], 9 * i);
  writeFileSync(join(scratch, 'many.bin'), Buffer.from(positions.buffer));
  gltf.buffers = [{ byteLength: positions.byteLength, uri: 'many.bin' }];
  gltf.bufferViews[0].byteLength = positions.byteLength;
  Object.assign(gltf.accessors[0], { count: 3 * count, min: [0, 0, 0], max: [1000, 1, 1000] });
  return gltf;
}

writeFileSync(join(scratch, 'many.gltf'), JSON.stringify(manyTriangles(300_000)));
writeFileSync(join(scratch, 'texture.gltf'), JSON.stringify(textured(evenPng(3000, 3000))));
writeFileSync(join(scratch, 'heights.png'), evenPng(3000, 3000));
// What is wrong is diagnosed, which takes most.
const wrong = shadowproof(['render', 'ordinary', '-o', 'wrong.png', '--size', '2500x2500']);
assert.equal(wrong.code, 0, wrong.err);

const cases = [
  ['verify', 'ordinary', '--technique', 'zfail', '--size', '2000x2000'],
  ['verify', 'near_plane', '--technique', 'zpass,zfail_geometry_shader', '--size', '2000x2000'],
  ['verify', 'hammered_silver', '--technique', 'bump_reflective', '--size', '1500x1500'],
  ['explain', 'ordinary', '--pixel', '9,9', '--technique', 'zfail', '--size', '2000x2000'],
  ['render', 'ordinary', '-o', 'a.exr', '--size', '3000x3000'],
  ['render', 'bumpy_sphere', '-o', 'a.exr', '--size', '1000x1000'],
  ['render', 'ordinary', '-o', 'a.png', '--size', '6000x6000'],
  ['render', 'bumpy_sphere', '-o', 'a.png', '--aov', 'color', '--size', '3000x3000'],
  ['render', 'bumpy_sphere', '-o', 'a.png', '--aov', 'normal', '--size', '1000x1000'],
  ['verify', 'bumpy_lights', '--light', 'spot', '--technique', 'bump_tangent_space', '--size',
   '1500x1500'],
  ['render', 'bumpy_lights', '--light', 'spot', '-o', 'a.exr', '--size', '1000x1000'],
  ['render', 'bumpy_lights', '--light', 'spot', '-o', 'a.png', '--aov', 'color', '--size',
   '3000x3000'],
  ['verify', 'many.gltf', '--technique', 'zfail', '--size', '64x64'],
  ['verify', 'texture.gltf', '--technique', 'bump_tangent_space', '--size', '64x64'],
  ['normal-map', 'heights.png', '-o', 'n.png'],
  ['check', 'near_plane', 'wrong.png'],
  ['bench', 'near_plane', '--technique', 'zfail', '--size', '2000x2000', '--repeats', '1',
   '--no-pictures'],
  ['stress', 'near_plane', '--technique', 'zfail', '--parameter', 'aspect', '--size', '1000x1000',
   '--witness', '0', '--no-pictures'],
];
for (const args of cases)
  test(`what it takes is bounded from both sides: ${args.join(' ')}`, () => {
    const peak = peakOf(args);
    assert.ok(peak > 2 * least, `${peak}: too little to tell`);
    const less = shadowproof([...args, '--memory', String(Math.floor(peak * 0.98))]);
    assert.equal(less.code, 3, `took ${peak}: ${less.out}${less.err}`);
    assert.match(less.err, /needs .* of memory .*\(--memory\)/);
    const more = shadowproof([...args, '--memory', String(program + 3 * (peak - least))]);
    assert.ok([0, 1].includes(more.code), `took ${peak}: ${more.err}`);
  });

test('merge takes no more for many runs than for few', () => {
  const one = join(scratch, 'one');
  assert.equal(shadowproof(['verify', 'near_plane', 'bumpy_sphere', 'many_lights', '--size', '64x64',
                            '--out', one, '-q']).code, 0);
  const runs = Array.from({ length: 12 }, (_, i) => join(scratch, `run${i}`));
  runs.forEach((run, i) => copyReport(one, run, `r${i}-`));
  const few = peakOf(['merge', ...runs.slice(0, 1), '--out', 'joined', '-q']);
  const many = peakOf(['merge', ...runs, '--out', 'joined', '-q']);
  const { scenes } = JSON.parse(readFileSync(join(scratch, 'joined/results.json')));
  const cells = scenes.flatMap(({ techniques }) => techniques);
  assert.ok(cells.length > 1000, `${cells.length} cells`);
  // As values they take ten times as much.
  const { size } = statSync(join(scratch, 'joined/results.json'));
  assert.ok(size > 1.2e6, `${size} bytes of results`);
  assert.ok(many < few + 4e6, `${few} and ${many} bytes`);
});
