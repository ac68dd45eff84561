// docs/recipes/slurm.sh on a real cluster: an array job and the job that joins its reports write
// what one run would have written, also where a node fails in the middle.
import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { setTimeout as pause } from 'node:timers/promises';
import { fileURLToPath } from 'node:url';
import { assertSameReport, scratch, shadowproof } from '../shadowproof.mjs';
import { startCluster } from './cluster.mjs';

const script = fileURLToPath(new URL('../../../docs/recipes/slurm.sh', import.meta.url));
const words = ['near_plane', 'many_lights', 'nested', 'open_lid', 'bumpy_sphere', 'sun', '--size', '96x96'];
let folder;
let cluster;
before(async () => {
  folder = mkdtempSync(join(tmpdir(), 'slurm-'));
  cluster = await startCluster(folder);
});
after(async () => {
  await cluster?.stop();
  rmSync(folder, { recursive: true });
});

/** Starts the script; returns what it says in the end, and how it ends. */
function submit(parts, report, args) {
  const child = spawn(script, [String(parts), report, ...args],
                      { cwd: scratch, env: cluster.env, stdio: ['ignore', 'pipe', 'pipe'] });
  let out = '';
  for (const stream of [child.stdout, child.stderr]) stream.on('data', (text) => { out += text; });
  return new Promise((resolve) => child.on('close', (code) => resolve({ code, out })));
}

const said = (report, part) => {
  const file = join(scratch, `${report}.parts`, `${part}.txt`);
  return existsSync(file) ? readFileSync(file, 'utf8') : '';
};

test('an array job and the merge behind it are one run', { timeout: 300_000 }, async () => {
  assert.equal(shadowproof(['verify', ...words, '--out', 'whole', '-q']).code, 0);
  const { code, out } = await submit(4, 'report', words);
  assert.equal(code, 0, out + cluster.log());
  assert.match(out, /^passed: \d+ cells; report in report\/index\.html$/m);
  assertSameReport('report', 'whole');
});

test('the gate of the whole is the exit code of the script', { timeout: 300_000 }, async () => {
  const few = ['near_plane', 'open_lid', '--technique', 'zpass,zfail', '--size', '64x64', '--gate', 'differences'];
  assert.equal(shadowproof(['verify', ...few, '--out', 'strict', '-q']).code, 1);
  const { code, out } = await submit(2, 'strict-report', few);
  assert.equal(code, 1, out + cluster.log());
  assertSameReport('strict-report', 'strict');
  assert.equal((await submit('none', 'x', [])).code, 2);
});

test('a node that is killed loses nothing but its cells, and another goes on', { timeout: 300_000 }, async () => {
  const ended = submit(4, 'lost', words);
  // Killed as soon as a part there has written some cells, and has others to write.
  let victim;
  for (let i = 0; victim === undefined && i < 1000; ++i) {
    await pause(50);
    const { stdout } = await cluster.run('squeue', '--array', '--noheader', '--states=RUNNING', '--nodelist=node1', '--format=%K');
    victim = stdout.split('\n').map(Number)
      .find((part) => part > 0 && said('lost', part).split('\n').length > 5);
  }
  await cluster.killNode('node1');
  const before = said('lost', victim);
  assert.doesNotMatch(before, /passed|goes on with/, 'the part was killed before its end');
  assert.ok(existsSync(join(scratch, `lost.parts/${victim}.writing/progress`)));
  await cluster.startNode('node1');
  const { code, out } = await ended;
  assert.equal(code, 0, out + cluster.log());
  assert.match(said('lost', victim), /^note: lost\.parts\/\d: goes on with the run that was cut off$/m);
  assertSameReport('lost', 'whole');
});
