// The section of shadow maps: what it shows of a pixel is what `explain` says of it, and the map itself
// has its texel marked.
import assert from 'node:assert/strict';
import { before, test } from 'node:test';
import { inflateSync } from 'node:zlib';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { scratch, shadowproof } from '../command/shadowproof.mjs';
import { cellsOf, keepScreenshot, openReport, resultsOf, text, writeReport } from './browser.mjs';
import { randomNumbers, seed } from './random.mjs';
import { named } from './scripts.mjs';

const { printed } = named(['numbers.js'], ['printed']);
const size = '160x160';

/** Which maps suit which scene's light. */
const suited = {
  cube_edge: ['cube_map_pcf', 'cube_map_six_pass'],
  spot: ['cube_map_six_pass', 'spot_map', 'spot_map_dual_texture'],
  sun: ['sun_map'],
};

let reports;
before(() => {
  reports = Object.entries(suited).map(([scene, techniques]) => {
    const folder = writeReport(`maps-of-${scene}`, [scene], size, techniques);
    return { folder, cells: cellsOf(resultsOf(folder)) };
  });
});

const causesOf = ({ cell }) => inflateSync(Buffer.from(cell.cause_map, 'base64'));

function explained({ scene, cell }, x, y) {
  const run = shadowproof(['explain', scene.name, '--technique', cell.name, '--size', size, '--pixel',
                           `${x},${y}`, '--json', 'map-pixel.json']);
  assert.equal(run.code, 0, run.err);
  return JSON.parse(readFileSync(join(scratch, 'map-pixel.json'), 'utf8')).techniques[0].map;
}

const factsOf = (page) => page.locator('.inspector .facts div').evaluateAll((rows) =>
  Object.fromEntries(rows.map((row) => [row.children[0].textContent, row.children[1].textContent])));

/** Where the mark is: the middle of the pixels of its colour. */
const markOf = (page) => page.locator('#map-faces').evaluate((canvas) => {
  const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
  let [count, x, y] = [0, 0, 0];
  for (let i = 0; i < data.length; i += 4) {
    if (data[i] !== 0xD5 || data[i + 1] !== 0x5E || data[i + 2] !== 0) continue;
    ++count;
    x += i / 4 % canvas.width;
    y += Math.floor(i / 4 / canvas.width);
  }
  return { count, x: x / count + 0.5, y: y / count + 0.5, width: canvas.width, height: canvas.height };
});

for (const [i, scene] of Object.keys(suited).entries())
  test(`texel, footprint and mark of a pixel of ${scene} are those that explain has (seed ${seed})`,
       () => pixelsAreAsExplained(reports[i]));

async function pixelsAreAsExplained({ folder, cells }) {
  const random = randomNumbers();
  const { page, open, said } = await openReport(folder);
  assert.equal(cells.length, suited[cells[0].scene.name].length);
  for (const each of cells) {
    const asked = [...causesOf(each).entries()].filter(([, cause]) => cause !== 255).map(([i]) => i);
    assert.ok(asked.length > 0, each.id);
    let map = null;
    let place;
    for (let tries = 0; !map && tries < 20; ++tries) {
      const pixel = asked[Math.floor(random() * asked.length)];
      place = [pixel % each.scene.width, Math.floor(pixel / each.scene.width)];
      map = explained(each, ...place);
    }
    assert.ok(map, `${each.id} has a pixel that asks its map`);
    await open(`#${each.id}?pixel=${place.join(',')}`);
    const facts = await factsOf(page);
    const { size: side } = each.cell.map;
    assert.equal(facts.Texel, `(${map.texel.join(', ')}) of face ${map.face}, ${side} a side`);
    // As floats have them.
    const words = map.footprint.map((length) => length === null ? 'endless' : printed(Math.fround(length), 3));
    assert.equal(facts.Footprint, `${words.join(' × ')} on the surface`);
    const mark = await markOf(page);
    const faces = mark.width === mark.height ? 1 : 6;
    const pictured = faces === 1 ? mark.width : mark.width / 3;
    assert.equal(mark.width * mark.height, faces * pictured * pictured);
    assert.ok(mark.count > 0, each.id);
    const inside = pictured / 9; // a mark near the border is cut off
    const expected = [0, 1].map((axis) => map.texel[axis] / side * pictured +
      (faces === 1 ? 0 : (axis === 0 ? map.face % 3 : Math.floor(map.face / 3)) * pictured));
    assert.ok(Math.abs(mark.x - expected[0]) < inside && Math.abs(mark.y - expected[1]) < inside,
              `${each.id}: ${JSON.stringify(mark)} where ${expected} belongs`);
    await keepScreenshot(page, `map-${each.cell.name}`, { fullPage: true });
  }
  assert.deepEqual(said, []);
}

test('a block that ends at its face says so, and one that continues says that', async () => {
  for (const [edges, words] of [['clamped', /repeating the border of its face/],
                                ['seamless', /across the edges of its face/]]) {
    const run = shadowproof(['verify', 'cube_edge', '--size', size, '--technique', 'cube_map_pcf', '--map-size',
                             '64', '--map-average', 'values', '--map-edges', edges, '--out', edges, '-q']);
    assert.equal(run.code, 0, run.out + run.err);
    const report = join(scratch, edges);
    const [each] = cellsOf(resultsOf(report));
    assert.equal(each.cell.map.edges, edges);
    assert.equal(each.cell.causes.seam > 0, edges === 'clamped', JSON.stringify(each.cell.causes));
    const { page, open } = await openReport(report);
    const asks = [...causesOf(each).entries()].filter(([, cause]) => cause !== 255).map(([i]) => i);
    let found = false;
    for (const i of asks.slice(0, 20)) {
      await open(`#${each.id}?pixel=${i % each.scene.width},${Math.floor(i / each.scene.width)}`);
      if (await page.locator('#averaged').count() === 0) continue;
      assert.match(await text(page, '#averaged'), words);
      found = true;
      break;
    }
    assert.ok(found, each.id);
  }
});
