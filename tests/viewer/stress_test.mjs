// The page of stress: made by a small run, opened from disk.
import assert from 'node:assert/strict';
import { existsSync, readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join } from 'node:path';
import { before, test } from 'node:test';
import { scratch, shadowproof } from '../command/shadowproof.mjs';
import { keepScreenshot, openReport } from './browser.mjs';
import { named } from './scripts.mjs';

const axe = readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');
const { valueScale, shareScale, roomy } =
  named(['numbers.js', 'labels.js', 'bench/figures.js', 'bench/layout.js', 'bench/plot.js', 'stress/chart.js'],
        ['valueScale', 'shareScale', 'roomy']);

let folder;
let run;
before(() => {
  const { code, err } = shadowproof(['stress', 'near_plane', '--size', '48x48', '--out', 'stress',
    '--technique', 'zpass,zfail,zfail_reversed', '--parameter', 'near_plane,light_to_face', '-q']);
  assert.equal(code, 0, err);
  folder = join(scratch, 'stress');
  run = JSON.parse(readFileSync(join(folder, 'results.json'), 'utf8'));
});

test('zero stands apart from the least other value, on both axes', () => {
  const x = valueScale([0, 1e-16, 1e-3, 1], 100, 900);
  assert.equal(x(0), 100);
  assert.ok(x(1e-16) > 130 && x(1e-16) < x(1e-3) && x(1) === 900);
  const y = shareScale([0, 0.01, 10], 50, 250);
  assert.equal(y(0), 250);
  assert.ok(y(0.01) < 230 && y(10) < y(0.01) && y(10) >= 50);
  assert.equal(shareScale([0, 0], 50, 250)(0), 250);
});

test('words of values keep their distance', () => {
  assert.deepEqual(roomy([1, 5, 100, 130, 300], (value) => value, 54), [1, 100, 300]);
});

test('the page opens from disk in silence, with a section for each parameter', async () => {
  const { page, said, asked } = await openReport(folder);
  assert.deepEqual(await page.locator('.parameter h2').allInnerTexts(),
                   ['near_plane', 'light_to_face']);
  await keepScreenshot(page, 'stress', { fullPage: true });
  assert.deepEqual([said, asked], [[], []]);
});

test('breaking points are those of the results, each with its mark in the chart', async () => {
  const { page } = await openReport(folder);
  const along = run.breaking.filter(({ parameter }) => parameter === 'light_to_face');
  const measured = along.filter((each) => each.measured !== null);
  const derived = along.filter((each) => each.derived !== null);
  assert.ok(measured.length > 0 && derived.length > 0);
  const rows = new Set([...measured, ...derived]).size;
  assert.equal(await page.locator('#light_to_face table.numbers tbody tr').count(), rows);
  assert.equal(await page.locator('#light_to_face svg .breaking').count(), measured.length);
  assert.equal(await page.locator('#light_to_face svg .derived').count(), derived.length);
});

test('an entry tells its causes and command, and leads to its pictures', async () => {
  const { page } = await openReport(folder);
  const section = page.locator('#near_plane');
  await section.locator('details summary').click();
  await section.locator('button[data-verdict="fails"]').first().click();
  const story = await section.locator('.story').innerText();
  assert.match(story, /zpass at near_plane=1e-07/);
  assert.match(story, /% wrong \(precision/);
  assert.match(story, /shadowproof verify near_plane --technique zpass --size 48x48 --stress near_plane=1e-07/);
  const link = await section.locator('a.pictures').getAttribute('href');
  const [file, cell] = link.split('#');
  assert.ok(existsSync(join(folder, file)));
  await section.locator('a.pictures').click();
  await page.waitForSelector('main h1');
  assert.match(page.url(), new RegExp(`pictures/index.html#${cell}`));
  assert.match(await page.locator('main').innerText(), /zpass/);
});

test('of one technique the chart has a line for each cause', async () => {
  const { page } = await openReport(folder);
  await page.selectOption('#technique', 'zpass');
  const words = await page.locator('#near_plane svg').first().innerHTML();
  assert.match(words, /Wrong pixels of zpass, by cause/);
  assert.match(words, />near_plane</);
});

for (const theme of ['light', 'dark'])
  test(`axe-core finds nothing (${theme})`, async () => {
    const { page } = await openReport(folder, { theme });
    await page.locator('#near_plane details summary').click();
    await page.locator('#near_plane button[data-verdict="fails"]').first().click();
    await page.evaluate(axe);
    const { violations } = await page.evaluate(() => window.axe.run(document, {
      runOnly: ['wcag2a', 'wcag2aa', 'wcag21a', 'wcag21aa', 'wcag22aa', 'best-practice'] }));
    assert.deepEqual(violations.map(({ id, nodes }) =>
      `${id}: ${nodes.slice(0, 3).map(({ html }) => html.slice(0, 200)).join(' | ')}`), []);
  });
