// The inspector decodes the report's blocks; `explain` traces the pixel anew. They must say the
// same, digit by digit.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { before, test } from 'node:test';
import { inflateSync } from 'node:zlib';
import { scratch, shadowproof } from '../command/shadowproof.mjs';
import { cellsOf, openReport, resultsOf, shown, text, writeReport } from './browser.mjs';
import { randomNumbers, seed } from './random.mjs';
import { named } from './scripts.mjs';

const { printed, printedPoint } = named(['numbers.js'], ['printed', 'printedPoint']);
const { explainCommand } = named(['words.js'], ['explainCommand']);
const size = '300x256'; // large enough for edges, and no square
const scenes = ['near_plane', 'far_plane', 'eye_inside', 'ordinary'];

let folder;
let cells;
before(() => {
  folder = writeReport('report', scenes, size);
  cells = cellsOf(resultsOf(folder));
});

const causesOf = ({ cell }) => inflateSync(Buffer.from(cell.cause_map, 'base64'));

function differingPixels(each) {
  return [...causesOf(each).entries()].filter(([, cause]) => cause !== 255).map(([i]) => i);
}

/** What the command says of a pixel: { lines, record }. */
function explained({ scene, cell }, x, y) {
  const run = shadowproof(['explain', scene.name, '--technique', cell.name, '--size', size, '--pixel',
                           `${x},${y}`, '--json', 'pixel.json']);
  assert.equal(run.code, 0, run.err);
  return { said: run.out, record: JSON.parse(readFileSync(join(scratch, 'pixel.json'), 'utf8')) };
}

/** Rows "depth change inside crossing" as the command prints them. */
function printedLedger(said) {
  return [...said.matchAll(/^ +(\S+) +([+-]1) +(\d+)  ((?:side|light cap) of .+)$/gm)].map((row) => row.slice(1));
}

const rowsOf = (page) => page.locator('.ledger tbody tr').evaluateAll((rows) =>
  rows.filter((row) => row.querySelector('.depth')).map((row) =>
    ['.depth', '.change', '.inside', '.what', '.fate'].map((part) =>
      row.querySelector(part).textContent.trim())));

const factsOf = (page) => page.locator('.inspector .facts div').evaluateAll((rows) =>
  Object.fromEntries(rows.map((row) => [row.children[0].textContent, row.children[1].textContent])));

const fates = { counted: /^counted [+-]1$/, beyond: /not asked for$/, lost_near: /near plane$/,
                lost_far: /far plane$/, lost_cap: /cap is missing$/ };

async function compare(page, each, x, y) {
  const { said, record } = explained(each, x, y);
  const [technique] = record.techniques;
  const values = await text(page, '.inspector .values');
  assert.equal(values.replace(/\s+/g, ' ').trim(),
               `truth ${record.truth} claim ${technique.claim} cause ${technique.cause}`);
  const rows = await rowsOf(page);
  assert.deepEqual(rows.map((row) => row.slice(0, 4)), printedLedger(said));
  rows.forEach((row, i) => assert.match(row[4], fates[technique.statuses[i]]));
  for (const [id, value] of [['predicted', technique.predicted], ['stored', technique.stored],
                             ['read-back', technique.read_back]])
    assert.equal(await text(page, `#${id}`), String(value), id);
  const facts = await factsOf(page);
  const { seen, margin, inside } = record;
  const sees = seen ? `triangle ${seen.triangle} of ${seen.mesh} at ${printedPoint(seen.point)}, ` +
                      `depth ${printed(seen.depth)}` : 'background';
  assert.equal(facts.Sees, sees);
  assert.ok(said.includes(`sees      ${sees}\n`), said);
  assert.equal(facts.Shown, technique.shown
    ? `triangle ${technique.shown.triangle} of ${technique.shown.mesh}` : 'background');
  assert.equal(facts.Decided, record.exactness);
  assert.equal(facts['Margin along the ray']?.split(' ')[0],
               margin.depth === null ? undefined : printed(margin.depth));
  assert.equal(facts['Margin in the picture'].split(' ')[0],
               margin.pixels === null ? 'no' : printed(margin.pixels));
  assert.ok(said.includes(`inside    ${facts.Inside}\n`), facts.Inside);
  assert.ok(said.includes(`ray       ${facts.Ray}\n`), facts.Ray);
  assert.ok(said.includes(`light     ${facts.Light}\n`), facts.Light);
  assert.equal(facts.Masks, said.match(/^ {2}masks {5}(.+)$/m)?.[1]);
  assert.equal(Boolean(facts.Masks), inside.let_through > 0);
  assert.equal(inside.surface === null, seen === null);
}

test(`twenty differing pixels read as explain has them (seed ${seed})`, async () => {
  const random = randomNumbers();
  const withPixels = cells.filter(({ cell }) => cell.differing > 0 && cell.name !== 'auto')
    .sort((a, b) => b.cell.differing - a.cell.differing);
  const { page, open, said, asked } = await openReport(folder);
  for (let i = 0; i < 20; ++i) {
    // The three large cells, and in between the others, whose few pixels are edges and precision.
    const each = i % 4 === 3 ? withPixels[3 + Math.floor(random() * (withPixels.length - 3))]
                             : withPixels[i % 4];
    const pixels = differingPixels(each);
    const pixel = pixels[Math.floor(random() * pixels.length)];
    const [x, y] = [pixel % each.scene.width, Math.floor(pixel / each.scene.width)];
    await open(`#${each.id}?pixel=${x},${y}`);
    await compare(page, each, x, y);
  }
  assert.deepEqual(said, []);
  assert.deepEqual(asked, []);
});

test('where light falls through the holes of masks, both say of how many volumes', async () => {
  const masked = writeReport('masked', ['perforated'], size, ['zfail_reversed']);
  const [each] = cellsOf(resultsOf(masked));
  const { page, open, said } = await openReport(masked);
  const pixels = differingPixels(each);
  const tried = [0.2, 0.5, 0.8].map((way) => pixels[Math.floor(way * pixels.length)]);
  let through = 0;
  for (const pixel of tried) {
    const [x, y] = [pixel % each.scene.width, Math.floor(pixel / each.scene.width)];
    await open(`#${each.id}?pixel=${x},${y}`);
    await compare(page, each, x, y);
    through += (await factsOf(page)).Masks ? 1 : 0;
  }
  assert.ok(through > 0);
  assert.deepEqual(said, []);
});

test('a technique that leaves casters out shows what its own volumes are', async () => {
  const { page, open, said } = await openReport(folder);
  const chosen = cells.filter(({ cell }) => cell.differing > 0 && cell.name === 'auto');
  assert.ok(chosen.length > 0);
  for (const each of chosen) {
    const [pixel] = differingPixels(each);
    const [x, y] = [pixel % each.scene.width, Math.floor(pixel / each.scene.width)];
    const [technique] = explained(each, x, y).record.techniques;
    await open(`#${each.id}?pixel=${x},${y}`);
    const rows = await rowsOf(page);
    assert.deepEqual(rows.map(([depth, change]) => [depth, change]), technique.crossings
      .map(({ depth, change }) => [printed(depth), `${change > 0 ? '+' : ''}${change}`]));
    rows.forEach((row, i) => assert.match(row[4], fates[technique.statuses[i]]));
    assert.equal(await text(page, '#predicted'), String(technique.predicted));
    assert.equal(await text(page, '#stored'), String(technique.stored));
  }
  assert.deepEqual(said, []);
});

test(`pixels that agree show both counters as explain has them (seed ${seed})`, async () => {
  const random = randomNumbers(seed + 1);
  const { page, open } = await openReport(folder);
  for (let i = 0; i < 6; ++i) {
    const each = cells[Math.floor(random() * cells.length)];
    const causes = causesOf(each);
    let pixel;
    do pixel = Math.floor(random() * causes.length); while (causes[pixel] !== 255);
    const [x, y] = [pixel % each.scene.width, Math.floor(pixel / each.scene.width)];
    const { record } = explained(each, x, y);
    const [technique] = record.techniques;
    await open(`#${each.id}?pixel=${x},${y}`);
    assert.equal(await text(page, '.why'), 'Truth and claim agree here.');
    assert.equal((await text(page, '.inspector .values')).replace(/\s+/g, ' ').trim(),
                 `truth ${record.truth} claim ${technique.claim}`);
    assert.equal(parseInt(await text(page, '#stored'), 10), technique.stored);
    assert.equal(parseInt(await text(page, '#read-back'), 10), technique.read_back);
  }
});

test('stepping follows the rows from the top, skips none, and begins again at the end', async () => {
  const each = cells.find(({ id }) => id === 'near_plane/zpass');
  const { width } = each.scene;
  const place = (pixel) => [pixel % width, Math.floor(pixel / width)];
  const pixels = differingPixels(each);
  const order = [...pixels.slice(-3), ...pixels.slice(0, 5)].map(place);
  const { page } = await openReport(folder, { hash: `#${each.id}?pixel=${order[0]}` });
  const isAt = async ([x, y]) => assert.equal(await text(page, '.inspector h2'), `Pixel (${x}, ${y})`);
  for (const at of order.slice(1)) {
    await page.locator('#next').click();
    await isAt(at);
  }
  for (const at of order.reverse().slice(1)) {
    await page.locator('#previous').click();
    await isAt(at);
  }
});

test('the explain command that the inspector gives is one that explains this pixel', async () => {
  const each = cells.find(({ id }) => id === 'near_plane/zpass');
  const { page } = await openReport(folder, { hash: '#near_plane/zpass' });
  const command = await text(page, '#copy-explain-text');
  const { x, y } = each.cell.first;
  assert.equal(command,
               `shadowproof explain near_plane --technique zpass --size ${size} --pixel ${x},${y}`);
  const run = shadowproof(command.split(' ').slice(1));
  assert.equal(run.code, 0, run.err);
  await shown(page);
});

test('of a picture that a renderer made, too, it is a command about the scene alone', () => {
  const commands = [
    ["shadowproof check /a/sun.gltf --renderer 'node '\\''/x y.mjs'\\'' {scene} {out}' --name three --size 64x64",
     'shadowproof explain /a/sun.gltf --size 64x64 --pixel 3,4'],
    ["shadowproof check 'my scene.gltf' 'a b.png' --unlit 'o ff.png' --light 1 --no-alignment",
     "shadowproof explain 'my scene.gltf' --light 1 --pixel 3,4"]];
  for (const [command, wanted] of commands) assert.equal(explainCommand(command, 3, 4), wanted);
});
