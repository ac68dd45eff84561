// The section of traced shadows: what it shows of a pixel is what `explain` says of it.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { before, test } from 'node:test';
import { inflateSync } from 'node:zlib';
import { scratch, shadowproof } from '../command/shadowproof.mjs';
import { damageBlock } from './coded.mjs';
import { cellsOf, copyOfReport, keepScreenshot, openReport, resultsOf, text, writeReport } from './browser.mjs';
import { randomNumbers, seed } from './random.mjs';
import { named } from './scripts.mjs';

const { printed, printedPoint } = named(['numbers.js'], ['printed', 'printedPoint']);
const size = '160x160';
const scenes = ['light_on_edge', 'slivers', 'near_light'];
const techniques = ['traced_offset', 'traced_epsilon', 'traced_skip'];

let folder;
let cells;
before(() => {
  folder = writeReport('traced', scenes, size, techniques);
  cells = cellsOf(resultsOf(folder)).filter(({ cell }) => cell.differing > 0);
});

const differingOf = ({ cell }) =>
  [...inflateSync(Buffer.from(cell.cause_map, 'base64')).entries()]
    .filter(([, cause]) => cause !== 255).map(([i]) => i);

function explained({ scene, cell }, x, y) {
  const run = shadowproof(['explain', scene.name, '--technique', cell.name, '--size', size, '--pixel',
                           `${x},${y}`, '--json', 'traced-pixel.json']);
  assert.equal(run.code, 0, run.err);
  return JSON.parse(readFileSync(join(scratch, 'traced-pixel.json'), 'utf8')).techniques[0];
}

const factsOf = (page) => page.locator('.inspector .facts div').evaluateAll((rows) =>
  Object.fromEntries(rows.map((row) => [row.children[0].textContent, row.children[1].textContent])));

const placeOf = ({ scene }, pixel) => [pixel % scene.width, Math.floor(pixel / scene.width)];

test(`the rays of pixels are those that explain has (seed ${seed})`, async () => {
  const random = randomNumbers();
  const { page, open, said } = await openReport(folder);
  assert.ok(cells.length >= 3);
  let shot = 0;
  for (const each of cells)
    for (let tries = 0; tries < 4; ++tries) {
      const pixels = differingOf(each);
      const [x, y] = placeOf(each, pixels[Math.floor(random() * pixels.length)]);
      const { saw, at, shadow_ray: ray } = explained(each, x, y);
      await open(`#${each.id}?pixel=${x},${y}`);
      const facts = await factsOf(page);
      assert.equal(facts['Eye ray met'],
                   saw === null ? 'nothing' : `triangle ${saw} at ${printed(at)}`);
      if (!ray) {
        assert.match(await text(page, '.inspector'), /No shadow ray was shot here/);
        continue;
      }
      ++shot;
      assert.equal(facts['Shadow ray'],
                   `from ${printedPoint(ray.origin)} along ${printedPoint(ray.direction)}`);
      assert.equal(facts['Embree’s answer'], ray.stopped_by === null ? 'nothing in the way'
        : `stopped by triangle ${ray.stopped_by}`);
      assert.equal(facts['Traced exactly'],
                   ray.hits.length > 0 ? `meets triangle ${ray.hits[0].triangle} first` : 'meets nothing');
      await keepScreenshot(page, `${each.cell.name}-${each.scene.name}`);
    }
  assert.ok(shot >= 6, `${shot} shadow rays`);
  assert.deepEqual(said, []);
});

test('a damaged list of the rays is named in place of the evidence', async () => {
  const [each] = cells;
  const copy = copyOfReport(folder, 'damaged-rays');
  damageBlock(join(copy, `${each.id}.cell.js`), 'direction_y');
  const [x, y] = placeOf(each, differingOf(each)[0]);
  const { page } = await openReport(copy, { hash: `#${each.id}?pixel=${x},${y}` });
  assert.match(await text(page, '.inspector .alert'),
               /evidence cannot be shown: .*cell\.js: block direction_y is damaged/);
});
