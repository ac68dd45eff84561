// `shadowproof stress` and --stress as their users meet them. No test holds a time.
import assert from 'node:assert/strict';
import { existsSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import Ajv from 'ajv/dist/2020.js';
import { scratch, shadowproof } from './shadowproof.mjs';

const schema = JSON.parse(readFileSync(new URL('../../docs/stress.schema.json', import.meta.url)));
const validate = new Ajv({ strict: true, allErrors: true, allowUnionTypes: true }).compile(schema);
const assertValid = (run) => assert.ok(validate(run), JSON.stringify(validate.errors, null, 1));
const written = (name) => JSON.parse(readFileSync(join(scratch, name), 'utf8'));

const small = ['--size', '48x48', '--witness', '24'];
const stressed = (args) => shadowproof(['stress', ...args, ...small]);

const told = stressed(['near_plane', '--technique', 'zpass,zfail,zfail_reversed,cube_map_six_pass',
                       '--parameter', 'near_plane,light_to_face,coincident_faces',
                       '--json', 'stress.json', '--out', 'stress']);
const run = written('stress.json');
const wrong = ({ differing, causes }) => differing - (causes.edge ?? 0);
const along = (technique, parameter) => run.points.filter((point) =>
  point.technique === technique && point.parameter === parameter && !point.refused);

test('what it writes is valid by its schema, and in its folder too', () => {
  assert.equal(told.code, 0, told.out + told.err);
  assertValid(run);
  assert.deepEqual(written('stress/results.json'), run);
});

test('each parameter goes from the scene as it is to its end, on both its sides', () => {
  const values = along('truth', 'near_plane').map(({ value }) => value);
  assert.deepEqual(values, [...values].sort((a, b) => a - b));
  assert.equal(values[0], 1e-7);
  assert.equal(values.at(-1), 1);
  assert.equal(along('truth', 'light_to_face')[0].value, 0);
  for (const parameter of ['near_plane', 'light_to_face', 'coincident_faces'])
    assert.equal(along('truth', parameter).filter(({ own }) => own).length, 1);
});

test('the witness decides pixels of every point again, and agrees', () => {
  for (const { witness } of run.points.filter(({ technique, refused }) =>
    technique === 'truth' && !refused)) {
    assert.equal(witness.asked, 24);
    assert.equal(witness.disagreements, 0);
  }
  assert.match(told.out, /truth and witness differ at 0 of [\d,]+ pixels/);
});

test('the truth is the same however the scene is told, at every point', () => {
  for (const { relations } of run.points.filter(({ technique, refused }) =>
    technique === 'truth' && !refused)) {
    assert.ok(relations.tried.length >= 5, relations.tried.join());
    assert.ok(relations.compared >= 4 * 48 * 48);
    assert.equal(relations.changed, 0);
  }
  assert.match(told.out, /told otherwise [\d,]+ times changes 0 pixels/);
});

test('a technique that is wrong before has no breaking point, and is said', () => {
  const [{ parameters }] = run.scenes;
  assert.ok(parameters[0].wrong_before.includes('zpass'));
  assert.ok(!run.breaking.some(({ technique }) => technique === 'zpass'));
  assert.match(told.out, /wrong as it is +zpass/);
});

test('breaking points lie between the last value that holds and the first that fails', () => {
  for (const { technique, parameter, side, holds, measured, cause } of run.breaking) {
    const up = side === 'up';
    const points = along(technique, parameter);
    const inside = points.filter(({ value }) => (up ? value <= holds : value >= holds));
    const own = points.find((point) => point.own).value;
    for (const point of inside.filter(({ value }) => (up ? value >= own : value <= own)))
      assert.equal(wrong(point), 0, `${technique} ${parameter} ${point.value}`);
    if (measured === null) continue;
    const there = points.find(({ value }) => value === measured);
    assert.ok(wrong(there) > 0);
    assert.ok(there.causes[cause] > 0);
    if (measured > 0 && holds > 0 && parameter !== 'coincident_faces')
      assert.ok(Math.max(measured / holds, holds / measured) <= 1.11, `${technique} ${parameter}`);
  }
});

test('where depths no longer suffice is derived to within a factor of 4', () => {
  const scenes = ['ordinary', 'near_plane', 'far_plane', 'overlapping', 'coarse_curve'];
  const { code, err } = shadowproof(['stress', ...scenes, '--parameter', 'near_plane',
    '--technique', 'zpass,zfail,zfail_infinite,zfail_reversed', '--witness', '1',
    '--json', 'derived.json', '--no-pictures', '-q']);
  assert.ok([0, 1].includes(code), err);
  const { breaking } = written('derived.json');
  const both = breaking.filter(({ derived, measured }) => derived !== null && measured !== null);
  for (const cause of ['precision', 'near_plane'])
    assert.ok(both.filter((each) => each.cause === cause).length >= 4, cause);
  for (const { scene, technique, side, derived, measured } of both)
    assert.ok(Math.max(derived / measured, measured / derived) <= 4,
              `${scene} ${technique} ${side}: derived ${derived}, measured ${measured}`);
  // Depth that floats reversed hold breaks nowhere, and nothing else is derived.
  const alone = breaking.filter(({ derived, measured }) => (derived === null) !== (measured === null));
  assert.deepEqual(alone, []);
});

test('where rays break is derived to within a factor of 4', () => {
  const { code, err } = shadowproof(['stress', 'nested', 'seen_shadow', '--parameter',
    'origin_distance,scale', '--technique', 'traced_epsilon', '--witness', '1',
    '--json', 'rays.json', '--no-pictures', '-q']);
  assert.ok([0, 1].includes(code), err);
  const { breaking } = written('rays.json');
  const broken = breaking.filter(({ measured }) => measured !== null);
  for (const cause of ['acne', 'leak'])
    assert.ok(broken.filter((each) => each.cause === cause).length >= 2, cause);
  for (const { scene, parameter, derived, measured } of broken)
    assert.ok(Math.max(derived / measured, measured / derived) <= 4,
              `${scene} ${parameter}: derived ${derived}, measured ${measured}`);
  const alone = breaking.filter(({ derived, measured }) => (derived === null) !== (measured === null));
  assert.deepEqual(alone, []);
});

test('z-fail without a far plane outlasts any near plane that floats of depth resolve', () => {
  const near = along('zfail_reversed', 'near_plane').filter(({ value }) => value <= 0.01);
  assert.ok(near.length > 2);
  for (const point of near) assert.equal(wrong(point), 0, `${point.value}`);
});

test('a point is shown again by its command: the same causes, and its pictures are there', () => {
  const point = along('cube_map_six_pass', 'light_to_face')
    .find(({ value, own }) => value > 1 && !own);
  const words = point.command.split(' ').slice(1);
  const again = shadowproof([...words, '--json', 'again.json', '--out', 'again', '-q']);
  assert.ok([0, 1].includes(again.code), again.err);
  const [cell] = written('again.json').scenes[0].techniques;
  assert.deepEqual(cell.causes, point.causes);
  assert.equal(cell.differing, point.differing);
  const [page, place] = point.pictures.split('#');
  assert.ok(existsSync(join(scratch, 'stress', page)));
  assert.ok(existsSync(join(scratch, 'stress', 'pictures', `${place}.claim.png`)), place);
});

test('settings of maps are taken from end to end too, on maps alone, and shown again by their flags', () => {
  const { code, err } = stressed(['near_plane', '--technique', 'zfail,cube_map_six_pass', '--parameter',
    'map_size,map_bias,map_range', '--json', 'maps.json', '--out', 'maps', '-q', '--no-pictures']);
  assert.equal(code, 0, err);
  const maps = written('maps.json');
  assertValid(maps);
  assert.ok(!maps.points.some(({ technique }) => technique === 'zfail'));
  const wrongAt = (parameter, value) => wrong(maps.points.find((point) =>
    point.technique === 'cube_map_six_pass' && point.parameter === parameter &&
    (value === 'own' ? point.own : point.value === value)));
  assert.ok(wrongAt('map_size', 4) > 10 * wrongAt('map_size', 'own'));
  assert.ok(wrongAt('map_bias', 0) > wrongAt('map_bias', 'own')); // acne
  assert.ok(wrongAt('map_bias', 1000) > wrongAt('map_bias', 'own')); // leaks
  assert.ok(wrongAt('map_range', 0.01) > wrongAt('map_range', 'own'));
  assert.ok(wrongAt('map_range', 1e6) > wrongAt('map_range', 'own')); // the near plane goes along
  const coarse = maps.points.find(({ parameter, technique, value }) =>
    parameter === 'map_size' && technique === 'cube_map_six_pass' && value === 4);
  assert.match(coarse.command, /--map-size 4$/);
  const refused = shadowproof(['verify', 'ordinary', '--stress', 'map_size=4', '-q']);
  assert.equal(refused.code, 3);
  assert.match(refused.err + refused.out, /is a setting of techniques; give --map-size instead/);
});

test('--stress takes one scene to a value, for any command', () => {
  const stress = ['--stress', 'aspect=16', '--size', '64x64'];
  const { code, err } = shadowproof(['render', 'ordinary', '-o', 'wide.png', ...stress]);
  assert.equal(code, 0, err);
  const bytes = readFileSync(join(scratch, 'wide.png'));
  assert.deepEqual([bytes.readUInt32BE(16), bytes.readUInt32BE(20)], [256, 16]);
  const told = shadowproof(['explain', 'ordinary', '--pixel', '130,9', ...stress]);
  assert.equal(told.code, 0, told.err);
  const refused = (text, words) => {
    const { code: refusal, err: why } = shadowproof(['verify', 'ordinary', '--stress', text]);
    assert.equal(refusal, 2, why);
    assert.match(why, words);
  };
  refused('wind=1', /no parameter 'wind'; there are near_plane/);
  refused('aspect', /gives no number/);
  refused('aspect=wide', /gives no number/);
  const far = shadowproof(['verify', 'ordinary', '--stress', 'aspect=1e9', '-q']);
  assert.equal(far.code, 3);
  assert.match(far.err + far.out, /aspect=1000000000: is out of range/);
});

test('verify --witness says that the truth was decided again', () => {
  const { code, out } = shadowproof(['verify', 'light_in_plane', '--technique', 'zfail_reversed',
                                     '--size', '40x40', '--witness', '100', '--out', 'witnessed']);
  assert.equal(code, 0);
  assert.match(out, /note: 100 pixels decided again by the witness, 50 of them undecided by filters: all agree/);
});

test('scenes that cannot be read end nothing, and are said', () => {
  const { code, err } = stressed(['ordinary', 'none.gltf', '--technique', 'zfail_reversed',
                                  '--parameter', 'aspect', '--json', 'some.json', '--no-pictures',
                                  '-q']);
  assert.equal(code, 3);
  assert.match(err, /none\.gltf/);
  const some = written('some.json');
  assertValid(some);
  assert.ok(some.scenes[1].error);
  assert.ok(some.points.length > 0);
});

test('the same input gives the same points, but for times', () => {
  const points = ['one', 'two'].map((name) => {
    stressed(['ordinary', '--technique', 'zfail,traced_epsilon', '--parameter', 'scale',
              '--json', `${name}.json`, '--no-pictures', '-q',
              '--threads', name === 'one' ? '1' : '3']);
    return written(`${name}.json`).points.map(({ ms, judging_ms: judging, ...rest }) => rest);
  });
  assert.deepEqual(points[0], points[1]);
});
