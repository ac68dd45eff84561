// The README and the pages below docs: their tables say what the program says, their links lead
// somewhere, here and where they are installed.
import assert from 'node:assert/strict';
import { existsSync, readFileSync, readdirSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { filesBelow, shadowproof } from './shadowproof.mjs';

const root = fileURLToPath(new URL('../../', import.meta.url));
const textOf = (file) => readFileSync(join(root, file), 'utf8');
const pages = ['README.md', ...readdirSync(join(root, 'docs')).filter((file) => file.endsWith('.md'))
  .map((file) => `docs/${file}`)];

/** The rows of the table whose first column has that title, cell by cell. */
const tableOf = (file, title) =>
  `${textOf(file)}\n\n`.match(new RegExp(`^\\| ${title} \\|[^]*?\n\n`, 'm'))[0].trim().split('\n')
    .map((line) => line.split('|').slice(1, -1).map((words) => words.trim()));

/** The names in backquotes in a table's first column. */
const namesIn = (file, title) =>
  tableOf(file, title).slice(2).flatMap(([first]) => [...first.matchAll(/`([^`]+)`/g)])
    .map(([, name]) => name);

test('the table of techniques says what list says', () => {
  const [titles, , ...rows] = tableOf('docs/techniques.md', 'technique');
  const { techniques } = JSON.parse(shadowproof(['list', '--json']).out);
  const shown = rows.map((row) => Object.fromEntries(titles.map((title, i) => [title, row[i]])));
  // What all may show, the text below the table says.
  const uncounted = ['invert', 'zfail_float'];
  const common = ({ name, precise }) => (precise === null ? ['precision']
    : ['precision', 'open_mesh', 'alpha', ...(uncounted.includes(name) ? [] : ['counter'])]);
  for (const technique of techniques)
    for (const cause of common(technique))
      assert.ok(technique.fails_at.includes(cause), `${technique.name} ${cause}`);
  const failings = ({ fails_at, by_nature, ...technique }) =>
    [...by_nature, ...fails_at.filter((cause) => !by_nature.includes(cause) &&
                                                 !common(technique).includes(cause))]
      .map((cause) => `\`${cause}\`${by_nature.includes(cause) ? '\\*' : ''}`).join(', ') || '–';
  assert.deepEqual(
    shown.map((row) => [row.technique, row.source, row.needs, row['fails at'], Number(row.time)]),
    techniques.map((technique) => [`\`${technique.name}\``, technique.source, technique.needs,
                                   failings(technique), technique.cost]));
});

test('the table of bundled scenes has each of them, once', () => {
  const { scenes } = JSON.parse(shadowproof(['list', '--json']).out);
  assert.deepEqual(namesIn('docs/scenes.md', 'bundled scene').sort(),
                   scenes.map(({ name }) => name).sort());
});

test("the README's example lines are what verify prints, but for times", () => {
  const withoutTimes = (line) => line.replace(/  [\d.]+ ms$/, '');
  const examples = textOf('README.md').match(/^\w+ +near_plane  .* ms$/gm);
  assert.equal(examples.length, 2);
  const techniques = examples.map((line) => line.split(' ')[0]).join();
  const run = shadowproof(['verify', 'near_plane', '--technique', techniques]);
  assert.equal(run.code, 0, run.err);
  assert.deepEqual(examples.map(withoutTimes), run.out.match(/^\w+ +near_plane  .* ms$/gm).map(withoutTimes));
});

test('the README is read in two minutes', () => {
  const words = textOf('README.md').replace(/\]\([^)]*\)/g, ']').split(/\s+/)
    .filter((word) => /[a-z0-9]/i.test(word));
  assert.ok(words.length <= 550, `${words.length} words`);
});

test('the folders on the page of the house are there', () => {
  const folders = namesIn('docs/house.md', 'folder');
  assert.ok(folders.length > 20);
  for (const folder of folders) assert.ok(existsSync(join(root, folder)), folder);
});

/** Where a page's links lead: [file from the root, heading or undefined]. */
const linksOf = (page) =>
  [...textOf(page).matchAll(/\]\(([^)\s]+)\)/g)].map(([, link]) => link)
    .filter((link) => !/^https?:/.test(link))
    .map((link) => link.split('#'))
    .map(([file, heading]) => [file === '' ? page : join(dirname(page), file), heading]);

/** As GitHub makes them of headings. */
const anchorsOf = (page) =>
  [...textOf(page).matchAll(/^#+ (.*)$/gm)].map(([, heading]) =>
    heading.toLowerCase().replace(/[^\p{L}\p{N} _-]/gu, '').replaceAll(' ', '-'));

test('every link leads to a file, and to a heading that it has', () => {
  assert.ok(pages.flatMap(linksOf).length > 40);
  for (const page of pages)
    for (const [file, heading] of linksOf(page)) {
      assert.ok(existsSync(join(root, file)), `${page}: ${file}`);
      if (heading) assert.ok(anchorsOf(file).includes(heading), `${page}: ${file}#${heading}`);
    }
});

test('every test that the page of promises names is there, and each promise names one', () => {
  const all = filesBelow(join(root, 'tests'));
  const page = textOf('docs/reliability.md');
  const named = [...page.matchAll(/`([^`\s]*_test\.(?:mjs|cpp))`/g)].map(([, name]) => name);
  assert.ok(named.length > 40);
  for (const name of named) {
    const text = `(^|/)${name.replace(/^tests\//, '').replaceAll('.', '\\.').replaceAll('*', '[^/]*')}$`;
    assert.ok(all.some((file) => new RegExp(text).test(file)), name);
  }
  for (const [, folder] of page.matchAll(/`(tests\/[^`\s]*)`/g)) assert.ok(existsSync(join(root, folder)), folder);
  // A test that is quoted by its own name: `file`, "name".
  const quoted = [...page.matchAll(/`(\w+\/\w+_test\.mjs)`,\s+"([^"]+)"/g)];
  assert.ok(quoted.length >= 7);
  for (const [, file, name] of quoted)
    assert.ok(textOf(`tests/${file}`).includes(name.replaceAll(/\s+/g, ' ')), `${file}: ${name}`);
  for (const [, promise] of page.split('## Your files')[1].split('\nLimits. ')[0].matchAll(/\n(\*\*[^]*?)\n\n/g))
    assert.match(promise, /_test\.mjs`/, promise);
});

test('the hypotheses of a diagnosis are those that the program, the page and the schema name', () => {
  const folder = join(root, 'compare/picture');
  const source = readdirSync(folder).filter((file) => file.endsWith('_hypotheses.cpp') ||
                                                      file === 'moved_light.cpp')
    .map((file) => readFileSync(join(folder, file), 'utf8')).join('');
  const tried = new Set([...source.matchAll(/(?:consider\(\s*|\.hypothesis = )"(\w+)"/g)]
    .map(([, name]) => name));
  const listed = new Set([...textOf('docs/results.schema.json')
    .match(/"hypothesis": \{"enum": \[([^\]]*)\]/)[1].matchAll(/\w+/g)].map(([name]) => name));
  const explained = new Set(tableOf('docs/check.md', 'hypothesis').slice(2)
    .flatMap(([first]) => [...first.matchAll(/`(\w+)`/g)]).map(([, name]) => name));
  assert.deepEqual([...explained].sort(), [...listed].sort());
  assert.deepEqual([...tried].sort(), [...listed].sort());
});

test('what the pages link to is installed with them', () => {
  const installed = textOf('cmake/install.cmake');
  for (const [file] of pages.flatMap(linksOf))
    if (file.startsWith('docs/')) assert.ok(installed.includes(file), file);
});

test('the house has a line for each room, and no other', () => {
  const named = namesIn('docs/house.md', 'folder').filter((name) => !name.startsWith('tests') &&
                                                                    name !== 'scenes/bundled');
  const roomsBelow = (folder) => readdirSync(join(root, folder), { withFileTypes: true })
    .filter((entry) => entry.isDirectory()).flatMap(({ name }) => roomsBelow(join(folder, name)))
    .concat(existsSync(join(root, folder, 'CMakeLists.txt')) ? [folder] : []);
  const rooms = ['scenes', 'reference', 'raster', 'compare'].flatMap(roomsBelow);
  assert.deepEqual(named.filter((name) => !existsSync(join(root, name))), []);
  assert.deepEqual(rooms.filter((room) => !named.includes(room)), ['scenes/bundled']
    .filter((room) => rooms.includes(room)));
});
