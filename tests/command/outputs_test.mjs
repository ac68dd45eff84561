// What list, render and explain print and write.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { isForPointLights, scratch, shadowproof } from './shadowproof.mjs';

test('list names every scene, technique and cause, alike as text and as JSON', () => {
  const text = shadowproof(['list']).out;
  const json = JSON.parse(shadowproof(['list', '--json']).out);
  for (const name of ['ordinary', 'near_plane', 'far_plane', 'eye_inside'])
    assert.ok(json.scenes.some((scene) => scene.name === name), name);
  for (const name of ['zpass', 'zfail', 'zfail_clamp', 'zfail_infinite', 'zfail_reversed'])
    assert.ok(json.techniques.some((technique) => technique.name === name), name);
  assert.equal(json.causes.length, 21);
  for (const { name } of [...json.scenes, ...json.techniques, ...json.causes])
    assert.ok(text.includes(`  ${name} `), name);
  for (const { name, cost } of json.techniques)
    assert.match(text, new RegExp(`\\n  ${name.replace('+', '\\+')} [^]*?\\n +cost: ${cost.toFixed(2)} x zfail_reversed\\n`));
});

test('list states to which depth the numbers of a technique suffice, for which picture', () => {
  const text = shadowproof(['list']).out;
  const json = JSON.parse(shadowproof(['list', '--json']).out);
  const precise = (name) => json.techniques.find((technique) => technique.name === name).precise;
  const { near, far, rows, yfov } = precise('zpass');
  assert.match(text, new RegExp(`near plane of ${near}, a far plane of\\s+${far}, and ${rows} rows ` +
                                `of pixels over ${yfov} degrees`));
  // Errors of (16 + 10) 2^-24 t^2 / near, of window depths and of the transform, against pixels that are
  // w t wide; a finite far plane adds little.
  const width = 2 * Math.tan(yfov / 2 * Math.PI / 180) / rows;
  for (const name of ['zpass', 'zfail', 'zfail_clamp', 'zfail_infinite', 'invert'])
    assert.ok(Math.abs(precise(name).to / (near * width * 2 ** 24 / 26) - 1) < 0.01, name);
  for (const name of ['zfail_reversed', 'auto', 'bump_one_pass'])
    assert.deepEqual([precise(name).from, precise(name).to], [near, null], name);
  for (const name of ['cube_map_six_pass', 'traced_epsilon']) assert.equal(precise(name), null);
  assert.match(text, /\n  zfail  [^]*?\n +precise: to \d+\.\d\n/);
  assert.match(text, /\n  zfail_reversed  [^]*?\n +precise: at any depth\n/);
});

test('verify prints one line a cell, and what auto leaves out only into the results', () => {
  const { techniques } = JSON.parse(shadowproof(['list', '--json']).out);
  const run = shadowproof(['verify', 'near_plane', '--size', '64x64', '--json', 'lines.json']);
  const lines = run.out.split('\n').filter((line) => !/ wrong pixels? excused: /.test(line));
  const cells = lines.slice(lines.findIndex((line) => line.startsWith('zpass '))).slice(0, -2);
  assert.deepEqual(cells.map((line) => line.match(/^(\S+) +near_plane  /)?.[1]),
                   techniques.filter(isForPointLights).map(({ name }) => name));
  assert.match(cells.find((line) => line.startsWith('auto ')), /^auto .*  saved -?[\d.]+ ms and [\d,]+ of [\d,]+ volume fragments .*  [\d.]+ ms$/);
  const auto = JSON.parse(readFileSync(join(scratch, 'lines.json'), 'utf8'))
    .scenes[0].techniques.find(({ name }) => name === 'auto');
  assert.ok(auto.left_out.length > 1, auto.left_out.join());
});

test('the class map is an 8-bit gray PNG, the same at each run and for any number of threads', () => {
  assert.equal(shadowproof(['render', 'ordinary', '--size', '64x48', '-o', 'a.png']).code, 0);
  assert.equal(shadowproof(['render', 'ordinary', '--size', '64x48', '-o', 'b.png',
                            '--threads', '1']).code, 0);
  const png = readFileSync(join(scratch, 'a.png'));
  assert.deepEqual(png, readFileSync(join(scratch, 'b.png')));
  assert.equal(png.toString('latin1', 1, 4), 'PNG');
  // IHDR: width, height, bit depth, colour type 0 (gray).
  assert.deepEqual([png.readUInt32BE(16), png.readUInt32BE(20), png[24], png[25]], [64, 48, 8, 0]);
});

test('the EXR names its channels, and is the same at each run', () => {
  for (const file of ['a.exr', 'b.exr'])
    assert.equal(shadowproof(['render', 'ordinary', '--size', '32x32', '-o', file]).code, 0);
  const exr = readFileSync(join(scratch, 'a.exr'));
  assert.deepEqual(exr, readFileSync(join(scratch, 'b.exr')));
  const header = exr.toString('latin1', 0, 1000);
  for (const channel of ['P.X', 'P.Y', 'P.Z', 'N.X', 'N.Y', 'N.Z', 'depth.Z', 'primId',
                         'exactness', 'visibility.'])
    assert.ok(header.includes(channel), channel);
});

test('explain says the same on the console and in JSON', () => {
  const run = shadowproof(['explain', 'near_plane', '--pixel', '300,300', '--json', 'pixel.json']);
  assert.equal(run.code, 0, run.err);
  const pixel = JSON.parse(readFileSync(join(scratch, 'pixel.json'), 'utf8'));
  assert.equal(pixel.schema, 'shadowproof/pixel/1');
  assert.match(run.out, new RegExp(`truth +${pixel.truth}`));
  assert.match(run.out, new RegExp(`triangle ${pixel.seen.triangle} of ${pixel.seen.mesh}`));
  assert.ok(pixel.techniques.some(({ predicted }) => predicted !== undefined));
  for (const technique of pixel.techniques.filter(({ predicted }) => predicted !== undefined))
    assert.match(run.out, new RegExp(
      `${technique.name} +${technique.predicted} +${technique.stored} +${technique.read_back} +` +
      `(to [\\d.]+|at any depth) +${technique.claim}`));
});

test("explain's crossings lead from the count at the eye to the count at infinity", () => {
  const at = (x, y) => {
    const file = `pixel-${x}-${y}.json`;
    shadowproof(['explain', 'eye_inside', '--pixel', `${x},${y}`, '--technique', 'zfail_reversed',
                 '--json', file]);
    return JSON.parse(readFileSync(join(scratch, file), 'utf8'));
  };
  for (const pixel of [at(256, 256), at(101, 300), at(400, 200)]) {
    const changes = pixel.crossings.map((crossing) => crossing.change);
    assert.equal(changes.reduce((sum, change) => sum + change, pixel.inside.eye),
                 pixel.inside.infinity);
  }
});

test('a moving light is judged where it is at --time', () => {
  const at = (time) => {
    const run = shadowproof(['verify', 'moving_light', '--size', '128x128', '--time', time,
                             '--json', `${time}.json`]);
    assert.equal(run.code, 0, run.out + run.err);
    return JSON.parse(readFileSync(join(scratch, `${time}.json`), 'utf8')).scenes[0];
  };
  const [early, late] = [at('0'), at('3')];
  assert.notEqual(early.digest, late.digest);
  assert.notEqual(early.reference.lit, late.reference.lit);
  assert.ok(late.notes.some((note) => note.includes('3 s')), late.notes.join());
});

test('an open caster is named before anything is drawn, and a closed one is not', () => {
  const notesOf = (scene) => {
    shadowproof(['verify', scene, '--size', '64x64', '--json', 'notes.json']);
    return JSON.parse(readFileSync(join(scratch, 'notes.json'), 'utf8')).scenes[0].notes;
  };
  assert.deepEqual(notesOf('open_lid'), [
    "caster 'open box' is open: 16 boundary edges in 1 ring; techniques that need closed volumes " +
    'may fail (open_mesh)']);
  assert.deepEqual(notesOf('ordinary'), []);
  const { out } = shadowproof(['verify', 'open_lid', '--size', '64x64']);
  assert.ok(out.indexOf("note: caster 'open box'") < out.indexOf('zpass '), out);
});
