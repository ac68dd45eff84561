// How time grows with the size of a problem: a line for each technique, both axes logarithmic, and
// beside it the exponents of the laws that fit, with their 95 % intervals.

const growthDashes = ['none', '7 3', '2 3', '9 3 2 3', '5 2', '12 4']; // of the lines of a group

function growthAxes({ box, panel, x, y, p, sizes, times, exponents }, axis, ink) {
  const quiet = { fill: ink.quiet };
  const grid = { stroke: ink.line };
  const dark = { fill: ink.ink, 'text-anchor': 'middle' };
  const parts = sizes.flatMap(([size, hasWords]) => [
    line([[x(size), box.top], [x(size), box.bottom]], grid),
    ...(hasWords ? [words(x(size), box.bottom + 17, grouped(size), { ...quiet, 'text-anchor': 'middle' })]
      : [])]);
  for (const ms of times)
    parts.push(line([[box.left, y(ms)], [box.right, y(ms)]], grid),
               words(box.left - 8, y(ms) + 4, tickWords(ms), { ...quiet, 'text-anchor': 'end' }));
  for (const value of exponents)
    parts.push(line([[p(value), box.top], [p(value), box.bottom]],
                    { stroke: ink.line, 'stroke-width': value === 0 || value === 1 ? 1.6 : 0.8 }),
               words(p(value), box.bottom + 17, String(value), { ...quiet, 'text-anchor': 'middle' }));
  return [...parts,
    words((box.left + box.right) / 2, box.bottom + 38, axis, dark),
    words((panel.left + panel.right) / 2, box.bottom + 38, 'exponent, 95 % within', dark),
    words(0, 0, 'milliseconds', { ...dark,
      transform: `translate(16 ${(box.top + box.bottom) / 2}) rotate(-90)` })];
}

/** The fitted law, and the times that the ends of its exponent's interval give. */
function lawShapes({ from, middle, to, exponent, at }, { box, x, y }, style) {
  const inside = ([across, down]) => [across, Math.max(box.top, Math.min(box.bottom, down))];
  const place = (size, p) => inside([x(size), y(at(size, p))]);
  const fan = [exponent.low, exponent.high].flatMap((p, i) => {
    const edge = [from, middle, to].map((size) => place(size, p));
    return i === 0 ? edge : edge.reverse();
  });
  return [svgElement('path', { class: 'fan', fill: style.stroke, opacity: 0.07, stroke: 'none',
            d: `${fan.map(([a, b], i) => `${i ? 'L' : 'M'}${a.toFixed(1)} ${b.toFixed(1)}`).join('')}z` }),
          line([place(from), place(to)], { ...style, class: 'law', 'stroke-width': 1.2, opacity: 0.9 })];
}

/**
 * A law's exponent and interval in the panel, without a cap at an end that is cut off by the panel's;
 * the first of two is hollow.
 */
function exponentShapes({ exponent }, row, isFirstOfTwo, { p, isShown }, ink, color) {
  const style = { stroke: color, 'stroke-width': 1.3 };
  const [low, high] = [p(exponent.low), p(exponent.high)];
  const y = row.y + (row.laws.length > 1 ? (isFirstOfTwo ? -3 : 3) : 0);
  return [line([[low, y], [high, y]], { ...style, class: 'exponent' }),
          ...[exponent.low, exponent.high].filter(isShown)
            .map((end) => line([[p(end), y - 3], [p(end), y + 3]], style)),
          svgElement('circle', { cx: p(exponent.value), cy: y, r: 3, stroke: color, 'stroke-width': 1.3,
                                 fill: isFirstOfTwo ? ink.paper : color })];
}

function growthRow(row, layout, dash, ink) {
  const { growth, group, places, laws } = row;
  const { box, panel, names } = layout;
  const color = inkOf(group, ink);
  const text = { 'font-family': mono, fill: ink.ink, 'font-size': growthFont };
  const left = box.right + 36;
  return [
    ...laws.flatMap((law) => lawShapes(law, layout, { stroke: color, 'stroke-dasharray': dash })),
    ...(laws.length > 0 ? [] : [line(places, { stroke: color, 'stroke-width': 1, 'stroke-dasharray': dash })]),
    ...places.map(([a, b]) => mark(group, a, b, ink)),
    line([places.at(-1), [box.right + 8, row.y], [left - 12, row.y]],
         { stroke: ink.quiet, 'stroke-width': 0.7, 'stroke-dasharray': '1 2' }),
    mark(group, left - 6, row.y, ink),
    words(left + 4, row.y + 4, growth.technique, { ...text, class: 'name' }),
    line([[left + 8 + names, row.y], [panel.right + 6, row.y]],
         { stroke: ink.line, 'stroke-width': 0.7 }),
    ...laws.flatMap((law, i) =>
      exponentShapes(law, row, laws.length > 1 && i === 0, layout, ink, color)),
    words(panel.right + 12, row.y + 4, row.words, { ...text, class: 'fit' })];
}

/** A ring at the size where a line breaks, with the letter that its row has. */
function breakMark({ growth, letter }, { x, y }, ink) {
  const at = growth.break && growth.points.find(({ size }) => size === growth.break.size);
  if (!at) return [];
  const [across, down] = [x(at.size), y(at.ms.median)];
  return [svgElement('circle', { class: 'break', cx: across, cy: down, r: 8, fill: 'none',
                                 stroke: ink.loss, 'stroke-width': 1.6 },
            svgElement('title', {}, `${growth.technique} breaks at ${grouped(at.size)}`)),
          words(across, down - 11, letter, { fill: ink.loss, 'font-size': growthFont, 'font-weight': 700,
            'text-anchor': 'middle', 'paint-order': 'stroke', stroke: ink.paper, 'stroke-width': 3 })];
}

function growthPicture(growths, axis, ink) {
  const layout = growthLayout(growths);
  const { width, height, rows } = layout;
  const before = new Map();
  const scenes = [...new Set(growths.map(({ scene }) => scene))].join(', ');
  const title = `Time against ${axis} (${scenes}), with fitted exponents and their 95 % intervals`;
  const drawn = rows.flatMap((row) => {
    const many = before.get(row.group) ?? 0;
    before.set(row.group, many + 1);
    return growthRow(row, layout, growthDashes[many % growthDashes.length], ink);
  });
  return svgElement('svg', { xmlns: 'http://www.w3.org/2000/svg', viewBox: `0 0 ${width} ${height}`,
                             width, height, role: 'img', 'aria-label': title },
    svgElement('rect', { width, height, fill: ink.paper }),
    words(16, 22, title, { fill: ink.ink, 'font-size': 13, 'font-weight': 700 }),
    ...legendOf(growths, width, ink),
    ...(rows.some(({ letter }) => letter) ? [words(16, 82,
      'A ring and a letter: one law does not do, and another holds from that size on (hollow: below, full: above).',
      { fill: ink.quiet })] : []),
    ...growthAxes(layout, axis, ink), ...drawn,
    ...rows.flatMap((row) => breakMark(row, layout, ink)));
}

function growthTable(growths) {
  return element('details', {}, element('summary', {}, 'As a table'),
    element('table', { class: 'numbers' },
      element('thead', {}, element('tr', {}, ['Technique', 'Exponent', 'Breaks', 'Median by size', 'Command']
        .map((head) => element('th', { scope: 'col' }, head)))),
      element('tbody', {}, growths.map((growth) => element('tr', {},
        element('th', { scope: 'row' }, growth.technique),
        element('td', {}, growth.exponent ? exponentWords(growth.exponent) : '–'),
        element('td', {}, growth.break
          ? `at ${grouped(growth.break.size)}: ${exponentWords(growth.break.below)}, then ` +
            exponentWords(growth.break.above) : '–'),
        element('td', {}, growth.points.map(({ size, ms }) =>
          `${grouped(size)}: ${ms.median.toPrecision(3)} ms`).join(', ')),
        element('td', {}, element('code', {}, growth.command)))))));
}
