// What the tests of `shadowproof bench` share: runs that measure as little as can be.
import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import Ajv from 'ajv/dist/2020.js';
import { scratch, shadowproof } from '../shadowproof.mjs';

const schema = JSON.parse(readFileSync(new URL('../../../docs/bench.schema.json', import.meta.url)));
const validate = new Ajv({ strict: true, allErrors: true }).compile(schema);
const reportSchema = JSON.parse(readFileSync(new URL('../../../docs/results.schema.json', import.meta.url)));
const validateReport = new Ajv({ strict: true, allErrors: true }).compile(reportSchema);
export const assertReport = (report) =>
  assert.ok(validateReport(report), JSON.stringify(validateReport.errors, null, 1));
export const assertValid = (run) => assert.ok(validate(run), JSON.stringify(validate.errors, null, 1));
export const written = (name) => JSON.parse(readFileSync(join(scratch, name), 'utf8'));
export const write = (name, json) => writeFileSync(join(scratch, name), JSON.stringify(json));

/** As little measuring as there can be: one sample of each point. */
export const least = ['--quick', '--size', '48x48', '--repeats', '1', '--no-pictures', '-q'];

/** The point of a run that has the technique and settings of another. */
export const pointOf = (run, { technique, settings }) => run.points.find(
  (point) => point.technique === technique &&
             JSON.stringify(point.settings) === JSON.stringify(settings));

export function benched(name, args) {
  const run = shadowproof(['bench', ...args, ...least, '--json', name]);
  assert.equal(run.code, 0, run.out + run.err);
  return written(name);
}

/** Starts a run and interrupts it as soon as `isReached`. Returns when it has ended. */
export async function interrupted(args, isReached) {
  const run = spawn(process.env.SHADOWPROOF, args, { cwd: scratch });
  const ended = new Promise((done) => run.on('exit', done));
  while (!isReached() && run.exitCode === null) await new Promise((done) => setTimeout(done, 50));
  run.kill('SIGINT');
  await ended;
}
