// How alike the shards of a run are: all of them in turn, over all bundled scenes.
//   SHADOWPROOF=build/release/shadowproof node tests/bench/shard_bench.mjs PARTS [ARGUMENTS OF verify]
// Prints the seconds of each, and how much longer the longest takes than their mean.
import { spawnSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

const [parts, ...words] = process.argv.slice(2);
if (!(Number(parts) > 0)) {
  console.error('usage: node tests/bench/shard_bench.mjs PARTS [ARGUMENTS OF verify]');
  process.exit(2);
}
const scratch = mkdtempSync(join(tmpdir(), 'shadowproof-shards-'));
const seconds = [];
let cells = 0;
for (let number = 1; number <= Number(parts); ++number) {
  const out = join(scratch, String(number));
  const started = process.hrtime.bigint();
  const run = spawnSync(process.env.SHADOWPROOF ?? 'build/release/shadowproof',
                        ['verify', ...words, '-q', '--shard', `${number}/${parts}`, '--out', out],
                        { encoding: 'utf8' });
  const taken = Number(process.hrtime.bigint() - started) / 1e9;
  const { scenes } = JSON.parse(readFileSync(join(out, 'results.json')));
  const here = scenes.reduce((sum, { techniques }) => sum + (techniques?.length ?? 0), 0);
  console.log(`${number}/${parts}: ${taken.toFixed(1)} s, ${here} cells, exit code ${run.status}`);
  seconds.push(taken);
  cells += here;
}
rmSync(scratch, { recursive: true });
const mean = seconds.reduce((sum, each) => sum + each) / seconds.length;
console.log(`${cells} cells; mean ${mean.toFixed(1)} s, longest ${Math.max(...seconds).toFixed(1)} s: `
            + `${(Math.max(...seconds) / mean).toFixed(2)} times the mean`);
