// The colours of cells whose technique lights bump maps: how far off they are, and those of one
// pixel. The bytes are those of the pictures; the figures are of linear light, in steps of 1/255.

/** By the values of the block color_verdict. */
const colorVerdictWords = [
  'that of what the technique shows, which is background or not the truth’s',
  'within the bound of what the error budget explains',
  'beyond the bound of what the error budget explains, as the technique’s arithmetic predicts',
  'not what the technique’s arithmetic predicts',
  'beyond the bound of what the error budget explains, and not what the technique’s arithmetic predicts',
  'more than 1/255 off, and right where the rasterizer may have drawn instead',
];
const colorNotJudged = 0;
const colorBeyond = 2;
const isUnpredicted = (verdict) => verdict === 3 || verdict === 4;

/** Linear light of the bytes of sRGB (IEC 61966-2-1), in steps of 1/255. */
const linearLight = Float64Array.from({ length: 256 }, (_, byte) => {
  const value = byte / 255;
  return 255 * (value <= 0.04045 ? value / 12.92 : ((value + 0.055) / 1.055) ** 2.4);
});

/** How far the bytes of a pixel's colour are off in linear light, in steps of 1/255: of the channel furthest off. */
function errorAt({ trueColor, claimedColor }, pixel) {
  let most = 0;
  for (let i = 3 * pixel; i < 3 * pixel + 3; ++i)
    most = Math.max(most, Math.abs(linearLight[claimedColor[i]] - linearLight[trueColor[i]]));
  return most;
}

/** "0.03", "24": steps of 1/255 in few digits. */
const fewSteps = (value) => value.toFixed(value < 9.995 ? 2 : 0);

const bytesAt = (colors, pixel) => Array.from(colors.subarray(3 * pixel, 3 * pixel + 3));

function modelWords({ normalise, cube_size: texels, newton_steps: steps, bumps, vectors, tangents,
                      filter, anisotropy }) {
  const how = texels ? ` of ${texels} texels a side`
    : steps !== undefined ? `, ${counted(steps, 'step')}` : '';
  return `normalised ${normalise === 'exact' ? 'exactly' : `by ${normalise}${how}`}, ` +
    (filter ? `bumps filtered (${filter}) by ${counted(anisotropy, 'lookup')}` +
              (anisotropy > 1 ? ' along a pixel at most' : '')
            : `bumps as ${bumps === 'as-given' ? 'given' : bumps}`) +
    (vectors?.includes('vertices') ? `, vectors made ${vectors.replaceAll('-', ' ')}` : '') +
    (tangents === 'polygons' ? ', tangents of polygons' : '');
}

/** How wide the intervals of right colours are; missing in results of older versions. */
function boundWords({ bound_width: width, interpolated, beyond_by: by }) {
  if (!width) return '';
  const ways = Object.entries(by ?? {}).sort((a, b) => b[1] - a[1])
    .map(([way, pixels]) => `${way} ${grouped(pixels)}`);
  return `right within ${fewSteps(width.median)}/255 from end to end at the median, ` +
    `${fewSteps(width.p999)} of 99.9 %, ${fewSteps(width.widest)} at most, at ` +
    `${counted(interpolated, 'pixel')} only with what the rasterizer may draw aside or round; ` +
    (ways.length > 0 ? `beyond that by ${ways.join(', ')}; ` : '');
}

/** How far the colours of a cell are off; null where it has none. */
function colorLine(scene, cell) {
  const { color } = cell;
  if (!color) return null;
  const { largest, largest_at: at, rmse, p999, picture_rmse: whole } = color;
  return element('p', { class: 'colors' }, element('b', {}, 'Colours: '),
    !at ? 'none is held against the truth, as surface or visibility are nowhere that; '
        : [`off by at most ${largest.toFixed(2)}/255 at `,
           element('a', { href: cellLink(scene, cell, { pixel: `${at.x},${at.y}`, zoom: 16 }) },
                   `(${at.x}, ${at.y})`),
           `${color.filter ? ' from the mean over the pixel' : ''}, rmse ${rmse.toFixed(2)}, ` +
           `99.9 % within ${p999.toFixed(2)}; `],
    whole === undefined ? ''
      : `of the whole picture, wrong shadows included, rmse ${whole.toFixed(2)}; `,
    ...(color.lights_before ?? []).map(({ name, differing }) =>
      `with the light of ${name}, whose shadows differ from the truth at ` +
      `${counted(differing, 'pixel')}; `),
    at ? boundWords(color) : '', `${modelWords(color)}.`);
}

/** The alarm where colours are not as predicted; null where they are. */
function unpredictedWords({ cell, colorVerdict, width }) {
  const count = cell.color?.unpredicted ?? 0;
  if (count === 0) return null;
  const first = colorVerdict ? colorVerdict.findIndex(isUnpredicted) : -1;
  const place = `(${first % width}, ${Math.floor(first / width)})`;
  return 'The colour is not what the technique’s arithmetic predicts at ' +
    `${counted(count, 'pixel')}${first < 0 ? '' : `; the first is ${place}`}.`;
}

/** Checks that the files are of one run. */
function checkColors({ cell, id, colorVerdict, problems }) {
  const counts = tallied(colorVerdict);
  const { judged, beyond, unpredicted, moved = 0 } = cell.color;
  if (colorVerdict.length - counts[0] !== judged || counts[colorBeyond] !== beyond ||
      counts[3] + counts[4] !== unpredicted || counts[5] !== moved)
    problems.push(`${id}.cell.js does not belong to results.js: ` +
                  'its colours were judged otherwise there');
}

/** The colours of a pixel in a few words: "true colour 12 34 56, claimed 12 34 57". */
function colorWords({ trueColor, claimedColor }, pixel) {
  const words = (colors) => (colors ? bytesAt(colors, pixel).join(' ') : 'unknown');
  return `true colour ${words(trueColor)}, claimed ${words(claimedColor)}`;
}

/** True and claimed colour of a pixel, their difference, and how it is judged. */
function pixelColors({ cell, trueColor, claimedColor, colorVerdict }, pixel) {
  if (!cell.color) return [];
  if (!trueColor || !claimedColor) return [alertLine('The colours cannot be shown.')];
  const right = bytesAt(trueColor, pixel);
  const claimed = bytesAt(claimedColor, pixel);
  const verdict = colorVerdict?.[pixel];
  const judged = colorVerdictWords[verdict];
  return [
    element('p', { class: 'values colors' },
      valueChip(cell.color.filter ? 'true mean' : 'true colour', right.join(' '), `rgb(${right})`),
      valueChip('claimed', claimed.join(' '), `rgb(${claimed})`),
      element('span', { class: 'value' }, 'off by ',
              element('b', {}, claimed.map((byte, i) => signed(byte - right[i])).join(' ')))),
    element('p', { class: isUnpredicted(verdict) ? 'counter unequal' : 'quiet' },
      `8-bit sRGB, as the pictures have them${judged ? `. In linear light: ${judged}` : ''}.`)];
}

/** What the shades of the colour error mean, with the pixels of each kind. */
function colorErrorRows({ color }) {
  if (!color) return [];
  const row = (name, mark, pixels, meaning) => (pixels === 0 ? null : element('tr', {},
    element('th', { scope: 'row' }, swatch(mark), name),
    element('td', { class: 'number' }, grouped(pixels)), element('td', {}, meaning)));
  return [
    row('within', 'linear-gradient(90deg, #000000, #fff4c8)',
        color.judged - color.beyond - color.unpredicted - (color.moved ?? 0),
        'what the error budget explains; the lighter, the further off the bytes are that are shown'),
    row('beyond', causeLegend('shading').color, color.beyond,
        'what the error budget explains, as the technique’s arithmetic predicts'),
    row('moved', causeLegend('edge').color, color.moved ?? 0,
        'more than 1/255 off, and right where the rasterizer may have drawn instead'),
    row('unpredicted', causeLegend('unexplained').color, color.unpredicted,
        'by the technique’s arithmetic')];
}
