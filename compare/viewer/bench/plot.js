// The plot of a benchmark as SVG. All colours are attributes, so that the picture stands by itself
// where it is exported.

const lightInk = { paper: '#ffffff', ink: '#1b1b1f', quiet: '#55555e', line: '#d5d5dc',
                   panel: '#f3f5f3', loss: '#a33c00', gain: '#00614a', dark: false };
const darkInk = { paper: '#16161a', ink: '#ececf1', quiet: '#a9a9b5', line: '#3a3a43',
                  panel: '#1d221f', loss: '#ff9a5c', gain: '#4fd1ae', dark: true };

const inkOf = (group, ink) => (ink.dark ? group.dark : group.color);

const sans = 'system-ui, "DejaVu Sans", sans-serif';
const mono = 'ui-monospace, "DejaVu Sans Mono", monospace';

const words = (x, y, text, attributes = {}) => svgElement('text', {
  x, y, 'font-family': sans, 'font-size': plotFont, ...attributes }, text);

const line = (points, attributes) => svgElement('path', {
  d: points.map(([x, y], i) => `${i ? 'L' : 'M'}${x.toFixed(1)} ${y.toFixed(1)}`).join(''),
  fill: 'none', ...attributes });

const mark = (group, x, y, ink, attributes = {}) => svgElement('path', {
  d: markShapes[group.shape], transform: `translate(${x.toFixed(1)} ${y.toFixed(1)})`,
  fill: inkOf(group, ink), stroke: ink.paper, 'stroke-width': 1, ...attributes });

/** The groups that the points have, in a row that breaks where it is full. */
function legendOf(points, width, ink) {
  const groups = markGroups.filter((group) => points.some((point) => groupOf(point) === group));
  let x = 16;
  let y = 44;
  return groups.flatMap((group) => {
    const size = 0.56 * plotFont * group.words.length + 34;
    if (x + size > width) [x, y] = [16, y + 17];
    const parts = [mark(group, x + 6, y - 4, ink),
                   words(x + 17, y, group.words, { fill: ink.ink })];
    x += size;
    return parts;
  });
}

const tickWords = (value) => (value >= 1000 ? grouped(value) : shortNumber(value));

function axesOf({ box, band, xTicks, yTicks }, kind, ink) {
  const bottom = Math.max(box.bottom, band.bottom);
  const quiet = { fill: ink.quiet };
  const grid = { stroke: ink.line, 'stroke-width': 1 };
  const parts = [];
  if (band.bottom > band.top)
    parts.push(svgElement('rect', { x: box.left, y: band.top, width: box.right - box.left,
                                    height: band.bottom - band.top, fill: ink.panel,
                                    stroke: ink.line }),
               words(box.left - 8, (band.top + band.bottom) / 2 + 4, 'exactly 0',
                     { ...quiet, 'text-anchor': 'end' }));
  for (const { value, at } of xTicks)
    parts.push(line([[at, box.top], [at, bottom]], grid),
               words(at, bottom + 17, tickWords(value), { ...quiet, 'text-anchor': 'middle' }));
  for (const { value, at } of yTicks)
    parts.push(line([[box.left, at], [box.right, at]], grid),
               words(box.left - 8, at + 4, shortNumber(value), { ...quiet, 'text-anchor': 'end' }));
  parts.push(words((box.left + box.right) / 2, bottom + 36, 'milliseconds, median of the samples',
                   { fill: ink.ink, 'text-anchor': 'middle' }));
  if (yTicks.length > 0)
    parts.push(words(0, 0, kind.words, { fill: ink.ink, 'text-anchor': 'middle',
      transform: `translate(16 ${(box.top + box.bottom) / 2}) rotate(-90)` }));
  return parts;
}

/** Steps: at each time, the least error that can be had by then. */
function frontLine({ front, box }, ink) {
  if (front.length === 0) return [];
  const steps = [];
  front.forEach(({ x, y }, i) => {
    if (i > 0) steps.push([x, front[i - 1].y]);
    steps.push([x, y]);
  });
  const [last] = front.slice(-1);
  if (!last.right) steps.push([box.right, last.y]);
  return [line(steps, { stroke: ink.ink, 'stroke-width': 1.6, 'stroke-dasharray': '6 3',
                        opacity: 0.75, class: 'front' })];
}

function arrowOf({ from, to, change }, ink) {
  const [dx, dy] = [to[0] - from[0], to[1] - from[1]];
  const length = Math.hypot(dx, dy);
  const color = change === 'same' ? ink.quiet : ink[change];
  const start = svgElement('circle', { cx: from[0], cy: from[1], r: 2.5, fill: color });
  if (length < 10) return [start];
  const [ux, uy] = [dx / length, dy / length];
  const tip = [to[0] - 7 * ux, to[1] - 7 * uy];
  const wing = (side) => [tip[0] - 6 * ux + side * 3.2 * uy, tip[1] - 6 * uy - side * 3.2 * ux];
  const style = { stroke: color, 'stroke-width': change === 'same' ? 1 : 2, class: `arrow ${change}`,
                  ...(change === 'gain' ? { 'stroke-dasharray': '4 2' } : {}) };
  return [start, line([from, tip], style),
          line([wing(1), tip, wing(-1)], { stroke: color, 'stroke-width': style['stroke-width'] })];
}

/** The interval of the median; without one, dots from the least sample to the greatest. */
function barOf({ point, y, low, high }, ink) {
  const style = { stroke: inkOf(groupOf(point), ink), opacity: 0.55 };
  if (!hasInterval(point.ms))
    return [line([[low, y], [high, y]], { ...style, 'stroke-width': 1.3, 'stroke-dasharray': '1 3' })];
  return [line([[low, y], [high, y]], { ...style, 'stroke-width': 1.3 }),
          line([[low, y - 3], [low, y + 3]], style), line([[high, y - 3], [high, y + 3]], style)];
}

function markOf({ point, x, y, label }, ink, isFront) {
  const parts = [
    svgElement('title', {}, `${pointName(point)}: ${timeWords(point.ms)}; ${errorWords(point)}`),
    svgElement('rect', { x: x - 11, y: y - 8, width: 22, height: 16, fill: 'transparent' })];
  if (label?.leader) {
    const [fromX, fromY, toX, toY] = label.leader;
    parts.push(line([[fromX, fromY], [toX, toY]], { stroke: ink.quiet, 'stroke-width': 0.7 }));
  }
  parts.push(mark(groupOf(point), x, y, ink,
                  isFront ? { stroke: ink.ink, 'stroke-width': 1.6 } : {}));
  if (label)
    parts.push(words(label.x, label.y, pointName(point), {
      'font-family': mono, fill: ink.ink, 'paint-order': 'stroke', stroke: ink.paper,
      'stroke-width': 3, ...(isFront ? { 'font-weight': 700 } : {}) }));
  return svgElement('g', { class: 'point', role: 'button', tabindex: -1,
                           'aria-label': `${pointName(point)}: ${timeWords(point.ms)}; ` +
                                         errorWords(point) }, ...parts);
}

/** The whole picture; the n-th element of class `point` is that of layout.marks[n]. */
function benchPicture(layout, kind, title, ink) {
  const { width, height, marks, arrows, front } = layout;
  return svgElement('svg', { xmlns: 'http://www.w3.org/2000/svg', viewBox: `0 0 ${width} ${height}`,
                             width, height, role: 'group', 'aria-label': title },
    svgElement('rect', { width, height, fill: ink.paper }),
    words(16, 22, title, { fill: ink.ink, 'font-size': 13, 'font-weight': 700 }),
    ...legendOf(marks.map(({ point }) => point), width, ink),
    ...axesOf(layout, kind, ink),
    ...marks.flatMap((each) => barOf(each, ink)),
    ...frontLine(layout, ink),
    ...arrows.flatMap((arrow) => arrowOf(arrow, ink)),
    ...marks.map((each) => markOf(each, ink, front.includes(each))));
}
