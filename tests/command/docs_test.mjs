// The README and the pages below docs: their tables say what the program says, their links lead
// somewhere, here and where they are installed.
import assert from 'node:assert/strict';
import { existsSync, readFileSync, readdirSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { shadowproof } from './shadowproof.mjs';

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
  const common = ({ name }) => (/^traced_|_map/.test(name) ? ['precision']
    : ['precision', 'open_mesh', ...(uncounted.includes(name) ? [] : ['counter'])]);
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

test('what the pages link to is installed with them', () => {
  const installed = textOf('cmake/install.cmake');
  for (const [file] of pages.flatMap(linksOf))
    if (file.startsWith('docs/')) assert.ok(installed.includes(file), file);
});
