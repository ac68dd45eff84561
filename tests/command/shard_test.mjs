// Parts of a run for several machines, and a run that goes on where it was cut off: together they
// write what one run would have written.
import assert from 'node:assert/strict';
import { spawn, spawnSync } from 'node:child_process';
import { copyFileSync, cpSync, existsSync, mkdirSync, readFileSync, readdirSync, renameSync,
         rmSync, statSync, truncateSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { before, test } from 'node:test';
import { setTimeout as pause } from 'node:timers/promises';
import { assertSameReport, filesBelow, scratch, shadowproof } from './shadowproof.mjs';

const size = ['--size', '48x48'];
const bundled = process.env.SHADOWPROOF_SCENES;
// Two files of one name, one that cannot be read, several lights, bump maps, and a name that a light
// of another scene has too; techniques that are for all of them. The matrix below has all.
const scenes = ['near_plane', 'a/spot.gltf', 'torn.gltf', 'b/spot.gltf', 'many_lights',
                'many_lights-key.gltf', 'bumpy_sphere', 'sun', '--technique',
                'zpass,zfail,zfail_reversed,invert,auto,traced_epsilon,traced_skip'];
const resultsOf = (folder) => JSON.parse(readFileSync(join(scratch, folder, 'results.json')));
const cellsOf = (folder) => resultsOf(folder).scenes.flatMap(({ name, techniques, error }) =>
  error ? [name] : techniques.map((cell) => `${name} ${cell.name}`));

function verify(out, words, { code = 3 } = {}) {
  const run = shadowproof(['verify', ...words, ...size, '--out', out, '-q']);
  assert.equal(run.code, code, run.out + run.err);
  return run;
}

before(() => {
  for (const folder of ['a', 'b']) mkdirSync(join(scratch, folder));
  copyFileSync(join(bundled, 'spot.gltf'), join(scratch, 'a/spot.gltf'));
  copyFileSync(join(bundled, 'long_shadow.gltf'), join(scratch, 'b/spot.gltf'));
  copyFileSync(join(bundled, 'ordinary.gltf'), join(scratch, 'many_lights-key.gltf'));
  writeFileSync(join(scratch, 'torn.gltf'), '{');
  verify('whole', scenes);
});

/** The shards of a run, in folders; `code`: those that their exit codes may be. */
function shards(of, words, prefix) {
  return Array.from({ length: of }, (_, i) => {
    const out = `${prefix}${i + 1}`;
    const run = shadowproof(['verify', ...words, ...size, '--out', out, '-q', '--shard',
                             `${i + 1}/${of}`]);
    assert.ok([0, 1, 3].includes(run.code), run.out + run.err);
    return out;
  });
}

test('shards of any number become the report of one run', () => {
  const all = new Set(cellsOf('whole'));
  for (const of of [1, 2, 5]) {
    const parts = shards(of, scenes, `of${of}-`);
    const seen = parts.flatMap(cellsOf);
    assert.equal(new Set(seen).size, seen.length, 'a cell is tried once');
    assert.deepEqual(new Set(seen), all);
    const run = shadowproof(['merge', ...parts.reverse(), '--out', `joined${of}`, '--json',
                             `joined${of}.json`, '-q']);
    assert.equal(run.code, 3, run.out + run.err);
    assertSameReport(`joined${of}`, 'whole');
    assert.deepEqual(readFileSync(join(scratch, `joined${of}.json`)),
                     readFileSync(join(scratch, `joined${of}`, 'results.json')));
  }
});

test('the same cells come to the same shard, and the report of one says which it is', () => {
  const [again] = shards(1, [...scenes], 'again-');
  assert.deepEqual(cellsOf(again), cellsOf('of1-1'));
  const { out } = verify('again-of5', [...scenes, '--shard', '3/5'],
                         { code: resultsOf('of5-3').passed ? 0 : 3 });
  assert.match(out, / of part 3 of 5[,;]/);
  assert.deepEqual(cellsOf('again-of5'), cellsOf('of5-3'));
  const { shard } = resultsOf('again-of5');
  assert.deepEqual([shard.number, shard.of, shard.run],
                   [3, 5, resultsOf('of5-1').shard.run]);
  assert.equal(resultsOf('joined5').shard, undefined);
  // A report of its own, made again as it is.
  const run = shadowproof(['report', '--from', 'of5-3', '--out', 'rebuilt', '-q']);
  assert.ok([0, 3].includes(run.code), run.err);
  assertSameReport('rebuilt', 'of5-3');
});

test('more shards than cells: some have none, and all become one run', () => {
  const words = ['near_plane', '--technique', 'zpass,zfail'];
  verify('few', words, { code: 0 });
  const parts = shards(4, words, 'few-');
  assert.deepEqual(parts.map((part) => cellsOf(part).length), [1, 1, 0, 0]);
  assert.equal(shadowproof(['merge', ...parts, '--out', 'few-joined', '-q']).code, 0);
  assertSameReport('few-joined', 'few');
});

test('a shard that is missing, given twice or of another run is refused by name', () => {
  const merge = (...parts) => shadowproof(['merge', ...parts, '--out', 'refused', '-q']);
  for (const [parts, words] of [
    [['of5-1', 'of5-2', 'of5-4', 'of5-5'], /of5-1[^\n]*: is shard 1\/5, and shard 3\/5 is not there/],
    [['of5-1'], /shard 2\/5 is not there/],
    [['of5-1', 'of5-2', 'of5-3', 'of5-4', 'of5-5', 'of5-2'],
     /of5-2[^\n]*: is shard 2\/5, which was given already/],
    [['of2-1', 'of2-2', 'of5-3'], /of5-3[^\n]*: is shard 3\/5 of another run/],
    [['few-1', 'of2-1'], /of another run/],
  ]) {
    const run = merge(...parts);
    assert.equal(run.code, 3, run.out);
    assert.match(run.err, words);
    assert.ok(!existsSync(join(scratch, 'refused')));
  }
  for (const text of ['0/2', '3/2', '1', '1/0', 'a/b', '1/2/3', '-1/2']) {
    const run = shadowproof(['verify', 'near_plane', '--shard', text]);
    assert.equal(run.code, 2, text);
    assert.match(run.err, /--shard/);
  }
});

test('what is said of a baseline is what one run would say', () => {
  verify('earlier', ['near_plane', 'far_plane', 'sun', '--technique', 'zpass,zfail,invert'], { code: 0 });
  const words = ['near_plane', 'sun', 'spot', '--technique', 'zfail,zp_plus,invert', '--baseline', 'earlier'];
  const code = verify('compared', words, { code: 0 }).code;
  const parts = shards(3, words, 'compared-');
  assert.equal(shadowproof(['merge', ...parts, '--out', 'compared-joined', '-q']).code, code);
  assertSameReport('compared-joined', 'compared');
  const { notes } = resultsOf('compared').baseline;
  for (const note of ['far_plane was not tried now', 'zpass on near_plane was not tried now', 'spot is new'])
    assert.ok(notes.includes(note), notes.join('\n'));
});

test('parts that were planned of different scenes are of different runs', () => {
  const words = ['late.gltf', 'near_plane', 'sun', '--technique', 'zpass,zfail,invert'];
  const codes = [3, 0, 0];
  const parts = codes.map((code, i) => {
    verify(`planned${i + 1}`, [...words, '--shard', `${i + 1}/3`], { code });
    return `planned${i + 1}`;
  });
  copyFileSync(join(bundled, 'ordinary.gltf'), join(scratch, 'late.gltf'));
  verify('planned1', [...words, '--shard', '1/3'], { code: 0 });
  const run = shadowproof(['merge', ...parts, '--out', 'refused', '-q']);
  assert.equal(run.code, 3, run.out);
  assert.match(run.err, /planned2[^\n]*: is shard 2\/3 of another run than planned1/);
  rmSync(join(scratch, 'late.gltf'));
});

test('a scene that stops provoking fails, also where shards have split it', () => {
  // The bundled scenes, of which one declares more than it shows.
  const changed = join(scratch, 'changed');
  cpSync(bundled, changed, { recursive: true });
  const file = join(changed, 'thin_caster.gltf');
  const gltf = JSON.parse(readFileSync(file));
  gltf.extras.shadowproof.provokes.push('far_plane');
  writeFileSync(file, JSON.stringify(gltf));
  const run = (...args) => shadowproof([...args, '-q'], { env: { SHADOWPROOF_SCENES: changed } });
  const whole = run('verify', 'thin_caster', '--out', 'stopped');
  assert.equal(whole.code, 1, whole.out + whole.err);
  assert.match(whole.out, /no technique shows far_plane any more, which the scene declares/);
  const parts = [1, 2, 3].map((number) => {
    const part = run('verify', 'thin_caster', '--out', `stopped${number}`, '--shard', `${number}/3`);
    assert.equal(part.code, 0, part.out + part.err);
    return `stopped${number}`;
  });
  const merged = run('merge', ...parts, '--out', 'stopped-joined');
  assert.equal(merged.code, 1, merged.out + merged.err);
  assert.match(merged.out, /no technique shows \["far_plane"\] of "thin_caster" any more/);
  assertSameReport('stopped-joined', 'stopped');
});

test('a light for which no technique is has no result, and its scene may have others', () => {
  const changed = join(scratch, 'changed-light');
  cpSync(bundled, changed, { recursive: true });
  const file = join(changed, 'many_lights.gltf');
  const gltf = JSON.parse(readFileSync(file));
  const { lights } = gltf.extensions.KHR_lights_punctual;
  assert.equal(lights.length, 3);
  lights[1].type = 'directional';
  writeFileSync(file, JSON.stringify(gltf));
  const run = (...args) => shadowproof([...args, '-q'], { env: { SHADOWPROOF_SCENES: changed } });
  const words = ['verify', '--technique', 'sun_map', ...size];
  const whole = run(...words, '--out', 'one-light');
  assert.equal(whole.code, 0, whole.out + whole.err);
  const names = cellsOf('one-light');
  assert.ok(names.length >= 2 && names.some((name) => name.startsWith('many_lights-')), names.join());
  const parts = [1, 2, 3].map((number) => {
    const part = run(...words, '--out', `one-light${number}`, '--shard', `${number}/3`);
    assert.equal(part.code, 0, part.out + part.err);
    return `one-light${number}`;
  });
  assert.equal(run('merge', ...parts, '--out', 'one-light-joined').code, 0);
  assertSameReport('one-light-joined', 'one-light');
});

test('shards are cut by the costs of an earlier run', () => {
  const results = resultsOf('few');
  const words = ['near_plane', '--technique', 'zpass,zfail,invert,zp_plus'];
  verify('costs', words, { code: 0 });
  const costs = resultsOf('costs');
  costs.scenes[0].spent_ms = 1;
  costs.scenes[0].techniques.forEach((cell) => { cell.spent_ms = cell.name === 'zfail' ? 500 : 10; });
  writeFileSync(join(scratch, 'costs.json'), JSON.stringify(costs));
  const parts = shards(3, [...words, '--costs', 'costs.json'], 'costly-');
  assert.deepEqual(parts.map(cellsOf), [['near_plane zpass'], ['near_plane zfail'],
                                        ['near_plane invert', 'near_plane zp_plus']]);
  assert.ok(results.scenes[0].techniques.every((cell) => cell.spent_ms > 0));
  assert.equal(shadowproof(['verify', 'near_plane', '--costs', 'costs.json']).code, 2);
  for (const [file, words] of [['torn.gltf', /torn\.gltf: is cut off/],
                               ['nowhere', /nowhere: there is no such file; name a results\.json/]])
    assert.match(shadowproof(['verify', 'near_plane', '--shard', '1/2', '--costs', file]).err, words);
});

/** Verifies, and kills the whole program as a power cut would, when so many cells are done. */
async function cutOff(out, words, cells, signal = 'SIGKILL') {
  const child = spawn(process.env.SHADOWPROOF, ['verify', ...words, ...size, '--out', out],
                      { cwd: scratch, stdio: ['ignore', 'pipe', 'pipe'], detached: true });
  let said = '';
  let errors = '';
  const ended = new Promise((resolve) => child.on('close', resolve));
  child.stderr.on('data', (text) => { errors += text; });
  child.stdout.on('data', (text) => {
    said += text;
    if ((said.match(/ (agrees|fails_as_predicted) /g) ?? []).length < cells) return;
    try {
      process.kill(signal === 'SIGKILL' ? -child.pid : child.pid, signal);
    } catch { /* it has ended */ }
  });
  await ended;
  await pause(20);
  return said + errors;
}

const few = ['near_plane', 'many_lights', 'torn.gltf', 'sun', '--technique',
             'zpass,zfail,zfail_clamp,zfail_infinite,invert,traced_skip'];

test('a run that is killed goes on where it was, and ends as if it had not been', async () => {
  verify('never-cut', few);
  const inode = (...path) => statSync(join(scratch, ...path)).ino;
  for (const cells of [1, 4, 9, 20]) {
    const out = `cut-${cells}`;
    await cutOff(out, few, cells);
    assert.ok(!existsSync(join(scratch, out)), 'nothing is at its place');
    const done = filesBelow(join(scratch, `${out}.writing/report`))
      .filter((file) => file.endsWith('cause.png'));
    const inodes = done.slice(0, -1).map((file) => inode(`${out}.writing/report`, file));
    const run = shadowproof(['verify', ...few, ...size, '--out', out, '--resume']);
    assert.equal(run.code, 3, run.out + run.err);
    assert.match(run.out, /^note: cut-\d+: goes on with the run that was cut off$/m);
    assertSameReport(out, 'never-cut');
    assert.deepEqual(done.slice(0, -1).map((file) => inode(out, file)), inodes, 'no cell is made twice');
    assert.ok(!existsSync(join(scratch, `${out}.writing`)));
    // Each cell is said, also those of the run before.
    assert.equal((run.out.match(/^\w+ +[\w-]+ +(agrees|fails_as_predicted) /gm) ?? []).length,
                 cellsOf(out).length - 1);
  }
});

test('with --resume a signal keeps what is done; without, nothing stays', async () => {
  for (const signal of ['SIGTERM', 'SIGINT']) {
    const said = await cutOff('signalled', [...few, '--resume'], 5, signal);
    assert.match(said, /the same command goes on with what is done of signalled/);
    assert.ok(existsSync(join(scratch, 'signalled.writing/progress')));
    // Again, further on.
    await cutOff('signalled', [...few, '--resume'], 12, signal);
    verify('signalled', [...few, '--resume']);
    assertSameReport('signalled', 'never-cut');
    rmSync(join(scratch, 'signalled'), { recursive: true });
    assert.match(await cutOff('signalled', few, 5, signal), /what was unfinished is removed/);
    assert.ok(!readdirSync(scratch).some((name) => name.startsWith('signalled')));
  }
});

test('what is not the same run is refused, and keeps what was done', async () => {
  copyFileSync(join(bundled, 'spot.gltf'), join(scratch, 'mine.gltf'));
  const words = ['near_plane', 'mine.gltf', '--technique', 'zpass,zfail,invert'];
  await cutOff('other', words, 4);
  const kept = filesBelow(join(scratch, 'other.writing'));
  const refused = (args, message) => {
    const run = shadowproof(['verify', ...args, '--out', 'other', '--resume', '-q']);
    assert.equal(run.code, 3, run.out);
    assert.match(run.err, /^shadowproof: other: cannot be gone on with: /);
    assert.match(run.err, message);
    assert.deepEqual(filesBelow(join(scratch, 'other.writing')), kept);
  };
  refused([...words, '--size', '49x48'], /other settings/);
  refused(['near_plane', '--technique', 'zpass,zfail,invert', ...size], /other scenes/);
  refused(['near_plane', 'mine.gltf', ...size], /other techniques/);
  refused([...words, ...size, '--shard', '1/2'], /other shard/);
  copyFileSync(join(bundled, 'sun.gltf'), join(scratch, 'mine.gltf'));
  const changed = shadowproof(['verify', ...words, ...size, '--out', 'other', '--resume', '-q']);
  assert.equal(changed.code, 3, changed.out);
  assert.match(changed.err, /mine\.gltf: is another scene than the run that was cut off has tried/);
  copyFileSync(join(bundled, 'spot.gltf'), join(scratch, 'mine.gltf'));
  verify('other', [...words, '--resume'], { code: 0 });
  assert.equal(cellsOf('other').length, 6);
});

test('a run that goes on notices what a scene declares, and which lights it has', async () => {
  const file = join(scratch, 'declared.gltf');
  copyFileSync(join(bundled, 'near_plane.gltf'), file);
  const words = ['declared.gltf', 'sun', '--technique', 'zpass,zfail,invert'];
  const goesOn = (more = []) => {
    const run = shadowproof(['verify', ...words, ...more, ...size, '--out', 'declared', '--resume', '-q']);
    assert.equal(run.code, 3, run.out);
    return run.err;
  };
  for (const cells of [2, 4]) { // in the middle of the scene, and behind it
    rmSync(join(scratch, 'declared.writing'), { recursive: true, force: true });
    await cutOff('declared', words, cells);
    const gltf = JSON.parse(readFileSync(join(bundled, 'near_plane.gltf')));
    gltf.extras.shadowproof.provokes = [];
    writeFileSync(file, JSON.stringify(gltf));
    assert.match(goesOn(), /declared\.gltf: is another scene than the run that was cut off has tried/);
    copyFileSync(join(bundled, 'near_plane.gltf'), file);
  }
  verify('declared', [...words, '--resume'], { code: 0 });
  copyFileSync(join(bundled, 'many_lights.gltf'), file);
  await cutOff('declared', [...words, '--shard', '1/1'], 2);
  copyFileSync(join(bundled, 'ordinary.gltf'), file);
  assert.match(goesOn(['--shard', '1/1']), /declared\.gltf: is another scene than/);
});

test('where the journal lost its end, whole files are taken over, or missed', async () => {
  const words = ['near_plane', 'sun', '--technique', 'zpass,zfail,invert'];
  verify('entire', words, { code: 0 });
  for (const bytes of [1, 5, 40]) {
    await cutOff('short', words, 4);
    const journal = join(scratch, 'short.writing/journal');
    truncateSync(journal, statSync(journal).size - bytes);
    const run = shadowproof(['verify', ...words, ...size, '--out', 'short', '--resume', '-q']);
    if (run.code === 0) assertSameReport('short', 'entire');
    else assert.match(run.err, /not as this program wrote it; move it away/);
    rmSync(join(scratch, 'short'), { recursive: true, force: true });
    rmSync(join(scratch, 'short.writing'), { recursive: true, force: true });
  }
});

test('files that were spoiled since make it begin anew, and foreign ones are not touched', async () => {
  const words = ['near_plane', 'sun', '--technique', 'zpass,zfail,invert'];
  verify('sound', words, { code: 0 });
  await cutOff('spoiled', words, 4);
  writeFileSync(join(scratch, 'spoiled.writing/report/near_plane/truth.png'), 'spoiled');
  const refused = shadowproof(['verify', ...words, ...size, '--out', 'spoiled', '--resume']);
  assert.equal(refused.code, 3, refused.out);
  assert.match(refused.err, /near_plane\/truth\.png, not as this program wrote it/);
  rmSync(join(scratch, 'spoiled.writing/report/near_plane/truth.png'));
  const run = shadowproof(['verify', ...words, ...size, '--out', 'spoiled', '--resume']);
  assert.equal(run.code, 0, run.err);
  assert.match(run.out, /begins anew/);
  assertSameReport('spoiled', 'sound');
});

test('a shard that is killed goes on, too', async () => {
  const words = [...scenes, '--shard', '2/2'];
  await cutOff('half', words, 6);
  verify('half', [...words, '--resume'], { code: 0 });
  assert.equal(shadowproof(['merge', 'of2-1', 'half', '--out', 'halves', '-q']).code, 3);
  assertSameReport('halves', 'whole');
});

test('a cell that could not run is tried again by the run that goes on', async () => {
  const words = ['near_plane', 'late.gltf', 'sun', '--technique', 'zpass,zfail,invert'];
  await cutOff('late', words, 5);
  copyFileSync(join(bundled, 'spot.gltf'), join(scratch, 'late.gltf'));
  verify('late', [...words, '--resume'], { code: 0 });
  assert.equal(cellsOf('late').length, 9);
});

test('the matrix of docs/github-actions.yml does what it says', () => {
  const yml = readFileSync(new URL('../../docs/github-actions.yml', import.meta.url), 'utf8');
  const here = join(scratch, 'runner');
  mkdirSync(join(here, 'installed/bin'), { recursive: true });
  writeFileSync(join(here, 'installed/bin/shadowproof'), `#!/bin/sh\nexec "$SHADOWPROOF" "$@" --size 48x48\n`,
                { mode: 0o755 });
  writeFileSync(join(here, 'installed/bin/join'), `#!/bin/sh\nexec "$SHADOWPROOF" "$@"\n`, { mode: 0o755 });
  const [, parts] = yml.match(/^ +part: \[([\d, ]+)\]/m);
  const [, PARTS] = yml.match(/^ +PARTS: (\d+)$/m);
  const [, SCENES] = yml.match(/^ +SCENES: (.+)$/m);
  const [verify] = yml.match(/installed\/bin\/shadowproof verify [^]*?\n(?= {6}#)/);
  const [merge] = yml.match(/installed\/bin\/shadowproof merge .*/);
  const bash = (command) => {
    const run = spawnSync('bash', ['-e', '-c', command],
                          { cwd: here, encoding: 'utf8', env: { ...process.env, PARTS, SCENES } });
    assert.equal(run.status, 0, run.stdout + run.stderr);
  };
  for (const part of parts.split(', ')) {
    mkdirSync(join(here, 'shards'), { recursive: true });
    bash(verify.replace('${{ matrix.part }}', part));
    renameSync(join(here, 'report'), join(here, `shards/report-${part}`));
  }
  bash(merge.replace('shadowproof', 'join')); // which takes no --size
  assert.equal(shadowproof(['verify', ...SCENES.split(' '), ...size, '--out', 'as-one', '-q']).code, 0);
  assertSameReport('runner/report', 'as-one');
});
