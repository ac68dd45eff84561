// Time and memory of merge, for more and more cells: each run is one of all bundled scenes, small.
//   SHADOWPROOF=build/release/shadowproof node tests/bench/merge_bench.mjs [RUNS...]
import { spawnSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, statSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { copyReport } from '../command/copied_report.mjs';

const program = process.env.SHADOWPROOF ?? 'build/release/shadowproof';
const counts = process.argv.length > 2 ? process.argv.slice(2).map(Number) : [1, 2, 4, 7];
const scratch = mkdtempSync(join(tmpdir(), 'shadowproof-merge-'));
const one = join(scratch, 'one');
spawnSync(program, ['verify', '--size', '64x64', '--out', one, '-q'], { stdio: 'ignore' });
const { scenes } = JSON.parse(readFileSync(join(one, 'results.json')));
const cells = scenes.reduce((sum, { techniques }) => sum + techniques.length, 0);
const runs = [];
for (const count of counts) {
  while (runs.length < count) {
    runs.push(join(scratch, `run${runs.length}`));
    copyReport(one, runs.at(-1), `r${runs.length}-`);
  }
  const out = join(scratch, 'joined');
  const file = join(scratch, 'peak');
  const { status } = spawnSync('/usr/bin/time', ['-f', '%M %e', '-o', file, program, 'merge',
                               ...runs.slice(0, count), '--out', out, '-q'], { stdio: 'ignore' });
  if (status !== 0) throw new Error(`merge ended with ${status}`);
  const [peak, seconds] = readFileSync(file, 'utf8').trim().split('\n').at(-1).split(' ').map(Number);
  const size = statSync(join(out, 'results.json')).size;
  console.log(`${count * cells} cells: ${seconds} s, peak ${(peak / 1024).toFixed(0)} MiB, `
              + `results.json ${(size / 1e6).toFixed(1)} MB`);
}
rmSync(scratch, { recursive: true });
