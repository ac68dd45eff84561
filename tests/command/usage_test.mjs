// Exit codes and sentences: wrong usage is 2, what could not run is 3.
import assert from 'node:assert/strict';
import { copyFileSync, mkdirSync, readFileSync, readdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { scratch, shadowproof } from './shadowproof.mjs';

const wrongUsage = [
  [[], /there are verify, check, render, explain, stress, bench, list/],
  [['inspect', 'ordinary', 'x.png'], /no command 'inspect'; there are verify, check, render, explain/],
  [['--nonsense'], /there are verify/],
  [['verify', '--technique', 'zmaybe'], /no technique 'zmaybe'; there are zpass, zfail/],
  [['verify', '--technique', 'zfial'], /no technique 'zfial' \(did you mean zfail\?\); there are zpass/],
  [['verify', '--techniqe', 'zfail'], /not expected.*\(did you mean --technique\?\)/],
  [['verfy', 'ordinary'], /no command 'verfy' \(did you mean verify\?\); there are verify/],
  [['verify', '--technique', ''], /technique/],
  [['verify', '--size', '512'], /WIDTHxHEIGHT/],
  [['verify', '--size', '0x512'], /WIDTHxHEIGHT/],
  [['verify', '--size', '512x512x'], /WIDTHxHEIGHT/],
  [['verify', '--size', '99999999999x1'], /WIDTHxHEIGHT/],
  [['verify', '--gl', 'vulkan'], /osmesa or egl/],
  [['verify', '--normalise', 'twice'], /'twice'.*exact, cube-map, newton-raphson/],
  [['verify', '--cube-size', '1'], /--cube-size/],
  [['verify', '--newton-steps', '4'], /--newton-steps/],
  [['verify', '--bumps', 'pits'], /'pits'.*as-given, height-field, normal-map, derivatives, indexed/],
  [['verify', '--gate', 'open'], /defects or differences/],
  [['verify', '--time', 'noon'], /seconds/],
  [['verify', '--time', 'nan'], /seconds/],
  [['verify', '--threads', '-1'], /threads/],
  [['verify', '--out', ''], /empty/],
  [['verify', '--json'], /json/],
  [['render', 'ordinary'], /output/],
  [['render', 'ordinary', '-o', 'truth.jpg'], /\.png or \.exr/],
  [['explain', 'ordinary'], /pixel/],
  [['explain', 'ordinary', '--pixel', '3'], /X,Y/],
  [['explain', 'ordinary', '--pixel', '-1,3'], /X,Y/],
  [['explain', 'ordinary', '--pixel', '512,3'], /outside/],
  [['explain', 'ordinary', '--pixel', '9,3', '--size', '8x8'], /outside/],
];
for (const [args, sentence] of wrongUsage)
  test(`wrong usage ends with 2 and a remedy: ${args.join(' ')}`, () => {
    const run = shadowproof(args);
    assert.equal(run.code, 2, run.err);
    assert.match(run.err, sentence);
    assert.equal(run.out, '');
  });

test('a scene that is not there ends with 3 and names the bundled ones', () => {
  const run = shadowproof(['verify', 'nowhere.gltf']);
  assert.equal(run.code, 3);
  assert.match(run.err, /nowhere\.gltf/);
  assert.match(run.err, /ordinary/);
});

for (const command of ['', 'verify', 'check', 'render', 'explain', 'stress', 'bench', 'list', 'report', 'merge',
                       'normal-map'])
  test(`help fits 80 columns: ${command || 'all of it'}`, () => {
    const run = shadowproof([command, '--help'].filter(Boolean));
    assert.equal(run.code, 0, run.err);
    const lines = run.out.split('\n');
    assert.ok(lines.length > 5);
    for (const line of lines) assert.ok(line.length <= 80, line);
  });

test('--version names what results depend on: Embree, Mesa and the instruction set', () => {
  const run = shadowproof(['--version'], { env: { SHADOWPROOF_INSTRUCTION_SET: 'sse4' } });
  assert.equal(run.code, 0, run.err);
  assert.match(run.out, /^shadowproof \d+\.\d+\.\d+\nEmbree \d.*\nOpenGL .*Mesa.*llvmpipe.*\ninstruction set SSE4\n$/);
  const unknown = shadowproof(['--version'], { env: { SHADOWPROOF_INSTRUCTION_SET: 'mmx' } });
  assert.equal(unknown.code, 3);
  assert.match(unknown.err, /"mmx" is not known/);
});

test('a scene that is nearly the name of a bundled one is asked about', () => {
  const run = shadowproof(['verify', 'ordnary']);
  assert.equal(run.code, 3);
  assert.match(run.err, /ordnary: is neither .* \(did you mean ordinary\?\)/);
});

test('a file that is no glTF ends with 3 and one sentence', () => {
  writeFileSync(join(scratch, 'broken.gltf'), '{"asset":');
  for (const args of [['verify', 'broken.gltf'], ['render', 'broken.gltf', '-o', 'x.png'],
                      ['explain', 'broken.gltf', '--pixel', '1,1']]) {
    const run = shadowproof(args);
    assert.equal(run.code, 3, args[0]);
    assert.match(run.err, /broken\.gltf/);
  }
});

test('an output that cannot be written ends with 3, and nothing is left', () => {
  const before = readdirSync(scratch);
  for (const args of [['render', 'ordinary', '--size', '8x8', '-o', 'missing/x.png'],
                      ['render', 'ordinary', '--size', '8x8', '-o', 'missing/x.exr'],
                      ['verify', 'ordinary', '--size', '8x8', '--out', '/proc/report']]) {
    const run = shadowproof(args);
    assert.equal(run.code, 3, `${args.join(' ')}: ${run.err}`);
    assert.match(run.err, /cannot be written/);
  }
  assert.deepEqual(readdirSync(scratch), before);
});

test('an output that cannot be written is refused by the name given, before any work', () => {
  for (const [args, file] of [
    [['render', 'ordinary', '-o', '/nonexistent/x.png'], '/nonexistent/x.png'],
    [['render', 'ordinary', '-o', '/nonexistent/x.exr'], '/nonexistent/x.exr'],
    [['explain', 'ordinary', '--pixel', '1,1', '--json', 'missing/p.json'], 'missing/p.json'],
    [['explain', 'ordinary', '--pixel', '1,1', '--svg', 'missing/p.svg'], 'missing/p.svg']]) {
    const run = shadowproof(args);
    assert.equal(run.code, 3, run.err);
    assert.ok(run.err.startsWith(`shadowproof: ${file}: cannot be written (`), run.err);
    assert.doesNotMatch(run.err, /writing-/);
    assert.equal(run.out, '');
  }
});

test('an empty file is called empty', () => {
  for (const name of ['empty.glb', 'empty.gltf']) {
    writeFileSync(join(scratch, name), '');
    const run = shadowproof(['verify', name, '--size', '8x8']);
    assert.equal(run.code, 3);
    assert.match(run.err, new RegExp(`${name.replace('.', '\\.')}: is empty; export`));
  }
});

test('names from files reach the console without control characters', () => {
  const name = 'a\x1b[31mred\x07\u009b2J.gltf';
  copyFileSync(new URL('../../scenes/bundled/ordinary.gltf', import.meta.url), join(scratch, name));
  const control = /[\x00-\x09\x0b-\x1f\x7f\u0080-\u009f]/;
  for (const args of [['verify', name, '--technique', 'zfail', '--size', '8x8'],
                      ['explain', name, '--pixel', '1,1', '--technique', 'zfail', '--size', '8x8'],
                      ['verify', `${name}.missing`], ['render', name, '-o', `no\x1b/x.png`]]) {
    const run = shadowproof(args);
    assert.doesNotMatch(run.out + run.err, control);
    assert.match(run.out + run.err, /\ufffd/);
  }
});

test('quiet, explain writes its files and prints nothing', () => {
  const run = shadowproof(['explain', 'ordinary', '--pixel', '1,1', '--technique', 'zfail',
                           '--size', '8x8', '-q', '--json', 'quiet.json']);
  assert.equal(run.code, 0, run.err);
  assert.equal(run.out + run.err, '');
  assert.equal(JSON.parse(readFileSync(join(scratch, 'quiet.json'), 'utf8')).x, 1);
});

test('one is one: counts of one have no plural', () => {
  const run = shadowproof(['verify', 'ordinary', '--technique', 'zfail', '--size', '8x8']);
  assert.match(run.out, /^passed: 1 cell; /m);
  const again = shadowproof(['report', '--from', 'report/results.json', '--out', 'again']);
  assert.match(again.out, /^passed: 1 cell; /m);
});

test('a folder that is no report is not replaced', () => {
  mkdirSync(join(scratch, 'holiday'));
  writeFileSync(join(scratch, 'holiday/photo.txt'), 'dear');
  const run = shadowproof(['verify', 'ordinary', '--size', '8x8', '--out', 'holiday']);
  assert.equal(run.code, 3);
  assert.match(run.err, /holiday.*not a report/);
  assert.deepEqual(readdirSync(join(scratch, 'holiday')), ['photo.txt']);
});

test('help and version end with 0, and help tells the exit codes', () => {
  assert.match(shadowproof(['--version']).out, /^shadowproof \d+\.\d+\.\d+\nEmbree \d/);
  const help = shadowproof(['--help']);
  assert.equal(help.code, 0);
  assert.match(help.out, /Exit codes/);
  for (const command of ['verify', 'render', 'explain', 'list'])
    assert.equal(shadowproof([command, '--help']).code, 0);
});
