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
const { frontOf, placeLabels, overlap, textWidth, spreadOut, groupOf, changeOf, timeWords, quickestRight,
        isSurelySlower, fittedLaw, growthLayout, growthTextWidth } =
  named(['numbers.js', 'labels.js', 'bench/figures.js', 'bench/layout.js', 'bench/growth_layout.js'],
        ['frontOf', 'placeLabels', 'overlap', 'textWidth', 'spreadOut', 'groupOf', 'changeOf', 'timeWords',
         'quickestRight', 'isSurelySlower', 'fittedLaw', 'growthLayout', 'growthTextWidth']);

/** What a run that kept the pictures of a point has written, each file empty. */
const picturesOfOnePoint = ['pictures/results.json', 'pictures/results.js',
                            'pictures/ordinary/bump_one_pass.cell.js'];
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

/** The name and the bytes of the file that a button saves. */
async function saved(page, button) {
  const waiting = page.waitForEvent('download');
  await page.click(button);
  const download = await waiting;
  return [download.suggestedFilename(), readFileSync(await download.path())];
}

test('another error shows the points that have it alone', async () => {
  const { page } = await openReport(plot);
  await page.selectOption('#kind', 'rmse');
  assert.equal(await page.locator('#plot .point').count(), 2);
});

test('the plot is saved as SVG that stands by itself, and as PNG', async () => {
  const { page } = await openReport(plot, { theme: 'dark' });
  const [name, svg] = await saved(page, '#svg');
  assert.equal(name, 'bench-ordinary.svg');
  assert.match(svg.toString(), /^<svg xmlns="http:\/\/www\.w3\.org\/2000\/svg"/);
  assert.match(svg.toString(), /fill="#ffffff"/); // paper, whatever the theme
  assert.ok(!/var\(|style=/.test(svg.toString()));
  const [picture, png] = await saved(page, '#png');
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

test('times without intervals are no loss and no gain, and are said to have none', () => {
  const few = (ms) => pointOf('zfail', ms, 0, { ms: timeOf([ms, ms, ms, ms, ms]) });
  assert.equal(changeOf(pointOf('zfail', 1), pointOf('zfail', 9)), 'loss');
  assert.equal(changeOf(pointOf('zfail', 9), pointOf('zfail', 1)), 'gain');
  assert.equal(changeOf(few(1), pointOf('zfail', 9)), 'same');
  assert.equal(changeOf(pointOf('zfail', 9), few(1)), 'same');
  assert.match(timeWords(few(2).ms), /^2\.00 ms, no interval \(5 samples, 2\.00 to 2\.00\)$/);
  assert.match(timeWords(pointOf('zfail', 2).ms), /^2\.00 ms, 95 % within 1\.80 and 2\.20, 6 samples/);
  const { interval, ...older } = timeOf([1, 1, 1, 1, 1, 1]); // of a file that does not say
  assert.equal(interval, true);
  assert.match(timeWords(older), /95 % within/);
});

test('the quickest technique that is right is neither the truth nor auto', () => {
  const points = [pointOf('truth', 1), pointOf('auto', 2), pointOf('zpass', 3, 7), pointOf('zfail', 5),
                  pointOf('zp_plus', 4)];
  const best = quickestRight(points);
  assert.equal(best.technique, 'zp_plus');
  assert.equal(quickestRight(points.slice(0, 3)), null);
  assert.ok(!isSurelySlower(pointOf('auto', 4.5).ms, best.ms), 'within the intervals');
  assert.ok(isSurelySlower(pointOf('auto', 6).ms, best.ms));
});

test('families are told apart in points and in lines of growth, also of older files', () => {
  const words = ({ technique, family }) => groupOf({ technique, family }).words;
  assert.equal(words({ technique: 'cube_map_six_pass', family: 'map' }), 'shadow maps');
  assert.equal(words({ technique: 'spot_map_pcf' }), 'shadow maps');
  assert.equal(words({ technique: 'traced_skip' }), 'rays in float');
  assert.equal(words({ technique: 'invert' }), 'other volumes');
  assert.equal(words({ technique: 'zfail_float', family: 'stencil' }), 'volumes counted behind (z-fail)');
  assert.equal(words({ technique: 'flat', family: 'another' }), 'other families');
});

test('a fitted law passes through points of its exponent, and its interval fans out from their middle', () => {
  const points = [10, 100, 1000].map((size) => ({ size, ms: { median: 3 * size ** 1.5 } }));
  const law = fittedLaw(points, { value: 1.5, low: 1, high: 2 });
  for (const { size, ms } of points) assert.ok(Math.abs(law.at(size) / ms.median - 1) < 1e-9);
  assert.ok(Math.abs(law.middle - 100) < 1e-9);
  assert.ok(Math.abs(law.at(100, 1) / law.at(100, 2) - 1) < 1e-9);
  assert.ok(law.at(1000, 1) < law.at(1000) && law.at(1000) < law.at(1000, 2));
});

test('names, exponents and sizes of growth have room, however many lines there are', () => {
  const name = 'zfail_degenerate_quads_and_more';
  const growths = Array.from({ length: 26 }, (_, i) => ({
    axis: 'triangles', scene: 'dense', technique: `${name}_${i}`, family: 'stencil',
    points: [1e3, 4e3, 1.6e4, 6.4e4, 2.56e5, 1e6, 4e6].map((size) => ({ size, ms: timeOf([size / 1e3]) })),
    exponent: { value: 1, low: 0.9, high: 1.1 },
    ...(i % 2 ? { break: { size: 6.4e4, below: { value: 0.5, low: 0.4, high: 0.6 },
                           above: { value: 1.5, low: 1.4, high: 1.6 } } } : {}) }));
  const { width, height, box, panel, rows, names, sizes, x } = growthLayout(growths);
  assert.ok(box.left < box.right && box.right - box.left > 200);
  for (const row of rows) {
    assert.ok(box.right + 40 + growthTextWidth(row.growth.technique) <= panel.left);
    assert.ok(panel.right + 12 + growthTextWidth(row.words) <= width);
    assert.ok(row.y >= box.top && row.y <= box.bottom);
  }
  assert.ok(names > 0 && height > box.bottom);
  const heights = rows.map(({ y }) => y).sort((a, b) => a - b);
  heights.forEach((y, i) => assert.ok(i === 0 || y - heights[i - 1] >= 11));
  assert.equal(new Set(rows.map(({ letter }) => letter).filter(Boolean)).size, 13);
  const shown = sizes.filter(([, hasWords]) => hasWords).map(([size]) =>
    [x(size) - textWidth(String(size)) / 2, x(size) + textWidth(String(size)) / 2]);
  shown.forEach(([from], i) => assert.ok(i === 0 || from > shown[i - 1][1]));
});

test('growth is drawn with its laws, exponents and intervals, and breaks are named', async () => {
  const { page, said } = await openReport(plot);
  const svg = page.locator('#growth svg').first();
  await keepScreenshot(page, 'bench-growth', { fullPage: true });
  assert.deepEqual(await svg.locator('.name').allTextContents(),
                   ['zfail', 'zpass', 'auto', 'cube_map_six_pass', 'traced_epsilon']);
  assert.deepEqual(await svg.locator('.fit').allTextContents(),
                   ['1.00 [1.00, 1.00]', '1.00 [1.00, 1.00]', '1.00 [1.00, 1.00]',
                    'a: 0.00, from 10,000 on 1.00', 'fewer than 3 sizes']);
  assert.equal(await svg.locator('.law').count(), 5); // two of the one that breaks, and none of two sizes
  assert.equal(await svg.locator('.fan').count(), 5);
  assert.equal(await svg.locator('.exponent').count(), 5);
  assert.equal(await svg.locator('.break').count(), 1);
  assert.match(await svg.innerHTML(), /shadow maps/);
  assert.doesNotMatch(await svg.innerHTML(), /other volumes/);
  // No text is cut by the picture's border, nor lies on another.
  const boxes = await svg.evaluate((picture) => [...picture.querySelectorAll('text')].map((text) => {
    const { x, y, width, height } = text.getBoundingClientRect();
    const frame = picture.getBoundingClientRect();
    return { name: text.textContent, left: x - frame.x, right: x + width - frame.x, top: y - frame.y + 2,
             bottom: y + height - frame.y - 2, width: frame.width, height: frame.height };
  }));
  for (const [i, a] of boxes.entries()) {
    assert.ok(a.left >= 0 && a.right <= a.width && a.top >= 0 && a.bottom <= a.height, a.name);
    for (const b of boxes.slice(i + 1)) assert.ok(!overlap(a, b), `${a.name} on ${b.name}`);
  }
  assert.deepEqual(said, []);
});

test('growth is saved as SVG that stands by itself, and as PNG', async () => {
  const { page } = await openReport(plot, { theme: 'dark' });
  const [name, svg] = await saved(page, '#growth-pixels-svg');
  assert.equal(name, 'bench-growth-pixels.svg');
  assert.match(svg.toString(), /^<svg xmlns="http:\/\/www\.w3\.org\/2000\/svg".*fill="#ffffff".*zpass/s);
  assert.ok(!/var\(|style=/.test(svg.toString()));
  const [picture, png] = await saved(page, '#growth-pixels-png');
  assert.equal(picture, 'bench-growth-pixels.png');
  assert.deepEqual([...png.subarray(0, 4)], [0x89, 0x50, 0x4e, 0x47]);
  assert.equal(png.readUInt32BE(16), 3 * 1100);
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
