// Colours that stand for all of a pixel: the cell shows means over pixels as right, tells how far they
// are off by texels in a pixel and by angle, and charts that beside the other techniques'.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { before, test } from 'node:test';
import { cellsOf, keepScreenshot, openReport, resultsOf, size, text, writeReport } from './browser.mjs';
import { scratch, shadowproof } from '../command/shadowproof.mjs';

const techniques = ['bump_tangent_space', 'bump_mipmapped', 'bump_toksvig', 'zfail_reversed'];
let folder;
let cells;
before(() => {
  folder = writeReport('report', ['distant_bumps'], undefined, techniques);
  cells = cellsOf(resultsOf(folder)).map(({ cell }) => cell);
});

const cellOf = (name) => cells.find((cell) => cell.name === name);
const plain = (words) => words.replace(/\s+/g, ' ').trim();

test('results tell how far all colours are from the means, and which filter made them', () => {
  const [unfiltered, mean, toksvig, volumes] = techniques.map(cellOf);
  assert.equal(unfiltered.color.filter, undefined);
  assert.equal(mean.color.filter, 'renormalised');
  assert.deepEqual([toksvig.color.filter, toksvig.color.anisotropy], ['toksvig', 1]);
  assert.equal(volumes.color, undefined);
  for (const { color } of [unfiltered, mean, toksvig]) {
    const means = color.pixel_means;
    assert.equal(means.most_rays, 1024);
    for (const bins of [means.by_texels, means.by_angle]) {
      const pixels = bins.reduce((sum, bin) => sum + bin.pixels, 0);
      assert.ok(pixels > 5000 && pixels <= means.alike);
    }
  }
  // What filters is held against the means, what does not against pixels' centres.
  assert.ok(Math.abs(mean.color.rmse - mean.color.pixel_means.rmse) < 1e-9);
  assert.ok(unfiltered.color.rmse < unfiltered.color.pixel_means.rmse / 10);
  // The filter is what brings it closer to the mean.
  assert.ok(mean.color.pixel_means.alike_rmse < unfiltered.color.pixel_means.alike_rmse);
});

test('the cell charts errors of what filters, itself, and one that does not', async () => {
  const { page, said } = await openReport(folder, { hash: '#distant_bumps/bump_toksvig' });
  const charts = page.locator('.filtering svg');
  assert.equal(await charts.count(), 2);
  for (const chart of await charts.all())
    assert.deepEqual(await chart.locator('.filter > text').allTextContents(),
                     ['bump_tangent_space', 'bump_mipmapped', 'bump_toksvig']);
  assert.equal(await charts.first().locator('.filter.own > text').textContent(), 'bump_toksvig');
  const { by_texels: bins } = cellOf('bump_toksvig').color.pixel_means;
  assert.equal(await charts.first().locator('.filter.own circle').count(), bins.length);
  const told = await charts.first().locator('.filter.own circle title').first().textContent();
  assert.ok(told.startsWith('bump_toksvig, ') && told.includes('texels in a pixel: '), told);
  const words = plain(await text(page, 'p.colors:not(.values)'));
  assert.ok(words.includes('from the mean over the pixel'), words);
  assert.ok(words.includes('bumps filtered (toksvig) by 1 lookup'), words);
  assert.deepEqual(said, []);
  await keepScreenshot(page, 'filtering', { fullPage: true });
});

test('other cells have no such charts', async () => {
  const { page, said } = await openReport(folder, { hash: '#distant_bumps/zfail_reversed' });
  assert.equal(await page.locator('.filtering').count(), 0);
  assert.deepEqual(said, []);
});

test('a pixel shows its mean as explain tells it', async () => {
  const [x, y] = [80, 92];
  const { page } = await openReport(folder, { hash: `#distant_bumps/bump_toksvig?pixel=${x},${y}` });
  const shown = plain(await text(page, '.values.colors'));
  const file = join(scratch, 'filtered.json');
  const run = shadowproof(['explain', 'distant_bumps', '--technique', 'bump_toksvig', '--size', size,
    '--pixel', `${x},${y}`, '--json', file, '-q']);
  assert.equal(run.code, 0, run.out + run.err);
  const [{ color: told }] = JSON.parse(readFileSync(file, 'utf8')).techniques;
  const bytes = told.true.map((linear) => Math.round(255 * Math.min(1,
    linear <= 0.0031308 ? 12.92 * linear : 1.055 * linear ** (1 / 2.4) - 0.055)));
  assert.ok(shown.includes(`true mean ${bytes.join(' ')}`), `${shown}: ${bytes}`);
  assert.equal(told.rays.length, 2);
  assert.ok(told.rays.every((rays) => rays >= 4 && rays <= 32));
});
