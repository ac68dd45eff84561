// Colours: where a technique has some, its cell shows and tells them; other cells show nothing new.
import assert from 'node:assert/strict';
import { readFileSync, rmSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { before, test } from 'node:test';
import { changeBlock, damageBlock } from './coded.mjs';
import { cellsOf, copyOfReport, emptyPage, keepScreenshot, openReport, resultsOf, settledLink, shown,
         text, writeReport } from './browser.mjs';
import { scratch, shadowproof } from '../command/shadowproof.mjs';
import { randomNumbers, seed } from './random.mjs';

const techniques = ['bump_three_pass', 'bump_tangent_space', 'zfail_reversed'];
const colorPanes = ['true_color', 'claimed_color', 'color_error'];
const otherPanes = ['truth', 'claim', 'difference', 'cause', 'predicted', 'read_back', 'volumes'];
const link = '#bumpy_torus/bump_three_pass';
const cellFile = 'bumpy_torus/bump_three_pass.cell.js';

let folder;
let cells;
let copies = 0;
before(() => {
  folder = writeReport('report', ['bumpy_torus'], undefined, techniques);
  cells = cellsOf(resultsOf(folder));
});

const cellOf = (name) => cells.find(({ cell }) => cell.name === name).cell;
const panes = (page) => page.locator('canvas.pane').evaluateAll((all) =>
  all.map((canvas) => canvas.dataset.picture));
const alerts = async (page) => (await page.locator('.alert, .broken').allInnerTexts()).join('\n');
const plain = (words) => words.replace(/\s+/g, ' ').trim();

/** A copy of the report after `damage(path)` was done to it, opened at the cell with colours. */
async function opened(damage, hash = link) {
  const copy = copyOfReport(folder, `copy-${++copies}`);
  damage((path) => join(copy, path));
  return openReport(copy, { hash });
}

/** Changes a block of a cell's script: `change` gets its bytes. */
function changeResults(path, change) {
  const results = JSON.parse(readFileSync(path('results.json'), 'utf8'));
  change(results.scenes[0].techniques[0], results);
  writeFileSync(path('results.js'), `shadowproof.results(${JSON.stringify(results)});`);
}

/** [red, green, blue] of every pixel of a PNG, as the browser decodes it. */
async function pixelsOf(page, path) {
  const bytes = await page.evaluate(async (url) => {
    const image = new Image();
    image.src = url;
    await image.decode();
    const canvas = document.createElement('canvas');
    Object.assign(canvas, { width: image.naturalWidth, height: image.naturalHeight });
    const context = canvas.getContext('2d');
    context.drawImage(image, 0, 0);
    return [...context.getImageData(0, 0, canvas.width, canvas.height).data];
  }, `data:image/png;base64,${readFileSync(join(folder, path)).toString('base64')}`);
  return Array.from({ length: bytes.length / 4 }, (_, i) => bytes.slice(4 * i, 4 * i + 3));
}

/** Linear to sRGB (IEC 61966-2-1) in 8 bits. */
const bytesOf = (linear) => linear.map((value) => {
  const kept = Math.min(1, Math.max(0, value));
  return Math.round(255 * (kept <= 0.0031308 ? 12.92 * kept : 1.055 * kept ** (1 / 2.4) - 0.055));
});

/** The true and the claimed colour of a pixel, as the command explains it. */
function explainedColors({ scene, cell }, pixel) {
  const file = join(scratch, 'pixel.json');
  const run = shadowproof(['explain', scene.name, '--technique', cell.name, '--size', '160x160', '--pixel',
    `${pixel % scene.width},${Math.floor(pixel / scene.width)}`, '--json', file, '-q']);
  assert.equal(run.code, 0, run.out + run.err);
  const [{ color }] = JSON.parse(readFileSync(file, 'utf8')).techniques;
  return color && { right: bytesOf(color.true), claimed: bytesOf(color.claimed) };
}

/** Whether a pane can have the pixel in its middle, as no pane shows what lies beside a picture. */
const isInside = (x, y, { width, height }) =>
  x >= 8 && y >= 8 && x < width - 8 && y < height - 8;

/** The bytes that a pane paints for the pixel in its middle, 96 pixels large, beside its word. */
const paintedIn = (page, name) => page.locator(`canvas[data-picture="${name}"]`).evaluate((canvas) =>
  [...canvas.getContext('2d').getImageData(Math.round(canvas.width / 2) - 38,
                                           Math.round(canvas.height / 2) - 38, 1, 1).data].slice(0, 3));

/** What two colours of sRGB bytes differ by in linear light, as the picture of the error has it. */
function errorColor(right, claimed) {
  const linear = (byte) => (byte > 10 ? ((byte / 255 + 0.055) / 1.055) ** 2.4 : byte / 255 / 12.92);
  const steps = 255 * Math.max(...right.map((byte, i) => Math.abs(linear(byte) - linear(claimed[i]))));
  const octaves = steps > 0.5 ? Math.log2(2 * steps) : 0;
  return [255, 244, 200].map((full) => Math.floor(full * Math.min(45, Math.round(5 * octaves)) / 45));
}

test('a cell with colours shows them before its other pictures', async () => {
  const { page, open, said, asked } = await openReport(folder, { hash: link });
  assert.deepEqual(await panes(page), [...colorPanes, ...otherPanes]);
  assert.deepEqual((await page.locator('figcaption').allInnerTexts()).slice(0, 3),
                   ['True colour', 'Claimed colour', 'Colour error']);
  await keepScreenshot(page, 'colors', { fullPage: true });
  await open(`${link}?zoom=48`);
  await keepScreenshot(page, 'colors-zoom');
  assert.deepEqual(said, []);
  assert.deepEqual(asked, []);
});

test('a cell without colours shows nothing new, though its scene has some', async () => {
  const { page, said } = await openReport(folder, { hash: '#bumpy_torus/zfail_reversed?pixel=80,80' });
  assert.deepEqual(await panes(page), otherPanes);
  assert.doesNotMatch(await text(page, 'main'), /colour/i);
  await page.locator('#view-slide').click();
  assert.doesNotMatch(await text(page, '#choose-0'), /colour/i);
  assert.equal(await text(page, '.stage figcaption'), 'Truth | Claim');
  await keepScreenshot(page, 'no-colors', { fullPage: true });
  assert.deepEqual(said, []);
});

test(`the inspector and the pictures have the bytes of the colours that are explained (seed ${seed})`, async () => {
  const random = randomNumbers(seed);
  const { page, open, said } = await openReport(folder);
  let errors = 0;
  for (const each of cells.filter(({ cell }) => cell.color)) {
    const { id, scene, cell } = each;
    const { x, y } = cell.color.largest_at;
    const pixels = [y * scene.width + x, ...Array.from({ length: 8 },
                                                       () => Math.floor(random() * scene.width * scene.height))];
    let checked = 0;
    for (const pixel of pixels) {
      const colors = explainedColors(each, pixel);
      if (!colors) continue; // nothing is seen there
      const { right, claimed } = colors;
      const [column, row] = [pixel % scene.width, Math.floor(pixel / scene.width)];
      await open(`#${id}?pixel=${column},${row}&zoom=96&centre=${column + 0.5},${row + 0.5}`);
      const off = claimed.map((byte, i) => byte - right[i])
        .map((by) => (by > 0 ? `+${by}` : String(by)));
      assert.equal(plain(await text(page, '.values.colors')),
                   `true colour ${right.join(' ')} claimed ${claimed.join(' ')} ` +
                   `off by ${off.join(' ')}`);
      assert.match(await text(page, '.inspector'), /8-bit sRGB, as the pictures have them\. In linear light: /);
      if (isInside(column, row, scene)) {
        assert.deepEqual(await paintedIn(page, 'true_color'), right);
        assert.deepEqual(await paintedIn(page, 'claimed_color'), claimed);
        const verdict = await text(page, '.inspector');
        if (/In linear light: (within|more than 1\/255 off)/.test(verdict)) {
          assert.deepEqual(await paintedIn(page, 'color_error'), errorColor(right, claimed));
          ++errors;
        }
        ++checked;
      }
    }
    assert.ok(checked > 1, `${id}: ${checked}`);
  }
  assert.ok(errors > 5, `${errors}`);
  assert.deepEqual(said, []);
});

test('the cell tells how far its colours are off, with a link to the pixel that is furthest', async () => {
  const { page } = await openReport(folder, { hash: link });
  const { color } = cellOf('bump_three_pass');
  const { x, y } = color.largest_at;
  const words = plain(await text(page, '.cell-head .colors'));
  assert.ok(words.startsWith(`Colours: off by at most ${color.largest.toFixed(2)}/255 at (${x}, ${y}), ` +
                             `rmse ${color.rmse.toFixed(2)}, 99.9 % within ${color.p999.toFixed(2)}; `));
  assert.match(words, /; normalised by cube-map of 64 texels a side, bumps as normal-map, vectors made at vertices\.$/);
  await page.locator('.cell-head .colors a').focus();
  await page.keyboard.press('Enter');
  await page.waitForFunction(() => location.hash.includes('zoom=16'));
  await shown(page);
  assert.equal(await text(page, '.inspector h2'), `Pixel (${x}, ${y})`);
});

test('the arithmetic’s forms that are exact are told in words', async () => {
  const { page } = await openReport(folder, { hash: '#bumpy_torus/bump_tangent_space' });
  assert.match(await text(page, '.cell-head .colors'), /normalised exactly, bumps as given\.$/);
});

test('where no colour is judged, none is said to be right', async () => {
  const { page } = await opened((path) => changeResults(path, ({ color }) => {
    Object.assign(color, { judged: 0, largest: 0, rmse: 0, p999: 0, beyond: 0 });
    delete color.largest_at;
  }));
  assert.match(await text(page, '.cell-head .colors'), /^Colours: none is held against the truth/);
});

test('slide, blend and toggle compare the true with the claimed colour; keys choose others', async () => {
  const { page, said } = await openReport(folder, { hash: link });
  for (const [key, caption] of [['2', 'True colour | Claimed colour'],
                                ['3', 'True colour, then Claimed colour'], ['4', 'True colour']]) {
    await page.keyboard.press(key);
    assert.equal(await text(page, '.stage figcaption'), caption);
  }
  await page.keyboard.press('x');
  assert.equal(await text(page, '.stage figcaption'), 'Claimed colour');
  await page.keyboard.press('b');
  assert.equal(await text(page, '.stage figcaption'), 'Colour error');
  await page.keyboard.press('b');
  assert.equal(await text(page, '.stage figcaption'), 'Truth');
  assert.match(await settledLink(page), /of=true_color,truth/);
  assert.deepEqual(said, []);
});

test('the overview has the largest error of each cell with colours', async () => {
  const { page } = await openReport(folder);
  const entry = (name) => text(page, `.matrix a[href="#bumpy_torus/${name}"]`);
  assert.ok((await entry('bump_three_pass'))
    .includes(`colour ${cellOf('bump_three_pass').color.largest.toFixed(0)}/255`));
  assert.ok((await entry('bump_tangent_space'))
    .includes(`colour ${cellOf('bump_tangent_space').color.largest.toFixed(2)}/255`));
  assert.doesNotMatch(await entry('zfail_reversed'), /colour/);
});

test('the difference marks nothing where colours alone differ; the cause does', async () => {
  const { cell } = cells[0];
  const decoder = await emptyPage();
  const difference = await pixelsOf(decoder, cell.images.difference);
  const causes = await pixelsOf(decoder, cell.images.cause);
  const shading = [...causes.keys()].filter((i) => causes[i].every((byte) => byte === 255)); // white
  assert.equal(shading.length, cell.causes.shading);
  const dimmed = ['88,88,92', '40,40,44']; // a claim of light, and one of shadow
  assert.ok(shading.every((i) => dimmed.includes(difference[i].join())));
});

test('a colour that nothing predicts is an alarm, and its pixel does not simply agree', async () => {
  const changed = (path) => {
    changeBlock(path('.'), 'bumpy_torus', 'bump_tangent_space', 'color_verdict',
                (verdicts) => { verdicts[120 * 160 + 80] = 3; });
    changeResults(path, (first, results) => {
      const cell = results.scenes[0].techniques.find(({ name }) => name === 'bump_tangent_space');
      Object.assign(cell, { verdict: 'unexplained', fails: true });
      cell.color.unpredicted = 1;
    });
  };
  const { page, open } = await opened(changed, '');
  const words = /The colour is not what the technique’s arithmetic predicts at 1 pixel/;
  assert.match(await text(page, '.failures'), words);
  await open('#bumpy_torus/bump_tangent_space?pixel=80,120');
  assert.match(await alerts(page), new RegExp(`${words.source}; the first is \\(80, 120\\)\\.`));
  assert.doesNotMatch(await alerts(page), /does not belong/);
  const inspector = await text(page, '.inspector');
  assert.match(inspector, /agree here on visibility\./);
  assert.match(inspector, /not what the technique’s arithmetic predicts\./);
  assert.match(await text(page, '.legends'), /unpredicted\s+1\s/);
});

for (const [file, block] of [[cellFile, 'color_verdict'], ['bumpy_torus/scene.js', 'color']])
  test(`what the error of the colours is drawn from is named where it is damaged: ${file}`, async () => {
    const { page } = await opened((path) => damageBlock(path(file), block));
    const error = page.locator('.stage figure', { hasText: 'Colour error' }).locator('.broken');
    assert.ok((await error.innerText()).includes(`${file}: block ${block} is damaged`));
    assert.equal((await panes(page)).length, block === 'color' ? 7 : 9);
  });

test('damaged colours are named, shown as unknown, and cost no ledger', async () => {
  const { page } = await opened((path) => damageBlock(path(cellFile), 'color'));
  assert.match(await alerts(page), /cell\.js: block color is damaged/);
  const broken = await page.locator('.stage .broken').allInnerTexts();
  assert.equal(broken.length, 2, 'the claimed colour, and the error');
  for (const each of broken) assert.match(each, /bump_three_pass\.cell\.js: block color is damaged/);
  assert.match(await alerts(page), /The colours cannot be shown\./);
  assert.equal(await page.locator('.values.colors').count(), 0);
  assert.equal(await page.locator('.ledger').count(), 1);
});

test('colours of another run are not taken for those of this', async () => {
  const { page } = await opened((path) =>
    changeBlock(path('.'), 'bumpy_torus', 'bump_three_pass', 'color_verdict',
                (verdicts) => verdicts.fill(1)));
  assert.match(await alerts(page), /cell\.js does not belong to results\.js: its colours were judged otherwise/);
});
