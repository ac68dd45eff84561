// The drawing under hard circumstances: it stays a picture, its words stay apart and inside, and
// the command and the browser draw the same.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { scratch, shadowproof } from '../command/shadowproof.mjs';
import { emptyPage, keepScreenshot } from './browser.mjs';
import { randomNumbers, seed } from './random.mjs';
import { named } from './scripts.mjs';

const { cutaway } = named(['cutaway/geometry.js', 'cutaway/words.js', 'cutaway/svg.js',
                           'cutaway/side.js', 'cutaway/strip.js', 'cutaway/comparison.js',
                           'cutaway/float_ray.js', 'cutaway/evidence.js', 'cutaway/cutaway.js'],
                          ['cutaway']);

let page;
before(async () => { page = await emptyPage(); });

/** A side of a volume that the ray along -z meets at `depth`, from an edge across the drawing. */
function side(depth, change, { mesh = 'caster', light = [0, 4, -6], along = 0.6 } = {}) {
  const on = [0, 0, -depth];
  const edge = light.map((value, i) => value + along * (on[i] - value));
  return { depth, change, kind: 'side', caster: { triangle: 7, mesh },
           from: [[edge[0] - 1, edge[1], edge[2]], [edge[0] + 1, edge[1], edge[2]]] };
}

const surfaceAt = (depth, mesh = 'floor') => ({
  triangle: 3, mesh, depth, point: [0, 0, -depth],
  corners: [[-5, -1, -depth + 2], [5, -1, -depth + 2], [0, 2, -depth - 4]] });

/** A record of the eye at the origin that looks along -z, counted by z-pass. */
function recordOf(crossings, changes = {}, technique = {}) {
  const sum = crossings.reduce((inside, { change }) => inside + change, 0);
  return {
    schema: 'shadowproof/pixel/1', scene: 'made <by> "hand" & eye', x: 1, y: 2, width: 8, height: 8,
    eye: [0, 0, 0], direction: [0, 0, -1], near: 0.5, far: 40,
    light: { name: 'lamp', position: [0, 4, -6] }, truth: 'lit', exactness: 'filtered',
    seen: surfaceAt(10), margin: { depth: 1, pixels: 2 },
    inside: { eye: 0, near: 0, surface: 0, far: sum, infinity: sum },
    crossings, adds_up: true, ...changes,
    techniques: [{
      name: 'zpass', test: 'depth_pass', predicted: 0, stored: 0, read_back: 0, claim: 'lit',
      shown: null, cause: 'near_plane',
      statuses: crossings.map(({ depth }) =>
        (depth < 0.5 ? 'lost_near' : depth > 10 ? 'beyond' : 'counted')),
      dark_cap: 'beyond', ...technique }],
  };
}

/** What a technique asked that reads a shadow map, or traces rays in float. */
const asksMap = (changes = {}) => ({ name: 'spot_map', test: undefined, statuses: undefined, map: {
  face: 0, texel: [764, 672], size: 1024, value: 'depth', format: 'd24', near: 0.1, far: 20,
  stored: 9.147, bias: 0.15, own: 10.283, width: 0.01, footprint: [0.017, 0.02], shows: 14,
  ...changes } });
const shoots = (changes = {}) => ({ name: 'traced_epsilon', test: undefined, statuses: undefined,
  shadow_ray: { near: 0.001, far: 10.3, stopped_by: 15, leaves_plane_at: 4e-6, passed_over: null,
                hits: [{ triangle: 1750, mesh: 'torus', t: 0.7 }], ...changes } });

function manyCrossings(count) {
  const random = randomNumbers();
  return Array.from({ length: count }, () => 0.1 + 15 * random()).sort((a, b) => a - b)
    .map((depth, i) => side(depth, i % 2 ? -1 : 1, { mesh: `leaf ${i % 7}`, along: random() }));
}

const pair = [side(2, 1), side(4, -1)];
const cases = {
  plain: recordOf(pair),
  nothing: recordOf([]),
  background: recordOf(pair, { seen: null, truth: 'background' }),
  'nothing at all': recordOf([], { seen: null, truth: 'background' }),
  'light behind the eye': recordOf([side(2, 1, { light: [0, 3, 5] }), side(4, -1, { light: [0, 3, 5] })],
                                   { light: { name: 'lamp', position: [0, 3, 5] } }),
  'light far behind the eye': recordOf([side(2, 1, { light: [0, 30, 500] })],
                                       { light: { name: 'lamp', position: [0, 30, 500] } }),
  'light far above': recordOf([side(2, 1, { light: [0, 900, -6], along: 0.999 })],
                              { light: { name: 'lamp', position: [0, 900, -6] } }),
  'light on the ray': recordOf(pair, { light: { name: 'lamp', position: [0, 0, -20] } }),
  'light next to the ray': recordOf([side(2, 1, { light: [0, 1e-3, -20] })],
                                    { light: { name: 'lamp', position: [0, 1e-3, -20] } }),
  'light at the eye': recordOf([], { light: { name: 'lamp', position: [0, 0, 0] } }),
  'directional light': recordOf([2, 4].map((depth, i) =>
    side(depth, 1 - 2 * i, { light: [0, 4e4, -2e4], along: 0.99995 })),
    { light: { name: 'sun', kind: 'directional', direction: [0, -2, 1] } }),
  'directional light from behind': recordOf([side(2, 1, { light: [0, 3e5, 5e5], along: 0.999999 })],
    { light: { name: 'sun', kind: 'directional', direction: [0, -0.5, -0.9] } }),
  'directional light along the ray': recordOf(pair,
    { light: { name: 'sun', kind: 'directional', direction: [0, 0, -1] } }),
  'directional light and nothing': recordOf([],
    { light: { name: 'sun', kind: 'directional', direction: [0, -1, 0] }, seen: null }),
  'directional light and crossings in one spot':
    recordOf([side(0.49999, 1), side(0.50001, -1), side(0.50002, 1), side(0.50003, -1)],
             { light: { name: 'sun', kind: 'directional', direction: [1, -1, 0] } }),
  'crossings in one spot': recordOf([side(0.49999, 1), side(0.50001, -1), side(0.50002, 1),
                                     side(0.50003, -1)]),
  'depths of every size': recordOf([side(1e-3, 1), side(1e-2, -1), side(0.6, 1), side(9e5, -1)],
                                   { near: 1e-4, far: 1e7, seen: surfaceAt(1e6) }),
  'eye inside': recordOf([side(3, -1)], { inside: { eye: 2, near: 2, surface: 1, far: 1, infinity: 1 } },
                         { predicted: -1, stored: 255, read_back: 255, claim: 'shadowed' }),
  'no finite far plane': recordOf(pair, { far: null }),
  'far plane in front of crossings': recordOf([side(12, 1), side(50, -1)], {},
    { test: 'depth_fail', statuses: ['counted', 'lost_far'], dark_cap: 'lost_far', predicted: -1,
      stored: 255, read_back: 255 }),
  'dark caps': recordOf([side(12, 1)], {}, { test: 'depth_fail', statuses: ['counted'],
                                            dark_cap: 'counted' }),
  'dark caps that are missing': recordOf([side(12, 1)], {}, { test: 'depth_fail',
    statuses: ['counted'], dark_cap: 'lost_cap', predicted: -1, stored: 255, read_back: 255 }),
  'every fate at once': recordOf([side(0.2, 1), side(0.3, -1), side(2, 1), side(11, -1), side(12, 1)],
    {}, { statuses: ['lost_near', 'lost_cap', 'counted', 'beyond', 'lost_far'] }),
  'a crossing lost by rounding': recordOf(pair, { adds_up: false }, { predicted: 1, stored: 1 }),
  'another counter read back': recordOf(pair, {}, { read_back: 3, claim: 'shadowed',
                                                    cause: 'unexplained' }),
  'a sum of many signs': recordOf([side(2, 1), side(11, 1), side(12, -1), side(13, -1), side(14, 1), side(15, -1)],
    {}, { test: 'depth_fail', statuses: ['beyond', 'counted', 'counted', 'counted', 'counted', 'counted'],
          predicted: 1, stored: 1, read_back: 1, claim: 'shadowed' }),
  'fifteen crossings': recordOf(manyCrossings(15)),
  'eighty crossings': recordOf(manyCrossings(80)),
  'four hundred crossings': recordOf(manyCrossings(400)),
  'a map': recordOf(pair, {}, asksMap()),
  'a map that is not asked': recordOf(pair, {}, { ...asksMap(), map: null }),
  'a map that shows nothing': recordOf([], {}, asksMap({ stored: 20, own: 19.99, shows: null })),
  'a map whose texel is the point': recordOf([], {}, asksMap({ stored: 10.283, bias: 0 })),
  'a map of a surface seen edge-on': recordOf([], {}, asksMap({ footprint: [null, 0.01] })),
  'a map of huge lengths': recordOf([], {}, asksMap({ stored: 1.23456e20, own: 1.23457e20 })),
  'a map that holds no number': recordOf([], {}, asksMap({ stored: null })),
  'a ramp': recordOf([], {}, asksMap({ format: 'ramp8' })),
  'an averaged map': recordOf([], {}, asksMap({ filter: 4, average: 'comparisons', lit: 11, of: 16,
                                                edges: 'seamless' })),
  'a float ray': recordOf(pair, {}, shoots()),
  'a float ray to a sun, in nothing’s way': recordOf([], {}, shoots({
    far: null, near: 0, leaves_plane_at: null, stopped_by: null, hits: [] })),
  'a float ray that passes over an edge': recordOf([], {}, shoots({
    passed_over: { triangle: 123456789, mesh: 'caster', t: 5.123456e-7 } })),
  'light cap and surface at one depth': recordOf([{ ...side(10, 1), kind: 'light cap',
                                                    from: surfaceAt(10).corners }, side(12, -1)]),
};

/** Texts of a drawing that overlap or leave it, and whether it is a picture at all. */
function flaws(svg) {
  return page.evaluate((source) => {
    const parsed = new DOMParser().parseFromString(source, 'image/svg+xml');
    if (parsed.querySelector('parsererror')) return ['no XML'];
    if (/NaN|undefined|Infinity[^<]*"/.test(source.replace(/<(title|desc|text)[^]*?<\/\1>/g, '')))
      return ['numbers that are none'];
    document.body.innerHTML = source;
    const drawing = document.querySelector('svg');
    const box = drawing.getBoundingClientRect();
    const texts = [...drawing.querySelectorAll('text')].map((node) =>
      ({ words: node.textContent, box: node.getBoundingClientRect() }));
    const said = [];
    texts.forEach(({ words, box: own }, i) => {
      if (own.left < box.left - 1 || own.right > box.right + 1 || own.bottom > box.bottom + 1)
        said.push(`"${words}" leaves the drawing`);
      for (const other of texts.slice(i + 1)) {
        const across = Math.min(own.right, other.box.right) - Math.max(own.left, other.box.left);
        const down = Math.min(own.bottom, other.box.bottom) - Math.max(own.top, other.box.top);
        // Boxes of text hold room above and below the letters.
        if (across > 1 && down > 4) said.push(`"${words}" lies on "${other.words}"`);
      }
    });
    return said;
  }, svg);
}

for (const [name, record] of Object.entries(cases))
  test(`words stay apart and inside at every width: ${name}`, async () => {
    for (const width of [340, 520, 534, 760, 1100])
      assert.deepEqual(await flaws(cutaway(record, 0, width)), [], `width ${width}`);
    await keepScreenshot(page, `cutaway-${name.replaceAll(' ', '-')}`);
  });

test('what is not counted is struck through with its reason, and the sum is a sentence', () => {
  const svg = cutaway(cases['every fate at once'], 0);
  for (const words of ['lost: in front of the near plane', 'lost: the cap is missing', 'counted',
                       'behind the surface: not asked for', 'lost: clipped at the far plane',
                       'Counted +1; the exact count is 0'])
    assert.ok(svg.includes(words), words);
});

test('no dashed line begins far outside, wherever the light is: dashes without end take seconds', () => {
  const high = [0, 4e6, -8e5];
  const all = { ...cases, 'light without end': recordOf(
    [side(2, 1, { light: high, along: 1 - 1e-7 }), side(4, -1, { light: high, along: 1 - 1e-7 })],
    { light: { name: 'sun', kind: 'directional', direction: [0, -4, 0.8] } }) };
  let dashed = 0;
  for (const [name, record] of Object.entries(all))
    for (const [line] of cutaway(record, 0, 760).matchAll(/<line [^>]*stroke-dasharray[^>]*>/g))
      for (const [, number] of line.matchAll(/ [xy][12]="([^"]+)"/g)) {
        assert.ok(Math.abs(Number(number)) < 2000, `${name}: ${number}`);
        ++dashed;
      }
  assert.ok(dashed > 100);
});

test('the drawing says whether it is to scale', () => {
  assert.match(cutaway(cases.plain, 0), />to scale</);
  assert.match(cutaway(cases['depths of every size'], 0), />not to scale: depths in their order only</);
  assert.match(cutaway(cases['light next to the ray'], 0), />not to scale: heights × [\d.e+]+</);
});

test('names from a scene cannot become markup', () => {
  const svg = cutaway(recordOf([side(2, 1, { mesh: '<script>"&' })]), 0);
  assert.ok(!svg.includes('<script>'));
  assert.ok(svg.includes('&lt;script&gt;&quot;&amp;'));
});

test(`the command, which runs the script by another engine, draws the same (seed ${seed})`, () => {
  for (const [scene, pixel] of [['near_plane', '66,33'], ['far_plane', '106,31'], ['eye_inside', '100,60'],
                                ['ordinary', '5,5']]) {
    const run = shadowproof(['explain', scene, '--technique', 'zfail,zpass', '--size', '160x160',
                             '--pixel', pixel, '--json', 'pixel.json', '--svg', 'pixel.svg']);
    assert.equal(run.code, 0, run.err);
    const record = JSON.parse(readFileSync(join(scratch, 'pixel.json'), 'utf8'));
    const svg = readFileSync(join(scratch, 'pixel.svg'), 'utf8');
    assert.ok([0, 1].some((k) => cutaway(record, k) === svg), scene);
  }
});

after(() => page?.context().close());
