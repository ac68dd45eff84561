// results.json against the JSON Schema of the repository, and its sums.
import assert from 'node:assert/strict';
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import Ajv from 'ajv/dist/2020.js';
import { scratch, shadowproof } from './shadowproof.mjs';

const schema = JSON.parse(readFileSync(new URL('../../docs/results.schema.json', import.meta.url)));
const validate = new Ajv({ strict: true, allErrors: true }).compile(schema);

function resultsOf(args) {
  const run = shadowproof([...args, '--json', 'results.json']);
  return { code: run.code, ...JSON.parse(readFileSync(join(scratch, 'results.json'), 'utf8')) };
}
function assertValid({ code, ...results }) {
  assert.ok(validate(results), JSON.stringify(validate.errors, null, 1));
}

// Whole runs of every scene are tests of their own.
const all = resultsOf(['verify', 'ordinary', 'eye_inside', 'many_lights', 'nested', 'open_lid',
                       'light_inside', '--size', '96x96']);

test('the results of scenes of every kind are valid', () => assertValid(all));

test('the gate, the verdicts and the exit code say the same', () => {
  const verdicts = all.scenes.flatMap((scene) => scene.techniques.map((cell) => cell.verdict));
  const bad = verdicts.some((verdict) => verdict === 'defect' || verdict === 'unexplained');
  // So few pixels need not show all that a scene provokes.
  const missed = all.scenes.some((scene) => scene.no_longer_provoked.length > 0);
  assert.equal(all.passed, !bad && !missed);
  assert.equal(all.code, bad || missed ? 1 : 0);
});

test('pixels add up: classes to the picture, causes to the differing, ledger to the picture', () => {
  const sum = (numbers) => numbers.reduce((total, number) => total + number, 0);
  for (const scene of all.scenes) {
    const { lit, shadowed, background } = scene.reference;
    assert.equal(lit + shadowed + background, scene.width * scene.height);
    for (const cell of scene.techniques) {
      assert.equal(sum(Object.values(cell.causes)), cell.differing);
      if (cell.ledger) assert.equal(sum(Object.values(cell.ledger)), cell.pixels);
      assert.equal('first' in cell, cell.differing > 0);
    }
  }
});

test('figures of volumes are those that were predicted, and each ray has its pixel', () => {
  for (const scene of all.scenes) {
    const { rays, lit, shadowed } = scene.reference;
    const pixels = scene.width * scene.height;
    assert.ok(rays >= pixels && rays <= pixels + lit + shadowed);
    for (const { name, volumes, volume_fragments: shown, saved, ...cell } of scene.techniques) {
      if (!volumes) continue; // of another family
      const { fragments, against } = volumes;
      assert.equal(volumes.checked, cell.pixels);
      assert.equal(volumes.unexplained, 0);
      assert.equal(fragments.shown, shown);
      assert.ok(fragments.low <= shown && shown <= fragments.high, `${scene.name}/${name}`);
      assert.equal(against?.shown, saved && shown + saved.volume_fragments);
      assert.ok(!('words' in volumes));
    }
  }
});

test('results whose figures contradict each other are refused, and the figure is named', () => {
  const refused = (change, figure) => {
    const { code, ...results } = structuredClone(all);
    change(results.scenes[0], results.scenes[0].techniques[0]);
    writeFileSync(join(scratch, 'changed.json'), JSON.stringify(results));
    const run = shadowproof(['report', '--from', 'changed.json', '--out', 'changed']);
    assert.equal(run.code, 3, run.err);
    assert.match(run.err, figure);
  };
  refused((scene, cell) => (cell.volume_fragments += 1), /volumes\/fragments\/shown/);
  refused((scene, cell) => (cell.volumes.checked -= 1), /volumes\/checked/);
  refused((scene, cell) => (cell.volumes.unexplained = 3), /volumes/);
  refused((scene) => (scene.reference.rays = 1), /reference\/rays/);
});

test('what a family adds to its cells is checked by that family, and by no other', () => {
  const report = (family, change) => {
    const { code, ...results } = structuredClone(all);
    const cells = results.scenes.flatMap(({ techniques }) => techniques);
    change(cells.find((cell) => cell.family === family));
    writeFileSync(join(scratch, 'changed.json'), JSON.stringify(results));
    return shadowproof(['report', '--from', 'changed.json', '--out', 'changed']);
  };
  for (const [family, change, why] of [
    ['stencil', (cell) => delete cell.ledger, /lacks "ledger"/],
    ['stencil', (cell) => (cell.ledger.equal += 1), /ledger adds up to/],
    ['stencil', (cell) => delete cell.volumes, /lacks "volumes"/],
    ['map', (cell) => (cell.map.size = 0), /map\/size must be/],
    ['traced', (cell) => delete cell.rays, /lacks "rays"/],
    ['traced', (cell) => (cell.rays.unexplained += 1), /rays adds up to/],
  ]) {
    const run = report(family, change);
    assert.equal(run.code, 3, `${family}: ${change}`);
    assert.match(run.err, why);
  }
  // Of a family that this program does not know, what all families have is enough.
  assert.notEqual(report('stencil', (cell) => {
    cell.family = 'later';
    delete cell.ledger;
  }).code, 3);
});

test('the report folder holds the same results as --json, but for nothing', () => {
  const folder = JSON.parse(readFileSync(join(scratch, 'report/results.json'), 'utf8'));
  const { code, ...results } = all;
  assert.deepEqual(folder, results);
});

test('a claim of shares of light tells how many pixels and how wrong they are, validly', () => {
  const results = resultsOf(['verify', 'spot', '--technique',
                             'spot_map,spot_map_pcf,spot_map_stencil,spot_map_dual_texture',
                             '--map-size', '64', '--size', '96x96']);
  assertValid(results);
  const [whole, shared, , ramp] = results.scenes[0].techniques;
  assert.equal(ramp.map.format, 'ramp8');
  assert.ok(shared.partly_lit > 0 && shared.partly_lit <= shared.differing);
  assert.ok(shared.wrongness > 0 && shared.wrongness < shared.differing);
  assert.ok(shared.causes.filter > 0);
  assert.deepEqual([whole.partly_lit, whole.wrongness], [undefined, undefined]);
});

test('a map of a sun tells its slope bias where it has one, validly', () => {
  const args = ['verify', 'sun', '--technique', 'sun_map', '--map-size', '64', '--size', '96x96'];
  const sloped = resultsOf([...args, '--map-slope-bias', '1.1']);
  assertValid(sloped);
  const [{ map }] = sloped.scenes[0].techniques;
  assert.ok(Math.abs(map.slope_bias - 1.1) < 1e-6);
  assert.equal(map.value, 'depth');
  assert.equal(map.texels_unexplained, 0);
  const plain = resultsOf(args);
  assertValid(plain);
  assert.equal(plain.scenes[0].techniques[0].map.slope_bias, undefined);
});

test('a scene that cannot be read is an error in valid results, and the others are tried', () => {
  writeFileSync(join(scratch, 'broken.gltf'), '{');
  const results = resultsOf(['verify', 'broken.gltf', 'ordinary', '--technique', 'zfail',
                             '--size', '32x32']);
  assertValid(results);
  assert.equal(results.code, 3);
  assert.equal(results.passed, false);
  assert.match(results.scenes[0].error, /broken\.gltf/);
  assert.equal(results.scenes[1].techniques.length, 1);
});

test('the schema refuses what is not so', () => {
  const { code, ...results } = all;
  const changed = (change) => {
    const copy = structuredClone(results);
    change(copy);
    return copy;
  };
  assert.ok(!validate(changed((copy) => delete copy.gl)));
  assert.ok(!validate(changed((copy) => (copy.schema = 'shadowproof/results/2'))));
  assert.ok(!validate(changed((copy) => (copy.scenes[0].techniques[0].verdict = 'fine'))));
  assert.ok(!validate(changed((copy) => (copy.scenes[0].techniques[0].causes.moon = 1))));
  assert.ok(!validate(changed((copy) => (copy.scenes[0].techniques[0].images.claim = '../x.png'))));
});

test('results of a run with allowances and a baseline are valid', () => {
  shadowproof(['verify', 'near_plane', '--size', '64x64', '--json', 'earlier.json']);
  const results = resultsOf(['verify', 'near_plane', '--size', '64x64', '--allow', 'near_plane=3,edge',
                             '--baseline', 'earlier.json']);
  assertValid(results);
  assert.equal(results.baseline.file, 'earlier.json');
  assert.ok(results.scenes[0].techniques.every((cell) => cell.since.new === 0));
});
