// What is missing or damaged is named, and never taken for agreement.
import assert from 'node:assert/strict';
import { readFileSync, rmSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { before, test } from 'node:test';
import { damageBlock, rewriteBytes } from './coded.mjs';
import { copyOfReport, keepScreenshot, openReport, resultsOf, text, writeReport } from './browser.mjs';

let folder;
let copies = 0;
before(() => { folder = writeReport('report', ['near_plane']); });

const cellFile = 'near_plane/zpass.cell.js';
const link = '#near_plane/zpass?pixel=66,33';

/** A copy of the report after `damage(path)` was done to it, opened at a cell. */
async function opened(damage, hash = link) {
  const copy = copyOfReport(folder, `damaged-${++copies}`);
  damage((path) => join(copy, path));
  return openReport(copy, { hash });
}

function rewrite(path, change) {
  const old = readFileSync(path, 'utf8');
  const changed = change(old);
  assert.notEqual(changed, old);
  writeFileSync(path, changed);
}

const alerts = async (page) => (await page.locator('.alert, .broken').allInnerTexts()).join('\n');

async function saysNothingAgrees(page) {
  assert.doesNotMatch(await text(page, '.inspector'), /agree here/);
}

test('a missing picture is named in its place', async () => {
  const { page } = await opened((path) => rmSync(path('near_plane/zpass.claim.png')));
  assert.match(await alerts(page), /near_plane\/zpass\.claim\.png is missing or damaged/);
  assert.equal(await page.locator('canvas[data-picture="claim"]').count(), 0);
  assert.equal(await page.locator('canvas[data-picture="truth"]').count(), 1);
  await page.locator('#view-slide').click();
  assert.match(await text(page, '.stage'), /claim\.png is missing or damaged/);
});

test('a picture that ends early is named', async () => {
  const { page } = await opened((path) => {
    const bytes = readFileSync(path('near_plane/truth.png'));
    writeFileSync(path('near_plane/truth.png'), bytes.subarray(0, 20));
  });
  assert.match(await alerts(page), /near_plane\/truth\.png is missing or damaged/);
});

test('a picture of another size is named with both sizes, never stretched', async () => {
  const { page } = await opened((path) => writeFileSync(path('near_plane/zpass.cause.png'),
    Buffer.from('iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNk+M9QDwADhgGAWjR9awAAAABJRU5ErkJggg==', 'base64')));
  assert.match(await alerts(page), /cause\.png is 1×1 pixels; the results are of 160×160/);
});

test('a missing script of a cell is named; a differing pixel keeps no ledger and does not agree', async () => {
  const { page } = await opened((path) => rmSync(path(cellFile)));
  assert.match(await alerts(page), /near_plane\/zpass\.cell\.js is missing/);
  await saysNothingAgrees(page);
  await keepScreenshot(page, 'damaged', { fullPage: true });
  await page.locator('#goto').fill('0,0');
  await page.locator('#goto').press('Enter');
  await saysNothingAgrees(page);
});

test('a missing script of a scene is named', async () => {
  const { page } = await opened((path) => rmSync(path('near_plane/scene.js')));
  assert.match(await alerts(page), /near_plane\/scene\.js is missing/);
  await saysNothingAgrees(page);
});

test('a script that ends early is damaged', async () => {
  const { page } = await opened((path) => rewriteBytes(path(cellFile), (old) => old.slice(0, 2000)));
  assert.match(await alerts(page), /near_plane\/zpass\.cell\.js is damaged/);
  await saysNothingAgrees(page);
});

for (const block of ['claim', 'read_back', 'ledger', 'crossing', 'triangle', 'vertex'])
  test(`a damaged block is named: ${block}`, async () => {
    const { page } = await opened((path) => damageBlock(path(cellFile), block));
    assert.match(await alerts(page), new RegExp(`cell\\.js: block ${block} is damaged`));
    await saysNothingAgrees(page);
    assert.equal(await page.locator('.ledger').count(), 0);
  });

for (const block of ['seen', 'exactness'])
  test(`a damaged block of the scene is named: ${block}`, async () => {
    const { page } = await opened((path) => damageBlock(path('near_plane/scene.js'), block));
    assert.match(await text(page, '.inspector .alert'),
                 new RegExp(`evidence cannot be shown: near_plane/scene\\.js: block ${block} is damaged`));
    assert.equal(await page.locator('.ledger').count(), 0);
  });

test('results that name no picture are told so', async () => {
  const { page } = await opened((path) => {
    const results = resultsOf(path('.'));
    const { images } = results.scenes[0].techniques.find(({ name }) => name === 'zpass');
    assert.ok(delete images.cause);
    writeFileSync(path('results.js'), `shadowproof.results(${JSON.stringify(results)});`);
  });
  assert.match(await text(page, '.stage .broken'), /^the results name no picture of the cause$/);
});

test('a block of another length is damaged', async () => {
  const { page } = await opened((path) => rewriteBytes(path('near_plane/scene.js'), (old) =>
    old.replace(/("visibility":\s*\{[^}]*"length":)\d+/, '$1100')));
  assert.match(await alerts(page),
               /scene\.js: block visibility is damaged: 100 elements where 25600 belong/);
  assert.match(await alerts(page), /cell\.js: block claim cannot be decoded without visibility/);
  await saysNothingAgrees(page);
});

test('a damaged cause map is named, and no pixel is said to agree', async () => {
  const { page } = await opened((path) => damageBlock(path(cellFile), 'cause'));
  assert.match(await alerts(page), /near_plane\/zpass\.cell\.js: block cause is damaged/);
  assert.match(await alerts(page), /block ledger cannot be decoded without the cause map/);
  await saysNothingAgrees(page);
});

test('a cell of another run is not taken for one of this', async () => {
  const { page } = await opened((path) => {
    const other = readFileSync(path('near_plane/zfail.cell.js'), 'latin1');
    writeFileSync(path(cellFile), other.replace('near_plane/zfail', 'near_plane/zpass'), 'latin1');
  });
  assert.match(await alerts(page), /zpass\.cell\.js/);
  assert.equal(await page.locator('.ledger').count(), 0);
});

test('a blank truth is named', async () => {
  const { page } = await opened((path) => {
    const results = resultsOf(path('.'));
    Object.assign(results.scenes[0].reference, { lit: 0, shadowed: 0, background: 25600 });
    writeFileSync(path('results.js'), `shadowproof.results(${JSON.stringify(results)});`);
  });
  assert.match(await alerts(page), /The truth is blank: no pixel sees a surface/);
});

test('without its results the report says so', async () => {
  const { page } = await opened((path) => rmSync(path('results.js')), '');
  assert.match(await alerts(page), /results\.js, .*is missing or damaged/);
  const damaged = await opened((path) => rewrite(path('results.js'), (old) => old.slice(0, 500)), '');
  assert.match(await alerts(damaged.page), /results\.js, .*is missing or damaged/);
  // A packed scene with one character changed.
  const altered = await opened((path) => rewrite(path('results.js'), (old) =>
    old.replace(/("scenes":\["[\w+/]{80})(.)/, (all, begin, one) => begin + (one === 'A' ? 'B' : 'A'))), '');
  assert.match(await alerts(altered.page), /results\.js, .*is missing or damaged/);
});
