// Starts the command under test and cleans up behind it.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { mkdtempSync, readFileSync, readdirSync, rmSync, statSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after } from 'node:test';

/** An empty folder of this test file alone, removed after its tests. */
export const scratch = mkdtempSync(join(tmpdir(), 'shadowproof-test-'));
after(() => rmSync(scratch, { recursive: true }));

/**
 * Runs `shadowproof ARGS`: { code, signal, out, err }. code is null where a signal ended it, and
 * where `seconds` went by: it hangs.
 */
export function shadowproof(args, { env = {}, seconds = 800 } = {}) {
  const run = spawnSync(process.env.SHADOWPROOF, args, {
    cwd: scratch,
    encoding: 'utf8',
    env: { ...process.env, ...env },
    timeout: seconds * 1000,
    killSignal: 'SIGKILL',
  });
  return { code: run.status, signal: run.signal, out: run.stdout, err: run.stderr };
}

/** Whether a technique, as list has it, suits a scene without bump maps under a point light. */
export const isForPointLights = ({ needs_bump_maps, lights }) =>
  !needs_bump_maps && lights.includes('point');

/** Paths, relative to a folder, of all files below it. */
export function filesBelow(folder, prefix = '') {
  return readdirSync(join(folder, prefix)).sort().flatMap((name) => {
    const path = join(prefix, name);
    return statSync(join(folder, path)).isDirectory() ? filesBelow(folder, path) : [path];
  });
}

/** Results as they are but for times. */
export function timeless(results) {
  const copy = structuredClone(results);
  delete copy.ms;
  delete copy.report_ms;
  for (const scene of copy.scenes) {
    delete scene.spent_ms;
    delete scene.reference?.ms;
    delete scene.reference?.build_ms;
    for (const cell of scene.techniques ?? []) {
      delete cell.ms;
      delete cell.spent_ms;
      delete cell.saved?.ms;
      delete cell.saved?.plan_ms;
      delete cell.map?.ms;
    }
  }
  return copy;
}

/** Two reports, in folders of `scratch`, that are the same to the byte but for times. */
export function assertSameReport(folder, whole) {
  const resultsOf = (name) => JSON.parse(readFileSync(join(scratch, name, 'results.json')));
  // As text, in which the order of members counts.
  const text = (name) => JSON.stringify(timeless(resultsOf(name)), null, 1);
  assert.equal(text(folder), text(whole));
  const files = filesBelow(join(scratch, whole));
  assert.deepEqual(filesBelow(join(scratch, folder)), files);
  for (const file of files.filter((name) => !/^(results\.js|manifest\.json)/.test(name)))
    assert.deepEqual(readFileSync(join(scratch, folder, file)),
                     readFileSync(join(scratch, whole, file)), file);
}
