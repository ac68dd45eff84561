// What the commands write: into what is there already, and never over what is not theirs.
import assert from 'node:assert/strict';
import Ajv from 'ajv/dist/2020.js';
import { spawn } from 'node:child_process';
import { chmodSync, existsSync, lstatSync, mkdirSync, readFileSync, readdirSync, rmSync, statSync,
         symlinkSync, writeFileSync } from 'node:fs';
import { createHash } from 'node:crypto';
import { join } from 'node:path';
import { test } from 'node:test';
import { grayPng } from '../command/png.mjs';
import { assertRefused, contentOf, run, scratch } from './faults.mjs';

const program = process.env.SHADOWPROOF;
const small = ['near_plane', '--size', '16x16', '--technique', 'zpass'];
const verify = (...args) => [program, 'verify', ...small, ...args];
const height = join(scratch, 'height.png');
writeFileSync(height, grayPng(16, 16, (x, y) => ((x * x + 7 * y) * 257) % 65536));

const bench = (...args) => [program, 'bench', ...small, '--quick', '--repeats', '1', '--no-pictures',
                            '--out', 'r', '-q', ...args];
const shard = join(scratch, 'shard');
assert.equal(run(verify('--out', shard)).code, 0);

/** Every command that writes one file, with where to; each exits with 0. */
const writers = {
  json: (file) => verify('--out', 'r', '--json', file),
  junit: (file) => verify('--out', 'r', '--junit', file),
  explain: (file) => [program, 'explain', 'near_plane', '--pixel', '3,3', '--size', '16x16',
                      '--technique', 'zpass', '--json', file],
  svg: (file) => [program, 'explain', 'near_plane', '--pixel', '3,3', '--size', '16x16',
                  '--technique', 'zpass', '--svg', file],
  merge: (file) => [program, 'merge', shard, '--out', 'r', '--json', file],
  accept: (file) => [program, 'accept', shard, '-o', file],
  'export-view': (file) => [program, 'export-view', 'near_plane', '-o', file],
  bench: (file) => bench('--json', file),
  csv: (file) => bench('--csv', file),
  // A parameter that this scene has not: no point is judged, which would take seconds.
  stress: (file) => [program, 'stress', ...small, '--parameter', 'denormal', '--no-pictures',
                     '--out', 'r', '-q', '--json', file],
};

/** Exactly one document of JSON, XML or CSV. */
function assertOneDocument(text, where) {
  if (text.startsWith('{')) return JSON.parse(text);
  const [first] = text.split('\n'); // a heading, or the tag of the root
  assert.ok(first.length > 20, first);
  assert.equal(text.split(first).length, 2, where);
}

const pictures = {
  png: [program, 'render', 'near_plane', '--size', '16x16', '-o', 'picture.png'],
  exr: [program, 'render', 'near_plane', '--size', '16x16', '-o', 'picture.exr'],
  'normal-map png': [program, 'normal-map', height, '-o', 'picture.png'],
  'normal-map exr': [program, 'normal-map', height, '-o', 'picture.exr'],
};

function folder(name) {
  const below = join(scratch, name);
  mkdirSync(below);
  return below;
}

test('the current folder is never a report, whatever lies in it', () => {
  const below = folder('repository');
  mkdirSync(join(below, '.git'));
  writeFileSync(join(below, '.git/config'), 'mine');
  writeFileSync(join(below, 'source.c'), 'mine');
  assert.equal(run(verify('--json', 'results.json', '--out', 'report'), { cwd: below }).code, 0);
  rmSync(join(below, 'report'), { recursive: true });
  const before = contentOf(below);
  for (const out of ['.', '..', below, join(below, '.'), '../repository'])
    assertRefused(run(verify('--out', out), { cwd: below }), out);
  const beside = folder('beside');
  assertRefused(run(verify('--out', '../repository'), { cwd: beside }), 'from beside');
  assert.deepEqual(contentOf(below), before);
});

test('a report lists its files, and a second one keeps and names what is not listed', () => {
  const below = folder('kept');
  assert.equal(run(verify('--out', 'report'), { cwd: below }).code, 0);
  const { ['manifest.json']: text, ...files } = contentOf(join(below, 'report'));
  const manifest = JSON.parse(text);
  const schema = JSON.parse(readFileSync(new URL('../../docs/manifest.schema.json', import.meta.url)));
  const validate = new Ajv({ strict: true, allErrors: true }).compile(schema);
  assert.ok(validate(manifest), JSON.stringify(validate.errors));
  for (const name of ['../up', '/root', 'a//b', 'a/..', '.', ''])
    assert.ok(!validate({ ...manifest, files: [{ ...manifest.files[0], name }] }), name);
  assert.deepEqual(manifest.files.map(({ name }) => name).sort(),
                   Object.keys(files).filter((name) => files[name] !== 'folder').sort());
  for (const { name, size, xxh3 } of manifest.files) {
    assert.equal(size, files[name].length, name);
    assert.match(xxh3, /^[0-9a-f]{32}$/);
  }
  writeFileSync(join(below, 'report/notes.txt'), 'mine');
  const again = run(verify('--out', 'report', '-q'), { cwd: below });
  assert.equal(again.code, 0, again.err);
  assert.match(again.out, /^report: kept notes\.txt, which this program did not write$/m);
  assert.equal(readFileSync(join(below, 'report/notes.txt'), 'utf8'), 'mine');
  assert.deepEqual(readdirSync(below), ['report']);
  for (const command of [['report', '--from', 'report', '--out', 'report'],
                         ['merge', 'report', '--out', 'report']]) {
    const made = run([program, ...command], { cwd: below });
    assert.equal(made.code, 0, made.err);
    assert.match(made.out, /^report: kept notes\.txt, /m);
    assert.ok(existsSync(join(below, 'report/near_plane/zpass.claim.png')));
  }
});

test('results that lie below the new report are refused, and stay', () => {
  const below = folder('inside');
  assert.equal(run(verify('--out', 'report'), { cwd: below }).code, 0);
  assert.equal(run(verify('--out', 'report/shard'), { cwd: below }).code, 0);
  const before = contentOf(below);
  assertRefused(run([program, 'merge', 'report/shard', '--out', 'report'], { cwd: below }), 'shard');
  assert.deepEqual(contentOf(below), before);
});

test('a run that cannot start touches nothing', () => {
  const below = folder('not-started');
  assert.equal(run(verify('--out', 'report'), { cwd: below }).code, 0);
  const before = contentOf(below);
  for (const wrong of [['--json', 'missing/file'], ['--baseline', 'missing.json'],
                       ['--json', 'report/index.html'], ['--junit', 'report/results.json'],
                       ['--junit', 'report/manifest.json'], ['--json', 'report/near_plane']])
    assertRefused(run(verify('--out', 'report', ...wrong), { cwd: below }), wrong.join(' '));
  assert.deepEqual(contentOf(below), before);
});

test('--json and --junit in the report are of the report: listed, and replaced by the next run', () => {
  const below = folder('within');
  const args = ['--out', 'report', '--json', 'report/extra/all.json', '--junit', 'report/junit.xml'];
  for (let i = 0; i < 2; ++i) {
    const done = run(verify(...args), { cwd: below });
    assert.equal(done.code, 0, done.err);
    assert.doesNotMatch(done.out, /kept/);
    writeFileSync(join(below, 'report/junit.xml'), 'changed by hand');
  }
  const same = run(verify('--out', 'report', '--json', 'report/results.json'), { cwd: below });
  assert.equal(same.code, 0, same.err);
  assert.match(same.out, /^report: kept junit\.xml, changed since this program wrote it$/m);
  assert.ok(!existsSync(join(below, 'report/extra')));
  assert.deepEqual(readdirSync(below), ['report']);
});

test('two runs into one folder at once: one writes it, the other fails at once and names that', async () => {
  const below = folder('two');
  assert.equal(run(verify('--out', 'report'), { cwd: below }).code, 0);
  const first = spawn(program, ['verify', 'ordinary', '--size', '1024x1024', '--out', 'report'],
                      { cwd: below });
  while (!existsSync(join(below, 'report.writing/report')) && first.exitCode === null)
    await new Promise((resolve) => setTimeout(resolve, 10));
  const second = run(verify('--out', 'report'), { cwd: below });
  assertRefused(second, 'the second');
  assert.match(second.err, /report: is being written by process \d+ on \S+, since \S+; wait/);
  assert.ok(existsSync(join(below, 'report/near_plane/zpass.claim.png')), 'the old one is there');
  first.kill('SIGTERM');
  await new Promise((resolve) => first.on('close', resolve));
  assert.deepEqual(readdirSync(below), ['report']);
  assert.equal(run(verify('--out', 'report'), { cwd: below }).code, 0);
});

for (const [name, command] of Object.entries(writers))
  test(`${name} writes into devices, pipes and links, and keeps modes`, () => {
    const below = folder(`file-${name}`);
    writeFileSync(join(below, 'target'), 'old');
    chmodSync(join(below, 'target'), 0o640);
    symlinkSync('target', join(below, 'link'));
    run(['mkfifo', 'pipe'], { cwd: below });
    assert.equal(run(command('/dev/null'), { cwd: below }).code, 0);
    assert.ok(lstatSync('/dev/null').isCharacterDevice());
    const full = run(command('/dev/full'), { cwd: below });
    assertRefused(full, '/dev/full');
    assert.ok(lstatSync('/dev/full').isCharacterDevice());
    assert.match(full.err, /\/dev\/full: cannot be written \(No space left on device\)/);
    assert.equal(run(command('link'), { cwd: below }).code, 0);
    assert.ok(lstatSync(join(below, 'link')).isSymbolicLink());
    assert.equal(statSync(join(below, 'target')).mode & 0o777, 0o640);
    assertOneDocument(readFileSync(join(below, 'target'), 'utf8'), 'link');
    const words = command('pipe').map((word) => `'${word}'`).join(' ');
    const piped = run(['sh', '-c', `cat pipe > piped & ${words} && wait`], { cwd: below });
    assert.equal(piped.code, 0, piped.err);
    assert.ok(lstatSync(join(below, 'pipe')).isFIFO());
    assertOneDocument(readFileSync(join(below, 'piped'), 'utf8'), 'pipe');
    const opened = run(['sh', '-c', `${command('/dev/fd/3').map((word) => `'${word}'`).join(' ')} 3>opened`],
                       { cwd: below });
    assert.equal(opened.code, 0, opened.err);
    assertOneDocument(readFileSync(join(below, 'opened'), 'utf8'), 'descriptor');
    // Nothing can be made there, by root either.
    assertRefused(run(command('/proc/sys/file'), { cwd: below }), 'a read-only place');
  });

for (const [name, command] of Object.entries(pictures))
  test(`${name} is the same by a link, keeps the mode, and is refused for what it cannot write`, () => {
    const below = folder(`picture-${name.replace(' ', '-')}`);
    const file = command.at(-1);
    const hash = () => createHash('sha256').update(readFileSync(join(below, file))).digest('hex');
    assert.equal(run(command, { cwd: below }).code, 0);
    const first = hash();
    rmSync(join(below, file));
    writeFileSync(join(below, 'target'), 'old');
    chmodSync(join(below, 'target'), 0o640);
    symlinkSync('target', join(below, file));
    assert.equal(run(command, { cwd: below }).code, 0);
    assert.equal(hash(), first);
    assert.ok(lstatSync(join(below, file)).isSymbolicLink());
    assert.equal(statSync(join(below, 'target')).mode & 0o777, 0o640);
    // By a link, since the name's end says which kind of picture it is.
    for (const device of ['/dev/null', '/dev/full']) {
      rmSync(join(below, file));
      symlinkSync(device, join(below, file));
      const done = run(command, { cwd: below });
      if (device === '/dev/null') assert.equal(done.code, 0, done.err);
      else assertRefused(done, device);
    }
    // A pipe gets the very bytes; nothing can be made in /proc, by root either.
    rmSync(join(below, file));
    run(['mkfifo', 'pipe'], { cwd: below });
    symlinkSync('pipe', join(below, file));
    const words = command.map((word) => `'${word}'`).join(' ');
    const piped = run(['sh', '-c', `cat pipe > piped & ${words} && wait`], { cwd: below });
    assert.equal(piped.code, 0, piped.err);
    assert.ok(lstatSync(join(below, 'pipe')).isFIFO());
    assert.equal(createHash('sha256').update(readFileSync(join(below, 'piped'))).digest('hex'), first);
    rmSync(join(below, file));
    symlinkSync('/proc/sys/file', join(below, file));
    assertRefused(run(command, { cwd: below }), 'a read-only place');
    for (const name of [file, 'pipe', 'piped']) rmSync(join(below, name));
    assert.deepEqual(readdirSync(below), ['target']);
    const limited = run(['sh', '-c', `ulimit -f 0; exec ${words}`], { cwd: below });
    assertRefused(limited, 'ulimit -f');
    assert.match(limited.err, /File too large/);
    assert.deepEqual(readdirSync(below), ['target']);
  });

test('a step summary that cannot be written is said, and fails nothing', () => {
  const below = folder('summary');
  writeFileSync(join(below, 'summary.md'), 'before\n');
  const on = (file) => run(verify('--out', 'r'),
                           { cwd: below, env: { GITHUB_ACTIONS: 'true', GITHUB_STEP_SUMMARY: file } });
  assert.equal(on('summary.md').code, 0);
  assert.match(readFileSync(join(below, 'summary.md'), 'utf8'), /^before\n[^]*near_plane/);
  const full = on('/dev/full');
  assert.equal(full.code, 0);
  assert.match(full.err, /GITHUB_STEP_SUMMARY=\/dev\/full: cannot be written \(No space left/);
});

test('a file that is read, or named for two outputs, is never written over', () => {
  const below = folder('apart');
  const scene = join(below, 'scene.gltf');
  writeFileSync(scene, readFileSync(join(process.env.SHADOWPROOF_SCENES, 'near_plane.gltf')));
  symlinkSync('scene.gltf', join(below, 'link.json'));
  writeFileSync(join(below, 'heights.png'), readFileSync(height));
  const before = contentOf(below);
  const at = ['--size', '16x16', '--technique', 'zpass'];
  for (const command of [
    [program, 'verify', 'scene.gltf', ...at, '--out', 'r', '--json', './scene.gltf'],
    [program, 'verify', 'scene.gltf', ...at, '--out', 'r', '--junit', 'link.json'],
    [program, 'verify', 'scene.gltf', ...at, '--out', 'r', '--json', 'a', '--junit', './a'],
    [program, 'verify', 'scene.gltf', ...at, '--out', 'r', '--json', 'r'],
    [program, 'explain', 'scene.gltf', '--pixel', '3,3', ...at, '--json', scene],
    [program, 'render', 'scene.gltf', '--size', '16x16', '-o', 'scene.gltf'],
    [program, 'normal-map', 'heights.png', '-o', 'heights.png'],
  ]) {
    const done = run(command, { cwd: below });
    assert.notEqual(done.code, 0, command.join(' '));
    assert.match(done.err, /^\S+: [^\n]+; [^\n]+|Run with --help/m, command.join(' '));
    assert.deepEqual(contentOf(below), before, command.join(' '));
  }
});

test('a step summary into a pipe that nobody reads does not hang', () => {
  const below = folder('summary-pipe');
  run(['mkfifo', 'pipe'], { cwd: below });
  const done = run(verify('--out', 'r', '-q'),
                   { cwd: below, env: { GITHUB_ACTIONS: 'true', GITHUB_STEP_SUMMARY: 'pipe' }, seconds: 60 });
  assert.equal(done.code, 0, done.err);
  assert.match(done.err, /GITHUB_STEP_SUMMARY=pipe: /);
});
