// The commands where file operations fail, where they are killed, and where the disk is full: exit
// code 3 and a sentence, or 0 and everything whole.
import assert from 'node:assert/strict';
import { mkdirSync, readFileSync, readdirSync, rmSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { grayPng } from '../command/png.mjs';
import { assertRefused, changes, contentOf, faults, killed, killedAfter, operationsOf, run, scratch }
  from './faults.mjs';

const program = process.env.SHADOWPROOF;
const picture = ['--size', '16x16'];
const verify = (technique) => [program, 'verify', 'near_plane', ...picture, '--technique', technique,
                               '--out', 'report', '-q'];
const height = join(scratch, 'height.png');
writeFileSync(height, grayPng(64, 64, (x, y) => ((x * x + 7 * y) * 257) % 65536));
const files = {
  render: [program, 'render', 'near_plane', '--size', '128x128', '-q', '-o', 'out.png'],
  'render to EXR': [program, 'render', 'near_plane', '--size', '32x32', '-q', '-o', 'out.exr'],
  'normal-map': [program, 'normal-map', height, '-q', '-o', 'out.png'],
};

/** A folder with an old report of zpass, and a file of somebody else in it. */
function place(name) {
  const below = join(scratch, name);
  mkdirSync(below);
  assert.equal(run(verify('zpass'), { cwd: below }).code, 0);
  writeFileSync(join(below, 'report/notes.txt'), 'mine');
  return below;
}

/**
 * One report whole, and what is not its own; returns its technique. `damaged`: pictures may lack, where
 * the run that wrote it says so.
 */
function assertWhole(below, where, damaged = false) {
  const { ['manifest.json']: text, ...all } = contentOf(join(below, 'report'));
  const own = Object.keys(all).filter((name) => all[name] !== 'folder' && name !== 'notes.txt');
  const manifest = JSON.parse(text);
  assert.deepEqual(manifest.files.map(({ name }) => name).sort(), own.sort(), where);
  for (const { name, size } of manifest.files) assert.equal(all[name].length, size, `${where}: ${name}`);
  assert.equal(all['notes.txt'], 'mine', where);
  const [cell] = JSON.parse(all['results.json']).scenes[0].techniques;
  for (const file of ['claim.png', 'cell.js'])
    assert.ok(damaged || own.includes(`near_plane/${cell.name}.${file}`), `${where}: ${file}`);
  const other = cell.name === 'zpass' ? 'zfail' : 'zpass';
  assert.deepEqual(own.filter((name) => name.startsWith(`near_plane/${other}.`)), [], where);
  return cell.name;
}

test('verify: where any one file operation fails, a report is whole', () => {
  const below = place('verify-fails');
  const count = operationsOf(verify('zfail'), below, { cwd: below });
  let old = 'zfail';
  for (let at = 1; at <= count; ++at) {
    const where = `operation ${at} of ${count}`;
    const next = old === 'zpass' ? 'zfail' : 'zpass';
    const done = run(verify(next), { cwd: below, env: faults(below, { at, errno: at % 2 ? 28 : 5 }) });
    const now = assertWhole(below, where);
    if (done.code === 0) assert.equal(now, next, where);
    else assertRefused(done, where);
    assert.deepEqual(readdirSync(below), ['report'], where);
    old = now;
  }
});

/** After a kill: the next run is not kept from anything, and leaves nothing. */
function assertMended(below, where) {
  const next = run(verify('zpass'), { cwd: below });
  assert.equal(next.code, 0, where + next.err);
  assert.equal(assertWhole(below, where), 'zpass');
  assert.deepEqual(readdirSync(below), ['report'], where);
}

test('verify: killed at file operations and at random moments, a report is whole', async () => {
  const below = place('verify-killed');
  const count = operationsOf(verify('zfail'), below, { cwd: below, ...changes });
  // Each of the operations of a folder that is replaced is tried in replace_test.mjs.
  for (let at = 1; at <= count; at += Math.ceil(count / 25)) {
    run(verify('zfail'), { cwd: below, env: faults(below, { at, ...killed }) });
    assertWhole(below, `killed at operation ${at} of ${count}`);
    assertMended(below, `killed at operation ${at} of ${count}`);
  }
  const begin = process.hrtime.bigint();
  run(verify('zfail'), { cwd: below });
  const milliseconds = Number(process.hrtime.bigint() - begin) / 1e6;
  const moments = 100;
  for (let i = 0; i < moments; ++i) {
    // Every other time, the next run comes while the children of the killed one still end.
    const children = i % 2 === 0;
    const where = `killed at moment ${i}`;
    await killedAfter(milliseconds * (0.1 + i / moments), verify('zfail'), { cwd: below, children });
    if (children) assertWhole(below, where);
    assertMended(below, where);
  }
});

for (const [name, command] of Object.entries(files))
  test(`${name}: where any one file operation fails, the picture is whole or as it was`, () => {
    const below = join(scratch, name.replaceAll(' ', '-'));
    const file = command.at(-1);
    mkdirSync(below);
    assert.equal(run(command, { cwd: below }).code, 0);
    const whole = readFileSync(join(below, file), 'latin1');
    const count = operationsOf(command, below, { cwd: below });
    for (let at = 1; at <= count; ++at) {
      const where = `operation ${at} of ${count}`;
      writeFileSync(join(below, file), 'old');
      const done = run(command, { cwd: below, env: faults(below, { at, errno: at % 2 ? 28 : 5 }) });
      const now = contentOf(below);
      assert.deepEqual(Object.keys(now), [file], where);
      if (done.code === 0) assert.ok(now[file] === whole, where);
      else assertRefused(done, where);
      assert.ok(now[file] === 'old' || now[file] === whole, where);
    }
  });

for (const [name, errno] of [['EIO', 5], ['ENOSPC', 28]]) {
  test(`merge: where any one file operation fails by ${name}, a report is whole`, () => {
    const below = place(`merge-${name}`);
    for (const technique of ['zpass', 'zfail'])
      assert.equal(run([...verify(technique).slice(0, -2), technique, '-q'], { cwd: below }).code, 0);
    const merge = (shard) => [program, 'merge', shard, '--out', 'report'];
    const count = operationsOf(merge('zfail'), below, { cwd: below });
    let old = 'zfail';
    for (let at = 1; at <= count; ++at) {
      const where = `operation ${at} of ${count}`;
      const next = old === 'zpass' ? 'zfail' : 'zpass';
      const done = run(merge(next), { cwd: below, env: faults(below, { at, errno }) });
      // What cannot be read of a shard is damage, which is said, and is in this report alone.
      const damaged = done.code === 0 && /^damaged: [^\n]+\.(png|js) (is missing|cannot be read)/m.test(done.out);
      if (damaged) {
        assert.equal(assertWhole(below, where, true), next, where);
        assert.equal(run(merge(next), { cwd: below }).code, 0, where);
      }
      const now = assertWhole(below, where);
      if (done.code === 0) assert.equal(now, next, where);
      else assertRefused(done, where);
      assert.deepEqual(readdirSync(below).sort(), ['report', 'zfail', 'zpass'], where);
      old = now;
    }
  });

  test(`explain: where any one file operation fails by ${name}, its files are old or new, and whole`, () => {
    const below = join(scratch, `explain-${name}`);
    mkdirSync(below);
    const command = [program, 'explain', 'near_plane', '--pixel', '3,3', ...picture, '--technique', 'zpass',
                     '-q', '--json', 'pixel.json', '--svg', 'pixel.svg'];
    const count = operationsOf(command, below, { cwd: below });
    const whole = contentOf(below);
    assert.equal(typeof JSON.parse(whole['pixel.json']), 'object');
    assert.match(whole['pixel.svg'], /^<svg [^]*<\/svg>\s*$/);
    for (let at = 1; at <= count; ++at) {
      const where = `operation ${at} of ${count}`;
      for (const file of Object.keys(whole)) writeFileSync(join(below, file), 'old');
      const done = run(command, { cwd: below, env: faults(below, { at, errno }) });
      const now = contentOf(below);
      if (done.code === 0) assert.deepEqual(now, whole, where);
      else assertRefused(done, where);
      assert.deepEqual(Object.keys(now), Object.keys(whole), where);
      for (const [file, content] of Object.entries(now))
        assert.ok(content === 'old' || content === whole[file], `${where}: ${file}`);
    }
  });
}

/** Whether a file system of its own can be mounted here, unseen by others. */
const mounts = run(['unshare', '-m', 'mount', '-t', 'tmpfs', 'none', scratch]).code === 0;

/**
 * Runs a command in `below` with room for so many bytes; then `look`, a shell command, whose output
 * is returned too. On a disk of its own where that can be mounted; elsewhere writing fails there.
 */
function withRoom(bytes, command, below, prepare, look) {
  if (!mounts) {
    rmSync(below, { recursive: true, force: true });
    mkdirSync(below);
    run(['sh', '-c', prepare], { cwd: below });
    const done = run(command, { cwd: below, env: faults(below, { bytes }) });
    return { ...done, look: run(['sh', '-c', look], { cwd: below }).out };
  }
  const script = `mount -t tmpfs -o size=64m none . && cd "$PWD" && { ${prepare}; } >/dev/null &&
    used=$(df --output=used -B1 . | tail -n 1) &&
    mount -o remount,size=$((used + ${bytes})) . && { "$@"; code=$?; echo "--look--"; ${look}; exit $code; }`;
  const done = run(['unshare', '-m', 'sh', '-c', script, 'sh', ...command], { cwd: below });
  const [out, seen] = done.out.split('--look--\n');
  return { ...done, out, look: seen };
}

test(`a disk that fills at every 4 KB: pictures are whole or not there (${mounts ? 'tmpfs' : 'by the shim'})`, () => {
  for (const [name, command] of Object.entries(files)) {
    const below = join(scratch, `full-${name.replaceAll(' ', '-')}`);
    mkdirSync(below);
    let code = 3;
    let written;
    for (let bytes = 0; code !== 0; bytes += 4096) {
      assert.ok(bytes < 400000, `${name} never fits`);
      const done = withRoom(bytes, command, below, 'true', 'ls -A; sha256sum out.* 2>/dev/null');
      code = done.code;
      if (code !== 0) {
        assertRefused(done, `${name}, ${bytes} bytes`);
        assert.match(done.err, /No space left on device/);
        assert.equal(done.look, '', `${name}, ${bytes} bytes`);
      } else {
        written = done.look;
      }
    }
    const roomy = withRoom(1 << 22, command, below, 'true', 'ls -A; sha256sum out.* 2>/dev/null');
    assert.equal(written, roomy.look, name);
  }
});

const where = mounts ? 'tmpfs' : 'by the shim';
const merged = [program, 'merge', join(scratch, 'shard'), '--out', 'report', '-q'];
assert.equal(run([...verify('zfail').slice(0, -3), '--out', 'shard', '-q']).code, 0);
for (const [name, command] of [['verify', verify('zfail')], ['merge', merged]])
  test(`a disk that fills at every 4 KB: the report of ${name} is the old one or the new (${where})`, () => {
    const below = place(`full-${name}`);
    const old = join(scratch, `old-${name}`);
    run(['cp', '-a', join(below, 'report'), old]);
    const look = 'ls -A; ls -A report; cat report/notes.txt; grep -Eo "\\"z(pass|fail)\\"" report/results.json';
    const seen = new Set();
    let code = 3;
    for (let bytes = 0; code !== 0; bytes += 4096) {
      assert.ok(bytes < 2000000, 'the report never fits');
      const done = withRoom(bytes, command, below, `rm -rf report; cp -a '${old}' report`, look);
      code = done.code;
      if (code !== 0) assertRefused(done, `${bytes} bytes`);
      assert.match(done.look, /^report\nindex\.html\nmanifest\.json\nnear_plane\nnotes\.txt\nresults\.js\nresults\.json\nmine/,
                   `${bytes} bytes`);
      assert.ok(done.look.includes(`"${code === 0 ? 'zfail' : 'zpass'}"`), `${bytes} bytes: ${done.look}`);
      seen.add(code);
    }
    assert.deepEqual([...seen], [3, 0]);
  });
