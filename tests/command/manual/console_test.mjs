// What the console says by default, with -v, and at the end of a long run.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { existsSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { scratch, shadowproof } from '../shadowproof.mjs';

const small = ['--size', '64x64'];

test('what was left out is said with -v alone, and stands in the results', () => {
  const args = ['verify', 'ordinary', '--technique', 'zfail', ...small];
  const usual = shadowproof(args);
  assert.equal(usual.code, 0, usual.err);
  assert.doesNotMatch(usual.out, /left out/);
  const [{ left_out }] = JSON.parse(readFileSync(join(scratch, 'report/results.json'), 'utf8')).scenes;
  assert.ok(left_out.length > 0);
  const verbose = shadowproof([...args, '-v']).out;
  for (const clause of left_out) assert.ok(verbose.includes(`\n  left out: ${clause}\n`), clause);
  const both = shadowproof([...args, '-v', '-q']);
  assert.equal(both.code, 2);
});

/** Cause, verdict and wrong pixels of the lines of cells. */
const cellsOf = (lines) => lines
  .map((line) => line.match(/^ *(\S+) +(\S+) +(agrees|fails_as_predicted|defect|unexplained) +([\d,]+) of \S+(.*)/))
  .filter(Boolean)
  .map(([, technique, scene, verdict, differing, rest]) => {
    const number = (words) => Number(words.replaceAll(',', ''));
    const edge = rest.match(/edge ([\d,]+)/);
    return { technique, scene, verdict, wrong: number(differing) - (edge ? number(edge[1]) : 0) };
  });

test('a long run ends with its worst cells: first what fails, then the most wrong pixels', () => {
  const run = shadowproof(['verify', 'near_plane', 'ordinary', ...small, '--gate', 'differences', '--allow',
                           'cap', '--out', 'long']);
  assert.equal(run.code, 1, run.err);
  const [all, end] = run.out.split('worst cells first:\n');
  const judged = cellsOf(all.split('\n'));
  assert.ok(judged.length > 20);
  const worst = cellsOf(end.split('\n'));
  assert.equal(worst.length, 5);
  const failing = judged.filter(({ technique, scene }) =>
    end.match(new RegExp(`^reproduce: .* ${scene} --technique ${technique} `, 'm')));
  assert.ok(failing.length > 0 && failing.length < judged.length);
  const byWrong = (cells) => cells.filter(({ wrong }) => wrong > 0).sort((a, b) => b.wrong - a.wrong);
  const others = judged.filter((cell) => !failing.includes(cell));
  assert.deepEqual(worst, [...byWrong(failing), ...byWrong(others)].slice(0, 5));
  assert.ok(existsSync(join(scratch, 'long/index.html')));
});

test('a short run, a single scene and a quiet run have no list of worst cells', () => {
  for (const args of [['near_plane', 'ordinary', '--technique', 'zpass,zfail'], ['near_plane'],
                      ['near_plane', 'ordinary', '-q']])
    assert.doesNotMatch(shadowproof(['verify', ...args, ...small]).out, /worst cells/);
});

/** What a terminal gets, a line of progress each. */
function onTerminal(...words) {
  const command = [process.env.SHADOWPROOF, ...words].map((word) => `'${word}'`).join(' ');
  const run = spawnSync('script', ['-qec', command, '/dev/null'],
                        { cwd: scratch, encoding: 'utf8', env: { ...process.env, TERM: 'xterm' } });
  assert.equal(run.status, 0, run.stdout);
  return run.stdout.split(/[\r\n]+/).map((line) => line.replaceAll('\x1b[K', ''));
}

const hasTerminals = spawnSync('script', ['-qec', 'true', '/dev/null']).status === 0;

test('on a terminal each step says which of how many scenes or pictures it is about', {
  skip: !hasTerminals && 'no pseudo terminal is to be had here',
}, () => {
  const says = (lines, wanted) => assert.ok(lines.some((line) => wanted.test(line)), lines.join('\n'));
  const verified = onTerminal('verify', 'ordinary', 'sun', '--technique', 'zfail', ...small);
  says(verified, /^scene 1 of 2: ordinary: tracing$/);
  says(verified, /^scene 2 of 2, about \d+ s left: sun: tracing$/);
  for (const name of ['a.png', 'b.png'])
    assert.equal(shadowproof(['render', 'ordinary', ...small, '-o', name, '-q']).code, 0);
  const checked = onTerminal('check', 'ordinary', 'a.png', 'b.png', ...small);
  says(checked, /^picture 1 of 2: a: judging$/);
  says(checked, /^picture 2 of 2: b: judging$/);
  says(checked, /^writing report$/);
});
