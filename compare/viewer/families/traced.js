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

/** The ray as the command draws it, too. */
function tracedDrawing(row, unit) {
  const { tag, colors } = cutawaySvg;
  const [width, height] = [480, cutawayFloatRay.heightOf(row)];
  return tag('svg', { xmlns: 'http://www.w3.org/2000/svg', viewBox: `0 0 ${width} ${height}`,
                      width, height, role: 'img', 'font-family': 'sans-serif',
                      'aria-label': 'The shadow ray from its start to the light' },
    tag('rect', { x: 0, y: 0, width, height, fill: colors.paper, class: 'cut-fill-paper' }) +
    cutawayFloatRay.draw(row, 0, width, (t) => printed(t * unit, 6)));
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
