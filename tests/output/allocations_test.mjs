// The commands where memory runs out: exit code 3 and one sentence with a remedy, or a report that says
// which cell could not run, or 0 and everything whole; the old report or picture, or the new one. At a few
// places Mesa, TBB and GLib wait for ever: then the command gives up by --timeout.
// Failing are, in turn, places in the code that allocate, each when it does so for the first time,
// and allocations spread over the whole run. SHADOWPROOF_TRIES=N tries N of either, and
// SHADOWPROOF_TRIES=places every place: 20 minutes.
import assert from 'node:assert/strict';
import { cpSync, mkdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { isDeepStrictEqual } from 'node:util';
import { grayPng } from '../command/png.mjs';
import { contentOf, run, scratch } from './faults.mjs';

const program = process.env.SHADOWPROOF;
const height = join(scratch, 'height.png');
writeFileSync(height, grayPng(8, 8, (x, y) => ((x * x + 7 * y) * 257) % 65536));
const commands = {
  'normal-map': [program, 'normal-map', height, '--timeout', '20', '-q', '-o', 'out.png'],
  render: [program, 'render', 'near_plane', '--size', '16x16', '--threads', '1', '--timeout', '20',
           '-q', '-o', 'out.png'],
  merge: [program, 'merge', '../shard', '--out', 'report', '-q'],
  verify: [program, 'verify', 'near_plane', '--size', '16x16', '--technique', 'zpass', '--threads', '1',
           '--timeout', '20', '--out', 'report', '-q'],
};
/** Of each command and kind: so many of them fail, evenly spread. */
const tries = { places: 40, allocations: 15 };

/** Stands already where a command writes: it is replaced by what is whole, or stays. */
const old = join(scratch, 'old');
mkdirSync(old);
writeFileSync(join(old, 'out.png'), 'old');
assert.equal(run([...commands.verify.map((word) => (word === 'zpass' ? 'zfail' : word))], { cwd: old }).code, 0);

const counter = join(scratch, 'allocations');
/** Settings of allocation_faults.cpp; `counts`: places or allocations; `at`: the one that fails. */
function allocations(kind, counts, at) {
  writeFileSync(counter, Buffer.alloc(16));
  return { LD_PRELOAD: process.env.ALLOCATION_FAULTS, ALLOCATION_KIND: kind,
           ALLOCATION_COUNTER: counter, ...(counts === 'allocations' && { ALLOCATION_EVERY: '1' }),
           ...(at && { ALLOCATION_AT: String(at) }) };
}
const counted = () => Number(readFileSync(counter).readBigUInt64LE(0));
const hasFailed = () => readFileSync(counter).readBigUInt64LE(8) === 1n;

assert.equal(run([...commands.verify.slice(0, -3), '--out', 'shard']).code, 0);

const resultsOf = (all) => JSON.parse(all['report/results.json']);

const cases = Object.keys(commands).flatMap((name) => ['new', 'malloc'].flatMap((kind) =>
  Object.keys(tries).map((counts) => ({ name, kind, counts }))));
for (const { name, kind, counts } of cases)
  test(`${name}: where one of its ${counts} of ${kind} fails, nothing is cut, and a sentence says so`, () => {
    const command = commands[name];
    const below = join(scratch, `${name}-${kind}`);
    const ours = command.at(command.indexOf('-q') + 1) === '-o' ? 'out.png' : 'report';
    const start = () => {
      rmSync(below, { recursive: true, force: true });
      mkdirSync(below);
      cpSync(join(old, ours), join(below, ours), { recursive: true });
    };
    start();
    const before = contentOf(below);
    const isOld = (all) => isDeepStrictEqual(all, before);
    const whole = run(command, { cwd: below, env: allocations(kind, counts) });
    assert.equal(whole.code, 0, whole.err);
    const count = counted();
    assert.ok(count > 100, `${count} ${counts}: the shim counts nothing`);
    const picture = contentOf(below)['out.png'];
    /** The whole picture, or a report with all files that it lists, and no others; of this run. */
    const isNew = (all) => {
      const names = Object.keys(all);
      if (picture !== undefined) return names.join() === 'out.png' && all['out.png'] === picture;
      const manifest = JSON.parse(all['report/manifest.json'] ?? '{"files":[]}');
      const listed = manifest.files.map((file) => `report/${file.name}`);
      return !names.includes('report.writing') && listed.includes('report/index.html') &&
        listed.sort().join() === names.filter((file) => all[file] !== 'folder' &&
          file !== 'report/manifest.json').sort().join() &&
        manifest.files.every((file) => all[`report/${file.name}`].length === file.size) &&
        resultsOf(all).scenes.every((scene) => scene.error ||
          scene.techniques.every(({ name: technique }) => technique === 'zpass'));
    };
    /** What ends a run says what failed and what helps; a report says what could not run. */
    const isSaid = ({ code, err }, all) => {
      if (code === 0) return isNew(all);
      if (code === 1) return isNew(all) && /"timed_out"/.test(all['report/results.json']);
      const sentences = err.match(/^shadowproof: [^\n]*[^\n;]; [^\n]+$/gm) ?? [];
      const errors = isNew(all) && ours === 'report' &&
        resultsOf(all).scenes.flatMap((scene) => [scene, ...scene.techniques ?? []])
          .map((each) => each.error).filter(Boolean);
      return code === 3 && (sentences.length === 1 || (errors && errors.length > 0));
    };
    const faults = [];
    let failed = 0;
    const asked = process.env.SHADOWPROOF_TRIES ?? tries[counts];
    const times = asked !== 'places' ? Number(asked) : counts === 'places' ? count : tries[counts];
    for (let i = 0; i < times; ++i) {
      const at = 1 + Math.floor((count - 1) * i / (times - 1));
      start();
      const done = run(command, { cwd: below, env: allocations(kind, counts, at) });
      failed += hasFailed() ? 1 : 0;
      const all = contentOf(below);
      // Some libraries can do without.
      if (!isSaid(done, all) || !(isOld(all) || isNew(all)))
        faults.push(`${at} of ${count}: ${done.code ?? done.signal} ${done.err.slice(0, 300)} ` +
                    `[${Object.keys(all).join(' ')}]`);
    }
    assert.deepEqual(faults, []);
    // The last are not always reached: what threads allocate is not the same each time.
    assert.ok(failed > times / 2, `${failed} of ${times} ${counts} failed`);
  });
