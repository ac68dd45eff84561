// The view of a scene on its way into other engines, and back: export-view and the flags that
// stand in place of the file's camera and light.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { scratch, shadowproof } from '../shadowproof.mjs';

const viewOf = (...args) => {
  const run = shadowproof(['export-view', ...args]);
  assert.equal(run.code, 0, run.err);
  return JSON.parse(run.out);
};
const size = ['--size', '100x80'];

test('export-view prints the view for each engine, or for those that are named', () => {
  const view = viewOf('near_plane', ...size);
  assert.equal(view.schema, 'shadowproof/view/1');
  assert.deepEqual([view.width, view.height], [100, 80]);
  assert.deepEqual(Object.keys(view.engines),
                   ['three', 'babylon', 'godot', 'blender', 'ogre', 'unity', 'unreal']);
  for (const { camera, code } of Object.values(view.engines)) {
    assert.equal(camera.view_from_world.length, 4);
    assert.ok(code.length > 3);
  }
  assert.deepEqual(Object.keys(viewOf('near_plane', '--engine', 'ogre,three').engines),
                   ['three', 'ogre']);
  const unknown = shadowproof(['export-view', 'near_plane', '--engine', 'quake']);
  assert.equal(unknown.code, 2);
  assert.match(unknown.err, /'quake' is not known; there are three, babylon, godot/);
});

test('export-view writes a file, whole or not at all', () => {
  assert.equal(shadowproof(['export-view', 'spot', '-o', 'view.json']).out, '');
  assert.equal(JSON.parse(readFileSync(join(scratch, 'view.json'))).light.kind, 'spot');
  const run = shadowproof(['export-view', 'spot', '-o', 'missing/view.json']);
  assert.equal(run.code, 3);
  assert.match(run.err, /missing\/view\.json: cannot be written/);
});

const pictureOf = (name, ...args) => {
  const run = shadowproof(['render', ...args, ...size, '-o', `${name}.png`, '-q']);
  assert.equal(run.code, 0, run.err);
  return readFileSync(join(scratch, `${name}.png`));
};

test("the file's own view, given as numbers, is the same picture; another one is not", () => {
  const { camera, light } = viewOf('ordinary', ...size);
  const own = ['--camera-matrix', camera.matrix.join(), '--light-position', light.position.join(),
               '--fov', String(camera.yfov * 180 / Math.PI)];
  const given = pictureOf('given', 'ordinary', ...own);
  assert.ok(given.equals(pictureOf('own', 'ordinary')));
  for (const other of [['--light-position', light.position.map((x) => x + 0.5).join()],
                       ['--fov', '30'],
                       ['--camera-matrix', camera.matrix.map((m, i) => m + (i === 12)).join()]])
    assert.ok(!given.equals(pictureOf('other', 'ordinary', ...other)), other.join(' '));
});

test('an orthographic view, given as numbers, is the same picture; another one is not', () => {
  const parallel = ['--ortho', '7.5'];
  const { camera, light, engines } = viewOf('ordinary', ...size, ...parallel);
  assert.equal(camera.yfov, null);
  assert.equal(camera.extent.height, 7.5);
  assert.equal(engines.three.camera.field_of_view, null);
  assert.match(engines.three.code.join('\n'), /THREE\.OrthographicCamera\(-[\d.]+, [\d.]+, 3\.75, -3\.75, /);
  const own = ['--camera-matrix', camera.matrix.join(), '--light-position', light.position.join(),
               '--ortho', String(camera.extent.height)];
  const given = pictureOf('given', 'ordinary', ...own);
  assert.ok(given.equals(pictureOf('own', 'ordinary', ...parallel)));
  for (const other of [['--ortho', '7.6'], [], [...parallel, '--camera-matrix',
                       camera.matrix.map((m, i) => m + 0.1 * (i === 12)).join()]])
    assert.ok(!given.equals(pictureOf('other', 'ordinary', ...other)), other.join(' '));
});

test('the command that reproduces a cell has the view', () => {
  const run = shadowproof(['verify', 'near_plane', '--technique', 'zpass', ...size, '--fov', '35',
                           '--light-position', '-3.4,8.8,-0.7', '--gate', 'differences']);
  assert.equal(run.code, 1, run.out + run.err);
  assert.match(run.out, /reproduce: .*--light-position -3\.4,8\.8,-0\.7 --fov 35/);
});

test('what places no camera or light is refused by name', () => {
  const refused = (code, words, ...args) => {
    const run = shadowproof(['render', 'sun', '-o', 'x.png', ...args]);
    assert.equal(run.code, code, run.err);
    assert.match(run.err, words);
  };
  refused(2, /--fov: '180' is no angle between 0 and 180 degrees; give one, as 45/, '--fov', '180');
  refused(2, /--ortho: '-3' is no length above 0; give one, as 10/, '--ortho', '-3');
  refused(2, /--ortho excludes --fov|--fov excludes --ortho/, '--ortho', '3', '--fov', '40');
  refused(2, /--light-position: '1,2' is not 3 numbers/, '--light-position', '1,2');
  refused(2, /--camera-matrix: '1 0 x' is not 16 numbers/, '--camera-matrix', '1 0 x');
  refused(3, /--light-position: cannot move the light .* directional/, '--light-position', '1,2,3');
  refused(3, /--camera-matrix: mirrors/, '--camera-matrix', '-1,0,0,0,0,1,0,0,0,0,1,0,0,1,9,1');
});
