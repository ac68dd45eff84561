// Measures four scenes, and `auto` on further ones, and writes docs/results.md with the plots.
//   SHADOWPROOF=build/release/shadowproof node tests/bench/results_page.mjs [SECONDS PER SCENE]
//   SHADOWPROOF=... node tests/bench/results_page.mjs FOLDER [SECONDS]   (that it measured into, with so
//   many seconds: measures nothing)
// `auto` gets a quarter of the seconds, as a run of it has a fifth of the points.
// Nothing else should run meanwhile: times are compared within one run. Ends with 1 where `auto` is
// slower than the quickest technique that is right, beyond both intervals.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { existsSync, mkdtempSync, mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { chromium } from 'playwright-core';
import { named } from '../viewer/scripts.mjs';

const { hasInterval, isSurelySlower, quickestRight, wrongPixels } =
  named(['numbers.js', 'bench/figures.js'],
        ['hasInterval', 'isSurelySlower', 'quickestRight', 'wrongPixels']);

const scenes = ['near_plane', 'thin_caster', 'idle_casters', 'walking_figure'];
const measuredBefore = existsSync(process.argv[2] ?? '');
const seconds = (measuredBefore ? process.argv[3] : process.argv[2]) ?? '120';
const program = process.env.SHADOWPROOF;
assert.ok(program || measuredBefore, 'SHADOWPROOF names no program');
const docs = fileURLToPath(new URL('../../docs', import.meta.url));
// Stays, so that a page that cannot be written does not cost the measurement.
const folder = measuredBefore ? process.argv[2] : mkdtempSync(join(tmpdir(), 'shadowproof-results-'));
console.log(`the plot is in ${folder}`);

const manyScenes = [...scenes, 'ordinary', 'far_plane', 'eye_inside', 'nested'];
/** Shadow volumes without settings that are swept. */
const volumeTechniques = ['zpass', 'zfail', 'zfail_clamp', 'zfail_infinite', 'zfail_reversed',
  'zfail_half_edge', 'zfail_degenerate_quads', 'zfail_geometry_shader', 'zfail_per_triangle', 'zpass_capped',
  'zpass_eye_count', 'zp_plus', 'invert', 'zfail_float', 'auto'];

function measured(out, names, most, ...more) {
  if (!measuredBefore) {
    const args = ['bench', ...names, '--seconds', String(most), '--out', out, '--no-pictures', ...more];
    const { status } = spawnSync(program, args, { stdio: 'inherit' });
    assert.equal(status, 0, `shadowproof ${args.join(' ')} ended with ${status}`);
  }
  return JSON.parse(readFileSync(join(out, 'results.json'), 'utf8'));
}

/** Each scene's plot, as the page's own button saves it. */
async function savePlots() {
  const browser = await chromium.launch({
    executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
    args: process.getuid?.() === 0 ? ['--no-sandbox'] : [],
  });
  const page = await browser.newPage({ viewport: { width: 1000, height: 800 } });
  await page.goto(pathToFileURL(join(folder, 'index.html')).href);
  mkdirSync(join(docs, 'results'), { recursive: true });
  for (const scene of scenes) {
    await page.selectOption('#scene', scene);
    const [download] = await Promise.all([page.waitForEvent('download'), page.click('#svg')]);
    await download.saveAs(join(docs, 'results', `${scene}.svg`));
  }
  await browser.close();
}

const run = measured(folder, scenes, seconds);
const autos = measured(join(folder, 'auto'), manyScenes, Number(seconds) / 4, '--technique', volumeTechniques.join(','));
await savePlots();

const isOwn = (point, settings) =>
  Object.entries(settings).every(([name, value]) => (point.settings[name] ?? point.own?.[name]) === value);
/** The point of a technique whose settings are these, and else its own. */
function pointOf(scene, technique, settings = {}) {
  const found = run.points.find((point) =>
    point.scene === scene && point.technique === technique && isOwn(point, settings) &&
    Object.keys(point.settings).every((name) => name in settings));
  assert.ok(found, `${technique} ${JSON.stringify(settings)} was not measured on ${scene}`);
  return found;
}
const wrong = (point, cause) => (cause ? point.causes[cause] ?? 0
  : point.differing - (point.causes.edge ?? 0));
const percent = (pixels, point) => {
  const share = 100 * pixels / point.pixels;
  return share === 0 ? '0' : `${Number(share.toPrecision(2))} %`;
};
const ms = ({ ms: time }) => `${time.median.toPrecision(3)} ` + (hasInterval(time)
  ? `(${time.low.toPrecision(3)} to ${time.high.toPrecision(3)})` : '(no interval)');
const times = (a, b) => `${(a.ms.median / b.ms.median).toFixed(2)} times`;
const stageShare = (point, name) => {
  const sum = Object.values(point.stages).reduce((all, { median }) => all + median, 0);
  return `${Math.round(100 * point.stages[name].median / sum)} %`;
};
const table = (head, rows) => [head, head.map(() => '---'), ...rows]
  .map((row) => `| ${row.join(' | ')} |`).join('\n');

const volumes = (scene) => pointOf(scene, 'zfail_reversed');
const map = (scene, settings) => pointOf(scene, 'cube_map_six_pass', settings);

/** The biases that were tried, least first. */
const biases = [...new Set(run.points.filter((point) => 'map-bias' in (point.own ?? {}))
  .map((point) => point.settings['map-bias'] ?? point.own['map-bias']))]
  .sort((a, b) => Number(a) - Number(b));
const withBias = (scene, bias) => map(scene, { 'map-bias': bias });
function bestBias(scene) {
  const tried = biases.map((bias) => [bias, withBias(scene, bias)]);
  return tried.reduce((best, each) => (wrong(each[1]) < wrong(best[1]) ? each : best));
}
const [least, most] = [biases[0], biases.at(-1)];

const summary = table(
  ['the lecture', ...scenes.map((scene) => `\`${scene}\``)],
  [
    ['**Volumes** "consume lots of fill rate": share of the frame that counting takes',
     ...scenes.map((scene) => stageShare(volumes(scene), 'counting'))],
    ['**Volumes** are "relatively accurate": pixels wrong',
     ...scenes.map((scene) => percent(wrong(volumes(scene)), volumes(scene)))],
    ['**Maps** are "relatively efficient", "one additional drawing only": time of the frame, ' +
     'beside the volumes\'', ...scenes.map((scene) => times(map(scene), volumes(scene)))],
    ['... of which drawing the map, six times for a point light',
     ...scenes.map((scene) => stageShare(map(scene), 'map'))],
    ['**Maps**, pixels wrong',
     ...scenes.map((scene) => percent(wrong(map(scene)), map(scene)))],
    [`"Precision and biasing issues": self-shadowed (\`acne\`) without bias`,
     ...scenes.map((scene) => percent(wrong(withBias(scene, least), 'acne'), map(scene)))],
    [`... light that leaks (\`leak\`) at a bias of ${most}`,
     ...scenes.map((scene) => percent(wrong(withBias(scene, most), 'leak'), map(scene)))],
    ['"Hand tuning per scene": the bias, of those tried, with the fewest wrong pixels',
     ...scenes.map((scene) => bestBias(scene)[0])],
    ['... pixels wrong with it', ...scenes.map((scene) =>
      percent(wrong(bestBias(scene)[1]), map(scene)))],
  ]);

/** `auto`, the quickest other technique that is right, and zfail_reversed, on a scene. */
const comparedOn = (scene) => {
  const points = autos.points.filter((point) => point.scene === scene);
  const find = (technique) => points.find((point) => point.technique === technique);
  return { scene, auto: find('auto'), best: quickestRight(points), usual: find('zfail_reversed') };
};
const compared = manyScenes.map(comparedOn);
const slower = compared.filter(({ auto, best }) => best && isSurelySlower(auto.ms, best.ms));
const quicker = compared.filter(({ auto, best }) => best && isSurelySlower(best.ms, auto.ms));
const isTimed = ({ auto, best }) => best && hasInterval(auto.ms) && hasInterval(best.ms);
const gains = table(['scene', '`auto`, ms', 'quickest other that is right, ms', '`auto` takes', 'of `zfail_reversed`',
                     'pixels of `auto` wrong'],
  compared.map(({ scene, auto, best, usual }) => [`\`${scene}\``, ms(auto),
    best ? `\`${best.technique}\` ${ms(best)}` : 'none', best ? times(auto, best) : '–', times(auto, usual),
    String(wrongPixels(auto))]));
const sceneWords = (all) => all.map(({ scene }) => `\`${scene}\``).join(', ') || 'none';

const truths = table(['scene', 'truth, ms', '`zfail_reversed`, ms', 'truth takes', 'without filters, ms', 'which takes'],
  scenes.map((scene) => {
    const truth = pointOf(scene, 'truth');
    const unfiltered = pointOf(scene, 'truth', { filters: 'off' });
    return [`\`${scene}\``, ms(truth), ms(volumes(scene)), times(truth, volumes(scene)), ms(unfiltered),
            times(unfiltered, truth)];
  }));

const { gl, embree, machine, version } = run;
const timed = run.points.filter(({ ms: time }) => hasInterval(time));
const settled = run.points.filter(({ ms: time }) => time.settled);
writeFileSync(join(docs, 'results.md'), `# Results

What [\`shadowproof bench\`](bench.md) measured on four bundled scenes at ${run.scenes[0].width}x${run.scenes[0].height}. This page is made
by one command, which measures anew:

\`\`\`
SHADOWPROOF=build/release/shadowproof node tests/bench/results_page.mjs ${seconds}
\`\`\`

shadowproof ${version}, ${gl.renderer}, OpenGL ${gl.version}, Embree ${embree}; ${machine.processor},
${machine.cores} cores, ${machine.system}. This is OpenGL in software: times compare techniques with each other
on this machine, and say nothing of a graphics card. Milliseconds are medians, with their 95 %
intervals, where there are six samples for one: ${timed.length} of ${run.points.length} points have an interval, and of ${settled.length}
it is within 5 % of the median.${settled.length < run.points.length / 2 ? ' Most are wider: the machine was not quiet. Ratios of times whose\nintervals overlap say little.' : ''} Pixels that differ at an edge are not wrong.

## Maps against volumes

The lecture CS448 (Akeley and Hanrahan, Stanford, Fall 2001, lecture 11) ends with a summary of shadow
volumes and shadow maps. These are its statements and what they come to here, but for two: that tuning a
bias is difficult for dynamic scenes, and that maps may be extended to linear and area lights. Volumes are
\`zfail_reversed\`; maps are \`cube_map_six_pass\` with its own settings (${
  Object.entries(map(scenes[0]).own).map(([name, value]) => `${name} ${value}`).join(', ')}) where none are named.

${summary}

## What \`auto\` gains

A run of its own, of ${volumeTechniques.length} techniques of shadow volumes. Beyond both intervals \`auto\` is slower than the
quickest other technique that is right on these scenes: ${sceneWords(slower)}; and quicker than it on these:
${sceneWords(quicker)}. On ${compared.filter(isTimed).length} of ${compared.length} scenes both have an interval.

${gains}

## What the truth costs

The truth's time is that of all eye and shadow rays, with their exact decisions; without filters each
decision is one of exact arithmetic. Its tree of boxes is there
already. That of \`zfail_reversed\` includes making the volumes.

${truths}

## All techniques and settings

Further left is quicker, lower is more right; points that are exactly right have a row each below. The
broken line is the front.
${scenes.map((scene) => `
### ${scene}

![Error against run time on ${scene}](results/${scene}.svg)
`).join('')}`);

if (slower.length > 0) {
  console.error(`auto is slower than the quickest that is right on ${sceneWords(slower)}`);
  process.exitCode = 1;
}
