// Programs whose file operations fail, or that are killed, where a test says so; and what stands in
// a folder, to compare with.
import assert from 'node:assert/strict';
import { spawn, spawnSync } from 'node:child_process';
import { lstatSync, mkdtempSync, readFileSync, readdirSync, readlinkSync, rmSync, writeFileSync }
  from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after } from 'node:test';

/** An empty folder of this test file alone, removed after its tests. */
export const scratch = mkdtempSync(join(tmpdir(), 'shadowproof-output-'));
after(() => rmSync(scratch, { recursive: true, force: true }));

const counter = join(scratch, '.counter');

/** Runs `command`: { code, signal, out, err }; code is null where a signal ended it, or it hung. */
export function run(command, { cwd = scratch, env = {}, seconds = 120 } = {}) {
  const done = spawnSync(command[0], command.slice(1), {
    cwd, encoding: 'utf8', env: { ...process.env, ...env }, timeout: seconds * 1000,
    killSignal: 'SIGKILL',
  });
  return { code: done.status, signal: done.signal, out: done.stdout, err: done.stderr };
}

/** Settings of file_faults.cpp for what happens below a folder. */
export function faults(below, settings = {}) {
  writeFileSync(counter, Buffer.alloc(16));
  return { LD_PRELOAD: process.env.FILE_FAULTS, FAULTS_BELOW: below, FAULTS_COUNTER: counter,
           ...Object.fromEntries(Object.entries(settings).map(([key, value]) =>
             [`FAULTS_${key.toUpperCase()}`, String(value)])) };
}

/** Only what changes something counts: killed while it reads, a program leaves what there was before. */
export const changes = { changes: 1 };
/** The operation that is reached kills the program. */
export const killed = { kill: 1, ...changes };

/** How many file operations below a folder a command makes. */
export function operationsOf(command, below, { cwd, ...settings } = {}) {
  const { code, out, err } = run(command, { cwd, env: faults(below, settings) });
  assert.ok(code === 0, out + err);
  const calls = Number(readFileSync(counter).readBigUInt64LE(0));
  assert.ok(calls > 5, `${calls} file operations: the shim counts nothing`);
  return calls;
}

/** The calls below a folder, in their order, that write, sync, link or rename: "fsync report". */
export function loggedOf(command, below, { cwd, ...settings } = {}) {
  const log = join(scratch, '.log');
  writeFileSync(log, '');
  const { code, out, err } = run(command, { cwd, env: faults(below, { log, ...settings }) });
  assert.ok(code === 0, out + err);
  return readFileSync(log, 'utf8').trim().split('\n')
    .map((line) => line.replace(/\S*#\d+ \(deleted\)$/, 'unnamed').replace(/\.shadowproof-\S+$/, 'passing'));
}

/**
 * Kills a command with SIGKILL after some milliseconds, unless it ended. Returns when it has ended:
 * with its children, or a moment before them.
 */
export async function killedAfter(milliseconds, command, { cwd = scratch, children = true } = {}) {
  // Children hold the pipe that they inherit until they end.
  const stdio = ['ignore', children ? 'pipe' : 'ignore', 'ignore'];
  const child = spawn(command[0], command.slice(1), { cwd, stdio });
  child.stdout?.resume();
  const ended = new Promise((resolve) => child.on('close', resolve));
  const timer = setTimeout(() => child.kill('SIGKILL'), milliseconds);
  await ended;
  clearTimeout(timer);
}

/** All that is below a folder: path to content, "-> target" of links, "folder" of folders. */
export function contentOf(folder, prefix = '', all = {}) {
  for (const name of readdirSync(join(folder, prefix)).sort()) {
    const path = join(prefix, name);
    const status = lstatSync(join(folder, path));
    if (status.isDirectory()) {
      all[path] = 'folder';
      contentOf(folder, path, all);
    } else if (status.isSymbolicLink()) {
      all[path] = `-> ${readlinkSync(join(folder, path))}`;
    } else {
      all[path] = status.isFile() ? readFileSync(join(folder, path), 'latin1') : 'special';
    }
  }
  return all;
}

/** A run that could not: exit code 3, and one sentence that names no passing name. */
export function assertRefused({ code, signal, err }, where) {
  assert.equal(code, 3, `${where}: ${code} ${signal} ${err}`);
  assert.match(err, /^\w+: [^\n]+: [^\n]+; [^\n]+\n$/, where);
  assert.doesNotMatch(err, /\.shadowproof-|\.writing\/report|\/proc\/self/, where);
}
