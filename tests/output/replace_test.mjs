// A folder that replaces another: what it takes, what it keeps, and what is left of it where a file
// operation fails, or the program is killed.
import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import { chmodSync, existsSync, lstatSync, mkdirSync, readFileSync, readdirSync, rmSync, statSync,
         symlinkSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { assertRefused, changes, contentOf, faults, killed, killedAfter, loggedOf, operationsOf, run, scratch }
  from './faults.mjs';

const program = process.env.REPLACE_FOLDER;
const command = (folder, ...files) => [program, folder, ...files];
const oldFiles = ['index.html=old', 'results.json=old', 'near/zpass/claim.png=old', 'far/cell.js=old'];
const newFiles = ['index.html=new', 'results.json=new', 'near/zpass/claim.png=new', 'sun/cell.js=new'];
const asContent = (files) => Object.fromEntries(files.map((file) => file.split('=')));

/** A folder of its own with an old report in it, and files of somebody else in that. */
function place(name) {
  const below = join(scratch, name);
  mkdirSync(below);
  writeFileSync(join(below, 'neighbour.txt'), 'mine');
  assert.equal(run(command('report', ...oldFiles), { cwd: below }).code, 0);
  writeFileSync(join(below, 'report/notes.txt'), 'mine');
  mkdirSync(join(below, 'report/near/sketches'));
  writeFileSync(join(below, 'report/near/sketches/a.txt'), 'mine');
  symlinkSync('../neighbour.txt', join(below, 'report/link'));
  return below;
}

const foreign = { 'notes.txt': 'mine', 'near/sketches/a.txt': 'mine', link: '-> ../neighbour.txt' };

/** Files of the report at its place, without its manifest. */
function reportFiles(below) {
  const { ['manifest.json']: manifest, ...all } = contentOf(join(below, 'report'));
  assert.ok(manifest, 'a report has a manifest');
  return Object.fromEntries(Object.entries(all).filter(([, content]) => content !== 'folder'));
}

/** The old report or the new one, whole, with all that is not the program's. Returns which. */
function assertWhole(below, where) {
  const files = reportFiles(below);
  const which = files['index.html'];
  const own = asContent(which === 'old' ? oldFiles : newFiles);
  assert.deepEqual(files, { ...own, ...foreign }, where);
  const listed = JSON.parse(readFileSync(join(below, 'report/manifest.json'), 'utf8')).files;
  assert.deepEqual(listed.map(({ name }) => name).sort(), Object.keys(own).sort(), where);
  assert.equal(readFileSync(join(below, 'neighbour.txt'), 'utf8'), 'mine');
  return which;
}

const nothingBeside = (below, where) => assert.deepEqual(readdirSync(below).sort(),
                                                         ['neighbour.txt', 'report'], where);

test('what the manifest does not list stays where it is, and is said', () => {
  const below = place('stays');
  writeFileSync(join(below, 'report/far/cell.js'), 'changed by hand');
  const inode = lstatSync(join(below, 'report/notes.txt')).ino;
  const { code, out, err } = run(command('report', ...newFiles), { cwd: below });
  assert.equal(code, 0, err);
  assert.deepEqual(reportFiles(below),
                   { ...asContent(newFiles), ...foreign, 'far/cell.js': 'changed by hand' });
  assert.equal(lstatSync(join(below, 'report/notes.txt')).ino, inode, 'the very same file');
  assert.equal(out, 'report: kept link, near/sketches/, notes.txt, which this program did not ' +
    'write\nreport: kept far/cell.js, changed since this program wrote it\n');
  nothingBeside(below);
});

test('a foreign or changed file where the new report needs its name is refused by its name', () => {
  for (const name of ['index.html', 'sun', 'sun/cell.js', 'manifest.json']) {
    const below = place(`in-the-way-of-${name.replace('/', '-')}`);
    if (name.includes('/')) mkdirSync(join(below, 'report/sun'));
    writeFileSync(join(below, 'report', name), 'mine');
    const before = contentOf(below);
    const done = run(command('report', ...newFiles), { cwd: below });
    assertRefused(done, name);
    if (name !== 'manifest.json') assert.ok(done.err.includes(`report/${name}: `), done.err);
    assert.deepEqual(contentOf(below), before, name);
  }
});

test('places that are not a report are refused, and stay as they are', () => {
  const below = join(scratch, 'refused');
  mkdirSync(below);
  const make = (name, ...files) => {
    mkdirSync(join(below, name), { recursive: true });
    for (const file of files) {
      mkdirSync(join(below, name, file, '..'), { recursive: true });
      writeFileSync(join(below, name, file), '{"schema":"shadowproof/results/1"}');
    }
    return name;
  };
  make('old-report', 'results.json', 'index.html');
  make('holiday', 'photo.jpg');
  make('manifest-of-another', 'manifest.json');
  writeFileSync(join(below, 'file'), 'text');
  for (const name of ['.git/config', '.hg/store', '.svn/entries', '.bzr/README', '_darcs/format',
                      '.jj/repo', 'CVS/Root', '.fslckout', '_FOSSIL_', '.pijul/config', '.git']) {
    const folder = `vcs-${name.replace(/\W/g, '-')}`;
    assert.equal(run(command(folder, ...oldFiles), { cwd: below }).code, 0);
    make(folder, name);
  }
  make('up/down');
  for (const name of ['link-to-holiday', 'link-to-here', 'link-to-root'])
    symlinkSync({ 'link-to-holiday': 'holiday', 'link-to-here': '.', 'link-to-root': '/' }[name],
                join(below, name));
  symlinkSync('loop', join(below, 'loop'));
  assert.equal(run(command('home', ...oldFiles), { cwd: below }).code, 0);
  const before = contentOf(below);
  for (const name of [...readdirSync(below), '.', '..', '/', '/proc', '/root', 'up/..', 'up/down/../..',
                      '/dev/null', 'file/below']) {
    if (name === 'up') continue;
    const done = run(command(name, ...newFiles),
                     { cwd: below, env: { HOME: join(below, 'home') } });
    assertRefused(done, name);
    assert.ok(done.err.startsWith(`replace_folder: ${name}: `), done.err);
  }
  assert.deepEqual(contentOf(below), before);
});

test('the empty home of any account is refused, and what holds it, but not what lies in it', (t) => {
  const below = join(scratch, 'homes');
  mkdirSync(join(below, 'people/ann'), { recursive: true });
  const accounts = join(scratch, 'passwd');
  writeFileSync(accounts, `${readFileSync('/etc/passwd', 'utf8')}ann:x:4711:4711::${below}/people/ann:\n`);
  // Seen by these runs alone.
  const knowing = (...args) =>
    ['unshare', '-m', 'sh', '-c', `mount --bind '${accounts}' /etc/passwd && exec "$@"`, 'sh', ...args];
  if (run(knowing('true')).code !== 0) return t.skip('nothing can be mounted here');
  symlinkSync('people/ann', join(below, 'link'));
  for (const name of ['people/ann', 'people/ann/', 'people', 'link']) {
    const done = run(knowing(...command(name, ...newFiles)), { cwd: below });
    assertRefused(done, name);
    assert.match(done.err, /is a home folder, or holds one/);
  }
  assert.deepEqual(contentOf(below), { link: '-> people/ann', people: 'folder', 'people/ann': 'folder' });
  assert.equal(run(knowing(...command('people/ann/report', ...newFiles)), { cwd: below }).code, 0);
  assert.equal(run(command('people', ...newFiles), { cwd: below }).code, 3, 'neither empty nor a report');
  assert.ok(existsSync(join(below, 'people/ann/report/index.html')));
});

test('a manifest cannot lead out of the folder', () => {
  const below = place('led-out');
  const manifest = JSON.parse(readFileSync(join(below, 'report/manifest.json'), 'utf8'));
  const { size, xxh3 } = manifest.files.find(({ name }) => name === 'index.html');
  mkdirSync(join(below, 'pictures'));
  writeFileSync(join(below, 'pictures/a.png'), 'old'); // what index.html holds
  symlinkSync('../pictures', join(below, 'report/pictures'));
  manifest.files.push({ name: 'pictures/a.png', size, xxh3 });
  writeFileSync(join(below, 'report/manifest.json'), JSON.stringify(manifest));
  assert.equal(run(command('report', ...newFiles), { cwd: below }).code, 0);
  assert.equal(readFileSync(join(below, 'pictures/a.png'), 'utf8'), 'old');
  assert.ok(lstatSync(join(below, 'report/pictures')).isSymbolicLink());
  for (const name of ['../neighbour.txt', '/etc/passwd', 'a//b', '.', '']) {
    writeFileSync(join(below, 'report/manifest.json'),
                  JSON.stringify({ ...manifest, files: [{ name, size, xxh3 }] }));
    assertRefused(run(command('report', ...oldFiles), { cwd: below }), name);
  }
  assert.equal(readFileSync(join(below, 'neighbour.txt'), 'utf8'), 'mine');
});

test("mode of the folder, and a link that leads to it, stay", () => {
  const below = place('mode');
  chmodSync(join(below, 'report'), 0o750);
  chmodSync(join(below, 'report/near/sketches'), 0o500);
  symlinkSync('report', join(below, 'latest'));
  symlinkSync('made', join(below, 'dangling'));
  assert.equal(run(command('latest', ...newFiles), { cwd: below }).code, 0);
  assert.equal(statSync(join(below, 'report')).mode & 0o777, 0o750);
  assert.equal(statSync(join(below, 'report/near/sketches')).mode & 0o777, 0o500);
  assert.ok(lstatSync(join(below, 'latest')).isSymbolicLink());
  assert.equal(assertWhole(below), 'new');
  assert.equal(run(command('dangling', ...newFiles), { cwd: below }).code, 0);
  assert.ok(existsSync(join(below, 'made/index.html')));
  assert.deepEqual(readdirSync(below).sort(),
                   ['dangling', 'latest', 'made', 'neighbour.txt', 'report']);
});

/** A process that holds the folder until it is told to go on. */
async function holder(below) {
  const child = spawn(program, ['report', ...newFiles],
                      { cwd: below, env: { ...process.env, REPLACE_FOLDER_WAITS: '1' } });
  await new Promise((resolve) => child.stdout.once('data', resolve));
  const end = () => new Promise((resolve) => {
    child.on('close', (code) => resolve(code));
    child.stdin.end('\n');
  });
  return { child, end };
}

test('a second run into one folder fails at once, and names the process that writes', async () => {
  const below = place('held');
  const { child, end } = await holder(below);
  for (const name of ['report', './report/', join(below, 'report')]) {
    const second = run(command(name, ...newFiles), { cwd: below });
    assertRefused(second, name);
    assert.match(second.err, new RegExp(`is being written by process ${child.pid} on \\S+, since `));
  }
  assert.equal(assertWhole(below), 'old');
  assert.equal(await end(), 0);
  assert.equal(assertWhole(below), 'new');
  nothingBeside(below);
});

test('a work folder of somebody else is refused and stays', () => {
  const below = place('not-ours');
  mkdirSync(join(below, 'report.writing/report'), { recursive: true });
  writeFileSync(join(below, 'report.writing/lock'), 'mine');
  writeFileSync(join(below, 'report.writing/report/index.html'), 'mine');
  const before = contentOf(below);
  assertRefused(run(command('report', ...newFiles), { cwd: below }), 'foreign lock');
  assert.deepEqual(contentOf(below), before);
  rmSync(join(below, 'report.writing/lock'));
  assertRefused(run(command('report', ...newFiles), { cwd: below }), 'no lock');
  assert.equal(readFileSync(join(below, 'report.writing/report/index.html'), 'utf8'), 'mine');
});

test('a file that came into the work folder of a dead process is never removed', async () => {
  const below = place('came');
  const { child } = await holder(below);
  const dead = new Promise((resolve) => child.on('close', resolve));
  child.kill('SIGKILL');
  await dead;
  writeFileSync(join(below, 'report.writing/report/mine.txt'), 'mine');
  const done = run(command('report', ...newFiles), { cwd: below });
  assertRefused({ ...done, err: done.err.replace('.writing/report', '') }, 'mine.txt');
  assert.match(done.err, /mine\.txt/);
  assert.equal(assertWhole(below), 'old');
  rmSync(join(below, 'report.writing/report/mine.txt'));
  assert.equal(run(command('report', ...newFiles), { cwd: below }).code, 0);
  assert.equal(assertWhole(below), 'new');
  nothingBeside(below);
});

test('a file of the work folder of a dead process that was edited, or put there, is never removed', async () => {
  const edits = {
    edited: (file) => writeFileSync(file, 'mine'),
    'of the same size': (file) => writeFileSync(file, 'nex'),
    'a link': (file) => { rmSync(file); symlinkSync('../../neighbour.txt', file); },
    'a manifest': (file) => writeFileSync(join(file, '../manifest.json'), '{}'),
  };
  for (const [name, edit] of Object.entries(edits)) {
    const below = place(`edited-${name.replaceAll(' ', '-')}`);
    const { child } = await holder(below);
    const dead = new Promise((resolve) => child.on('close', resolve));
    child.kill('SIGKILL');
    await dead;
    const content = join(below, 'report.writing/report');
    assert.ok(existsSync(join(content, 'index.html')));
    edit(join(content, 'index.html'));
    const changed = name === 'a manifest' ? 'manifest.json' : 'index.html';
    const mine = contentOf(content)[changed];
    for (let i = 0; i < 2; ++i) {
      const done = run(command('report', ...newFiles), { cwd: below });
      assertRefused({ ...done, err: done.err.replace('.writing/report', '') }, name);
      assert.ok(done.err.includes(`holds ${changed}, not as this program wrote it; move it away`), done.err);
      assert.equal(assertWhole(below), 'old');
      assert.deepEqual(contentOf(content), { [changed]: mine }, name); // all else was the program's
    }
    rmSync(join(content, changed));
    assert.equal(run(command('report', ...newFiles), { cwd: below }).code, 0);
    assert.equal(assertWhole(below), 'new');
    nothingBeside(below);
  }
});

/** What some file systems do not have, NFS and FUSE among them. */
const poor = { without: 'unnamed,exchange' };

test('a report is on the disk before it is at its place, and its name after', () => {
  const below = place('synced');
  for (const [folder, lacking, ...exchange] of [
    ['report', {}, 'renameat2 report'],
    ['new', {}, 'renameat2 new'],
    // Tried in vain first.
    ['report', poor, 'renameat2 report', 'rename report.writing/older', 'rename report'],
    ['newer', poor, 'renameat2 newer', 'rename newer'],
  ]) {
    const calls = loggedOf(command(folder, ...newFiles), below, { cwd: below, ...lacking });
    const synced = calls.indexOf(`syncfs ${folder}.writing/report`);
    assert.ok(synced > 0, calls.join('\n'));
    assert.ok(calls.slice(0, synced).filter((call) => call.startsWith('write ')).length > newFiles.length);
    for (const name of [...newFiles.map((file) => file.split('=')[0]), 'manifest.json'])
      assert.ok(calls.slice(0, synced).some((call) => call.endsWith(` ${folder}.writing/report/${name}`)), name);
    assert.deepEqual(calls.slice(synced + 1), [...exchange, 'fsync .'], folder);
  }
});

test('where any one file operation fails, the old report or the new one is whole', () => {
  for (const [reason, lacking] of [[5, {}], [28, {}], [5, poor]]) { // EIO, ENOSPC
    const below = place(`fails-${reason}-${lacking.without ?? ''}`);
    const count = operationsOf(command('report', ...newFiles), below, { cwd: below, ...lacking });
    for (let at = 1; at <= count + 3; ++at) {
      const where = `operation ${at} of ${count}, errno ${reason}, without ${lacking.without}`;
      run(command('report', ...oldFiles), { cwd: below });
      assert.equal(assertWhole(below, where), 'old');
      const done = run(command('report', ...newFiles),
                       { cwd: below, env: faults(below, { at, errno: reason, ...lacking }) });
      const which = assertWhole(below, where);
      if (done.code === 0) assert.equal(which, 'new', where);
      else assertRefused(done, where);
      nothingBeside(below, where);
    }
  }
});

test('a child process writes files of the folder, and one that fails leaves none half-written', () => {
  const below = place('forks');
  const options = { cwd: below, env: { REPLACE_FOLDER_FORKS: '1' } };
  assert.equal(run(command('report', ...newFiles), options).code, 0);
  assert.equal(assertWhole(below), 'new');
  const count = operationsOf(command('report', ...newFiles), below, { cwd: below });
  let fewer = 0;
  for (let at = 1; at <= count; ++at) {
    const where = `operation ${at} of ${count}`;
    const env = { ...options.env, ...faults(below, { at, errno: 28 }) };
    const done = run(command('report', ...newFiles), { cwd: below, env });
    if (done.code !== 0) assertRefused(done, where);
    const { 'notes.txt': notes, 'near/sketches/a.txt': sketch, link, ...own } = reportFiles(below);
    assert.deepEqual({ 'notes.txt': notes, 'near/sketches/a.txt': sketch, link }, foreign, where);
    const listed = JSON.parse(readFileSync(join(below, 'report/manifest.json'), 'utf8')).files;
    assert.deepEqual(listed.map(({ name }) => name).sort(), Object.keys(own).sort(), where);
    for (const [name, content] of Object.entries(own)) assert.equal(content, 'new', `${where}: ${name}`);
    if (Object.keys(own).length < newFiles.length) ++fewer;
    nothingBeside(below, where);
  }
  assert.ok(fewer > 0, 'no child failed');
});

/** After a kill: whole at its place, and the next run leaves nothing. */
function assertMended(below, where) {
  assertWhole(below, where);
  const next = run(command('report', ...newFiles), { cwd: below });
  assert.equal(next.code, 0, where + next.err);
  assert.equal(assertWhole(below, where), 'new');
  nothingBeside(below);
}

test('killed at any file operation, the old report or the new one is whole', () => {
  const below = place('killed');
  const count = operationsOf(command('report', ...newFiles), below, { cwd: below, ...changes });
  for (let at = 1; at <= count; ++at) {
    assert.equal(run(command('report', ...oldFiles), { cwd: below }).code, 0);
    const done = run(command('report', ...newFiles),
                     { cwd: below, env: faults(below, { at, ...killed }) });
    assert.equal(done.signal, 'SIGKILL', `operation ${at}`);
    assertMended(below, `killed at operation ${at} of ${count}`);
  }
});

test('where folders cannot be exchanged, a run after a kill finds what was there, or mends it', () => {
  const below = place('killed-poor');
  const count = operationsOf(command('report', ...newFiles), below, { cwd: below, ...changes, ...poor });
  let missing = 0;
  for (let at = 1; at <= count; ++at) {
    assert.equal(run(command('report', ...oldFiles), { cwd: below }).code, 0);
    run(command('report', ...newFiles), { cwd: below, env: faults(below, { at, ...killed, ...poor }) });
    if (existsSync(join(below, 'report'))) assertWhole(below, `operation ${at}`);
    else ++missing;
    assert.equal(run(command('report', ...newFiles), { cwd: below, env: faults(below, poor) }).code, 0);
    assertMended(below, `killed at operation ${at} of ${count}`);
  }
  assert.ok(missing <= 2, `${missing} moments without a report`);
});

test('killed twice in turn, a run after a run, nothing is lost either', () => {
  const below = place('killed-twice');
  const count = operationsOf(command('report', ...newFiles), below, { cwd: below, ...changes });
  for (let at = 3; at <= count; at += 3) {
    run(command('report', ...oldFiles), { cwd: below });
    for (const files of [newFiles, newFiles])
      run(command('report', ...files), { cwd: below, env: faults(below, { at, ...killed }) });
    assertMended(below, `killed twice at operation ${at}`);
  }
});

test('killed at a hundred random moments, the old report or the new one is whole', async () => {
  const below = place('killed-at-random');
  const begin = process.hrtime.bigint();
  run(command('report', ...oldFiles), { cwd: below });
  const milliseconds = Number(process.hrtime.bigint() - begin) / 1e6;
  for (let i = 0; i < 100; ++i) {
    run(command('report', ...oldFiles), { cwd: below });
    await killedAfter(milliseconds * (i + 1) / 80, command('report', ...newFiles), { cwd: below });
    assertMended(below, `killed at moment ${i}`);
  }
});
