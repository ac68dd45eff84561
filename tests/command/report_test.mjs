// The report folder, the lines on the console, and JUnit.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { before, test } from 'node:test';
import { inflateSync } from 'node:zlib';
import { filesBelow, isForPointLights, scratch, shadowproof } from './shadowproof.mjs';

const techniques = JSON.parse(shadowproof(['list', '--json']).out).techniques
  .filter(isForPointLights).map(({ name }) => name);
let run;
before(() => {
  run = shadowproof(['verify', 'ordinary', 'near_plane', '--out', 'a', '--junit', 'junit.xml']);
});

test('the same run gives the same bytes, but for the results, which hold times, and what lists them', () => {
  shadowproof(['verify', 'ordinary', 'near_plane', '--out', 'b', '--threads', '1']);
  const files = filesBelow(join(scratch, 'a'));
  assert.deepEqual(filesBelow(join(scratch, 'b')), files);
  for (const file of files.filter((name) => !/^(results\.js(on)?|manifest\.json)$/.test(name)))
    assert.deepEqual(readFileSync(join(scratch, 'b', file)), readFileSync(join(scratch, 'a', file)),
                     file);
});

test('cells that have a picture or a block alike share it, and lack none', () => {
  const files = filesBelow(join(scratch, 'a'));
  const { scenes } = JSON.parse(readFileSync(join(scratch, 'a/results.json'), 'utf8'));
  const seen = { pictures: 0, shared: 0, blocks: 0, references: 0 };
  for (const { folder, techniques: cells } of scenes) {
    const script = (name) => readFileSync(join(scratch, 'a', folder, `${name}.cell.js`), 'latin1');
    const pictures = cells.flatMap(({ images }) => Object.values(images));
    assert.ok(pictures.every((path) => files.includes(path)));
    const distinct = [...new Set(pictures)].map((path) =>
      readFileSync(join(scratch, 'a', path), 'latin1'));
    assert.equal(new Set(distinct).size, distinct.length, 'two files are the same');
    seen.pictures += distinct.length;
    seen.shared += pictures.length - distinct.length;
    const blocks = [];
    for (const { name } of cells)
      for (const [, block, from, text] of
        script(name).matchAll(/^"(\w+)":\{(?:"from":"([^"]+)"|"type")(.*)/gm)) {
        if (from) {
          const [other, named] = from.split('/');
          assert.match(script(other), new RegExp(`^"${named}":\\{"type"`, 'm'), `${name}: ${block}`);
          ++seen.references;
        } else if (text.length > 200) {
          blocks.push(text.replace(/\}+\);$|,$/, ''));
        }
      }
    assert.equal(new Set(blocks).size, blocks.length, 'two blocks are the same');
    seen.blocks += blocks.length;
  }
  for (const count of Object.values(seen)) assert.ok(count > 50, JSON.stringify(seen));
});

test('a second run replaces the report whole and leaves nothing beside it', () => {
  shadowproof(['verify', 'near_plane', '--technique', 'zpass', '--out', 'c']);
  shadowproof(['verify', 'ordinary', '--technique', 'zfail', '--out', 'c']);
  assert.deepEqual(filesBelow(join(scratch, 'c')), [
    'index.html', 'manifest.json', 'ordinary/scene.js', 'ordinary/truth.png', 'ordinary/zfail.cause.png',
    'ordinary/zfail.cell.js', 'ordinary/zfail.claim.png', 'ordinary/zfail.difference.png',
    'results.js', 'results.json']);
  assert.ok(filesBelow(scratch).every((file) => !/\.writing/.test(file)));
});

test('the page names no file but the results, and is the same for every run', () => {
  const page = readFileSync(join(scratch, 'a/index.html'), 'utf8');
  const named = [...page.matchAll(/ (?:src|href)="([^"#]+)"|@import|\burl\(/g)];
  assert.deepEqual(named.map((match) => match[1]), ['results.json', 'results.js']);
  shadowproof(['verify', 'far_plane', '--technique', 'zfail', '--size', '32x32', '--out', 'other']);
  assert.equal(readFileSync(join(scratch, 'other/index.html'), 'utf8'), page);
});

test('results.js runs the results, but for the cause maps, which the cells have', () => {
  const results = JSON.parse(readFileSync(join(scratch, 'a/results.json'), 'utf8'));
  for (const { techniques: cells } of results.scenes)
    for (const cell of cells) delete cell.cause_map;
  let given;
  new Function('shadowproof', readFileSync(join(scratch, 'a/results.js'), 'utf8'))(
    { results: (results) => { given = results; } });
  given.scenes = given.scenes.map((scene) => JSON.parse(inflateSync(Buffer.from(scene, 'base64'))));
  assert.deepEqual(given, results);
});

test('elsewhere than on a terminal there is no colour and no progress line', () => {
  assert.doesNotMatch(run.out, /[\x1b\r]/);
});

test('each cell has its line, in the order of the techniques', () => {
  const line = /^\w+ +(ordinary|near_plane)  (agrees|fails_as_predicted|defect|unexplained) +[\d,]+ of 262,144( \(.+\))?(  first \(\d+,\d+\) \w+)?.*  \d+\.\d ms$/;
  const cells = run.out.split('\n').filter((text) => line.test(text));
  assert.equal(cells.length, 2 * techniques.length, run.out);
  assert.deepEqual(cells.slice(0, techniques.length).map((text) => text.split(' ')[0]), techniques);
});

test('quiet prints the end alone where nothing failed', () => {
  const quiet = shadowproof(['verify', 'ordinary', '-q', '--out', 'q']);
  assert.equal(quiet.code, 0, quiet.out);
  assert.match(quiet.out, /^passed: \d+ cells; report in q\/index\.html\n$/);
});

test('a gate on differences fails where the gate on defects passes, and says how to see it', () => {
  const args = ['verify', 'near_plane', '--technique', 'zpass', '--out', 'g'];
  assert.equal(shadowproof(args).code, 0);
  const gated = shadowproof([...args, '--gate', 'differences']);
  assert.equal(gated.code, 1);
  assert.match(gated.out,
               /^reproduce: shadowproof verify near_plane --technique zpass --gate differences$/m);
});

test('the same file twice has two folders of pictures', () => {
  const twice = shadowproof(['verify', 'ordinary', 'ordinary', '--technique', 'zfail', '--size',
                             '32x32', '--out', 't']);
  assert.equal(twice.code, 0, twice.out + twice.err);
  const files = filesBelow(join(scratch, 't'));
  assert.ok(files.includes('ordinary/truth.png') && files.includes('ordinary-2/truth.png'));
});

test('JUnit has a suite a scene and a case a cell', () => {
  const xml = readFileSync(join(scratch, 'junit.xml'), 'utf8');
  assert.match(xml, /^<\?xml version="1.0" encoding="UTF-8"\?>\n<testsuites>\n/);
  assert.equal([...xml.matchAll(/<testsuite /g)].length, 2);
  assert.equal([...xml.matchAll(/<testcase /g)].length, 2 * techniques.length);
});
