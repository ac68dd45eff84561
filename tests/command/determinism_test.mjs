// The same bytes for any number of threads, any instruction set, and any locale.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { mkdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { inflateSync } from 'node:zlib';
import { filesBelow, scratch, shadowproof } from './shadowproof.mjs';

/** Times are the one thing that differs. */
const withoutTimes = (bytes) => Buffer.from(bytes.toString('latin1')
  .replace(/"(\w*ms|\w*milliseconds)": ?[-+.\de]+/g, '"$1":0'), 'latin1');

/** results.js with its scenes unpacked: they hold times. */
const unpacked = (script) => Buffer.from(script.toString('latin1').replace(/"([\w+/]{40,}={0,2})"/g,
  (all, scene) => inflateSync(Buffer.from(scene, 'base64')).toString('latin1')), 'latin1');

/** Of a manifest without the files that hold times; of any other file all. */
function content(folder, file) {
  const bytes = readFileSync(join(scratch, folder, file));
  if (file.endsWith('results.js')) return withoutTimes(unpacked(bytes));
  if (!file.endsWith('manifest.json')) return withoutTimes(bytes);
  const manifest = JSON.parse(bytes);
  manifest.files = Object.entries(manifest.files).filter(([key, value]) =>
    !/^results\.js/.test(value.name ?? key));
  return Buffer.from(JSON.stringify(manifest));
}

let runs = 0;
/** Every file that reports and three renders consist of, by name. */
function everything(flags = [], env = {}) {
  const folder = `run-${++runs}`;
  mkdirSync(join(scratch, folder));
  for (const args of [
    ['verify', 'near_plane', '--technique', 'zfail,zpass,auto', '--size', '96x64',
     '--out', join(folder, 'report'), '--time', '0.5'],
    ['verify', 'bumpy_sphere', '--technique', 'bump_tangent_space', '--size', '96x64',
     '--out', join(folder, 'lit')],
    // Seen from so far that a float ray's claim hangs on each rounding.
    ['verify', 'slivers', '--technique', 'traced_epsilon,traced_skip,cube_map_six_pass',
     '--size', '48x48', '--out', join(folder, 'slivers')],
    ['render', 'spot', '--size', '96x64', '-o', join(folder, 'truth.exr')],
    ['render', 'bumpy_sphere', '--size', '96x64', '-o', join(folder, 'lit.exr')],
    ['render', 'overlapping', '--size', '96x64', '-o', join(folder, 'truth.png')],
    ['explain', 'near_plane', '--pixel', '43,13', '--size', '96x64', '--technique', 'zpass',
     '--json', join(folder, 'pixel.json'), '--svg', join(folder, 'pixel.svg')]]) {
    const run = shadowproof([...args, ...flags], { env });
    assert.ok([0, 1].includes(run.code), run.err);
  }
  return new Map(filesBelow(join(scratch, folder)).map((file) =>
    [file, content(folder, file)]));
}

function sameAs(expected, found) {
  assert.deepEqual([...found.keys()], [...expected.keys()]);
  for (const [file, bytes] of expected)
    assert.ok(bytes.equals(found.get(file)), `${file} differs`);
}

const plain = everything(['--threads', '2']);

test('for any number of threads', () => {
  for (const threads of ['1', '7']) sameAs(plain, everything(['--threads', threads]));
});

test('on every instruction set that this processor has', () => {
  let tried = 0;
  for (const set of ['sse2', 'ssse3', 'sse4', 'avx2', 'avx512', 'best']) {
    const env = { SHADOWPROOF_INSTRUCTION_SET: set };
    const probe = shadowproof(['render', 'ordinary', '--size', '4x4', '-o', 'probe.png'], { env });
    if (probe.code === 3 && /this processor has no/.test(probe.err)) continue;
    assert.equal(probe.code, 0, probe.err);
    sameAs(plain, everything([], env));
    ++tried;
  }
  assert.ok(tried >= 2, String(tried));
});

test('an instruction set that is not known is an error', () => {
  const run = shadowproof(['render', 'ordinary', '--size', '4x4', '-o', 'probe.png'],
                          { env: { SHADOWPROOF_INSTRUCTION_SET: 'mmx' } });
  assert.equal(run.code, 3);
  assert.match(run.err, /SHADOWPROOF_INSTRUCTION_SET: "mmx" is not known; give sse2, /);
});

test('another instruction set of Embree makes other claims, so that the one that is used matters', () => {
  const claims = (set) => {
    const out = `traced-${set}`;
    const run = shadowproof(['verify', 'slivers', '--technique', 'traced_skip', '--size', '48x48', '--out', out],
                            { env: { SHADOWPROOF_TEST_TRACED_INSTRUCTION_SET: set } });
    assert.ok([0, 1].includes(run.code), run.err);
    return readFileSync(join(scratch, out, 'slivers/traced_skip.claim.png'));
  };
  const expected = plain.get('slivers/slivers/traced_skip.claim.png');
  assert.ok(claims('sse2').equals(expected));
  if (/ avx2 /.test(readFileSync('/proc/cpuinfo', 'utf8'))) assert.ok(!claims('avx2').equals(expected));
});

test('in any locale', (context) => {
  const locales = join(scratch, 'locales');
  mkdirSync(locales);
  const made = spawnSync('localedef',
                         ['-i', 'de_DE', '-f', 'UTF-8', join(locales, 'de_DE.UTF-8')]);
  if (made.error || made.status > 1) return context.skip('no localedef (package locales)');
  const env = { LOCPATH: locales, LC_ALL: 'de_DE.UTF-8', LANG: 'de_DE.UTF-8' };
  const comma = spawnSync('bash', ['-c', 'printf %.1f 1'], { env: { ...process.env, ...env } });
  assert.match(String(comma.stdout), /^1,0/);
  sameAs(plain, everything([], env));
  sameAs(plain, everything([], { LC_ALL: 'C' }));
});
