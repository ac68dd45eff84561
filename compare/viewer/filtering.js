// Error of colours against how many texels a pixel covers, and against how slanted it sees the
// surface: what stands for the bumps below a pixel, held against the mean of what they show.

const filterDashes = ['none', '7 3', '2 3', '9 3 2 3', '5 2', '12 4'];

/** The scene's cells that filter, the cell itself, and the first that does not filter. */
function comparedFilters(scene, cell) {
  const cells = (scene.techniques ?? []).filter(({ color }) => color?.pixel_means);
  const unfiltered = cells.find(({ color }) => !color.filter);
  return cells.filter((each) => each.color.filter || each === cell || each === unfiltered);
}

const binMiddle = { texels: ({ from, to }) => Math.sqrt(from * to),
                    angle: ({ from, to }) => (from + to) / 2 };

/** Heights in their order, at least `room` apart, as near as can be to where they were. */
function spreadHeights(heights, room, bottom) {
  const order = heights.map((_, i) => i).sort((a, b) => heights[a] - heights[b]);
  const placed = [...heights];
  order.forEach((i, k) => {
    if (k > 0) placed[i] = Math.max(placed[i], placed[order[k - 1]] + room);
  });
  const over = Math.max(0, Math.max(...placed) - bottom);
  return placed.map((height) => height - over);
}

/** `axis`: { bins: name in pixel_means, middle, ticks, x: from a value and the box, label, words }. */
function filterChart(cells, cell, axis, width) {
  const box = { left: 62, right: width - 176, top: 14, bottom: 232 };
  const lines = cells.map((each) => each.color.pixel_means[axis.bins].filter(({ rmse }) => rmse > 0));
  const errors = lines.flat().map(({ rmse }) => rmse);
  if (errors.length === 0) return null;
  const low = Math.min(...errors) / 1.3;
  const high = Math.max(...errors) * 1.3;
  const y = (rmse) => box.bottom -
    Math.log(rmse / low) / Math.log(high / low) * (box.bottom - box.top);
  const values = lines.flat().map(axis.middle);
  const x = axis.scale(Math.min(...values), Math.max(...values), box);
  const rule = (d) => svgElement('path', { d });
  const text = (left, row, words, anchor = 'middle') =>
    svgElement('text', { x: left, y: row, 'text-anchor': anchor }, words);
  const axes = [
    ...axis.ticks(Math.min(...values), Math.max(...values)).flatMap((value) =>
      [rule(`M${x(value)} ${box.top}V${box.bottom}`),
       text(x(value), box.bottom + 18, value < 1000 ? printed(value, 3) : grouped(value))]),
    ...roundValues(low, high).flatMap((rmse) =>
      [rule(`M${box.left} ${y(rmse)}H${box.right}`),
       text(box.left - 6, y(rmse) + 4, printed(rmse, 2), 'end')]),
    text((box.left + box.right) / 2, box.bottom + 38, axis.label)];
  const title = text(0, 0, 'error, steps of 1/255');
  title.setAttribute('transform', `translate(13 ${(box.top + box.bottom) / 2}) rotate(-90)`);
  const ends = lines.map((bins) => (bins.length > 0 ? y(bins.at(-1).rmse) : box.bottom));
  const rows = spreadHeights(ends, 14, box.bottom);
  const series = cells.map((each, i) => svgElement('g',
    { class: each === cell ? 'filter own' : 'filter' },
    svgElement('path', { 'stroke-dasharray': filterDashes[i % filterDashes.length],
      d: lines[i].map((bin, k) =>
        `${k === 0 ? 'M' : 'L'}${x(axis.middle(bin)).toFixed(1)} ${y(bin.rmse).toFixed(1)}`)
        .join('') }),
    ...lines[i].map((bin) => {
      const dot = svgElement('circle', { cx: x(axis.middle(bin)), cy: y(bin.rmse), r: 3 });
      dot.append(svgElement('title', {}, `${each.name}, ${axis.words(bin)}: ` +
        `${printed(bin.rmse, 3)}/255 over ${counted(bin.pixels, 'pixel')}`));
      return dot;
    }),
    text(box.right + 10, rows[i] + 4, each.name, 'start')));
  return svgElement('svg', { class: 'plot', role: 'img', width, height: box.bottom + 46,
                             viewBox: `0 0 ${width} ${box.bottom + 46}`,
                             'aria-label': `Error of colours against ${axis.label}` },
    svgElement('g', { class: 'axes' }, ...axes, title), ...series);
}

const logAxis = (low, high, { left, right }) => (value) =>
  left + 8 + (low === high ? 0.5 : Math.log(value / low) / Math.log(high / low)) *
             (right - left - 16);
const straightAxis = (low, high, { left, right }) => (value) =>
  left + 8 + (low === high ? 0.5 : (value - low) / (high - low)) * (right - left - 16);

const texelAxis = {
  bins: 'by_texels', middle: binMiddle.texels, scale: logAxis, ticks: roundValues,
  label: 'texels along the pixel’s longer side',
  words: ({ from, to }) => `${printed(from, 3)} to ${printed(to, 3)} texels in a pixel` };
const angleAxis = {
  bins: 'by_angle', middle: binMiddle.angle, scale: straightAxis,
  ticks: (low, high) => [0, 15, 30, 45, 60, 75, 90].filter((at) => at >= low && at <= high),
  label: 'degrees between ray and surface normal',
  words: ({ from, to }) => `seen at ${from} to ${to} degrees` };

/** Null where the colours are not held against means over the pixels. */
function filteringSection(scene, cell) {
  const means = cell.color?.pixel_means;
  if (!means) return null;
  const cells = comparedFilters(scene, cell);
  const width = Math.max(340, Math.min(640, document.documentElement.clientWidth - 56));
  const charts = [texelAxis, angleAxis].map((axis) => filterChart(cells, cell, axis, width))
    .filter(Boolean);
  return element('section', { class: 'filtering', 'aria-labelledby': 'filtering-title' },
    element('h2', { id: 'filtering-title' }, 'Bumps smaller than pixels'),
    element('p', { class: 'quiet' },
      'How far colours are from the mean of up to ' +
      `${counted(means.most_rays, 'ray')} over each pixel, each with its own exact visibility: root mean ` +
      `square ${fewSteps(means.rmse)}/255, and ${fewSteps(means.alike_rmse)}/255 over the ` +
      `${counted(means.alike, 'pixel')} whose rays all meet one mesh, all lit or all in shadow. The ` +
      'lines are of these, where they see a bump map.'),
    ...charts.map((chart) => element('div', { class: 'scroll', role: 'region', tabindex: '0',
                                              'aria-label': 'Chart' }, chart)));
}
