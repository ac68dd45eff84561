// The section of traced shadows: the shadow ray of a pixel that differs, drawn from its start to
// the light, with what it met.

/** The row of a pixel that differs, decoded. */
function tracedRow({ blocks: { ray, met, at }, differing }, pixel) {
  const row = rankOf(differing, pixel);
  const [ox, oy, oz, dx, dy, dz, near, far, leaves] = ray.subarray(9 * row, 9 * row + 9);
  const [seen, stopped, first, passed] = met.subarray(4 * row, 4 * row + 4);
  const [depth, firstAt, passedAt] = at.subarray(3 * row, 3 * row + 3);
  const hit = (triangle, t) => (triangle === noTriangle ? null : { triangle, t });
  return { origin: [ox, oy, oz], direction: [dx, dy, dz], near, far, seen, stopped, depth,
           shot: !Number.isNaN(near), leaves: Number.isNaN(leaves) ? null : leaves,
           first: hit(first, firstAt), passed: hit(passed, passedAt) };
}

/** What lies along a shadow ray, by distance. */
function tracedMarks(row) {
  return [
    { t: 0, words: 'start', color: 'ink' },
    row.near > 0 ? { t: row.near, words: 'epsilon: hits count beyond', color: 'quiet' } : null,
    row.leaves === null ? null
      : { t: row.leaves, words: 'leaves its receiver’s plane', color: 'shade' },
    row.passed ? { t: row.passed.t, words: `passes over triangle ${row.passed.triangle}`,
                   color: 'bad' } : null,
    row.first ? { t: row.first.t, words: `meets triangle ${row.first.triangle}`, color: 'bad' }
              : null,
    Number.isFinite(row.far) ? { t: row.far, words: 'light', color: 'light' } : null,
  ].filter(Boolean).sort((a, b) => a.t - b.t);
}

/** The ray from left to right, a line of words for each mark. Distances are in logarithms from a
    half of the smallest, as they range from rounding errors to the size of the scene. */
function tracedDrawing(row, unit) {
  const { tag, line, words, colors } = cutawaySvg;
  const marks = tracedMarks(row);
  const width = 480;
  const lineHeight = 20;
  const height = 34 + lineHeight * marks.length;
  const least = Math.min(...marks.map(({ t }) => t).filter((t) => t > 0), 1) / 2;
  const scale = (t) => Math.log(1 + t / least);
  const most = Math.max(...marks.map(({ t }) => scale(t)), 1e-9);
  const x = (t) => 14 + (width - 28) * (scale(t) / most) * (Number.isFinite(row.far) ? 1 : 0.85);
  const parts = [
    tag('rect', { x: 0, y: 0, width, height, fill: colors.paper, class: 'cut-fill-paper' }),
    line([x(0), 16], [width - 6, 16], 'line', 2)];
  marks.forEach(({ t, words: text, color }, i) => {
    const y = 40 + lineHeight * i;
    const right = x(t) > width / 2;
    parts.push(line([x(t), 16], [x(t), y - 4], color, 1),
               tag('circle', { cx: x(t), cy: 16, r: 4, fill: colors[color],
                               class: `cut-fill-${color}` }),
               words([x(t) + (right ? -5 : 5), y], `${text}, ${printed(t * unit, 6)}`, color, 12,
                     right ? 'end' : 'start'));
  });
  return tag('svg', { xmlns: 'http://www.w3.org/2000/svg', viewBox: `0 0 ${width} ${height}`,
                      width, height, role: 'img', 'font-family': 'sans-serif',
                      'aria-label': 'The shadow ray from its start to the light' }, parts.join(''));
}

addFamily('traced', {
  blocks: (pixels, differing) => ({ ray: 9 * differing, met: 4 * differing, at: 3 * differing }),
  differing({ opened }, pixel) {
    const row = tracedRow(opened, pixel);
    const unit = opened.cellFile.ray_unit;
    const named = (triangle) => (triangle === noTriangle ? 'nothing' : `triangle ${triangle}`);
    const scaled = (point) => printedPoint(point.map((value) => value * unit));
    const saw = ['Eye ray met', row.seen === noTriangle ? 'nothing'
      : `${named(row.seen)} at ${printed(row.depth * unit)}`];
    if (!row.shot)
      return [facts([saw]), element('p', { class: 'quiet' }, 'No shadow ray was shot here.')];
    const drawing = element('div', { id: 'traced-ray', class: 'scroll', tabindex: '0',
                                     role: 'region', 'aria-label': 'Shadow ray' });
    drawing.innerHTML = tracedDrawing(row, unit); // cutawaySvg escapes all text
    return [
      drawing,
      facts([saw, ['Shadow ray', `from ${scaled(row.origin)} along ${printedPoint(row.direction)}`],
             ['Embree’s answer', row.stopped === noTriangle ? 'nothing in the way'
               : `stopped by ${named(row.stopped)}`],
             ['Traced exactly', row.first ? `meets ${named(row.first.triangle)} first`
                                          : 'meets nothing']])];
  },
  agreeing: () => [element('p', { class: 'quiet' },
                           'The rays of pixels that agree are printed by the command.')],
});
