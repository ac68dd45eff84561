// A crash, an abort or a hang in one cell of verify, of the driver or of Embree, loses that cell
// alone; render and explain end in a sentence. losses_test.mjs has stress, bench and check.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { existsSync, readFileSync, readdirSync, rmSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { filesBelow, scratch, shadowproof } from './shadowproof.mjs';

const size = ['--size', '48x48'];
const techniques = ['zpass', 'zfail', 'zfail_clamp'];
const verify = ['verify', 'near_plane', 'many_lights', '--technique', techniques.join(), ...size];
const resultsOf = (file) => JSON.parse(readFileSync(join(scratch, file), 'utf8'));
const fault = (words, once) => ({
  env: { LD_PRELOAD: process.env.FAULTY_DRIVER, SHADOWPROOF_FAULT: words,
         ASAN_OPTIONS: 'verify_asan_link_order=0',
         ...(once && { SHADOWPROOF_FAULT_ONCE: join(scratch, once) }) },
});

/** Figures that two runs have in common. Cells that have a picture alike keep it in one of them. */
const withoutTimes = (cell) => ({ ...cell, ms: 0, spent_ms: 0, saved: null, images: null });

/** The bytes of a cell's pictures, wherever they are. */
const picturesOf = (folder, { images }) => Object.fromEntries(Object.entries(images)
  .map(([kind, path]) => [kind, readFileSync(join(scratch, folder, path), 'base64')]));

/** The call of glReadPixels, counted over the run, that is the first of a scene's second cell. */
function secondCell(words) {
  // Each technique reads back as often as the next one on this scene; found by trying.
  for (let call = 2; call < 200; ++call) {
    const run = shadowproof(verify, fault(`glReadPixels:${call}:${words}`, `mark-${words}`));
    const mark = join(scratch, `mark-${words}`);
    if (existsSync(mark)) rmSync(mark);
    const [scene] = resultsOf('report/results.json').scenes;
    if (scene.techniques[1].error) return { call, run };
  }
  return assert.fail('no call of glReadPixels is the second technique’s');
}

test('an aborted cell says so, all others are as in an undisturbed run', () => {
  const plain = shadowproof([...verify, '--out', 'plain']);
  assert.equal(plain.code, 0, plain.err);
  const { run } = secondCell('6');
  assert.equal(run.code, 3);
  assert.match(run.out, /zfail +near_plane +error +zfail: .*signal 6 \(Aborted\)/);
  const whole = resultsOf('plain/results.json').scenes;
  const broken = resultsOf('report/results.json').scenes;
  assert.deepEqual(broken.map(({ name }) => name), whole.map(({ name }) => name));
  for (const [i, scene] of broken.entries())
    for (const [k, cell] of scene.techniques.entries()) {
      if (i === 0 && k === 1) {
        assert.match(cell.error, /^zfail: the process that tried it was ended by signal 6/);
        continue;
      }
      assert.deepEqual(withoutTimes(cell), withoutTimes(whole[i].techniques[k]));
      assert.deepEqual(picturesOf('report', cell), picturesOf('plain', whole[i].techniques[k]));
    }
  const cells = (folder) => filesBelow(join(scratch, folder))
    .filter((file) => /\.(png|js)$/.test(file) && file !== 'results.js');
  // What others of its scene share with the cell, they have themselves.
  const elsewhere = (folder) => cells(folder).filter((file) => !file.startsWith('near_plane/'));
  assert.deepEqual(elsewhere('report'), elsewhere('plain'));
  assert.ok(elsewhere('report').length > 0);
  for (const file of elsewhere('report'))
    assert.deepEqual(readFileSync(join(scratch, 'report', file)),
                     readFileSync(join(scratch, 'plain', file)), file);
});

test('a fault at each cell in turn loses no other cell', () => {
  // Without a mark each new process counts from one: the fault meets every cell that begins one.
  const run = shadowproof(verify, fault('glReadPixels:1:11'));
  assert.equal(run.code, 3);
  const { scenes } = resultsOf('report/results.json');
  assert.equal(scenes.length, 4);
  for (const scene of scenes)
    assert.deepEqual(scene.techniques.map(({ name, error }) => [name, /signal 11/.test(error)]),
                     techniques.map((name) => [name, true]));
});

test('an exception that nobody catches ends the program in words, and changes nothing', () => {
  const before = filesBelow(join(scratch, 'plain')).sort();
  for (const command of [[...verify, '--out', 'plain'],
                         ['render', 'near_plane', ...size, '-o', 'thrown.png']]) {
    const run = shadowproof(command, fault('fork:1:throw'));
    assert.equal(run.code, 3, run.err);
    assert.match(run.err, /^shadowproof: ended by an error in a library's thread, [^\n]*\n$/);
  }
  assert.deepEqual(filesBelow(join(scratch, 'plain')).sort(), before);
  assert.deepEqual(readdirSync(scratch).filter((name) => /thrown|writing/.test(name)), []);
});

test('a cell that hangs is given up after --timeout, with a verdict of its own that fails', () => {
  const run = shadowproof([...verify, '--timeout', '20', '--junit', 'junit.xml'],
                          fault('glReadPixels:1:hang', 'hung'));
  assert.equal(run.code, 1, run.err);
  assert.match(run.out, /^zpass +near_plane +timed_out +zpass: took longer than --timeout 20; /m);
  assert.match(run.out, /^reproduce: .*--technique zpass/m);
  const [scene] = resultsOf('report/results.json').scenes;
  assert.equal(scene.techniques[0].verdict, 'timed_out');
  assert.equal(scene.techniques[0].fails, true);
  assert.deepEqual(scene.techniques.slice(1).map(({ verdict }) => verdict), ['agrees', 'agrees']);
  assert.match(readFileSync(join(scratch, 'junit.xml'), 'utf8'), /<failure type="timed_out"/);
  const again = shadowproof(['report', '--from', 'report', '--out', 'again']);
  assert.equal(again.code, 1, again.err);
  assert.match(again.out, /^fails: "zpass" on "near_plane": timed_out$/m);
});

test('explain and render are given up after --timeout, and write nothing', () => {
  for (const [args, words] of [
    [['render', 'ordinary', '-o', 'late.png'], 'rtcBuildBVH:1:hang'],
    [['explain', 'ordinary', '--pixel', '3,3', '--technique', 'zpass', '--json', 'late.json'],
     'glReadPixels:1:hang'],
  ]) {
    const run = shadowproof([...args, ...size, '--timeout', '2'], fault(words));
    assert.equal(run.code, 3);
    assert.match(run.err, /^shadowproof: ordinary: took longer than --timeout 2; /m);
  }
  assert.ok(!existsSync(join(scratch, 'late.png')) && !existsSync(join(scratch, 'late.json')));
});

test('a crash of Embree is the scene’s own', () => {
  const run = shadowproof(verify, fault('rtcBuildBVH:1:6', 'built'));
  assert.equal(run.code, 3);
  assert.match(run.err, /near_plane: tracing: .*signal 6/);
  const { scenes } = resultsOf('report/results.json');
  assert.match(scenes[0].error, /signal 6/);
  assert.equal(scenes.length, 4);
  for (const scene of scenes.slice(1))
    for (const cell of scene.techniques) assert.ok(cell.verdict, `${scene.name} ${cell.error}`);
});

test('render and explain end with a sentence where a library crashes', () => {
  for (const [args, words] of [
    [['render', 'ordinary', '-o', 'truth.png'], 'rtcBuildBVH:1:11'],
    [['explain', 'ordinary', '--pixel', '3,3', '--technique', 'zpass'], 'glReadPixels:1:6'],
  ]) {
    const run = shadowproof([...args, ...size], fault(words));
    assert.equal(run.code, 3);
    assert.match(run.err, /^shadowproof: the process that did the work was ended by signal/m);
  }
  assert.ok(!existsSync(join(scratch, 'truth.png')));
});

const printing = [[...verify], ['list'], ['--help'], ['verify', '--help'], ['--version'],
                  ['explain', 'ordinary', '--pixel', '3,3', '--technique', 'zpass', ...size],
                  ['render', 'ordinary', '-o', 'r.png', ...size]];
const quoted = (args) => args.map((word) => `'${word}'`).join(' ');

test('output that cannot be printed is no success', () => {
  for (const args of printing)
    for (const where of ['>/dev/full', '>&-']) {
      const run = spawnSync('sh', ['-c', `"$SHADOWPROOF" ${quoted(args)} ${where}`],
                            { cwd: scratch, encoding: 'utf8' });
      assert.equal(run.status, 3, `${args} ${where}: ${run.stderr}`);
      assert.match(run.stderr, /^shadowproof: standard output cannot be written \(/m);
    }
});

test('a pipe whose reader has gone is no success, and no signal', () => {
  for (const args of printing) {
    // The command starts when the pipe has no reader any more, which is when the FIFO at `gone` ends.
    const script = `rm -f gone code; mkfifo gone;
      { cat gone; "$SHADOWPROOF" ${quoted(args)}; echo $? >code; } | { exec <&-; : >gone; }
      cat code`;
    const run = spawnSync('sh', ['-c', script], { cwd: scratch, encoding: 'utf8' });
    assert.equal(run.stdout, '3\n', `${args}: ${run.stderr}`);
    assert.match(run.stderr, /^shadowproof: standard output cannot be written \(Broken pipe\)[^\n]*$/m, `${args}`);
  }
  for (const name of ['gone', 'code']) rmSync(join(scratch, name));
});

test('nothing is left in the folder but what was asked for', () => {
  assert.deepEqual(readdirSync(scratch).filter((name) => /writing|older|core/.test(name)), []);
});
