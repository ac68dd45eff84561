// A claim without surface, counter or colour, perhaps with shares of light: judged, reported,
// explained and opened like any other.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { before, test } from 'node:test';
import { scratch, shadowproof } from '../command/shadowproof.mjs';
import { openReport, shown, text } from '../viewer/browser.mjs';

const picture = ['--size', '96x96'];
const sides = 6;
const truth = join(scratch, 'truth.png');
const forgetting = { SHADOWPROOF_REMEMBERED: truth, SHADOWPROOF_FORGOTTEN: String(sides) };
const remembering = { SHADOWPROOF_REMEMBERED: truth };
const doubting = { ...forgetting, SHADOWPROOF_SHARE: '0.25' };

const verified = (name, env) => {
  const run = shadowproof(['verify', 'ordinary', ...picture, '--technique', 'remembered,zfail_reversed',
                           '--out', name], { env });
  const results = JSON.parse(readFileSync(join(scratch, name, 'results.json'), 'utf8'));
  return { ...run, cells: results.scenes[0].techniques };
};

before(() => {
  const run = shadowproof(['render', 'ordinary', ...picture, '-o', truth, '-q']);
  assert.equal(run.code, 0, run.err);
});

test('a claim that remembers the truth agrees, beside one that was counted', () => {
  const { code, out, err, cells } = verified('agreeing', remembering);
  assert.equal(code, 0, out + err);
  assert.deepEqual(cells.map(({ name, family, verdict }) => [name, family, verdict]),
                   [['remembered', 'remembered', 'agrees'], ['zfail_reversed', 'stencil', 'agrees']]);
  assert.equal(cells[0].volume_fragments, undefined);
  assert.equal(cells[0].ledger, undefined);
  assert.deepEqual(Object.keys(cells[0].images), ['claim', 'difference', 'cause']);
  assert.match(out, /remembered +ordinary +agrees +0 of 9,216/);
});

test('what it has forgotten is unexplained, told pixel by pixel, and fails the run', () => {
  const { code, out, cells: [cell] } = verified('forgetting', forgetting);
  assert.equal(code, 1);
  assert.equal(cell.verdict, 'unexplained');
  assert.ok(cell.causes.unexplained > 0 && cell.differing <= sides * sides, JSON.stringify(cell.causes));
  assert.match(out, new RegExp(`first \\(${cell.first.x},${cell.first.y}\\) unexplained`));
  const { x, y } = cell.first;
  const explained = shadowproof(['explain', 'ordinary', ...picture, '--technique',
                                 'remembered,zfail_reversed', '--pixel', `${x},${y}`, '--json',
                                 'pixel.json'], { env: forgetting });
  assert.equal(explained.code, 0, explained.err);
  assert.match(explained.out, / technique +remembered +claim +cause\n +remembered +shadowed +shadowed +unexplained\n/);
  assert.match(explained.out, / technique +predicted +stored +read back +precise +claim +cause +lost\n/);
  const record = JSON.parse(readFileSync(join(scratch, 'pixel.json'), 'utf8'));
  const [remembered, counted] = record.techniques;
  assert.equal(record.truth, 'lit');
  assert.deepEqual([remembered.family, remembered.remembered, remembered.claim, remembered.cause],
                   ['remembered', true, 'shadowed', 'unexplained']);
  assert.equal(remembered.shown, undefined);
  assert.equal(counted.family, 'stencil');
});

test('where it claims a share of the light, results and explain tell how much', () => {
  const { code, cells: [cell, counted] } = verified('doubting', doubting);
  assert.equal(code, 1);
  assert.equal(cell.family, 'remembered');
  assert.ok(cell.partly_lit > 0 && cell.partly_lit <= sides * sides, String(cell.partly_lit));
  assert.equal(cell.differing, cell.partly_lit);
  assert.equal(cell.wrongness, 0.75 * cell.partly_lit);
  assert.deepEqual([counted.partly_lit, counted.wrongness], [undefined, undefined]);
  const { x, y } = cell.first;
  const explained = shadowproof(['explain', 'ordinary', ...picture, '--technique', 'remembered',
                                 '--pixel', `${x},${y}`, '--json', 'share.json'], { env: doubting });
  assert.equal(explained.code, 0, explained.err);
  assert.match(explained.out, / remembered +partly_lit +partly_lit 0\.25 +unexplained\n/);
  const { techniques: [claim] } = JSON.parse(readFileSync(join(scratch, 'share.json'), 'utf8'));
  assert.deepEqual([claim.claim, claim.share], ['partly_lit', 0.25]);
});

test('a share of none or all of the light is no share, and refused', () => {
  for (const share of ['0', '1', 'nan', '-0.5']) {
    const { code, cells: [cell] } = verified('no-share', { ...doubting, SHADOWPROOF_SHARE: share });
    assert.equal(code, 3, share);
    assert.match(cell.error, /claim is neither background nor shadowed nor lit/);
  }
});

test('bench counts a pixel by the share of light by which it is off', () => {
  const { cells: [{ partly_lit: pixels }] } = verified('doubting-again', doubting);
  const run = shadowproof(['bench', 'ordinary', ...picture, '--technique', 'remembered', '--quick',
                           '--json', 'bench.json', '--out', 'plot', '-q'], { env: doubting });
  assert.equal(run.code, 1, run.err); // as the pixels are unexplained
  const { points } = JSON.parse(readFileSync(join(scratch, 'bench.json'), 'utf8'));
  const point = points.find(({ technique }) => technique === 'remembered');
  assert.deepEqual([point.falsely_lit, point.falsely_shadowed], [0, 0.75 * pixels]);
});

test('its results merge, and serve as a baseline', () => {
  const { code, err } = shadowproof(['merge', 'agreeing', '--out', 'merged', '-q'],
                                    { env: remembering });
  assert.equal(code, 0, err);
  const since = shadowproof(['verify', 'ordinary', ...picture, '--technique',
                             'remembered,zfail_reversed', '--baseline', 'agreeing/results.json',
                             '--out', 'since', '-q'], { env: forgetting });
  assert.equal(since.code, 1, since.err);
});

test('the viewer shows the share that is claimed at a pixel', async () => {
  verified('shared', doubting);
  const { page, said, asked } = await openReport(join(scratch, 'shared'),
                                                 { hash: '#ordinary/remembered' });
  await shown(page);
  await page.locator('#first').click();
  assert.match(await text(page, '.inspector'), /claim[^]*partly lit \(25 %\)/);
  assert.match(await text(page, '.legends'), /partly lit/);
  assert.equal(await page.locator('.alert').count(), 0);
  assert.deepEqual([said, asked], [[], []]);
});

test('the viewer opens its cell: claim and causes, and no counters', async () => {
  verified('opened', forgetting);
  const { page, said, asked } = await openReport(join(scratch, 'opened'),
                                                 { hash: '#ordinary/remembered' });
  await shown(page);
  assert.deepEqual(await page.locator('canvas[data-picture]').evaluateAll(
    (all) => all.map((canvas) => canvas.dataset.picture)), ['truth', 'claim', 'difference', 'cause']);
  await page.locator('#first').click();
  assert.match(await text(page, '.why'), /^unexplained: /);
  assert.match(await text(page, '.inspector'), /truth.*lit[^]*claim.*dark|truth[^]*lit[^]*claim[^]*shadowed/);
  assert.equal(await page.locator('.ledger').count(), 0);
  await page.locator('#goto').fill('0,0');
  await page.locator('#goto').press('Enter');
  assert.match(await text(page, '.why'), /agree here/);
  assert.equal(await page.locator('.alert').count(), 0);
  assert.deepEqual([said, asked], [[], []]);
});
