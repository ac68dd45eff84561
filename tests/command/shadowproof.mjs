// Starts the command under test and cleans up behind it.
import { spawnSync } from 'node:child_process';
import { mkdtempSync, readdirSync, rmSync, statSync } from 'node:fs';
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
