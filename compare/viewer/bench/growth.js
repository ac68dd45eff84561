// How time grows with the size of a problem: a line for each technique, both axes logarithmic.

const exponentWords = ({ value, low, high }) =>
  `${value.toFixed(2)} [${low.toFixed(2)}, ${high.toFixed(2)}]`;

/** "zfail ~ n^0.93 [0.88, 0.99]" */
const growthName = ({ technique, exponent }) =>
  (exponent ? `${technique} n^${exponentWords(exponent)}` : technique);

function growthPicture(growths, axis, ink, width) {
  const box = { left: 74, right: width - 270, top: 62, bottom: 62 + Math.max(260, 15 * growths.length) };
  const height = box.bottom + 46;
  const all = growths.flatMap(({ points }) => points).filter(({ ms }) => ms.median > 0);
  const sizes = all.map(({ size }) => size);
  const times = all.map(({ ms }) => ms.median);
  const [low, high] = [Math.min(...times) / 1.3, Math.max(...times) * 1.3];
  const x = logScale(Math.min(...sizes) / 1.1, Math.max(...sizes) * 1.1, box.left, box.right);
  const y = logScale(low, high, box.bottom, box.top);
  const quiet = { fill: ink.quiet };
  const grid = { stroke: ink.line };
  const parts = [];
  for (const size of [...new Set(sizes)])
    parts.push(line([[x(size), box.top], [x(size), box.bottom]], grid),
               words(x(size), box.bottom + 17, grouped(size), { ...quiet, 'text-anchor': 'middle' }));
  for (const ms of roundValues(low, high))
    parts.push(line([[box.left, y(ms)], [box.right, y(ms)]], grid),
               words(box.left - 8, y(ms) + 4, tickWords(ms), { ...quiet, 'text-anchor': 'end' }));
  parts.push(words((box.left + box.right) / 2, box.bottom + 36, axis,
                   { fill: ink.ink, 'text-anchor': 'middle' }),
             words(0, 0, 'milliseconds', { fill: ink.ink, 'text-anchor': 'middle',
               transform: `translate(16 ${(box.top + box.bottom) / 2}) rotate(-90)` }));
  const drawn = growths.map((growth) => ({ growth, group: groupOf(growth),
    places: growth.points.filter(({ ms }) => ms.median > 0)
      .map(({ size, ms }) => [x(size), y(ms.median)]) })).filter(({ places }) => places.length > 0);
  const heights = spreadOut(drawn.map(({ places }) => places.at(-1)[1]), 14, box.top, box.bottom);
  const dashes = ['none', '7 3', '2 3', '9 3 2 3', '5 2', '12 4']; // of the lines of a group
  const earlier = new Map();
  drawn.forEach(({ growth, group, places }, i) => {
    const color = inkOf(group, ink);
    const before = earlier.get(group) ?? 0;
    earlier.set(group, before + 1);
    const end = places.at(-1);
    parts.push(line(places, { stroke: color, 'stroke-width': 1.5, opacity: 0.85,
                              'stroke-dasharray': dashes[before % dashes.length] }),
               ...places.map(([a, b]) => mark(group, a, b, ink)),
               line([end, [box.right + 14, heights[i]]], { stroke: ink.quiet, 'stroke-width': 0.7, 'stroke-dasharray': '1 2' }),
               words(box.right + 18, heights[i] + 4, growthName(growth),
                     { 'font-family': mono, fill: ink.ink, 'font-size': 10.5 }));
    if (growth.break) {
      const at = growth.points.find(({ size }) => size === growth.break.size);
      if (at) parts.push(svgElement('circle', { cx: x(at.size), cy: y(at.ms.median), r: 9,
                                                fill: 'none', stroke: ink.loss, 'stroke-width': 1.6 },
        svgElement('title', {}, `${growth.technique} breaks at ${grouped(at.size)}`)));
    }
  });
  const title = `Time against ${axis}, with fitted exponents and their 95 % intervals`;
  return svgElement('svg', { xmlns: 'http://www.w3.org/2000/svg', viewBox: `0 0 ${width} ${height}`,
                             width, height, role: 'img', 'aria-label': title },
    svgElement('rect', { width, height, fill: ink.paper }),
    words(16, 22, title, { fill: ink.ink, 'font-size': 13, 'font-weight': 700 }),
    ...legendOf(growths, width, ink), ...parts);
}

function growthTable(growths) {
  return element('details', {}, element('summary', {}, 'As a table'),
    element('table', { class: 'numbers' },
      element('thead', {}, element('tr', {}, ['Technique', 'Exponent', 'Breaks', 'Median by size']
        .map((head) => element('th', { scope: 'col' }, head)))),
      element('tbody', {}, growths.map((growth) => element('tr', {},
        element('th', { scope: 'row' }, growth.technique),
        element('td', {}, growth.exponent ? exponentWords(growth.exponent) : '–'),
        element('td', {}, growth.break
          ? `at ${grouped(growth.break.size)}: ${exponentWords(growth.break.below)}, then ` +
            exponentWords(growth.break.above) : '–'),
        element('td', {}, growth.points.map(({ size, ms }) =>
          `${grouped(size)}: ${ms.median.toPrecision(3)} ms`).join(', ')))))));
}
