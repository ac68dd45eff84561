// What a point of a benchmark is called, how wrong it is, and to which group it belongs.

const settingsWords = (settings) =>
  Object.entries(settings ?? {}).map(([name, value]) => `${name}=${value}`).join(' ');

/** "bump_one_pass bumps=indexed" */
const pointName = (point) => [point.technique, settingsWords(point.settings)].filter(Boolean)
  .join(' ');

const samePoint = (a, b) => a.scene === b.scene && pointName(a) === pointName(b);

const wrongPixels = (point) => point.differing - (point.causes.edge ?? 0);

const percent = (count, point) => 100 * count / point.pixels;

/** The truth's means over the pixel have colours alone, held against the mean of most rays. */
const isMean = ({ technique, settings }) => technique === 'truth' && settings?.samples !== undefined;

const unlessMean = (of) => (point) => (isMean(point) ? null : of(point));

/** Ways to say how wrong a point is; null where it does not apply. Shares in percent. */
const errorKinds = [
  { id: 'wrong', words: 'wrong pixels, %', of: unlessMean((point) => percent(wrongPixels(point), point)) },
  { id: 'lit', words: 'falsely lit, %', of: unlessMean((point) => percent(point.falsely_lit, point)) },
  { id: 'shadowed', words: 'falsely shadowed, %',
    of: unlessMean((point) => percent(point.falsely_shadowed, point)) },
  { id: 'rmse', words: 'colour rmse, 1/255', of: (point) => point.color?.rmse ?? null },
  { id: 'p999', words: 'colour, 99.9 % within, 1/255', of: (point) => point.color?.p999 ?? null },
  { id: 'largest', words: 'colour at worst, 1/255', of: (point) => point.color?.largest ?? null },
];

// Marks differ by shape first, so that they can be told in print; the colours are Okabe and Ito's,
// the yellow left out, which is too pale on paper.
const markShapes = {
  star: 'M0 -7L1.8 -2.3 6.7 -2.2 2.9 .9 4.1 5.7 0 2.9 -4.1 5.7 -2.9 .9 -6.7 -2.2 -1.8 -2.3z',
  circle: 'M-5 0a5 5 0 1 0 10 0a5 5 0 1 0 -10 0z',
  triangle: 'M0 -6L5.6 4.4H-5.6z',
  square: 'M-4.6 -4.6H4.6V4.6H-4.6z',
  diamond: 'M0 -6.4L6.4 0 0 6.4 -6.4 0z',
  plus: 'M-2 -6H2V-2H6V2H2V6H-2V2H-6V-2H-2z',
  flag: 'M0 6.2L-5.6 -4.2H5.6z',
  cross: 'M-4.9 -3L-3 -4.9 0 -1.9 3 -4.9 4.9 -3 1.9 0 4.9 3 3 4.9 0 1.9 -3 4.9 -4.9 3 -1.9 0z',
  bar: 'M-5.5 -2.6H5.5V2.6H-5.5z',
};

/** A point's family, or a line's; older files lack it where it can be told by the name. */
const familyOf = ({ family, technique }) => family ||
  (/^(cube_map|spot_map|sun_map)/.test(technique) ? 'map'
    : technique.startsWith('traced_') ? 'traced' : 'stencil');

/** Groups of points in the order of the legend; the first that has a point is its own. */
const markGroups = [
  { words: 'exact truth', shape: 'star', color: '#000000', dark: '#ffffff',
    has: ({ technique }) => technique === 'truth' },
  { words: 'auto', shape: 'diamond', color: '#d55e00', dark: '#ff9a5c',
    has: ({ technique }) => technique === 'auto' },
  { words: 'bump lighting', shape: 'square', color: '#a3477f', dark: '#e79ac6',
    has: ({ technique }) => technique.startsWith('bump_') },
  { words: 'volumes counted behind (z-fail)', shape: 'triangle', color: '#0072b2', dark: '#56b4e9',
    has: ({ technique }) => technique.startsWith('zfail') },
  { words: 'volumes counted in front (z-pass)', shape: 'circle', color: '#00785a', dark: '#2fc99b',
    has: ({ technique }) => technique.startsWith('zp') },
  { words: 'other volumes', shape: 'plus', color: '#8a5a00', dark: '#e69f00',
    has: (point) => familyOf(point) === 'stencil' },
  { words: 'shadow maps', shape: 'flag', color: '#5b5b66', dark: '#b9b9c6',
    has: (point) => familyOf(point) === 'map' },
  { words: 'rays in float', shape: 'cross', color: '#6a3d9a', dark: '#c4a3f0',
    has: (point) => familyOf(point) === 'traced' },
  { words: 'other families', shape: 'bar', color: '#3c3c44', dark: '#dcdce4', has: () => true },
];

const groupOf = (point) => markGroups.find((group) => group.has(point));

/** Whether there is a 95 % interval: of six samples or more. Older files do not say so. */
const hasInterval = ({ interval, samples }) => interval ?? samples.length >= 6;

/** Whether all of one time's interval lies above all of the other's. Never without both. */
const isSurelySlower = (slower, quicker) =>
  hasInterval(slower) && hasInterval(quicker) && slower.low > quicker.high;

/** "3.21 ms, 95 % within 3.10 and 3.40, 12 samples" */
function timeWords(ms) {
  const { median, low, high, samples, settled } = ms;
  const [words, from, to] = [median, low, high].map((value) => value.toPrecision(3));
  const many = counted(samples.length, 'sample');
  return hasInterval(ms) ? `${words} ms, 95 % within ${from} and ${to}, ${many}${settled ? '' : ', not settled'}`
    : `${words} ms, no interval (${many}, ${from} to ${to})`;
}

/** "volumes 0.45 ms, surface 1.87 ms"; the medians of a frame's stages. */
const stageWords = (point) => Object.entries(point.stages ?? {})
  .map(([name, { median }]) => `${name} ${median.toPrecision(3)} ms`).join(', ');

/** 0.0123 as "0.012"; zero as "0". */
const shortNumber = (value) => (value === 0 ? '0' : String(Number(value.toPrecision(3))));

/** "0.26 % wrong (near_plane 171), falsely lit 0 %, ..." */
function errorWords(point) {
  const causes = Object.entries(point.causes).filter(([name]) => name !== 'edge')
    .map(([name, count]) => `${name} ${grouped(count)}`).join(', ');
  const wrong = wrongPixels(point);
  const words = [isMean(point) ? 'against the mean of most samples' : wrong === 0 ? 'no pixel wrong'
    : `${shortNumber(percent(wrong, point))} % wrong (${causes})`];
  if (point.falsely_lit > 0)
    words.push(`${shortNumber(percent(point.falsely_lit, point))} % falsely lit`);
  if (point.falsely_shadowed > 0)
    words.push(`${shortNumber(percent(point.falsely_shadowed, point))} % falsely shadowed`);
  if (point.color)
    words.push(`colour rmse ${shortNumber(point.color.rmse)}/255, 99.9 % within ` +
               `${shortNumber(point.color.p999)}, ${shortNumber(point.color.largest)} at worst`);
  return words.join('; ');
}

/**
 * How a point fares against an older run's: 'loss', 'gain' or 'same'. A time changes where the
 * intervals lie apart, an error at once.
 */
function changeOf(older, newer) {
  const errors = [wrongPixels(newer) - wrongPixels(older),
                  (newer.color?.rmse ?? 0) - (older.color?.rmse ?? 0)];
  if (isSurelySlower(newer.ms, older.ms) || errors.some((more) => more > 0)) return 'loss';
  if (isSurelySlower(older.ms, newer.ms) || errors.some((more) => more < 0)) return 'gain';
  return 'same';
}

/** Of a scene's points, the quickest that is right by its median, the truth and `auto` apart. */
function quickestRight(points) {
  const right = points.filter((point) => !['truth', 'auto'].includes(point.technique) &&
                                         wrongPixels(point) === 0);
  return right.length === 0 ? null
    : right.reduce((best, each) => (each.ms.median < best.ms.median ? each : best));
}
