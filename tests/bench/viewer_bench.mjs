// How large a report of sixty cells is, and how soon it can be used in a browser.
//   SHADOWPROOF=build/release/shadowproof node tests/bench/viewer_bench.mjs [RUNS]
// Of a report that is there, how soon its overview and, of each scene, the cell with most data open:
//   node tests/bench/viewer_bench.mjs RUNS REPORT
import { spawnSync } from 'node:child_process';
import { existsSync, mkdtempSync, readdirSync, rmSync, statSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { chromium } from 'playwright-core';

const runs = Number(process.argv[2] ?? 5);
const given = process.argv[3];
const folder = given ?? mkdtempSync(join(tmpdir(), 'shadowproof-bench-'));
const scenes = ['near_plane', 'far_plane', 'eye_inside', 'ordinary'];

const bytesBelow = (path) => (statSync(path).isDirectory()
  ? readdirSync(path).reduce((sum, name) => sum + bytesBelow(join(path, name)), 0)
  : statSync(path).size);

const median = (values) => [...values].sort((a, b) => a - b)[values.length >> 1];

/** Milliseconds from asking for the address until the page has what `isThere` looks for. */
async function opened(browser, hash, isThere) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 800 }, offline: true });
  const page = await context.newPage();
  const begin = performance.now();
  await page.goto(pathToFileURL(join(folder, 'index.html')).href + hash, { waitUntil: 'commit' });
  await page.waitForFunction(isThere, null, { polling: 'raf' });
  const ms = performance.now() - begin;
  await context.close();
  return ms;
}

/** Milliseconds from a click on a cell of the open overview until its pixel is inspected. */
async function clicked(browser, isThere) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 800 }, offline: true });
  const page = await context.newPage();
  await page.goto(pathToFileURL(join(folder, 'index.html')).href);
  const link = page.locator('.matrix td a').first();
  await link.waitFor();
  const begin = performance.now();
  await link.click();
  await page.waitForFunction(isThere, null, { polling: 'raf' });
  const ms = performance.now() - begin;
  await context.close();
  return ms;
}

const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
  args: process.getuid?.() === 0 ? ['--no-sandbox'] : [],
});
const tell = (what, ms) => console.log(
  `${what.padEnd(34)} median ${median(ms).toFixed(0)} ms, worst ${Math.max(...ms).toFixed(0)} ms`);

/** Of each scene of the report "nested/zpass": the cell whose own data are largest. */
const largestCells = () => readdirSync(folder).flatMap((scene) => {
  if (!existsSync(join(folder, scene, 'scene.js'))) return [];
  const sizeOf = (technique) => bytesBelow(join(folder, scene, `${technique}.cell.js`));
  const cells = readdirSync(join(folder, scene)).filter((name) => name.endsWith('.cell.js'))
    .map((name) => name.slice(0, -'.cell.js'.length));
  return cells.length === 0 ? [] : [`${scene}/${cells.reduce((a, b) => (sizeOf(a) >= sizeOf(b) ? a : b))}`];
});

if (given) {
  const pages = [['', () => document.querySelector('.matrix td a')]].concat(
    largestCells().map((cell) => [`#${cell}`, () => document.querySelector('canvas.pane') &&
      document.querySelector('#pixel-title')]));
  const medians = [];
  for (const [hash, isThere] of pages) {
    const ms = [];
    for (let i = 0; i < runs; ++i) ms.push(await opened(browser, hash, isThere));
    tell(hash || 'overview', ms);
    medians.push(median(ms));
  }
  console.log(`${pages.length} pages, slowest ${Math.max(...medians).toFixed(0)} ms`);
  await browser.close();
  process.exit(0);
}

const verify = spawnSync(process.env.SHADOWPROOF,
                         ['verify', ...scenes, ...scenes, ...scenes, '--out', folder, '-q', '--technique',
                          'zpass,zfail,zfail_clamp,zfail_infinite,zfail_reversed'],
                         { encoding: 'utf8' });
if (verify.status > 1) throw new Error(verify.stderr);
const overview = () => document.querySelectorAll('.matrix td a').length === 60 &&
  document.querySelector('.plot');
const cell = () => document.querySelector('#cutaway svg') &&
  document.querySelectorAll('canvas.pane').length === 7;
const times = { overview: [], 'a link to a cell': [], 'a click on a cell': [] };
for (let i = 0; i < runs; ++i) {
  times.overview.push(await opened(browser, '', overview));
  times['a link to a cell'].push(await opened(browser, '#near_plane/zpass', cell));
  times['a click on a cell'].push(await clicked(browser, cell));
}
await browser.close();
console.log(`60 cells at 512x512: ${(bytesBelow(folder) / 2 ** 20).toFixed(1)} MiB`);
for (const [what, ms] of Object.entries(times)) tell(what, ms);
rmSync(folder, { recursive: true });
