// Whatever is given as a file: it ends soon, with 3 (or 2), and with one sentence that names it.
import assert from 'node:assert/strict';
import { execFileSync, spawn, spawnSync } from 'node:child_process';
import { chmodSync, existsSync, mkdirSync, symlinkSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, test } from 'node:test';
import { triangle } from './hostile.mjs';
import { scratch, shadowproof } from './shadowproof.mjs';

const control = /[\x00-\x09\x0b-\x1f\x7f\u0080-\u009f\u061c\u200e\u200f\u2028-\u202e\u2066-\u2069]/;

execFileSync('mkfifo', [join(scratch, 'fifo')]);
writeFileSync(join(scratch, 'empty'), '');
writeFileSync(join(scratch, 'empty.md2'), '');
mkdirSync(join(scratch, 'folder'));
symlinkSync('nothing', join(scratch, 'dangling'));
symlinkSync('loop', join(scratch, 'loop'));
const odd = 'a\nb\x1b[31m\x07\u202e\u2066';
writeFileSync(join(scratch, odd), 'odd');
const raw = Buffer.concat([Buffer.from(join(scratch, 'x')), Buffer.from([0xff, 0xc0])]);
writeFileSync(raw, 'not UTF-8');
const server = spawn(process.execPath, ['-e',
  `require('net').createServer().listen(${JSON.stringify(join(scratch, 'socket'))})`]);
after(() => server.kill());
for (let i = 0; i < 100 && !existsSync(join(scratch, 'socket')); ++i)
  spawnSync('sleep', ['0.1']);

const inputs = ['fifo', 'empty', 'empty.md2', 'folder', 'dangling', 'loop', odd, 'socket', 'missing',
                '/dev/null', '/dev/zero', '/dev/urandom', '/proc/kcore', '/proc/self/mem',
                '/proc/self/fd/0', `${'n'.repeat(300)}`, 'empty/below', `${'d/'.repeat(3000)}x`];
const commands = {
  verify: (file) => ['verify', file, '--technique', 'zfail', '--size', '8x8'],
  render: (file) => ['render', file, '-o', 'a.png', '--size', '8x8'],
  explain: (file) => ['explain', file, '--pixel', '1,1', '--technique', 'zfail', '--size', '8x8'],
  'normal-map': (file) => ['normal-map', file, '-o', 'n.png'],
  report: (file) => ['report', '--from', file, '--out', 'again'],
  merge: (file) => ['merge', file, '--out', 'again'],
  bench: (file) => ['bench', file, '--technique', 'zfail', '--size', '8x8', '--repeats', '1'],
  'bench --from': (file) => ['bench', '--from', file, '--out', 'again'],
  'bench --against': (file) => ['bench', 'ordinary', '--against', file, '--size', '8x8'],
  'bench --resume': (file) => ['bench', 'ordinary', '--json', file, '--resume', '--size', '8x8',
                               '--technique', 'zfail', '--repeats', '1'],
  baseline: (file) => ['verify', 'ordinary', '--baseline', file, '--size', '8x8', '--technique', 'zfail'],
};

function judge(run, what) {
  assert.equal(run.signal, null, `${what}: ${run.signal}`);
  assert.ok([2, 3].includes(run.code), `${what}: ${run.code} ${run.out}`);
  assert.match(run.err, /^shadowproof: [^\n]+\n$/, what);
  assert.doesNotMatch(run.err + run.out, control, what);
}

for (const [name, command] of Object.entries(commands))
  test(`${name} refuses what is no file of its kind, in one sentence`, () => {
    for (const file of inputs) {
      // A run that was stopped before its first point left no file to go on from: it begins.
      if (name === 'bench --resume' && file === 'missing') continue;
      const run = shadowproof(command(file), { seconds: 60 });
      judge(run, `${name} ${JSON.stringify(file).slice(0, 60)}`);
      if (file.length < 20 && file !== odd) assert.ok(run.err.includes(file), run.err);
    }
  });

test('a file that may not be read is refused by its name', {
  skip: process.getuid() !== 0 && 'only root may become somebody else',
}, () => {
  writeFileSync(join(scratch, 'secret'), '{}');
  chmodSync(join(scratch, 'secret'), 0);
  mkdirSync(join(scratch, 'closed'));
  writeFileSync(join(scratch, 'closed', 'inside'), '{}');
  chmodSync(join(scratch, 'closed'), 0);
  const opened = join(scratch, 'open');
  mkdirSync(opened);
  chmodSync(opened, 0o777);
  chmodSync(scratch, 0o755);
  const asNobody = (...words) => spawnSync('setpriv', ['--reuid', '65534', '--clear-groups', ...words],
                                           { cwd: opened, encoding: 'utf8', timeout: 60_000 });
  // Unless the build lies where nobody else may look.
  if (asNobody('cat', process.env.SHADOWPROOF).status !== 0) return;
  for (const [name, command] of Object.entries(commands))
    for (const file of ['../secret', '../closed/inside']) {
      const run = asNobody(process.env.SHADOWPROOF, ...command(file));
      judge({ code: run.status, signal: run.signal, out: run.stdout, err: run.stderr },
            `${name} ${file}`);
      assert.ok(run.stderr.includes(file), run.stderr);
    }
});

test('a file that vanishes between two looks, or a scene among good ones, costs no other', () => {
  const run = shadowproof(['verify', 'ordinary', 'missing.gltf', '--technique', 'zfail',
                           '--size', '8x8', '--json', 'both.json']);
  assert.equal(run.code, 3);
  assert.match(run.out, /ordinary/);
  assert.match(run.err, /^shadowproof: missing\.gltf: is neither a bundled scene nor a file/m);
});

const nasty = ['a\u0000b', 'a\u001b[2Jb', 'a\nb', 'a\r\nb', 'a\u202eb', 'a\u2066b', 'a\u009bb'];
/** Places whose text comes into a refusal. */
const places = {
  'asset.version': (gltf, text) => { gltf.asset.version = text; },
  'a required extension': (gltf, text) => { gltf.extensionsRequired = [text]; },
  "a buffer's URI": (gltf, text) => { gltf.buffers[0].uri = text; },
  'an attribute': (gltf, text) => { gltf.meshes[0].primitives[0].attributes[text] = -1; },
  'a cause': (gltf, text) => { gltf.extras = { shadowproof: { provokes: [text] } }; },
};
for (const [place, change] of Object.entries(places))
  test(`no character of ${place} cuts a sentence, or moves in it`, () => {
    for (const text of nasty) {
      const gltf = triangle();
      change(gltf, text);
      writeFileSync(join(scratch, 'nasty.gltf'), JSON.stringify(gltf));
      const run = shadowproof(commands.verify('nasty.gltf'));
      judge(run, `${place} ${JSON.stringify(text)}`);
      assert.match(run.err, /^shadowproof: nasty\.gltf.*; \S.*\n$/);
    }
  });

test('a string of any length makes a message that can be read, to its remedy', () => {
  const gltf = triangle();
  gltf.asset.version = '\u20ac'.repeat(100_000);
  writeFileSync(join(scratch, 'long.gltf'), JSON.stringify(gltf));
  const run = shadowproof(commands.verify('long.gltf'));
  judge(run, 'a long version');
  assert.ok(run.err.length < 4500, String(run.err.length));
  assert.match(run.err, /^shadowproof: long\.gltf \/asset\/version: .*\u20ac\.\.\.\u20ac.*; convert the asset to glTF 2\.0\n$/);
});

test('bytes that are not UTF-8 in a string are refused, or shown as what they are not', () => {
  const text = JSON.stringify({ ...triangle(), asset: { version: 'VERSION' } });
  const [before, behind] = text.split('VERSION').map((part) => Buffer.from(part));
  writeFileSync(join(scratch, 'bytes.gltf'),
                Buffer.concat([before, Buffer.from([0x31, 0xff, 0xc0]), behind]));
  judge(shadowproof(commands.verify('bytes.gltf')), 'invalid UTF-8');
});

test("names in GitHub's lines have no control characters, and end no property", () => {
  const name = 'a\x1b[31m:b,c%d\r\u202e.gltf';
  writeFileSync(join(scratch, name), '{');
  const run = shadowproof(commands.verify(name), { env: { GITHUB_ACTIONS: 'true' } });
  assert.equal(run.code, 3);
  assert.doesNotMatch(run.out + run.err, control);
  const line = run.out.split('\n').find((one) => one.startsWith('::error '));
  assert.match(line, /^::error file=a\ufffd\[31m%3Ab%2Cc%25d\ufffd\ufffd\.gltf,title=[^:,]*::/);
});
