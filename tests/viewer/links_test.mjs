// A link restores the view that it was copied from.
import assert from 'node:assert/strict';
import { before, test } from 'node:test';
import { openReport, settledLink, shown, text, writeReport } from './browser.mjs';

let folder;
before(() => { folder = writeReport('report', ['near_plane']); });

/** The bytes of the picture in the first pane. */
const painted = (page) => page.locator('.stage').screenshot();

const links = [
  '#near_plane/zpass?zoom=16&centre=70.5,40.25&pixel=70,40',
  '#near_plane/zpass?view=slide&of=claim,cause&at=0.37&pixel=66,33&cause=near_plane',
  '#near_plane/zpass?view=blend&of=predicted,read_back&at=0.8&zoom=4&centre=80,80&pixel=66,33',
  '#near_plane/zpass?view=toggle&of=truth,difference&flipped=1&pixel=3,4',
  '#near_plane/zfail?pixel=10,10',
];

test('a link that is opened stays as it is, and shows the same twice', async () => {
  const { page, open, said } = await openReport(folder);
  for (const link of links) {
    await open(link);
    assert.equal(await settledLink(page), link);
    const before = await painted(page);
    await open(link);
    assert.deepEqual(await painted(page), before, link);
  }
  assert.deepEqual(said, []);
});

test('what a person does is in the link, and the link does it again', async () => {
  const { page, open } = await openReport(folder, { hash: '#near_plane/zpass' });
  await page.locator('#view-slide').click();
  await page.locator('#choose-1').selectOption('cause');
  const pane = page.locator('canvas.pane');
  await pane.hover({ position: { x: 250, y: 200 } });
  for (let i = 0; i < 4; ++i) await page.mouse.wheel(0, -100);
  const box = await pane.boundingBox();
  await page.mouse.move(box.x + 200, box.y + 200);
  await page.mouse.down();
  await page.mouse.move(box.x + 160, box.y + 230, { steps: 4 });
  await page.mouse.up();
  await pane.click({ position: { x: 300, y: 120 } });
  const link = await settledLink(page);
  for (const part of [/view=slide/, /of=truth,cause/, /zoom=\d/, /centre=[\d.]+,[\d.]+/, /pixel=\d+,\d+/])
    assert.match(link, part);
  await page.mouse.move(0, 0);
  await page.evaluate(() => document.activeElement.blur());
  const [before, pixel] = [await painted(page), await text(page, '.inspector h2')];
  await open(link);
  assert.equal(await text(page, '.inspector h2'), pixel);
  assert.equal(await settledLink(page), link);
  assert.deepEqual(await painted(page), before);
});

test('panes move as one: what one is zoomed to, all are', async () => {
  const { page } = await openReport(folder, { hash: '#near_plane/zpass?zoom=32&centre=80.5,80.5' });
  await page.locator('canvas[data-picture="claim"]').hover();
  await page.mouse.wheel(0, 100);
  await settledLink(page);
  // The counter is an exact picture of its blocks, and the truth of its own: at one place.
  const places = await page.evaluate(() => location.hash);
  assert.match(places, /zoom=24/);
  await page.locator('canvas[data-picture="truth"]').click({ position: { x: 100, y: 100 } });
  const first = await text(page, '.inspector h2');
  await page.locator('canvas[data-picture="read_back"]').click({ position: { x: 100, y: 100 } });
  assert.equal(await text(page, '.inspector h2'), first);
});

test('a link that is followed stands, though what was shown before was still to be remembered', async () => {
  const { page } = await openReport(folder, { hash: '#near_plane/zpass' });
  await settledLink(page);
  // The timer of the old view runs out between the new address and its event.
  await page.evaluate(() => {
    const { setTimeout } = window;
    let late;
    window.setTimeout = (call) => { late = call; return 0; };
    document.dispatchEvent(new KeyboardEvent('keydown', { key: '+' }));
    window.setTimeout = setTimeout;
    location.hash = '#near_plane/zfail?pixel=10,10';
    late();
  });
  await page.waitForFunction(() => /zfail/.test(document.querySelector('h1').textContent));
  assert.equal(await settledLink(page), '#near_plane/zfail?pixel=10,10');
  assert.equal(await text(page, '.inspector h2'), 'Pixel (10, 10)');
});

test('back and forth in the history follows, and an unknown cell is named', async () => {
  const { page, open } = await openReport(folder);
  await page.locator('.matrix td a').first().click();
  await shown(page);
  assert.match(await text(page, 'h1'), /near_plane \/ zpass/);
  await page.goBack();
  await page.waitForSelector('.matrix');
  await open('#near_plane/nothing');
  assert.match(await text(page, '.alert'), /no cell “near_plane\/nothing”/);
});

test('at 32 pixels a pixel, values stand in the pixels and their grid is drawn', async () => {
  const { page } = await openReport(folder, { hash: '#near_plane/zpass?zoom=32&centre=80.5,80.5' });
  const colors = await page.locator('canvas[data-picture="predicted"]').evaluate((canvas) => {
    const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
    const found = new Set();
    for (let i = 0; i < data.length; i += 4) found.add(`${data[i]},${data[i + 1]},${data[i + 2]}`);
    return found.size;
  });
  assert.ok(colors > 8, `${colors} colours: digits are antialiased, plain pixels are not`);
});
