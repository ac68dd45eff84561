// What would take more memory than may be had is refused, by name, before it is taken.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { attacks, evenPng, longText, writeAttack } from './hostile.mjs';
import { scratch, shadowproof } from './shadowproof.mjs';

/** The same with the most memory that it held, bytes. */
function measured(args, words = []) {
  const file = join(scratch, 'peak');
  const run = spawnSync('/usr/bin/time', ['-f', '%M', '-o', file, ...words,
                                          process.env.SHADOWPROOF, ...args],
                        { cwd: scratch, encoding: 'utf8', timeout: 300_000 });
  const lines = spawnSync('tail', ['-n', '1', file], { encoding: 'utf8' }).stdout;
  return { code: run.status, signal: run.signal, out: run.stdout, err: run.stderr,
           peak: 1024 * Number(lines) };
}

const small = ['--size', '16x16'];
const megabyte = 1e6;
// AddressSanitizer keeps what is freed, and shadows all of it.
const sanitized = Boolean(process.env.SHADOWPROOF_SANITIZED);

test('a flag that is no size is wrong usage, and the same everywhere', () => {
  for (const command of [['verify'], ['render', 'ordinary', '-o', 'a.png'], ['merge', 'a'],
                         ['explain', 'ordinary', '--pixel', '1,1'], ['report', '--from', 'a'],
                         ['normal-map', 'a.png', '-o', 'b.png']])
    for (const size of ['', 'lots', '-1', '0', '2XB', '1e99', 'nan', '1,5GB']) {
      const run = shadowproof([...command, '--memory', size]);
      assert.equal(run.code, 2, `${command} ${size}: ${run.err}`);
      assert.match(run.err, /--memory/);
    }
});

test('a picture that cannot fit is refused by its size, before its scene is read', () => {
  for (const command of [['verify', 'no.gltf'], ['render', 'no.gltf', '-o', 'a.exr'],
                         ['explain', 'no.gltf', '--pixel', '1,1']]) {
    const run = shadowproof([...command, '--size', '16384x16384', '--memory', '4GB']);
    assert.equal(run.code, 3);
    assert.match(run.err,
                 /^shadowproof: --size 16384x16384: needs [\d.]+ GB of memory for \d+ bytes a pixel.*the budget is 4\.0 GB \(--memory\); try a smaller picture/);
  }
});

test('without --memory the budget is what is left of a limit of address space', () => {
  const run = spawnSync('bash', ['-c', `ulimit -v 2500000; exec "$SHADOWPROOF" render ordinary ` +
    '-o a.exr --size 8192x8192'], { cwd: scratch, encoding: 'utf8' });
  assert.equal(run.status, 3, run.stderr);
  assert.match(run.stderr, /--size 8192x8192.*\(three quarters of what is available\)/);
});

for (const name of Object.keys(attacks))
  test(`${name} is refused within its budget, and says so`, { skip: sanitized }, () => {
    const bytes = writeAttack(scratch, name);
    const budget = 400 * megabyte;
    const run = measured(['verify', name, '--technique', 'zfail', ...small,
                          '--memory', String(budget)]);
    assert.equal(run.code, 3, `${bytes} bytes: ${run.err}`);
    assert.match(run.err, new RegExp(`^shadowproof: ${name.replace('.', '\\.')}[^]*; `));
    assert.ok(run.peak <= budget, `${run.peak} of ${budget}: ${run.err}`);
  });

for (const name of Object.keys(attacks))
  test(`${name} ends with a sentence also where address space runs out`, { skip: sanitized }, () => {
    writeAttack(scratch, name);
    for (const memory of [[], ['--memory', '64GB']]) {
      const run = spawnSync('bash', ['-c', 'ulimit -v 2000000; exec "$SHADOWPROOF" "$@"', 'bash',
        'verify', name, '--technique', 'zfail', ...small, ...memory],
        { cwd: scratch, encoding: 'utf8', timeout: 300_000 });
      assert.equal(run.signal, null, run.stderr);
      assert.ok([0, 1, 3].includes(run.status), `${run.status}: ${run.stderr}`);
      if (run.status === 3) assert.match(run.stderr, /^shadowproof: .+; /);
    }
  });

test('a picture of heights that decodes to more than the budget is refused', () => {
  writeFileSync(join(scratch, 'vast.png'), evenPng(8000, 8000));
  const run = measured(['normal-map', 'vast.png', '-o', 'n.png', '--memory', '1GB']);
  assert.equal(run.code, 3);
  assert.match(run.err, /^shadowproof: vast\.png: needs 7\.\d GB of memory for its 8000x8000 pixels/);
  assert.ok(sanitized || run.peak < 300 * megabyte, String(run.peak));
});

test('pictures that are checked together are held together', () => {
  const names = Array.from({ length: 6 }, (_, i) => `even-${i}.png`);
  for (const name of names) writeFileSync(join(scratch, name), evenPng(6000, 6000));
  const run = measured(['check', 'ordinary', ...names, '--memory', '700MB']);
  assert.equal(run.code, 3);
  assert.match(run.err, /^shadowproof: even-[1-5]\.png: .*700 MB/);
  assert.ok(sanitized || run.peak < 700 * megabyte, String(run.peak));
});

test('words in a picture are passed over, however long they are', () => {
  writeFileSync(join(scratch, 'words.png'), evenPng(16, 16, [longText(500 * megabyte)]));
  const run = measured(['normal-map', 'words.png', '-o', 'n.png', '--memory', '400MB']);
  assert.equal(run.code, 0, run.err);
  assert.ok(sanitized || run.peak < 300 * megabyte, String(run.peak));
});

test('what a damaged picture is told in is one sentence of ours', () => {
  const whole = evenPng(64, 64);
  const broken = Buffer.from(whole);
  broken[whole.indexOf('IDAT') + 8] ^= 0xff;
  for (const bytes of [whole.subarray(0, whole.length - 30), broken, whole.subarray(0, 20)]) {
    writeFileSync(join(scratch, 'damaged.png'), bytes);
    const run = shadowproof(['normal-map', 'damaged.png', '-o', 'n.png']);
    assert.equal(run.code, 3);
    assert.match(run.err, /^shadowproof: damaged\.png: is damaged \([^\n]+\); export the picture again\n$/);
  }
});
