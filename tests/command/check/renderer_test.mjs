// `check --renderer`: somebody's program makes the pictures, of one scene after the other. What it
// does wrong is named.
import assert from 'node:assert/strict';
import { copyFileSync, existsSync, mkdirSync, readdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { scratch, shadowproof } from '../shadowproof.mjs';

const script = fileURLToPath(new URL('renderer.mjs', import.meta.url));
const renderer = (how, words = '{scene} {view} {out}') =>
  `${process.execPath} '${script}' ${how} ${words}`;
const size = ['--size', '120x100'];
const path = (name) => join(scratch, name);

function checked(scenes, command, ...more) {
  const run = shadowproof(['check', ...scenes, '--renderer', command, ...size, '--out', 'checked',
                           ...more]);
  const results = existsSync(path('checked/results.json'))
    ? JSON.parse(readFileSync(path('checked/results.json'), 'utf8')) : null;
  return { ...run, results };
}
// A folder for temporary files of its own: other tests that run meanwhile have theirs.
const temporary = path('temporary');
mkdirSync(temporary);
process.env.TMPDIR = temporary;
const leftovers = () => readdirSync(temporary);

test('a right renderer agrees on several scenes, and its pictures lie in the report', () => {
  const { code, out, err, results } =
    checked(['ordinary', 'sun', 'near_plane'], renderer('right'), '--name', 'mine');
  assert.equal(code, 0, out + err);
  assert.deepEqual(results.scenes.map(({ name }) => name), ['ordinary', 'sun', 'near_plane']);
  for (const { name, techniques: [cell] } of results.scenes) {
    assert.equal(cell.name, 'mine');
    assert.equal(cell.verdict, 'agrees');
    assert.ok(existsSync(path(`checked/rendered/${name}/mine.png`)));
  }
  assert.deepEqual(leftovers(), []);
});

test('one that moves the light fails, with a command that reproduces it', () => {
  const { code, out, results } = checked(['ordinary'], renderer('moved'), '--no-diagnosis');
  assert.equal(code, 1, out);
  assert.ok(results.scenes[0].techniques[0].falsely_lit > 50);
  assert.match(out, /reproduce: shadowproof check ordinary --renderer .*moved/);
});

test('a twin that it writes too is what decides', () => {
  const { code, out, err } = checked(['ordinary'], renderer('right', '{scene} {view} {out} {unlit}'));
  assert.equal(code, 0, out + err);
});

for (const [how, words] of [
  ['fail', /ordinary: the renderer ended with code 7 \(it said: no GPU was found\); run it by hand/],
  ['crash', /ordinary: the renderer was ended by signal 11 .*; run it by hand/],
  ['nothing', /ordinary: the renderer ended well, but wrote no \{out\} \(it said nothing\)/],
  ['empty', /ordinary: the renderer ended well, but wrote no \{out\}/],
  ['blank', /rendered\/ordinary\/renderer\.png: is of one colour/]])
  test(`a renderer that makes "${how}" is named, and the other scene is tried`, () => {
    const { code, out, err, results } = checked(['ordinary', 'sun'], renderer(how));
    assert.equal(code, 3, err);
    assert.match(out + err, words);
    assert.equal(results.scenes.length, 2);
    const [scene] = results.scenes;
    assert.match(scene.error ?? scene.techniques[0].error, words);
    assert.deepEqual(leftovers(), []);
  });

test('one that hangs is given up, with all that it has started', () => {
  const started = Date.now();
  const { code, err } = checked(['ordinary'], renderer('hang'), '--timeout', '2');
  assert.equal(code, 3, err);
  assert.match(err, /ordinary: the renderer took longer than --timeout 2 /);
  assert.ok(Date.now() - started < 60000);
});

test('names with quotes, blanks and shell words reach the renderer as they are', () => {
  const folder = "it's $(touch oops); `a` \"b\"";
  mkdirSync(path(folder));
  copyFileSync(new URL('../../../scenes/bundled/ordinary.gltf', import.meta.url),
               path(`${folder}/my scene.gltf`));
  const { code, out, err } = checked([`${folder}/my scene.gltf`], renderer('right'));
  assert.equal(code, 0, out + err);
  assert.ok(!existsSync(path('oops')));
});

test('a scene that cannot be read is one of many', () => {
  const { code, err, results } = checked(['nowhere.gltf', 'sun'], renderer('right'));
  assert.equal(code, 3);
  assert.match(err, /nowhere\.gltf: is neither a bundled scene nor a file/);
  assert.equal(results.scenes[1].techniques[0].verdict, 'agrees');
});

test('a command that cannot be right is wrong usage', () => {
  const refused = (words, ...args) => {
    const run = shadowproof(['check', 'ordinary', ...args]);
    assert.equal(run.code, 2, run.err);
    assert.match(run.err, words);
  };
  refused(/writes no picture; put \{out\} where/, '--renderer', 'blender {scene}');
  refused(/\{lit\} is not known; there are \{scene\}, \{view\}, \{out\}, \{unlit\} and \{unshadowed\}/,
          '--renderer', 'blender {lit} {out}');
  refused(/a quote, ', does not end/, '--renderer', "blender '{out}");
  refused(/leave --mask, --unlit and --unshadowed out/, '--renderer', 'blender {out}', '--unlit', 'off.png');
  refused(/--stress: changes the scene/, '--renderer', 'blender {out}', '--stress', 'scale=2');
  refused(/--name: '\.\.\/x' is no name/, '--renderer', 'blender {out}', '--name', '../x');
  refused(/IMAGE, or --renderer that makes one is required/);
  const missing = checked(['ordinary'], 'no-such-program {out}');
  assert.equal(missing.code, 3);
  assert.match(missing.err, /no-such-program: cannot be started \(No such file or directory\)/);
});
