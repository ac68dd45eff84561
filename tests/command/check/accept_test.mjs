// A baseline of reviewed results: each cause has its reason, and what is new since fails all the same.
import assert from 'node:assert/strict';
import { existsSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { grayPng, readPng } from '../png.mjs';
import { scratch, shadowproof } from '../shadowproof.mjs';

const path = (name) => join(scratch, name);
const jsonOf = (name) => JSON.parse(readFileSync(path(name), 'utf8'));
const zpass = ['verify', 'near_plane', '--technique', 'zpass', '--size', '96x96',
               '--gate', 'differences'];

function succeed(code, ...args) {
  const run = shadowproof(args);
  assert.equal(run.code, code, run.out + run.err);
  return run;
}

test('a cause is accepted with a reason, and then fails no more, whatever the gate', () => {
  succeed(1, ...zpass);
  const lacking = succeed(2, 'accept', 'report', '-o', 'accepted.json');
  assert.match(lacking.err, /near_plane: [\d,]+ pixels in 1 cell, first "zpass" on "near_plane"; give a reason: --reason 'near_plane=/);
  assert.ok(!existsSync(path('accepted.json')));
  const { out } = succeed(0, 'accept', 'report', '-o', 'accepted.json',
                          '--reason', 'near_plane=z-pass is used from outside alone, #12');
  assert.match(out, /accepted: near_plane: .*: z-pass is used from outside alone, #12/);
  assert.deepEqual(jsonOf('accepted.json').accepted.reasons,
                   { near_plane: 'z-pass is used from outside alone, #12' });
  const again = succeed(0, ...zpass, '--baseline', 'accepted.json');
  assert.match(again.out, /  accepted: near_plane: z-pass is used from outside alone, #12/);
  // The reason holds on, without being given again.
  succeed(0, 'accept', 'report', '-o', 'next.json');
  assert.deepEqual(jsonOf('next.json').accepted.reasons, jsonOf('accepted.json').accepted.reasons);
});

let square; // the corner of 12 x 12 lit pixels
/** Whether a pixel lies in the middle of that square. */
const isInSquare = (x, y) =>
  x >= square[0] + 2 && x < square[0] + 10 && y >= square[1] + 2 && y < square[1] + 10;

/** A picture of the truth in which a square of pixels is dark. */
function darkened(name) {
  succeed(0, 'render', 'ordinary', '--size', '200x200', '-o', 'truth.png', '-q');
  const truth = readPng(path('truth.png'));
  const shade = { 0: 20, 64: 60, 255: 190 };
  const isLit = (left, top) => Array.from({ length: 144 }, (_, i) =>
    truth.at(left + i % 12, top + Math.floor(i / 12))[0]).every((value) => value === 255);
  for (let i = 0; !square; ++i)
    if (isLit(i % 188, Math.floor(i / 188))) square = [i % 188, Math.floor(i / 188)];
  writeFileSync(path(name), grayPng(200, 200, (x, y) =>
    257 * (isInSquare(x, y) ? 60 : shade[truth.at(x, y)[0]])));
  writeFileSync(path('off.png'), grayPng(200, 200, (x, y) => 257 * (truth.at(x, y)[0] ? 60 : 20)));
}
const check = (...more) => shadowproof(['check', 'ordinary', 'mine.png', '--unlit', 'off.png', ...more]);

test('unexplained pixels of a picture are accepted by what they are diagnosed as, or not at all', () => {
  darkened('mine.png');
  assert.equal(check('--no-diagnosis').code, 1);
  assert.match(succeed(3, 'accept', 'report', '-o', 'no.json').err,
               /"mine" on "ordinary" has unexplained pixels; find their cause/);
  // All shadows of the picture are gone: that has a name.
  const truth = readPng(path('truth.png'));
  writeFileSync(path('mine.png'), grayPng(200, 200, (x, y) => 257 * (truth.at(x, y)[0] ? 190 : 20)));
  assert.equal(check().code, 1);
  succeed(0, 'accept', 'report', '-o', 'none.json', '--reason', 'no_shadow=not there yet');
  assert.equal(check('--baseline', 'none.json').code, 0);
});

test('pixels that are new since an acceptance fail', () => {
  const truth = readPng(path('truth.png'));
  writeFileSync(path('mine.png'), grayPng(200, 200, (x, y) =>
    257 * (isInSquare(x, y) ? 60 : truth.at(x, y)[0] ? 190 : 20)));
  const { code, out } = check('--baseline', 'none.json', '--no-diagnosis');
  assert.equal(code, 1, out);
  assert.match(out, /since the baseline: .*64 new/);
});

test('what cannot be accepted is refused by name', () => {
  succeed(1, ...zpass);
  const refused = (code, words, ...args) =>
    assert.match(succeed(code, 'accept', 'report', '-o', 'x.json', ...args).err, words);
  refused(2, /--reason far_plane: no cell fails by that/, '--reason', 'near_plane=a',
          '--reason', 'far_plane=b');
  refused(2, /'near_plane=' gives no reason/, '--reason', 'near_plane=');
  refused(2, /near_plane is given twice/, '--reason', 'near_plane=a', '--reason', 'near_plane=b');
  refused(3, /report: holds no reasons/, '--reasons-of', 'report');
  succeed(3, 'verify', 'nowhere.gltf', '--out', 'broken');
  if (existsSync(path('broken/results.json')))
    assert.match(succeed(3, 'accept', 'broken', '-o', 'x.json').err, /could not be tried/);
  assert.match(succeed(3, 'accept', 'report', '-o', 'missing/x.json', '--reason', 'near_plane=a').err,
               /missing\/x\.json: cannot be written/);
});
