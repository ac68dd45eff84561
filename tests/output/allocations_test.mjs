// The commands where memory runs out: exit code 3 and a sentence, or 0 and everything whole.
// SHADOWPROOF_TRIES=N lets N allocations of each command fail in turn, spread over all.
import assert from 'node:assert/strict';
import { mkdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { grayPng } from '../command/png.mjs';
import { contentOf, run, scratch } from './faults.mjs';

const program = process.env.SHADOWPROOF;
const height = join(scratch, 'height.png');
writeFileSync(height, grayPng(8, 8, (x, y) => ((x * x + 7 * y) * 257) % 65536));
const commands = {
  'normal-map': [program, 'normal-map', height, '-q', '-o', 'out.png'],
  render: [program, 'render', 'near_plane', '--size', '16x16', '--threads', '1', '-q', '-o', 'out.png'],
  merge: [program, 'merge', '../shard', '--out', 'report', '-q'],
  verify: [program, 'verify', 'near_plane', '--size', '16x16', '--technique', 'zpass', '--threads', '1',
           '--out', 'report', '-q'],
};
/** Of each command and kind: so many allocations fail, evenly spread over all that it makes. */
const tries = { 'normal-map': 40, render: 30, merge: 40, verify: 20 };

const counter = join(scratch, 'allocations');
/** Settings of allocation_faults.cpp; `at`: the allocation that fails. */
function allocations(kind, at) {
  writeFileSync(counter, Buffer.alloc(16));
  return { LD_PRELOAD: process.env.ALLOCATION_FAULTS, ALLOCATION_KIND: kind,
           ALLOCATION_COUNTER: counter, ...(at && { ALLOCATION_AT: String(at) }) };
}
const counted = () => Number(readFileSync(counter).readBigUInt64LE(0));
const hasFailed = () => readFileSync(counter).readBigUInt64LE(8) === 1n;

assert.equal(run([...commands.verify.slice(0, -3), '--out', 'shard']).code, 0);

for (const [name, command] of Object.entries(commands))
  for (const kind of ['new', 'malloc'])
    test(`${name}: where an allocation of ${kind} fails, nothing is cut, and a sentence says so`, () => {
      const below = join(scratch, `${name}-${kind}`);
      mkdirSync(below);
      const whole = run(command, { cwd: below, env: allocations(kind) });
      assert.equal(whole.code, 0, whole.err);
      const count = counted();
      assert.ok(count > 100, `${count} allocations: the shim counts nothing`);
      const picture = contentOf(below)['out.png'];
      /** Nothing, the whole picture, or a report with all files that it lists, and no others. */
      const isWhole = (all) => {
        const names = Object.keys(all);
        if (names.length === 0) return true;
        if (picture !== undefined) return names.join() === 'out.png' && all['out.png'] === picture;
        const manifest = JSON.parse(all['report/manifest.json'] ?? '{"files":[]}');
        const listed = manifest.files.map((file) => `report/${file.name}`);
        return !names.includes('report.writing') && listed.includes('report/index.html') &&
          listed.sort().join() === names.filter((file) => all[file] !== 'folder' &&
            file !== 'report/manifest.json').sort().join() &&
          manifest.files.every((file) => all[`report/${file.name}`].length === file.size);
      };
      const faults = [];
      let failed = 0;
      const times = Number(process.env.SHADOWPROOF_TRIES ?? tries[name]);
      for (let i = 0; i < times; ++i) {
        const at = 1 + Math.floor((count - 1) * i / (times - 1));
        rmSync(below, { recursive: true });
        mkdirSync(below);
        const done = run(command, { cwd: below, env: allocations(kind, at) });
        failed += hasFailed() ? 1 : 0;
        const all = contentOf(below);
        // Some libraries can do without, and a cell that could not run is said in a whole report.
        const said = done.code === 0 ? Object.keys(all).length > 0
                                     : done.code === 3 && /\w/.test(done.err + done.out);
        if (!said || !isWhole(all))
          faults.push(`allocation ${at} of ${count}: ${done.code ?? done.signal} ${done.err.slice(0, 300)} ` +
                      `[${Object.keys(all).join(' ')}]`);
      }
      assert.deepEqual(faults, []);
      // The last may not be reached: what threads allocate is not the same each time.
      assert.ok(failed > 0.9 * times, `${failed} of ${times} allocations failed`);
    });
