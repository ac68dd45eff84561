// Files that the user names: what may stand there already, and what is left where writing fails.
import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import { chmodSync, copyFileSync, linkSync, lstatSync, mkdirSync, readFileSync,
         readdirSync, renameSync, rmSync, statSync, symlinkSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { assertRefused, changes, contentOf, faults, killed, loggedOf, operationsOf, run, scratch }
  from './faults.mjs';

const program = process.env.WRITE_OUTPUT;
const fresh = 'nnnnnnnn'; // what the program writes

function folder(name, files = {}) {
  const below = join(scratch, name);
  mkdirSync(below);
  for (const [file, content] of Object.entries(files)) writeFileSync(join(below, file), content);
  return below;
}

/** Asked whether it can write a file, it changes nothing: no content, no time, no name. */
function assertAskingChangesNothing(below, file) {
  const times = () => readdirSync(below).map((name) => lstatSync(join(below, name), { bigint: true }))
    .concat(lstatSync(below, { bigint: true }))
    .map(({ ino, size, mode, mtimeNs, ctimeNs }) => [ino, size, mode, mtimeNs, ctimeNs]);
  const before = times();
  const done = run([program, file], { cwd: below, env: { WRITE_OUTPUT_ASKS: '1' } });
  assert.deepEqual(times(), before);
  return done;
}

test('a new file has the mode that the umask leaves, an old one keeps its own, also its owner', () => {
  const below = folder('modes', { private: 'old', group: 'old' });
  chmodSync(join(below, 'private'), 0o600);
  chmodSync(join(below, 'group'), 0o640);
  const own = process.getuid() === 0 ? [65534, 65534] : [process.getuid(), process.getgid()];
  if (process.getuid() === 0) assert.equal(run(['chown', own.join(':'), 'group'], { cwd: below }).code, 0);
  for (const [name, mode] of [['private', 0o600], ['group', 0o640], ['new', 0o666 & ~process.umask()]]) {
    assert.equal(assertAskingChangesNothing(below, name).code, 0);
    assert.equal(run([program, name], { cwd: below }).code, 0);
    assert.equal(statSync(join(below, name)).mode & 0o7777, mode, name);
    assert.equal(readFileSync(join(below, name), 'utf8'), fresh);
  }
  const { uid, gid } = statSync(join(below, 'group'));
  assert.deepEqual([uid, gid], own);
  assert.deepEqual(readdirSync(below), ['group', 'new', 'private']);
});

test('links are followed and stay, also one to nothing; a hard link keeps the old content', () => {
  const below = folder('links', { target: 'old' });
  mkdirSync(join(below, 'sub'));
  symlinkSync('../target', join(below, 'sub/link'));
  symlinkSync('sub/link', join(below, 'link'));
  symlinkSync('sub/made', join(below, 'dangling'));
  symlinkSync('missing/made', join(below, 'hopeless'));
  symlinkSync('loop', join(below, 'loop'));
  linkSync(join(below, 'target'), join(below, 'other'));
  for (const name of ['link', 'dangling']) {
    assert.equal(assertAskingChangesNothing(below, name).code, 0);
    assert.equal(run([program, name], { cwd: below }).code, 0);
    assert.ok(lstatSync(join(below, name)).isSymbolicLink(), name);
  }
  for (const name of ['hopeless', 'loop'])
    assertRefused(assertAskingChangesNothing(below, name), name);
  assert.equal(readFileSync(join(below, 'target'), 'utf8'), fresh);
  assert.equal(readFileSync(join(below, 'sub/made'), 'utf8'), fresh);
  assert.equal(readFileSync(join(below, 'other'), 'utf8'), 'old');
  assert.ok(lstatSync(join(below, 'sub/link')).isSymbolicLink());
  assert.deepEqual(readdirSync(join(below, 'sub')), ['link', 'made']);
});

test('devices stay devices: /dev/null takes all, /dev/full nothing', () => {
  const numbers = (name) => statSync(name).rdev;
  const before = [numbers('/dev/null'), numbers('/dev/full')];
  assert.equal(run([program, '/dev/null', '100000']).code, 0);
  const full = run([program, '/dev/full']);
  assertRefused(full, '/dev/full');
  assert.equal(full.err, 'write_output: /dev/full: cannot be written (No space left on device); ' +
    'free some space, or name another place\n');
  assert.deepEqual([numbers('/dev/null'), numbers('/dev/full')], before);
  assert.ok(lstatSync('/dev/null').isCharacterDevice() && lstatSync('/dev/full').isCharacterDevice());
});

test('standard output by name gets the bytes after what was printed, as a pipe and as a file', () => {
  const below = folder('stdout');
  for (const name of ['/dev/stdout', '/dev/fd/1', '/proc/self/fd/1']) {
    assert.equal(run([program, name]).out, `before ${fresh}`);
    const shell = ['sh', '-c', `echo first > out; '${program}' ${name} >> out`];
    assert.equal(run(shell, { cwd: below }).code, 0);
    assert.equal(readFileSync(join(below, 'out'), 'utf8'), `first\nbefore ${fresh}`);
  }
  const closed = run(['sh', '-c', `'${program}' /dev/fd/9 9>&-`]);
  assertRefused(closed, 'a descriptor that is not open');
});

test('a FIFO gets the bytes and stays; asking does not end it for its reader', async () => {
  const below = folder('fifo');
  assert.equal(run(['mkfifo', 'pipe'], { cwd: below }).code, 0);
  const reader = spawn('cat', ['pipe'], { cwd: below });
  let text = '';
  reader.stdout.on('data', (chunk) => { text += chunk; });
  const ended = new Promise((resolve) => reader.on('close', resolve));
  assert.equal(assertAskingChangesNothing(below, 'pipe').code, 0);
  const done = await new Promise((resolve) =>
    spawn(program, ['pipe', '300000'], { cwd: below }).on('close', resolve));
  assert.equal(done, 0);
  await ended;
  assert.equal(text, 'n'.repeat(300000));
  assert.ok(lstatSync(join(below, 'pipe')).isFIFO());
});

test('a FIFO that nobody reads is an error, and hangs nothing', () => {
  const below = folder('fifo-alone');
  run(['mkfifo', 'pipe'], { cwd: below });
  const done = run([program, 'pipe'], { cwd: below });
  assertRefused(done, 'no reader');
  assert.match(done.err, /pipe: cannot be written \(nobody reads from the other end\)/);
});

test('a FIFO that is open and not read is an error when it is full, and hangs nothing', () => {
  const below = folder('full-pipe');
  run(['mkfifo', 'pipe'], { cwd: below });
  // It holds the reading end, and never reads.
  const holder = spawn('sh', ['-c', 'exec 3<>pipe; exec sleep 60'], { cwd: below });
  try {
    const done = run([program, 'pipe', '1000000'], { cwd: below, seconds: 30 });
    assert.equal(done.code, 3, `${done.code} ${done.signal} ${done.err}`);
    assert.match(done.err, /pipe: cannot be written \(.*timed out/);
  } finally {
    holder.kill();
  }
});

test('folders, places that do not exist and names that are too long are refused before', () => {
  const below = folder('nowhere', { file: 'old' });
  mkdirSync(join(below, 'folder'));
  for (const name of ['folder', 'folder/', 'new/', 'missing/file', 'file/below', 'n'.repeat(300), '.',
                      '/proc/new']) {
    const done = assertAskingChangesNothing(below, name);
    assertRefused(done, name);
    assert.ok(done.err.startsWith(`write_output: ${name}: cannot be written (`), done.err);
  }
});

test('a read-only place is refused before, also for root where the file system is', () => {
  const below = folder('readonly', { file: 'old', program: '' });
  chmodSync(scratch, 0o755);
  copyFileSync(program, join(below, 'program'));
  chmodSync(join(below, 'program'), 0o755);
  mkdirSync(join(below, 'locked'));
  writeFileSync(join(below, 'locked/old'), 'old');
  chmodSync(join(below, 'locked'), 0o555);
  writeFileSync(join(below, 'protected'), 'old');
  chmodSync(join(below, 'protected'), 0o444);
  const before = contentOf(below);
  // Root may write anywhere that is not mounted otherwise: there, somebody else tries.
  const user = process.getuid() === 0
    ? ['setpriv', '--reuid', '65534', '--regid', '65534', '--clear-groups'] : [];
  for (const name of ['locked/old', 'locked/new', 'protected']) {
    const done = run([...user, join(below, 'program'), name], { cwd: below });
    assertRefused(done, name);
    assert.match(done.err, /Permission denied/);
  }
  chmodSync(join(below, 'locked'), 0o755);
  for (const name of ['/proc/version', '/proc/new'])
    assertRefused(run([program, name]), name);
  assert.deepEqual(contentOf(below), before);
});

test('a limit on the size of files is an error of its own, and the old file stays', () => {
  const below = folder('limit', { old: 'old' });
  for (const name of ['old', 'new']) {
    const done = run(['sh', '-c', `ulimit -f 1; exec '${program}' ${name} 5000`], { cwd: below });
    assertRefused(done, name);
    assert.match(done.err, /File too large.*ulimit -f/);
  }
  assert.deepEqual(contentOf(below), { old: 'old' });
});

test('where any one file operation fails, the old file or the new one is whole, and alone', () => {
  const ways = [[5, {}], [28, {}], [5, { without: 'unnamed' }]]; // EIO, ENOSPC
  for (const name of ['old', 'new', 'link'])
    for (const [reason, lacking] of ways) {
      const below = folder(`fails-${name}-${reason}-${lacking.without ?? ''}`, { old: 'old' });
      symlinkSync('old', join(below, 'link'));
      const count = operationsOf([program, name], below, { cwd: below, ...lacking });
      for (let at = 1; at <= count; ++at) {
        const where = `${name}, operation ${at} of ${count}, errno ${reason}`;
        rmSync(join(below, 'new'), { force: true });
        writeFileSync(join(below, 'old'), 'old');
        const done = run([program, name], { cwd: below, env: faults(below, { at, errno: reason, ...lacking }) });
        const after = contentOf(below);
        const target = name === 'link' ? 'old' : name;
        if (done.code !== 0) assertRefused(done, where);
        else assert.equal(after[target], fresh, where);
        assert.ok([undefined, 'old', fresh].includes(after[target]), where);
        assert.deepEqual({ ...after, new: '', old: '' }, { link: '-> old', new: '', old: '' }, where);
        if (target === 'new') assert.equal(after.old, 'old', where);
      }
    }
});

/** What some file systems do not have, NFS and FUSE among them. */
const poor = { without: 'unnamed' };

for (const lacking of [{}, poor])
  test(`killed at any file operation, the old file or the new one is whole, and the next run alone${
    lacking.without ? ', also where no file can be without a name' : ''}`, () => {
    const below = folder(`killed-${lacking.without ?? ''}`, { old: 'old' });
    const count = operationsOf([program, 'old'], below, { cwd: below, ...changes, ...lacking });
    let left = 0;
    for (let at = 1; at <= count; ++at) {
      const where = `operation ${at} of ${count}`;
      writeFileSync(join(below, 'old'), 'old');
      const done = run([program, 'old'], { cwd: below, env: faults(below, { at, ...killed, ...lacking }) });
      assert.equal(done.signal, 'SIGKILL', where);
      assert.ok(['old', fresh].includes(readFileSync(join(below, 'old'), 'utf8')), where);
      left += readdirSync(below).length - 1;
      assert.equal(run([program, 'old'], { cwd: below }).code, 0);
      assert.deepEqual(contentOf(below), { old: fresh }, where);
    }
    assert.ok(left > 0, 'no leftover was met');
  });

test('a file is on the disk before it has its name, and the name after', () => {
  const below = folder('synced', { old: 'old' });
  const calls = (name, lacking) => loggedOf([program, name], below, { cwd: below, ...lacking });
  assert.deepEqual(calls('new'), ['write unnamed', 'fsync unnamed', 'linkat new', 'fsync .']);
  assert.deepEqual(calls('old'), ['write unnamed', 'fsync unnamed', 'linkat passing', 'rename old', 'fsync .']);
  for (const name of ['old', 'newer']) {
    const asked = 'rename passing'; // for the question whether it can be written
    assert.deepEqual(calls(name, poor), [asked, 'rename passing', 'write passing', 'fsync passing',
                                         `rename ${name}`, 'fsync .']);
  }
});

/** A leftover of a killed process in a folder that holds a file `old`: its name. */
function leftover(below) {
  const names = () => readdirSync(below).filter((name) => name.startsWith('.shadowproof-'));
  for (let at = 1; ; ++at) {
    const done = run([program, 'old'], { cwd: below, env: faults(below, { at, ...killed }) });
    assert.equal(done.signal, 'SIGKILL', 'it leaves nothing');
    if (names().length > 0) return names()[0];
  }
}

test('a file that another process is just giving its name is no leftover; unlocked, it is', () => {
  const below = folder('passing', { old: 'old' });
  const name = leftover(below);
  const done = run(['flock', name, program, 'new'], { cwd: below });
  assert.equal(done.code, 0, done.err);
  assert.deepEqual(Object.keys(contentOf(below)), [name, 'new', 'old']);
  assert.equal(run([program, 'new'], { cwd: below }).code, 0);
  assert.deepEqual(Object.keys(contentOf(below)), ['new', 'old']);
});

test('what only looks like a leftover stays: names of digits, copies, links, and other names of it', () => {
  const below = folder('like-leftovers', { old: 'old' });
  const name = leftover(below);
  const mine = { '.shadowproof-2024-01-31': 'mine', '.shadowproof-2024-02': '', '.shadowproof-1-0': 'mine',
                 '.shadowproof-notes': 'mine', '.shadowproof-': 'mine' };
  for (const [file, content] of Object.entries(mine)) writeFileSync(join(below, file), content);
  const copy = () => {
    copyFileSync(join(below, name), join(below, 'copy'));
    renameSync(join(below, 'copy'), join(below, name)); // beside the original: of another inode
  };
  const link = () => {
    renameSync(join(below, name), join(below, 'target'));
    symlinkSync('target', join(below, name));
  };
  const rename = () => renameSync(join(below, name), join(below, name.replace(/-\d+-/, '-7-')));
  for (const change of [copy, link, rename]) {
    change();
    const before = contentOf(below);
    assert.equal(run([program, 'old'], { cwd: below }).code, 0);
    assert.deepEqual(contentOf(below), { ...before, old: fresh }, change.name);
  }
});

test('a name for a file that is still empty proves nothing once it has content', () => {
  const below = folder('filled', { old: 'old' });
  // Killed between the call that makes the file and the one that gives it its next name.
  const names = () => readdirSync(below).filter((name) => name !== 'old');
  let name;
  for (let at = 1; !name; ++at) {
    run([program, 'old'], { cwd: below, env: faults(below, { at, ...killed, ...poor }) });
    [name] = names();
  }
  assert.equal(statSync(join(below, name)).size, 0);
  writeFileSync(join(below, name), 'mine');
  assert.equal(run([program, 'old'], { cwd: below }).code, 0);
  assert.deepEqual(contentOf(below), { [name]: 'mine', old: fresh });
  writeFileSync(join(below, name), '');
  assert.equal(run([program, 'old'], { cwd: below }).code, 0);
  assert.deepEqual(contentOf(below), { old: fresh });
});
