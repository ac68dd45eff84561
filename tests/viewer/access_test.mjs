// Everybody can use it: axe-core finds nothing, and a narrow screen needs no sideways scrolling.
import assert from 'node:assert/strict';
import { readFileSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join } from 'node:path';
import { before, test } from 'node:test';
import { copyOfReport, keepScreenshot, openReport, resultsOf, writeReport } from './browser.mjs';

const axe = readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');

let folder;
let failing;
let colors;
let unpredicted;
before(() => {
  folder = writeReport('report', ['near_plane', 'far_plane']);
  failing = copyOfReport(folder, 'failing');
  const results = resultsOf(failing);
  results.passed = false;
  results.baseline = { file: 'before.json', passed: true };
  Object.assign(results.scenes[0].techniques[0], { verdict: 'unexplained', fails: true,
                                                   since: { new: 5, gone: 1, changed: 2 } });
  Object.assign(results.scenes[1].techniques[1], { verdict: 'defect', fails: true });
  results.scenes[1].techniques[4] = { name: 'zfail_reversed', error: 'no glClipControl', fails: true };
  results.scenes.push({ name: 'torn', file: 'torn.gltf', error: 'torn.gltf: ends early' });
  writeFileSync(join(failing, 'results.js'), `shadowproof.results(${JSON.stringify(results)});`);
  colors = writeReport('colors', ['bumpy_torus'], undefined, ['bump_three_pass']);
  unpredicted = copyOfReport(colors, 'unpredicted');
  const strange = resultsOf(unpredicted);
  const [cell] = strange.scenes[0].techniques;
  Object.assign(cell, { verdict: 'unexplained', fails: true });
  cell.color.unpredicted = 7;
  writeFileSync(join(unpredicted, 'results.js'), `shadowproof.results(${JSON.stringify(strange)});`);
});

/** In words: the rule, and the elements that break it. */
async function violations(page) {
  await page.evaluate(axe);
  const { violations: found } = await page.evaluate(() => window.axe.run(document, {
    runOnly: ['wcag2a', 'wcag2aa', 'wcag21a', 'wcag21aa', 'wcag22aa', 'best-practice'] }));
  return found.map(({ id, help, nodes }) =>
    `${id}: ${help}: ${nodes.slice(0, 3).map(({ html }) => html.slice(0, 160)).join(' | ')}`);
}

const states = [
  ['overview', () => folder, ''],
  ['failing overview', () => failing, ''],
  ['filtered overview', () => failing, '#?verdict=defect'],
  ['cell and inspector', () => folder, '#near_plane/zpass'],
  ['pixel that agrees', () => folder, '#near_plane/zpass?pixel=1,1'],
  ['slide', () => folder, '#near_plane/zpass?view=slide'],
  ['toggle', () => folder, '#near_plane/zpass?view=toggle&zoom=32'],
  ['cell that could not run', () => failing, '#far_plane/zfail_reversed'],
  ['unexplained cell', () => failing, '#near_plane/zpass'],
  ['overview of colours', () => colors, ''],
  ['colours', () => colors, '#bumpy_torus/bump_three_pass'],
  ['compared colours', () => colors, '#bumpy_torus/bump_three_pass?view=blend'],
  ['unpredicted colours', () => unpredicted, '#bumpy_torus/bump_three_pass?pixel=80,120'],
];

for (const theme of ['light', 'dark'])
  for (const [name, report, hash] of states)
    test(`axe-core finds no violation: ${name}, ${theme}`, async () => {
      const { page } = await openReport(report(), { hash, theme });
      assert.deepEqual(await violations(page), []);
    });

for (const theme of ['light', 'dark'])
  test(`axe-core finds no violation: help, ${theme}`, async () => {
    const { page } = await openReport(folder, { theme });
    await page.keyboard.press('?');
    assert.deepEqual(await violations(page), []);
  });

test('the switch sets the other theme over that of the system', async () => {
  const { page } = await openReport(folder, { hash: '#near_plane/zpass', theme: 'light' });
  await page.locator('#theme').click();
  assert.deepEqual(await violations(page), []);
  assert.equal(await page.evaluate(() => getComputedStyle(document.body).colorScheme ||
    getComputedStyle(document.documentElement).colorScheme), 'dark');
});

for (const [name, report, hash] of states)
  test(`400 pixels wide, nothing needs sideways scrolling: ${name}`, async () => {
    const { page } = await openReport(report(), { hash, width: 400 });
    assert.ok(await page.evaluate(() => document.documentElement.scrollWidth) <= 400);
    await keepScreenshot(page, `narrow-${name.replaceAll(' ', '-')}`, { fullPage: true });
  });

test('the inspected pixel is said to a screen reader', async () => {
  const { page } = await openReport(folder, { hash: '#near_plane/zpass' });
  await page.keyboard.press('n');
  const said = await page.locator('[role="status"]').textContent();
  assert.match(said, /^\(\d+, \d+\) +truth lit, claim shadowed, near_plane/);
});
