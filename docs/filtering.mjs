// Makes docs/filtering.png: the true means over pixels, and what techniques claim in their place, of
// the boards and the floor of distant_bumps, cut out of the pages of a report.
//   SHADOWPROOF=build/dev/shadowproof CHROMIUM=chromium node docs/filtering.mjs
import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { emptyPage, openReport, writeReport } from '../tests/viewer/browser.mjs';
import { scratch } from '../tests/command/shadowproof.mjs';

const techniques = ['bump_tangent_space', 'bump_mipmapped', 'bump_mipmapped_dimmed', 'bump_toksvig', 'bump_lean'];
const folder = writeReport('filtering', ['distant_bumps'], '512x512', techniques);

/** What a pane of a cell's page shows, in the size of the picture. */
async function pictureOf(technique, pane) {
  const { page } = await openReport(folder, { hash: `#distant_bumps/${technique}?pixel=511,511`, width: 2600 });
  const picture = await page.locator(`canvas.pane[data-picture="${pane}"]`).evaluate((canvas) => canvas.toDataURL());
  await page.close();
  return picture;
}

const shown = [['mean over the pixel', await pictureOf('bump_mipmapped', 'true_color')]];
for (const technique of techniques) shown.push([technique, await pictureOf(technique, 'claimed_color')]);
const figures = shown.map(([name, picture]) => `<figure><div class="boards"><img src="${picture}"></div>
  <div class="floor"><img src="${picture}"></div><figcaption>${name}</figcaption></figure>`);
const html = join(scratch, 'filtering.html');
writeFileSync(html, `<style>
  body { margin: 8px; width: 1230px; display: grid; grid-template-columns: repeat(3, 1fr); gap: 10px; font: 14px monospace; }
  figure { margin: 0 } figcaption { padding-top: 2px }
  div { width: 400px; overflow: hidden; position: relative } img { position: absolute; width: 512px; image-rendering: pixelated }
  .boards { height: 185px } .boards img { left: -56px; top: -38px }
  .floor { height: 130px } .floor img { left: -56px; top: -258px }
</style>${figures.join('')}`);
const page = await emptyPage();
await page.setViewportSize({ width: 1246, height: 726 });
await page.goto(`file://${html}`);
await page.screenshot({ path: 'docs/filtering.png' });
process.exit(0);
