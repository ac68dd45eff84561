// Files with several lights, and lights of every kind.
import assert from 'node:assert/strict';
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { scratch, shadowproof } from './shadowproof.mjs';

const ordinary = JSON.parse(
  readFileSync(new URL('../../scenes/bundled/ordinary.gltf', import.meta.url)));
const small = ['--size', '64x64', '--technique', 'zfail_reversed'];

/** The scene `ordinary` in file `name` under lights of its own: [{ light, node }]. */
function sceneUnder(name, lights) {
  const gltf = structuredClone(ordinary);
  const place = gltf.nodes.findIndex((node) => node.name === 'light');
  const lamp = gltf.nodes[place];
  gltf.extensions.KHR_lights_punctual.lights = lights.map(({ light }) => light);
  lights.forEach(({ node }, i) => {
    const at = i === 0 ? place : gltf.nodes.length;
    gltf.nodes[at] = { ...lamp, ...node, extensions: { KHR_lights_punctual: { light: i } } };
    if (i > 0) gltf.scenes[0].nodes.push(at);
  });
  writeFileSync(join(scratch, name), JSON.stringify(gltf));
}
const point = (name, translation) => ({ light: { type: 'point', name }, node: { translation, name } });

function resultsOf(args) {
  const run = shadowproof(['verify', ...args, ...small, '--json', 'results.json']);
  return { ...run, results: JSON.parse(readFileSync(join(scratch, 'results.json'), 'utf8')) };
}
const namesOf = ({ scenes }) => scenes.map(({ name, light }) => [name, light]);

sceneUnder('three.gltf', [point('left one', [-3.5, 8.9, -0.7]), point('right', [4.5, 7.9, 1.7]),
                          point('right', [0.5, 6.9, 3.7])]);

test('every light of a file is judged by itself, and named where its name tells it', () => {
  const { code, err, out, results } = resultsOf(['three.gltf']);
  assert.equal(code, 0, out + err);
  assert.deepEqual(namesOf(results), [['three-left one', 'left one'], ['three-right', 'right'],
                                      ['three-2', 'right']]);
  assert.deepEqual(results.scenes.map(({ folder }) => folder),
                   ['three-left_one', 'three-right', 'three-2']);
  assert.equal(new Set(results.scenes.map(({ digest }) => digest)).size, 3);
  assert.equal(new Set(results.scenes.map(({ reference }) => reference.lit)).size, 3);
  for (const { notes } of results.scenes) assert.doesNotMatch(notes.join('\n'), /is judged/);
});

test('the command that shows a cell again judges its light alone, to the same pixels', () => {
  const { results } = resultsOf(['three.gltf']);
  assert.deepEqual(results.scenes.map(({ techniques: [cell] }) =>
    cell.command.match(/--light (\S+(?: one')?)/)[1]), ["'left one'", 'right', '2']);
  results.scenes.forEach((scene, i) => {
    const alone = resultsOf(['three.gltf', '--light', ['left one', 'right', '2'][i]]).results;
    assert.deepEqual(namesOf(alone), [['three', scene.light]]);
    assert.equal(alone.scenes[0].digest, scene.digest);
    assert.equal(alone.scenes[0].reference.lit, scene.reference.lit);
    assert.deepEqual(alone.scenes[0].techniques[0].causes, scene.techniques[0].causes);
    assert.match(alone.scenes[0].notes.join('\n'), /3 lights in the file: light \d "[^"]+" is judged/);
  });
});

test('a file of one light keeps its name, and its command names no light', () => {
  sceneUnder('one.gltf', [point('lamp', [-3.5, 8.9, -0.7])]);
  const { results } = resultsOf(['one.gltf']);
  assert.deepEqual(namesOf(results), [['one', 'lamp']]);
  assert.doesNotMatch(results.scenes[0].techniques[0].command, /--light/);
});

test('names that coincide with those of other files stay apart', () => {
  sceneUnder('three-right.gltf', [point('lamp', [-3.5, 8.9, -0.7])]);
  const { results } = resultsOf(['three-right.gltf', 'three.gltf']);
  assert.deepEqual(results.scenes.map(({ name }) => name),
                   ['three-right', 'three-left one', 'three-right-2', 'three-2']);
});

test('a light whose name is another one’s number is chosen by what chooses it', () => {
  sceneUnder('numbers.gltf', [point('1', [-3.5, 8.9, -0.7]), point('0', [4.5, 7.9, 1.7])]);
  const { results } = resultsOf(['numbers.gltf']);
  assert.deepEqual(namesOf(results), [['numbers-1', '1'], ['numbers-0', '0']]);
  for (const scene of results.scenes) {
    const alone = resultsOf(['numbers.gltf', '--light', scene.light]).results;
    assert.equal(alone.scenes[0].digest, scene.digest);
  }
});

/** Lit pixels of the truth. */
function litUnder(name, lights) {
  sceneUnder(name, lights);
  const run = shadowproof(['render', name, '-o', 'truth.png', '--size', '64x64']);
  assert.equal(run.code, 0, run.err);
  return Number(run.out.match(/lit ([\d,]+)/)[1].replaceAll(',', ''));
}

test('render knows suns and spots, and a spot lights no more than the point in its place', () => {
  const translation = [-3.471, 8.877, -0.683];
  const down = { name: 'lamp', translation, rotation: [-Math.SQRT1_2, 0, 0, Math.SQRT1_2] };
  const spot = (outerConeAngle) =>
    [{ light: { type: 'spot', spot: { outerConeAngle } }, node: down }];
  const everywhere = litUnder('point.gltf', [point('lamp', translation)]);
  const wide = litUnder('wide.gltf', spot(1.2));
  const narrow = litUnder('narrow.gltf', spot(0.3));
  assert.ok(narrow > 0 && narrow < wide && wide <= everywhere, `${[narrow, wide, everywhere]}`);
  assert.ok(litUnder('sun.gltf', [{ light: { type: 'directional' }, node: down }]) > 0);
});

test('explain says where a sun shines to and draws its arrow', () => {
  sceneUnder('sun.gltf', [{ light: { type: 'directional', name: 'sun' },
                            node: { rotation: [-Math.SQRT1_2, 0, 0, Math.SQRT1_2] } }]);
  const run = shadowproof(['explain', 'sun.gltf', '--pixel', '30,40', '--technique', 'zfail',
                           '--size', '64x64', '--json', 'pixel.json']);
  const { light } = JSON.parse(readFileSync(join(scratch, 'pixel.json'), 'utf8'));
  assert.equal(light.kind, 'directional');
  assert.ok(Math.abs(light.direction[1] + 1) < 1e-12, `${light.direction}`);
  assert.ok(!('position' in light));
  assert.match(run.out, /light     sun shining along \(/);
});

test('what does not cast casts no shadow, and what does not receive shows none', () => {
  const litWith = (flags) => {
    const gltf = structuredClone(ordinary);
    for (const [node, says] of Object.entries(flags))
      gltf.nodes.find(({ name }) => name === node).extras = { shadowproof: says };
    writeFileSync(join(scratch, 'flags.gltf'), JSON.stringify(gltf));
    const run = shadowproof(['render', 'flags.gltf', '-o', 'truth.png', '--size', '64x64']);
    return Number(run.out.match(/lit ([\d,]+)/)[1].replaceAll(',', ''));
  };
  const all = litWith({});
  const noBall = litWith({ ball: { casts: false } });
  const bareFloor = litWith({ floor: { receives: false } });
  assert.ok(noBall > all, `${noBall} > ${all}`);
  assert.ok(bareFloor > noBall, `${bareFloor} > ${noBall}`);
});

test('a spot too wide for one map is judged without spot maps, unless they are named', () => {
  const spot = JSON.parse(
    readFileSync(new URL('../../scenes/bundled/spot.gltf', import.meta.url)));
  const [lamp] = spot.extensions.KHR_lights_punctual.lights;
  for (const [outer, isWide] of [[1.49, false], [1.55, true]]) {
    lamp.spot.outerConeAngle = outer;
    writeFileSync(join(scratch, 'wide.gltf'), JSON.stringify(spot));
    const run = (...more) => shadowproof(['verify', 'wide.gltf', '--size', '48x48', '--json', 'wide.json', ...more]);
    const { code, out, err } = run();
    assert.ok(code <= 1, out + err);
    const names = JSON.parse(readFileSync(join(scratch, 'wide.json'), 'utf8'))
      .scenes[0].techniques.map(({ name }) => name);
    assert.ok(names.includes('zpass') && names.includes('cube_map_six_pass'));
    assert.equal(names.some((name) => name.startsWith('spot_map')), !isWide);
    const note = /outerConeAngle of 1\.55 is too wide for one map, which spot maps need: they are left out unless named/;
    assert[isWide ? 'match' : 'doesNotMatch'](out, note);
    const named = run('--technique', 'spot_map');
    assert.equal(named.code === 3, isWide, named.out);
    if (isWide) assert.match(named.out, /make its outerConeAngle at most 1\.5/);
  }
});
