// A report as of another run, whose scenes have other names: many cells without the time that
// drawing them takes.
import { cpSync, mkdirSync, readFileSync, readdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';

/** Copies the report `from` to `to`; each scene's name, and its folder, begin with `prefix`. */
export function copyReport(from, to, prefix) {
  mkdirSync(to, { recursive: true });
  const results = JSON.parse(readFileSync(join(from, 'results.json')));
  for (const scene of results.scenes) {
    const renamed = (path) => prefix + path;
    cpSync(join(from, scene.folder), join(to, renamed(scene.folder)), { recursive: true });
    rename(join(to, renamed(scene.folder)), prefix);
    scene.name = renamed(scene.name);
    scene.folder = renamed(scene.folder);
    for (const { images } of [scene, ...scene.techniques])
      for (const kind of Object.keys(images)) images[kind] = renamed(images[kind]);
  }
  writeFileSync(join(to, 'results.json'), `${JSON.stringify(results, null, 1)}\n`);
}

/** Scripts say at their beginning whose they are: shadowproof.cell("near_plane/zpass", ... */
function rename(folder, prefix) {
  for (const entry of readdirSync(folder, { withFileTypes: true })) {
    const path = join(folder, entry.name);
    if (entry.isDirectory()) rename(path, prefix);
    else if (entry.name.endsWith('.js'))
      writeFileSync(path, readFileSync(path, 'latin1').replace('("', `("${prefix}`), 'latin1');
  }
}
