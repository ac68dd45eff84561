// Each hypothesis, on pictures in which just that is wrong: it is named first, with its parameter,
// explains nearly all and contradicts hardly anything. The evidence is withheld: a picture is all that
// there is.
import assert from 'node:assert/strict';
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { grayPng, readPng } from '../png.mjs';
import { scratch, shadowproof } from '../shadowproof.mjs';

const side = 256;
const size = ['--size', `${side}x${side}`];
const path = (name) => join(scratch, name);
const [lit, shadowed] = [255, 64];
const shade = { 0: 20, [shadowed]: 60, [lit]: 190 };
const sceneOf = (name) =>
  JSON.parse(readFileSync(join(process.env.SHADOWPROOF_SCENES, `${name}.gltf`), 'utf8'));

/** A class map, as (x, y) => 0, 64 or 255. */
function rendered(scene, ...more) {
  const run = shadowproof(['render', scene, ...size, ...more, '-o', 'classes.png', '-q']);
  assert.equal(run.code, 0, run.err);
  const png = readPng(path('classes.png'));
  return (x, y) => png.at(x, y)[0];
}

/** Of a scene that `change` has changed. */
function changed(scene, change) {
  const gltf = sceneOf(scene);
  change(gltf);
  writeFileSync(path('changed.gltf'), JSON.stringify(gltf));
  return rendered('changed.gltf');
}

function claimed(scene, technique, ...settings) {
  const run = shadowproof(['verify', scene, ...size, '--technique', technique, ...settings,
                           '--out', 'claims', '-q']);
  assert.ok(run.code <= 1, run.err);
  const png = readPng(path(`claims/${scene}/${technique}.claim.png`));
  return (x, y) => png.at(x, y)[0];
}

/** Where truth and picture are pictured, what differs is told by the first hypothesis. */
function diagnosed(scene, classes, hypothesis, ...view) {
  const off = rendered(scene, ...view);
  writeFileSync(path('off.png'), grayPng(side, side, (x, y) => 257 * (off(x, y) ? 60 : 20)));
  writeFileSync(path('mine.png'), grayPng(side, side, (x, y) =>
    257 * (off(x, y) ? shade[classes(x, y)] || 60 : 20)));
  const run = shadowproof(['check', scene, 'mine.png', '--unlit', 'off.png', '--no-alignment', ...view,
                           '--out', 'checked']);
  assert.equal(run.code, 1, run.out + run.err);
  const { scenes: [{ techniques: [cell] }] } = JSON.parse(readFileSync(path('checked/results.json')));
  const [best] = cell.diagnosis;
  const wrong = cell.falsely_lit + cell.falsely_shadowed;
  assert.equal(best?.hypothesis, hypothesis, run.out);
  assert.ok(best.explained >= 0.95 * wrong, run.out);
  assert.ok(best.contradicted <= Math.max(2, 0.01 * wrong), run.out);
  return best;
}

const near = (found, wanted, share = 0.02) =>
  assert.ok(Math.abs(found - wanted) <= share * Math.abs(wanted), `${found}, not ${wanted}`);

for (const scene of ['ordinary', 'overlapping', 'near_plane']) {
  test(`no shadow on ${scene}`, () => {
    const truth = rendered(scene);
    // Averted surfaces stay dark.
    const lights = rendered(scene);
    const all = claimed(scene, 'zfail');
    diagnosed(scene, (x, y) => (all(x, y) === shadowed && truth(x, y) ? lit : lights(x, y)), 'no_shadow');
  });
  test(`light and shadow exchanged on ${scene}`, () => {
    const truth = rendered(scene);
    diagnosed(scene, (x, y) => ({ 0: 0, [lit]: shadowed, [shadowed]: lit })[truth(x, y)], 'inverted');
  });
  test(`a light that is moved in ${scene}`, () => {
    const { light } = JSON.parse(shadowproof(['export-view', scene]).out);
    const by = [0.25, -0.15, 0.2];
    const { parameters } = diagnosed(scene, rendered(scene, '--light-position',
                                     light.position.map((at, i) => at + by[i]).join()), 'light_moved');
    // Within 2 % of the way from the light to the middle of the scene, near the origin.
    const off = Math.hypot(...['x', 'y', 'z'].map((axis, i) => parameters[axis] - by[i]));
    assert.ok(off <= 0.02 * Math.hypot(...light.position), JSON.stringify(parameters));
  });
  test(`a caster of ${scene} that casts no shadow`, () => {
    const name = { ordinary: 'ball', overlapping: 'copper', near_plane: 'planet' }[scene];
    const { words } = diagnosed(scene, changed(scene, ({ nodes }) => {
      nodes.find((node) => node.name === name).extras = { shadowproof: { casts: false } };
    }), 'caster_missing');
    assert.equal(words, `${name} casts no shadow`);
  });
}

test('the shadows of another light, in three pairs', () => {
  for (const [own, other] of [[0, 1], [1, 2], [2, 0]]) {
    const { parameters } = diagnosed('many_lights', rendered('many_lights', '--light', `${other}`),
                                     'other_light', '--light', `${own}`);
    assert.equal(parameters.light, other);
  }
});

for (const [scene, plane] of [['near_plane', 0.913], ['near_cap_some', null], ['near_cap_all', null]])
  test(`z-pass on ${scene}`, () => {
    const { parameters } = diagnosed(scene, claimed(scene, 'zpass'), 'zpass');
    if (plane) near(parameters.near, plane);
  });

test('z-fail with a far plane', () => {
  const view = JSON.parse(shadowproof(['export-view', 'far_plane']).out);
  const { parameters } = diagnosed('far_plane', claimed('far_plane', 'zfail'), 'zfail_far');
  assert.ok(parameters.far > view.camera.znear);
});

for (const [scene, length] of [['long_shadow', null], ['ordinary', 1.5], ['overlapping', 3]])
  test(`volumes of ${scene} that end too early`, () => {
    const { parameters } = diagnosed(scene, claimed(scene, 'zfail_truncated',
      ...(length ? ['--extrusion', `${length}`] : [])), 'short_volumes');
    if (length) near(parameters.length, length);
  });

for (const scene of ['ordinary', 'overlapping', 'near_plane'])
  test(`missing light caps on ${scene}`, () => {
    assert.deepEqual(diagnosed(scene, claimed(scene, 'zfail_no_light_cap'), 'missing_cap').parameters,
                     { light_cap: 0 });
  });

test('a counter of one bit', () => {
  assert.deepEqual(diagnosed('overlapping', claimed('overlapping', 'invert'), 'stencil_bits').parameters,
                   { bits: 1 });
});

for (const [scene, texels] of [['ordinary', 128], ['overlapping', 256], ['cube_edge', 64]])
  test(`a shadow map of ${texels} texels on ${scene}`, () => {
    const { parameters } = diagnosed(scene, claimed(scene, 'cube_map_six_pass',
                                     '--map-size', `${texels}`, '--map-bias', '0.15'), 'shadow_map');
    assert.equal(parameters.resolution, texels);
    // On overlapping coins nothing is as close to its shadow as the bias, or nearly: any will do.
    if (scene !== 'overlapping') near(parameters.bias, 0.15, 0.1);
  });

test('a shadow map of back faces alone', () => {
  const { parameters } = diagnosed('overlapping', claimed('overlapping', 'cube_map_six_pass',
    '--map-size', '128', '--map-bias', '0', '--map-culling', 'front'), 'shadow_map');
  assert.equal(parameters.culls_front, 1);
  assert.equal(parameters.resolution, 128);
});

// On `spot` 1024 texels are finer than the sixteenth of a pixel by which a renderer may move outlines.
for (const [scene, technique, texels] of [
  ['spot', 'spot_map', 64], ['spot', 'spot_map', 256], ['spot', 'spot_map', 512], ['sun', 'sun_map', 64],
  ['sun', 'sun_map', 128], ['sun', 'sun_map', 512], ['grazing_light', 'sun_map', 128]])
  test(`a ${technique} of ${texels} texels on ${scene}`, () => {
    const { parameters } = diagnosed(scene, claimed(scene, technique, '--map-size', `${texels}`),
                                     'shadow_map');
    assert.equal(parameters.resolution, texels);
    near(parameters.bias, 0.15, 0.1);
  });

// 200 texels are no power of two, which is all that a picture tells; how large they are, it does.
test('a map in parallel whose texels no engine offers', () => {
  const square = (texels) => diagnosed('sun', claimed('sun', 'sun_map', '--map-size', `${texels}`),
                                       'shadow_map').parameters;
  const fine = square(200);
  assert.equal(fine.resolution, undefined);
  near(fine.texel * 200, square(128).texel * 128, 0.005);
});

for (const [scene, technique, ...more] of [
  ['spot', 'spot_map', '--map-bias', '0.01', '--map-value', 'depth'],
  ['sun', 'sun_map', '--map-bias', '0.01'],
  ['ordinary', 'cube_map_six_pass', '--map-bias', '0.1', '--map-value', 'depth']])
  test(`a slope bias on ${scene}`, () => {
    const { parameters } = diagnosed(scene, claimed(scene, technique, '--map-size', '128',
      '--map-slope-bias', '2', ...more), 'shadow_map');
    assert.equal(parameters.resolution, 128);
    near(parameters.slope_bias, 2, 0.1);
  });

test('maps in front of which nothing was drawn: of back faces alone', () => {
  for (const [scene, technique] of [['spot', 'spot_map'], ['sun', 'sun_map']]) {
    const { parameters } = diagnosed(scene, claimed(scene, technique, '--map-size', '128', '--map-bias',
      '0.01', '--map-culling', 'front'), 'shadow_map');
    assert.equal(parameters.culls_front, 1);
    assert.equal(parameters.resolution, 128);
  }
});

test('beyond a far plane all is in shadow', () => {
  const spot = diagnosed('spot', claimed('spot', 'spot_map', '--map-far', '10', '--map-bias', '0.01'),
                         'shadow_map').parameters;
  assert.equal(spot.dark_outside, 1);
  near(spot.far, 10);
  const cube = diagnosed('ordinary', claimed('ordinary', 'cube_map_six_pass', '--map-far', '11',
                                             '--map-bias', '0.01'), 'shadow_map').parameters;
  assert.equal(cube.dark_outside, 1);
  near(cube.range, 11);
});

for (const [scene, epsilon] of [['ordinary', 0.2], ['ordinary', 0.5], ['overlapping', 0.5]])
  test(`rays on ${scene} that miss what is closer than ${epsilon}`, () => {
    near(diagnosed(scene, claimed(scene, 'traced_epsilon', '--ray-epsilon', `${epsilon}`),
                   'ray_epsilon').parameters.epsilon, epsilon, 0.1);
  });

test('shadow volumes before an orthographic camera, by what they lose', () => {
  const view = ['--ortho', '8'];
  const lost = (scene, technique, hypothesis) =>
    diagnosed(scene, claimed(scene, technique, ...view), hypothesis, ...view);
  const planes = (scene) => sceneOf(scene).cameras[0].perspective;
  near(lost('eye_inside', 'zpass', 'zpass').parameters.near, planes('eye_inside').znear);
  near(lost('far_plane', 'zfail', 'zfail_far').parameters.far, planes('far_plane').zfar);
  assert.equal(lost('ordinary', 'zfail_no_light_cap', 'missing_cap').parameters.light_cap, 0);
});
