// Pictures that went through JPEG, as screenshots do: written by Chromium.
import assert from 'node:assert/strict';
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { chromium } from 'playwright-core';
import { grayPng, readPng } from '../png.mjs';
import { scratch, shadowproof } from '../shadowproof.mjs';

const path = (name) => join(scratch, name);
const shade = { 0: 20, 64: 60, 255: 190 };
let browser;
let page;
before(async () => {
  browser = await chromium.launch({ executablePath: process.env.CHROMIUM,
                                    args: process.getuid?.() === 0 ? ['--no-sandbox'] : [] });
  page = await browser.newPage();
});
after(() => browser?.close());

/** A class map as a JPEG picture of that quality, 0 to 1. */
async function writeJpeg(name, classes, quality) {
  const { width, height, at } = readPng(path(classes));
  const png = grayPng(width, height, (x, y) => 257 * shade[at(x, y)[0]]).toString('base64');
  const url = await page.evaluate(async ([picture, level]) => {
    const image = new Image();
    image.src = `data:image/png;base64,${picture}`;
    await image.decode();
    const canvas = Object.assign(document.createElement('canvas'),
                                 { width: image.width, height: image.height });
    canvas.getContext('2d').drawImage(image, 0, 0);
    return canvas.toDataURL('image/jpeg', level);
  }, [png, quality]);
  writeFileSync(path(name), Buffer.from(url.split(',')[1], 'base64'));
}

for (const scene of ['ordinary', 'near_plane', 'sun'])
  test(`a right picture of ${scene} agrees at quality 90, and JPEG is said to lose something`, async () => {
    assert.equal(shadowproof(['render', scene, '-o', 'truth.png', '-q']).code, 0);
    await writeJpeg('mine.jpg', 'truth.png', 0.9);
    const { code, out, err } = shadowproof(['check', scene, 'mine.jpg']);
    assert.equal(code, 0, out + err);
    assert.match(out, /mine\.jpg: JPEG loses what tells light from shadow at outlines/);
  });

test('what is wrong in a JPEG picture has its name all the same', async () => {
  shadowproof(['verify', 'near_plane', '--technique', 'zpass', '--out', 'claims', '-q']);
  await writeJpeg('mine.jpg', 'claims/near_plane/zpass.claim.png', 0.9);
  assert.equal(shadowproof(['check', 'near_plane', 'mine.jpg', '--out', 'checked']).code, 1);
  const { scenes: [{ techniques: [cell] }] } =
    JSON.parse(readFileSync(path('checked/results.json'), 'utf8'));
  const [best] = cell.diagnosis;
  assert.equal(best.hypothesis, 'zpass');
  assert.ok(best.explained > 0.95 * (cell.falsely_lit + cell.falsely_shadowed));
  assert.ok(best.contradicted < 0.01 * best.explained);
});
