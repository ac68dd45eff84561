// three.js itself, by the script that stands in the docs: a person's renderer as it is. Its shadow maps
// are wrong near outlines, and the finer they are, the less; what is wrong is named.
import assert from 'node:assert/strict';
import { existsSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { grayPng, readPng } from '../png.mjs';
import { scratch, shadowproof } from '../shadowproof.mjs';

const script = fileURLToPath(new URL('../../../docs/recipes/three.mjs', import.meta.url));
const modules = fileURLToPath(new URL('../..', import.meta.url));

function checked(scene, env = {}, twins = '{unlit}') {
  const run = shadowproof(['check', scene, '--name', 'three', '--out', 'checked', '--renderer',
    `${process.execPath} '${script}' {scene} {view} {out} ${twins}`], { env: { MODULES: modules, ...env } });
  assert.ok(run.code <= 1, run.out + run.err);
  const { scenes: [{ techniques: [cell] }] } =
    JSON.parse(readFileSync(join(scratch, 'checked/results.json'), 'utf8'));
  return { ...run, cell, wrong: cell.falsely_lit + cell.falsely_shadowed };
}

for (const scene of ['ordinary', 'sun', 'spot'])
  test(`three.js shows ${scene} from the same view, and is wrong along the shadows' outlines alone`, () => {
    const { cell, wrong } = checked(scene);
    assert.ok(wrong > 0 && wrong < 0.003 * cell.pixels, `${wrong} of ${cell.pixels}`);
    assert.ok(cell.undecidable < 0.01 * cell.pixels);
    assert.ok(existsSync(join(scratch, `checked/rendered/${scene}/unlit.png`)));
  });

test('the map of three.js is named: its size, and that it holds back faces, side by side', () => {
  for (const texels of [256, 512]) {
    const { cell: { diagnosis: [best] }, wrong } = checked('overlapping', { MAP_SIZE: `${texels}` });
    assert.equal(best.hypothesis, 'shadow_map');
    const { resolution, culls_front, inset } = best.parameters;
    assert.deepEqual([resolution, culls_front, inset], [texels, 1, 1]);
    assert.ok(best.explained > 0.9 * wrong, `${best.explained} of ${wrong}`);
  }
});

for (const scene of ['sun', 'spot'])
  test(`the map of three.js is named on ${scene}, whose texels nobody tells`, () => {
    for (const texels of [128, 512]) {
      const { cell: { diagnosis: [best] }, wrong } = checked(scene, { MAP_SIZE: `${texels}` });
      assert.equal(best.hypothesis, 'shadow_map');
      assert.equal(best.parameters.resolution, texels);
      assert.equal(best.parameters.culls_front, 1);
      assert.ok(best.explained > 0.7 * wrong, `${best.explained} of ${wrong}`);
      assert.ok(best.contradicted <= 0.01 * wrong, `${best.contradicted} of ${wrong}`);
    }
  });

// Texels of a pixel: their steps are not seen, but the light's camera is where the file has the light.
test('the map of three.js is named on sun, whose texels are as fine as pixels', () => {
  const { cell: { diagnosis: [best] }, wrong } = checked('sun', { MAP_SIZE: '1024' });
  assert.equal(best.hypothesis, 'shadow_map');
  assert.equal(best.parameters.resolution, 1024);
  assert.ok(Math.abs(best.parameters.texel * 1024 - 10) < 1e-9);
  assert.ok(best.explained > 0.8 * wrong, `${best.explained} of ${wrong}`);
});

// Its own filters, which it takes where nothing is said: soft shadows, whose steps are hardly seen.
for (const [scene, type, filtered] of [
  ['overlapping', 'PCFShadowMap', [2, undefined, 1]], ['sun', 'PCFShadowMap', [2, undefined, 1]],
  ['spot', 'PCFSoftShadowMap', [3, 1, undefined]]])
  test(`the ${type} of three.js is named on ${scene}, with its filter`, () => {
    const { cell: { diagnosis: [best] }, wrong } = checked(scene, { MAP_SIZE: '128', MAP_TYPE: type });
    assert.equal(best.hypothesis, 'shadow_map');
    const { resolution, filter, smooth, points } = best.parameters;
    assert.equal(resolution, 128);
    assert.deepEqual([filter, smooth, points], filtered);
    assert.ok(best.explained > 0.9 * wrong, `${best.explained} of ${wrong}`);
    assert.ok(best.contradicted < 0.1 * wrong, `${best.contradicted} of ${wrong}`);
  });

test('shadows that end with the square of a directional light are told, and where it ends', () => {
  const { cell: { diagnosis: [best] }, wrong } = checked('sun', { HALF_SIDE: '3', MAP_SIZE: '256' });
  assert.equal(best.hypothesis, 'shadow_map');
  const { right, top, texel, resolution } = best.parameters;
  assert.equal(resolution, 256); // of a square around the light: two ends are seen, and no two opposite ones
  for (const [found, truly] of [[right, 3], [top, 3], [texel, 6 / 256]])
    assert.ok(Math.abs(found - truly) <= 0.02 * truly, `${found}, not ${truly}`);
  assert.ok(best.explained > 0.95 * wrong, `${best.explained} of ${wrong}`);
});

test('no pixel is wrong on a round surface that the light grazes', () => {
  const { cell: { regions = [] } } = checked('sun', { MAP_SIZE: '4096' });
  assert.deepEqual(regions.filter(({ receiver }) => receiver === 'knob'), []);
});

test('a coarser map of three.js is worse', () => {
  assert.ok(checked('ordinary', { MAP_SIZE: '128' }).wrong > 2 * checked('ordinary').wrong);
});

// Smooth normals, bump maps, textures and highlights are the engine's own; so are its shadow maps.
for (const scene of ['ordinary', 'spot', 'coarse_curve', 'bumpy_torus'])
  test(`with both twins, ${scene} may be shaded as the file has it`, () => {
    const { cell, wrong } = checked(scene, { MATERIALS: 'file', MAP_SIZE: '2048', NORMAL_BIAS: '0.01' },
                                    '{unlit} {unshadowed}');
    assert.ok(wrong < 0.003 * cell.pixels, `${wrong} of ${cell.pixels}`);
    assert.ok(existsSync(join(scratch, `checked/rendered/${scene}/unshadowed.png`)));
  });

// Its shading put together with the shadows of the truth is a right picture, however it is shaded.
for (const scene of ['ordinary', 'spot', 'coarse_curve', 'bumpy_torus'])
  test(`three.js's own shading of ${scene} with true shadows agrees, and with shadows aside does not`, () => {
    checked(scene, { MATERIALS: 'file' }, '{unlit} {unshadowed}');
    const rendered = (name) => readPng(join(scratch, `checked/rendered/${scene}/${name}.png`));
    const [dark, bright] = [rendered('unlit'), rendered('unshadowed')];
    const truth = join(scratch, 'truth.png');
    assert.equal(shadowproof(['render', scene, '-o', truth, '-q']).code, 0);
    const { width, height, at } = readPng(truth);
    const gray = ([r, g, b]) => 257 * Math.round((r + g + b) / 3); // eight bits still
    const write = (name, value) => {
      writeFileSync(join(scratch, name), grayPng(width, height, value));
      return name;
    };
    const off = write('off.png', (x, y) => gray(dark.at(x, y)));
    const bare = write('bare.png', (x, y) => gray(bright.at(x, y)));
    const shown = (aside) => write('shaded.png', (x, y) =>
      gray((at(Math.min(x + aside, width - 1), y)[0] === 255 ? bright : dark).at(x, y)));
    for (const twins of [['--unlit', off], ['--unlit', off, '--unshadowed', bare]]) {
      const right = shadowproof(['check', scene, shown(0), ...twins, '--out', 'shaded']);
      assert.equal(right.code, 0, right.out + right.err);
      const wrong = shadowproof(['check', scene, shown(3), ...twins, '--out', 'shaded', '--no-alignment',
                                 '--no-diagnosis']);
      assert.equal(wrong.code, 1, wrong.out + wrong.err);
    }
  });
