// A renderer for tests, as `check --renderer` starts it: HOW SCENE VIEW OUT [UNLIT]. It takes camera,
// light and size from VIEW alone.
import { spawn, spawnSync } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';
import { grayPng } from '../png.mjs';

const [how, scene, viewFile, out, unlit] = process.argv.slice(2);
const { width, height, camera, light } = JSON.parse(readFileSync(viewFile, 'utf8'));

function render(position, file) {
  const run = spawnSync(process.env.SHADOWPROOF, ['render', scene, '--size', `${width}x${height}`,
    '--camera-matrix', camera.matrix.join(),
    ...(camera.extent ? ['--ortho', String(camera.extent.height)]
      : ['--fov', String(camera.yfov * 180 / Math.PI)]),
    ...(light.kind === 'directional' ? [] : ['--light-position', position.join()]),
    '-o', file, '-q'], { encoding: 'utf8' });
  if (run.status !== 0) throw new Error(run.stderr);
}

if (how === 'fail') {
  console.error('no GPU was found');
  process.exit(7);
} else if (how === 'crash') {
  process.kill(process.pid, 'SIGSEGV');
} else if (how === 'hang') {
  // So does what it has started.
  spawn('sleep', ['600'], { stdio: 'inherit' });
  setTimeout(() => {}, 600000);
} else if (how === 'blank') {
  writeFileSync(out, grayPng(width, height, () => 30000));
} else if (how === 'empty') {
  writeFileSync(out, '');
} else if (how === 'moved') {
  render(light.position.map((x, i) => x + (i === 0) * 2), out);
} else if (how === 'right') {
  render(light.position, out);
  // Where the twin is darker by nothing at all, there is shadow.
  if (unlit) writeFileSync(unlit, grayPng(width, height, () => 64 * 257));
}
