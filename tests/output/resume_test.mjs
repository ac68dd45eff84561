// verify killed at any of its file operations, as when the power goes: the next run goes on, and
// the report is that of a run that was never cut off.
import assert from 'node:assert/strict';
import { mkdirSync, readdirSync, rmSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { changes, contentOf, faults, killed, operationsOf, run, scratch } from './faults.mjs';

const command = (...args) => [process.env.SHADOWPROOF, 'verify', 'near_plane', 'sun', '--technique',
                              'zpass,zfail', '--size', '16x16', '--out', 'report', '-q', ...args];

/** All files of a report, without times: those that hold some, and the hashes of these. */
function timeless(report) {
  const { 'results.json': text, 'results.js': script, 'manifest.json': manifest, ...rest } = contentOf(report);
  assert.ok(script && manifest);
  const results = JSON.parse(text);
  const drop = (value) => {
    if (typeof value !== 'object' || value === null) return;
    for (const key of Object.keys(value))
      if (/(^|_)ms$/.test(key)) delete value[key];
      else drop(value[key]);
  };
  drop(results);
  return { ...rest, results };
}

/** A folder of its own, perhaps with an older report that has a file of the user's. */
function place(name, older) {
  const below = join(scratch, name);
  mkdirSync(below);
  if (!older) return below;
  assert.equal(run([process.env.SHADOWPROOF, 'verify', 'spot', '--technique', 'zpass', '--size', '16x16', '-q'],
                   { cwd: below }).code, 0);
  writeFileSync(join(below, 'report/notes.txt'), 'mine');
  return below;
}

for (const older of [false, true]) {
  test(`killed at any file operation ${older ? 'beside an older report ' : ''}it goes on`, () => {
    const whole = place(`whole-${older}`, older);
    assert.equal(run(command(), { cwd: whole }).code, 0);
    const expected = timeless(join(whole, 'report'));
    const below = place(`cut-${older}`, older);
    const count = operationsOf(command(), below, { cwd: below, ...changes });
    let gone = 0;
    // Every second one, and fewer beside an older report: each takes a second.
    for (let at = 1; at <= count; at += older ? 4 : 2) {
      rmSync(below, { recursive: true });
      place(`cut-${older}`, older);
      const cut = run(command(), { cwd: below, env: faults(below, { at, ...killed }) });
      assert.equal(cut.signal, 'SIGKILL', `operation ${at}`);
      const next = run(command('--resume').filter((word) => word !== '-q'), { cwd: below });
      assert.equal(next.code, 0, `operation ${at}: ${next.err}`);
      if (/goes on with the run that was cut off/.test(next.out)) ++gone;
      assert.deepEqual(timeless(join(below, 'report')), expected, `operation ${at}`);
      assert.deepEqual(readdirSync(below), ['report'], `operation ${at}`);
    }
    assert.ok(gone > (older ? count / 8 : count / 4), `${gone} of ${count} went on`);
  });
}

test('killed again and again, a run after a run, it comes to its end', () => {
  const whole = place('again-whole', false);
  const count = operationsOf(command(), whole, { cwd: whole, ...changes });
  const below = place('again', false);
  let code = null;
  let runs = 0;
  for (; code !== 0; ++runs) {
    assert.ok(runs < 40, 'what is left takes no more than all of it');
    const at = 40 + Math.ceil((runs * count) / 20); // each a little later
    const cut = run(command('--resume'), { cwd: below, env: faults(below, { at, ...killed }) });
    ({ code } = cut);
    assert.ok(code === 0 || cut.signal === 'SIGKILL', cut.err);
  }
  assert.ok(runs > 3, `${runs} runs`);
  assert.deepEqual(timeless(join(below, 'report')), timeless(join(whole, 'report')));
});
