// The way from a failing build to the wrong pixel: overview, cell, pixel.
import assert from 'node:assert/strict';
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { before, test } from 'node:test';
import { cellsOf, copyOfReport, keepScreenshot, openReport, resultsOf, shown, text, writeReport }
  from './browser.mjs';

let folder;
before(() => { folder = writeReport('report'); });

const grouped = (count) => count.toLocaleString('en-US');

test('three clicks lead from the overview to a wrong pixel with its cause and its drawing', async () => {
  const { page, said, asked } = await openReport(folder);
  await page.locator('.matrix td a', { hasText: 'near_plane' }).first().click(); // one
  await shown(page);
  await page.locator('canvas[data-picture="cause"]').click({ position: { x: 60, y: 130 } }); // two
  assert.match(await text(page, '.inspector h2'), /^Pixel \(\d+, \d+\)$/);
  await page.locator('#first').click(); // three, where the second hit nothing
  const first = resultsOf(folder).scenes.find(({ name }) => name === 'near_plane').techniques
    .find(({ name }) => name === 'zpass').first;
  assert.equal(await text(page, '.inspector h2'), `Pixel (${first.x}, ${first.y})`);
  assert.match(await text(page, '.why'), /^near_plane: crossings were lost before the near plane/);
  assert.ok(await page.locator('#cutaway svg circle').count() > 4);
  assert.ok(await page.locator('.ledger tbody tr').count() > 1);
  assert.deepEqual(said, []);
  assert.deepEqual(asked, []);
});

test('the matrix has every cell with sign, words and count, scenes in order of their failures', async () => {
  const { page } = await openReport(folder);
  const results = resultsOf(folder);
  for (const { scene, cell } of cellsOf(results)) {
    const link = page.locator(`.matrix a[href="#${scene.folder}/${cell.name}"]`);
    const words = await link.innerText();
    assert.match(words, { agrees: /^✓ agrees/, fails_as_predicted: /^≈ fails as predicted/,
                          defect: /^✕ defect/, unexplained: /^\? unexplained/ }[cell.verdict]);
    const beyond = cell.differing - (cell.causes.edge ?? 0);
    if (beyond > 0) assert.match(words, new RegExp(grouped(beyond)));
  }
  assert.equal(await page.locator('.matrix tbody th').last().innerText(), 'ordinary');
});

test('a part of a run says which it is, also where it has nothing to try', async () => {
  const copy = copyOfReport(folder, 'part');
  const results = { ...resultsOf(copy), shard: { number: 2, of: 3, run: '0'.repeat(16) } };
  const write = () =>
    writeFileSync(join(copy, 'results.js'), `shadowproof.results(${JSON.stringify(results)});`);
  write();
  assert.match(await text((await openReport(copy)).page, '.banner'), /Part 2 of 3 of a run\./);
  results.scenes = [];
  write();
  const { page, said } = await openReport(copy);
  assert.match(await text(page, 'main'), /There was nothing to try in this part of the run\./);
  assert.deepEqual(said, []);
});

test('failures stand first, with the reason; nothing fails without being named', async () => {
  const copy = copyOfReport(folder, 'failing');
  const results = resultsOf(copy);
  const cell = (scene, name) => results.scenes.find((each) => each.name === scene).techniques
    .find((each) => each.name === name);
  results.passed = false;
  results.baseline = { file: 'before.json', passed: true };
  Object.assign(cell('far_plane', 'zfail'), { verdict: 'defect', fails: true, since:
    { new: 12, gone: 3, changed: 0, first: { x: 3, y: 4, cause: 'far_plane', was: null } } });
  const ordinary = results.scenes.find(({ name }) => name === 'ordinary');
  ordinary.techniques[4] = { name: 'zfail_reversed', error: 'no glClipControl', fails: true };
  results.scenes.push({ name: 'torn', file: 'torn.gltf', error: 'torn.gltf: ends early' });
  writeFileSync(join(copy, 'results.js'), `shadowproof.results(${JSON.stringify(results)});`);
  const { page, said } = await openReport(copy);
  assert.match(await text(page, 'h1'), /Failed: 2 of 24 cells/);
  const failures = await text(page, '.failures');
  for (const words of [/far_plane \/ zfail/, /defect/, /crossings were lost past the far plane/,
                       /no glClipControl/, /torn\.gltf: ends early/, /12 new, 3 gone, first at \(3, 4\): far_plane, was no difference/])
    assert.match(failures, words);
  assert.match(await text(page, '.matrix'), /could not be read/);
  assert.match(await text(page, '.banner'), /before\.json: 1 cell changed/);
  await keepScreenshot(page, 'overview-failing', { fullPage: true });
  await page.locator('.matrix a', { hasText: 'could not run' }).click();
  await shown(page);
  assert.match(await text(page, '.alert'), /no glClipControl/);
  assert.deepEqual(said, []);
});

test('filters by verdict, cause and text leave what they name, and are kept in the link', async () => {
  const { page } = await openReport(folder);
  const links = () => page.locator('.matrix td a').count();
  await page.locator('#filter-find').fill('far_plane zfail_c');
  assert.equal(await links(), 1);
  await page.locator('#filter-find').fill('');
  await page.locator('#filter-cause').selectOption('far_plane');
  assert.equal(await links(), 1);
  await page.locator('#filter-cause').selectOption('');
  await page.locator('.chip.agrees').click();
  const agreeing = cellsOf(resultsOf(folder)).filter(({ cell }) => cell.verdict === 'agrees');
  assert.equal(await links(), agreeing.length);
  await page.waitForFunction(() => location.hash === '#?verdict=agrees');
});

test('a run that is larger than a screen still shows every cell: twelve scenes, twenty techniques', async () => {
  const copy = copyOfReport(folder, 'large');
  const results = resultsOf(copy);
  for (let i = 0; i < 8; ++i)
    results.scenes.push({ ...results.scenes[i % 4], name: `scene_${i}`, folder: `scene_${i}` });
  for (const scene of results.scenes)
    scene.techniques = Array.from({ length: 20 }, (_, i) =>
      ({ ...scene.techniques[i % 5], name: `technique_${i}` }));
  writeFileSync(join(copy, 'results.js'), `shadowproof.results(${JSON.stringify(results)});`);
  const { page } = await openReport(copy);
  assert.equal(await page.locator('.matrix td a').count(), 240);
  assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), 1280);
  const labels = await page.locator('.plot .technique text').evaluateAll((texts) =>
    texts.map((label) => label.getBoundingClientRect().toJSON()));
  assert.ok(labels.length > 10);
  // Letters need less height than their line: two lines may share two of its pixels.
  const cross = ([a, b], [c, d]) => a < d && c < b;
  for (const [i, one] of labels.entries())
    for (const other of labels.slice(i + 1))
      assert.ok(!(cross([one.left, one.right], [other.left, other.right]) &&
                  cross([one.top + 1, one.bottom - 1], [other.top + 1, other.bottom - 1])));
  await keepScreenshot(page, 'overview-large', { fullPage: true });
});

test('the matrix says how many techniques a narrow window hides, until they are scrolled to', async () => {
  const { page } = await openReport(folder, { width: 400 });
  const beyond = page.locator('.beyond');
  const hidden = () => page.evaluate(() => {
    const end = document.querySelector('[aria-label="Matrix"]').getBoundingClientRect().right + 1;
    return [...document.querySelectorAll('.matrix thead th')]
      .filter((head) => head.getBoundingClientRect().right > end).length;
  });
  const count = await hidden();
  assert.ok(count > 1);
  assert.equal(await beyond.innerText(), `${count} techniques more to the right →`);
  await page.getByLabel('Matrix').evaluate((frame) => { frame.scrollLeft = frame.scrollWidth; });
  await page.waitForFunction(() => document.querySelector('.beyond').textContent === '');
  assert.equal(await hidden(), 0);
});

test('agreement in all pixels looks different from agreement but for edges', async () => {
  const copy = copyOfReport(folder, 'exact');
  const results = resultsOf(copy);
  const agreeing = cellsOf(results).filter(({ cell }) => cell.verdict === 'agrees');
  Object.assign(agreeing[0].cell, { differing: 0, causes: {} });
  Object.assign(agreeing[1].cell, { differing: 3, causes: { edge: 3 } });
  writeFileSync(join(copy, 'results.js'), `shadowproof.results(${JSON.stringify(results)});`);
  const { page } = await openReport(copy);
  const look = (id) => page.locator(`.matrix td:has(a[href="#${id}"])`).evaluate((td) =>
    [td.innerText.split('\n')[0], getComputedStyle(td).outlineStyle]);
  assert.deepEqual(await look(agreeing[0].id), ['✓ agrees', 'none']);
  assert.deepEqual(await look(agreeing[1].id), ['✓ agrees but for edges', 'dashed']);
  const edges = agreeing.filter(({ cell }) => cell.differing > 0);
  assert.match(await text(page, '.chip.agrees'),
               new RegExp(`${agreeing.length}, ${edges.length} of them but for edges`));
});

test('no two causes of the overview have the same mark', async () => {
  const copy = copyOfReport(folder, 'all-causes');
  const html = readFileSync(join(copy, 'index.html'), 'utf8');
  const { causes } = JSON.parse(html.match(/shadowproof\.legend\(([^]*?)\);/)[1]);
  const results = resultsOf(copy);
  cellsOf(results)[0].cell.causes = Object.fromEntries(causes.map(({ name }) => [name, 1]));
  writeFileSync(join(copy, 'results.js'), `shadowproof.results(${JSON.stringify(results)});`);
  const { page } = await openReport(copy);
  const marks = await page.locator('.legend-line .swatch').evaluateAll((swatches) =>
    swatches.map((swatch) => `${swatch.className} ${swatch.style.cssText}`));
  assert.equal(marks.length, causes.length);
  assert.equal(new Set(marks).size, causes.length, marks.join('\n'));
  await keepScreenshot(page, 'overview-causes');
});

test('each word of the report is explained: the causes link to their terms', async () => {
  const { page, said } = await openReport(folder);
  const causes = await page.locator('.legend-line a.term').allInnerTexts();
  assert.ok(causes.includes('near_plane'));
  await page.locator('.legend-line a.term', { hasText: 'near_plane' }).click();
  await page.waitForFunction(() => document.title === 'shadowproof: terms');
  assert.match(await text(page, '.terms .asked'), /^near_plane\s+crossings were lost before/);
  const ids = await page.locator('.terms > div').evaluateAll((divs) => divs.map(({ id }) => id));
  assert.equal(new Set(ids).size, ids.length);
  const words = await page.locator('.terms dt').allInnerTexts();
  for (const word of [...causes, 'truth', 'ledger', 'fails as predicted', 'zfail_reversed'])
    assert.ok(words.includes(word), word);
  await keepScreenshot(page, 'terms', { fullPage: true });
  await page.locator('#home').click();
  await page.waitForFunction(() => document.querySelector('.matrix'));
  await page.locator('#terms').click();
  await page.waitForFunction(() => document.querySelector('.terms'));
  assert.deepEqual(said, []);
});

test('versions, plan, times and the reproducing command stand on the cell’s page', async () => {
  const { page } = await openReport(folder, { hash: '#near_plane/zpass' });
  const results = resultsOf(folder);
  const scene = results.scenes.find(({ name }) => name === 'near_plane');
  const made = await text(page, '.made');
  for (const words of [results.version, results.embree, results.gl.version, results.gl.renderer,
                       scene.techniques[0].command, ...scene.left_out])
    assert.ok(made.includes(words), words);
  assert.ok(made.includes(`${scene.techniques[0].ms.toFixed(1)} ms`));
});

test('the legend counts what it names', async () => {
  const { page } = await openReport(folder, { hash: '#near_plane/zpass' });
  const scene = resultsOf(folder).scenes.find(({ name }) => name === 'near_plane');
  const legend = await text(page, '.legends');
  for (const [name, pixels] of Object.entries(scene.techniques[0].causes))
    assert.match(legend, new RegExp(`${name}\\s+${grouped(pixels)}`));
  assert.match(legend, new RegExp(`lit\\s+${grouped(scene.reference.lit)}`));
  assert.match(legend, /255 \(-1\)/);
});

test('the drawing is saved as a picture that stands alone', async () => {
  const { page, said } = await openReport(folder, { hash: '#near_plane/zpass' });
  const saved = page.waitForEvent('download');
  await page.locator('#save-drawing').click();
  const svg = readFileSync(await (await saved).path(), 'utf8');
  assert.match(svg, /^<svg xmlns="http:\/\/www.w3.org\/2000\/svg"/);
  assert.match(svg, /<title>Pixel \(\d+, \d+\) of near_plane, zpass<\/title>/);
  assert.doesNotMatch(svg, /var\(/);
  assert.deepEqual(said, []);
});

test('pictures for people: overview, cell, inspector, drawing, in both themes', async () => {
  const large = writeReport('for-people', undefined, '512x512');
  for (const theme of ['light', 'dark']) {
    const { page, open, said } = await openReport(large, { theme });
    await keepScreenshot(page, `overview-${theme}`, { fullPage: true });
    await open('#near_plane/zpass');
    await keepScreenshot(page, `cell-${theme}`);
    await open('#near_plane/zpass?view=slide&of=truth,claim&at=0.5');
    await keepScreenshot(page, `slide-${theme}`);
    await open('#near_plane/zpass?zoom=48');
    await keepScreenshot(page, `zoom-${theme}`);
    for (const [part, selector] of [['inspector', '.inspector'], ['drawing', '#cutaway']])
      if (process.env.SHADOWPROOF_SCREENSHOTS)
        await page.locator(selector).screenshot(
          { path: join(process.env.SHADOWPROOF_SCREENSHOTS, `${part}-${theme}.png`) });
    assert.deepEqual(said, []);
  }
});
