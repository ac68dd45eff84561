// The plot of a benchmark: redrawn from recorded runs, opened from disk.
import assert from 'node:assert/strict';
import { mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { dirname, join } from 'node:path';
import { before, test } from 'node:test';
import { scratch, shadowproof } from '../command/shadowproof.mjs';
import { pointOf, recordedRun, timeOf } from './bench_run.mjs';
import { keepScreenshot, openReport } from './browser.mjs';
import { named } from './scripts.mjs';

const axe = readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');
const { frontOf, placeLabels, overlap, textWidth, spreadOut } =
  named(['numbers.js', 'bench/figures.js', 'bench/layout.js'],
        ['frontOf', 'placeLabels', 'overlap', 'textWidth', 'spreadOut']);

/** What a run that kept the pictures of a point has written, each file empty. */
const picturesOfOnePoint = ['pictures/results.json', 'pictures/results.js',
                            'pictures/ordinary/bump_one_pass/cell.js'];
/** XXH3, 128 bits, of no bytes. */
const xxh3OfNothing = '99aa06d3014798d86001c324468d497f';

function plotOf(name, run, older) {
  const recorded = join(scratch, `${name}-recorded`);
  for (const file of picturesOfOnePoint) {
    mkdirSync(dirname(join(recorded, file)), { recursive: true });
    writeFileSync(join(recorded, file), '');
  }
  writeFileSync(join(recorded, 'manifest.json'), JSON.stringify({
    schema: 'shadowproof/manifest/1',
    files: picturesOfOnePoint.map((name) => ({ name, size: 0, xxh3: xxh3OfNothing })) }));
  writeFileSync(join(recorded, 'results.json'), JSON.stringify(run));
  const args = ['bench', '--from', recorded, '--out', name, '-q'];
  if (older) {
    writeFileSync(join(scratch, `${name}-older.json`), JSON.stringify(older));
    args.push('--against', `${name}-older.json`);
  }
  const { code, err } = shadowproof(args);
  assert.ok([0, 1].includes(code), err);
  return join(scratch, name);
}

/** A run in which zfail was quicker, zpass slower, and auto a little otherwise. */
function olderRun() {
  const older = recordedRun();
  for (const [technique, factor] of [['zfail', 0.3], ['zpass', 3], ['auto', 1.05]]) {
    const point = older.points.find((each) => each.technique === technique);
    point.ms = timeOf(point.ms.samples.map((ms) => factor * ms));
  }
  return older;
}

let plot;
let compared;
before(() => {
  plot = plotOf('plot', recordedRun());
  compared = plotOf('compared', recordedRun(), olderRun());
});

test('the front holds what no other beats, ties too, and never the truth', () => {
  const figure = (technique, ms, error) => ({ point: { technique }, ms, error });
  const names = frontOf([figure('truth', 0.1, 0), figure('a', 1, 9), figure('b', 2, 9),
                         figure('c', 2, 5), figure('d', 2, 5), figure('e', 3, 6), figure('f', 9, 0)])
    .map(({ point }) => point.technique);
  assert.deepEqual(names, ['a', 'c', 'd', 'f']);
});

test('labels never lie on each other nor on a mark, or are left out', () => {
  let seed = 1;
  const random = () => (seed = (seed * 48271) % 2147483647) / 2147483647;
  const box = { left: 0, right: 800, top: 0, bottom: 400 };
  for (let round = 0; round < 30; ++round) {
    const marks = Array.from({ length: 40 }, (_, i) =>
      ({ x: 300 + 200 * random(), y: 150 + 100 * random(), text: `technique_${i}` }));
    const places = placeLabels(marks, box, []);
    const boxes = places.map((place, i) => place &&
      { left: place.x, right: place.x + textWidth(marks[i].text), top: place.y - 10,
        bottom: place.y + 2 }).filter(Boolean);
    assert.ok(boxes.length > 20);
    boxes.forEach((a, i) => {
      assert.ok(boxes.every((b, k) => i === k || !overlap(a, b)));
      assert.ok(marks.every(({ x, y }) =>
        !overlap(a, { left: x - 7, right: x + 7, top: y - 7, bottom: y + 7 })));
    });
  }
});

test('labels at the ends of lines stand apart and within the picture', () => {
  const spread = spreadOut([100, 101, 99, 395, 400, 2], 14, 10, 400);
  const sorted = [...spread].sort((a, b) => a - b);
  assert.ok(sorted.every((y, i) => y >= 10 && y <= 400 && (i === 0 || y - sorted[i - 1] >= 14)));
  assert.ok(spread[2] < spread[0] && spread[0] < spread[1]);
});

test('the page opens from disk in silence, with a mark for each point', async () => {
  const { page, said, asked } = await openReport(plot);
  assert.equal(await page.locator('#plot .point').count(), recordedRun().points.length);
  await keepScreenshot(page, 'bench', { fullPage: true });
  assert.deepEqual([said, asked], [[], []]);
});

test('labels in the drawn plot do not overlap', async () => {
  const { page } = await openReport(plot);
  const boxes = await page.locator('#plot .point text').evaluateAll((labels) =>
    labels.map((label) => {
      const { x, y, width, height } = label.getBBox();
      return { name: label.textContent, left: x, right: x + width, top: y + 2,
               bottom: y + height - 2 };
    }));
  assert.ok(boxes.length >= 10);
  for (const [i, a] of boxes.entries())
    for (const b of boxes.slice(i + 1)) assert.ok(!overlap(a, b), `${a.name} on ${b.name}`);
});

test('points that are exactly right have a row each in the band, the others are above it', async () => {
  const { page } = await openReport(plot);
  const band = await page.locator('#plot svg > rect').nth(1).evaluate((rect) => {
    const { y, height } = rect.getBBox();
    return { y, height };
  });
  const heights = new Map(await page.locator('#plot .point').evaluateAll((points) =>
    points.map((point) => [point.getAttribute('aria-label').split(':')[0],
                           Number(point.lastElementChild.previousElementSibling
                             .getAttribute('transform').match(/ ([\d.]+)\)/)[1])])));
  const right = ['truth', 'auto', 'zfail', 'zfail_float', 'zp_plus'];
  for (const name of right)
    assert.ok(heights.get(name) > band.y && heights.get(name) < band.y + band.height, name);
  assert.equal(new Set(right.map((name) => heights.get(name))).size, right.length);
  assert.ok(heights.get('zpass') < band.y);
});

test('a mark names technique and settings where it is pointed at, and by keyboard', async () => {
  const { page } = await openReport(plot);
  await page.locator('#plot .point[aria-label^="bump_one_pass bumps=indexed"] rect').hover();
  assert.match(await page.locator('#note').innerText(), /bump_one_pass bumps=indexed\n25\.0 ms/);
  await page.keyboard.press('Tab');
  await page.locator('#plot .point[tabindex="0"]').focus();
  for (const key of ['End', 'ArrowLeft', 'ArrowLeft', 'ArrowRight']) await page.keyboard.press(key);
  assert.match(await page.locator('#note').innerText(), /^bump_one_pass\n/);
  await page.keyboard.press('Enter');
  const chosen = await page.locator('#chosen').innerText();
  assert.match(chosen, /shadowproof bench ordinary --technique bump_one_pass/);
  assert.match(chosen, /shadowproof verify ordinary --technique bump_one_pass/);
  assert.match(chosen, /normalise=cube-map bumps=normal-map/);
  assert.match(chosen, /volumes 2\.00 ms, lighting 18\.0 ms/);
  assert.equal(await page.locator('#pictures').getAttribute('href'),
               'pictures/index.html#ordinary/bump_one_pass');
});

test('another error shows the points that have it alone', async () => {
  const { page } = await openReport(plot);
  await page.selectOption('#kind', 'rmse');
  assert.equal(await page.locator('#plot .point').count(), 2);
});

test('the plot is saved as SVG that stands by itself, and as PNG', async () => {
  const { page } = await openReport(plot, { theme: 'dark' });
  const saved = async (button) => {
    const waiting = page.waitForEvent('download');
    await page.click(button);
    const download = await waiting;
    return [download.suggestedFilename(), readFileSync(await download.path())];
  };
  const [name, svg] = await saved('#svg');
  assert.equal(name, 'bench-ordinary.svg');
  assert.match(svg.toString(), /^<svg xmlns="http:\/\/www\.w3\.org\/2000\/svg"/);
  assert.match(svg.toString(), /fill="#ffffff"/); // paper, whatever the theme
  assert.ok(!/var\(|style=/.test(svg.toString()));
  const [picture, png] = await saved('#png');
  assert.equal(picture, 'bench-ordinary.png');
  assert.deepEqual([...png.subarray(0, 4)], [0x89, 0x50, 0x4e, 0x47]);
  assert.ok(png.readUInt32BE(16) >= 3 * 760);
});

test('two runs overlay with arrows: losses, gains, and what lies within the intervals', async () => {
  const { page, said } = await openReport(compared);
  await keepScreenshot(page, 'bench-against', { fullPage: true });
  assert.equal(await page.locator('#plot .arrow.loss').count(), 1);
  assert.equal(await page.locator('#plot .arrow.gain').count(), 1);
  assert.match(await page.locator('#said-below').innerText(), /1 loss .* 1 gain /);
  assert.deepEqual(said, []);
});

test('growth is drawn with its exponents', async () => {
  const { page } = await openReport(plot);
  assert.match(await page.locator('#growth svg').first().innerHTML(),
               /zfail n\^1\.00 \[1\.00, 1\.00\]/);
});

for (const theme of ['light', 'dark'])
  test(`axe-core finds nothing (${theme})`, async () => {
    const { page } = await openReport(compared, { theme });
    await page.locator('#plot .point').first().click();
    await page.evaluate(axe);
    const { violations } = await page.evaluate(() => window.axe.run(document, {
      runOnly: ['wcag2a', 'wcag2aa', 'wcag21a', 'wcag21aa', 'wcag22aa', 'best-practice'] }));
    assert.deepEqual(violations.map(({ id, nodes }) =>
      `${id}: ${nodes.slice(0, 3).map(({ html }) => html.slice(0, 200)).join(' | ')}`), []);
  });
