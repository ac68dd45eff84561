// One pixel: the text, the JSON and the drawing are the same story.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { scratch, shadowproof } from './shadowproof.mjs';

function explained(scene, pixel, more = []) {
  const run = shadowproof(['explain', scene, '--pixel', pixel, '--json', 'pixel.json', '--svg',
                           'pixel.svg', ...more]);
  assert.equal(run.code, 0, run.err);
  return {
    text: run.out,
    record: JSON.parse(readFileSync(join(scratch, 'pixel.json'), 'utf8')),
    svg: readFileSync(join(scratch, 'pixel.svg'), 'utf8'),
  };
}

test('every crossing of the record is a line of the text, with its running sum', () => {
  const { text, record } = explained('near_plane', '229,103');
  let inside = record.inside.eye;
  for (const { depth, change, caster } of record.crossings) {
    inside += change;
    const line = text.split('\n').find((each) => each.includes(`triangle ${caster.triangle} of`) &&
                                                 each.trim().startsWith(String(depth).slice(0, 7)));
    assert.ok(line, `${depth} in\n${text}`);
    assert.match(line, new RegExp(`\\${change > 0 ? '+' : '-'}1 +${inside} `));
  }
  assert.equal(inside, record.inside.infinity);
});

test('the depth to which a technique\'s numbers suffice follows from the scene\'s near plane', () => {
  const { text, record } = explained('ordinary', '256,256', ['--technique', 'zfail,zfail_reversed']);
  const [zfail, reversed] = record.techniques;
  const deeper = explained('ordinary', '256,256',
                           ['--technique', 'zfail', '--stress', 'near_plane=0.0913']).record;
  assert.equal(zfail.sufficient.from, record.near);
  assert.ok(Math.abs(zfail.sufficient.to / deeper.techniques[0].sufficient.to -
                     record.near / deeper.near) < 0.2);
  assert.deepEqual(reversed.sufficient, { from: record.near, to: null });
  const [, told] = text.match(/zfail .* to ([\d.]+) /);
  assert.ok(Math.abs(told / zfail.sufficient.to - 1) < 1e-3);
  assert.match(text, /zfail_reversed .* at any depth /);
});

test('what a technique lost makes the difference between its counter and the right one', () => {
  for (const [scene, pixel, technique, loss] of [
    ['near_plane', '229,103', 'zpass', /before the near plane$/m],
    ['far_plane', '340,99', 'zfail', /past the far plane$/m],
    ['eye_inside', '369,84', 'zpass', /around the eye$/m],
  ]) {
    const { text, record } = explained(scene, pixel, ['--technique', technique]);
    const [told] = record.techniques;
    const counted = record.crossings.reduce((sum, { change }, i) =>
      sum + (told.statuses[i] === 'counted' ? change : 0), 0);
    const caps = told.dark_cap === 'counted' ? record.inside.infinity : 0;
    assert.equal(told.test === 'depth_pass' ? counted : caps - counted, told.predicted);
    assert.notEqual(told.predicted, record.inside.surface);
    assert.match(text, loss);
  }
});

test('the drawing is an SVG of the technique that differs, and says what it claims', () => {
  const { svg } = explained('near_plane', '229,103');
  assert.match(svg, /^<svg [^>]*xmlns="http:\/\/www\.w3\.org\/2000\/svg"/);
  assert.match(svg, /<title>[^<]*zpass/);
  assert.match(svg, /claims shadowed/);
  assert.match(svg, /<\/svg>\s*$/);
});

test('a drawing for what counts no volumes shows them all, and says what it claims', () => {
  for (const technique of ['cube_map_six_pass', 'traced_epsilon']) {
    const { record, svg } = explained('near_plane', '229,103', ['--technique', technique]);
    assert.ok(record.crossings.length > 0);
    assert.match(svg, new RegExp(`<title>[^<]*${technique}`));
    assert.match(svg, new RegExp(`Counts no volumes; claims ${record.techniques[0].claim}\\.`));
    assert.doesNotMatch(svg, /undefined|NaN/);
  }
});

test('a drawing for a map holds its comparison, and one for a traced claim its ray', () => {
  const said = (text) => text.replace(/<[^>]*>/g, ' ').replace(/\s+/g, ' '); // rows are wrapped
  const { record, svg: drawn } = explained('near_plane', '229,103', ['--technique', 'cube_map_pcf']);
  const svg = said(drawn);
  const { map } = record.techniques[0];
  const digits = (value) => String(Number(value.toPrecision(6)));
  const is = map.stored + map.bias < map.own ? 'less than' : 'not less than';
  assert.ok(svg.includes(`${digits(map.stored)} + ${digits(map.bias)} is ${is} ${digits(map.own)}`));
  assert.ok(svg.includes(`own point ${digits(map.own)}`));
  assert.ok(svg.includes(`Texel (${map.texel[0]}, ${map.texel[1]}) of face ${map.face}, ${map.size}`));
  assert.ok(svg.includes(`${map.lit} of ${map.of} comparisons find light`));
  const traced = explained('ordinary', '300,300', ['--technique', 'traced_epsilon']);
  const { hits } = traced.record.techniques[0].shadow_ray;
  assert.ok(traced.svg.includes(`meets triangle ${hits[0].triangle}, ${digits(hits[0].t)}`));
});

test('before an orthographic camera lines come from infinity, and volumes are counted from there', () => {
  const { text, record, svg } = explained('eye_inside', '256,200',
                                          ['--ortho', '8', '--technique', 'zpass,zfail_reversed']);
  assert.equal(record.orthographic, true);
  const sums = { eye: record.inside.eye };
  const within = (depth) => record.crossings.filter((crossing) => crossing.depth < depth)
    .reduce((sum, { change }) => sum + change, sums.eye);
  assert.equal(within(record.near), record.inside.near);
  assert.equal(within(record.far), record.inside.far);
  assert.equal(within(Infinity), record.inside.infinity);
  assert.ok(record.crossings.some(({ depth }) => depth < record.near));
  const along = record.seen.point.map((x, i) => (x - record.eye[i]) / record.seen.depth);
  along.forEach((x, i) => assert.ok(Math.abs(x - record.direction[i]) < 1e-9));
  const [zpass, zfail] = record.techniques;
  assert.notEqual(zpass.predicted, zfail.predicted);
  assert.equal(zpass.cause, 'near_plane');
  assert.equal(zfail.predicted, record.inside.surface);
  assert.match(text, /shadow volumes along the ray/);
  assert.match(svg, /at infinity/);
  assert.doesNotMatch(svg, /NaN|Infinity/);
});

test('a drawing that cannot be written is an error that names the file', () => {
  const run = shadowproof(['explain', 'ordinary', '--pixel', '9,9', '--size', '32x32', '--svg',
                           'missing/x.svg']);
  assert.equal(run.code, 3);
  assert.match(run.err, /missing\/x\.svg/);
});

test('where one limitation alone is not the cause, all that are needed are named', () => {
  const { text, record } = explained('light_inside', '179,114', ['--technique', 'zfail,zpass']);
  assert.deepEqual(record.techniques.map(({ name, cause, also }) => [name, cause, also]),
                   [['zfail', 'far_plane', ['light_inside']], ['zpass', 'light_inside', []]]);
  assert.match(text, /^ +zfail +.* lit +far_plane with light_inside$/m);
  assert.match(text, /^ +zpass +.* lit +light_inside$/m);
});
