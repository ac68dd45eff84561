// The section of traced shadows: the shadow ray of a pixel that differs, drawn from its start to
// the light, with what it met.

/** The lists of cell.js, one number for each pixel that differs: compare/traced/ray_report.cpp. */
const tracedLists = [
  'origin_x', 'origin_y', 'origin_z', 'direction_x', 'direction_y', 'direction_z', 'near', 'far',
  'leaves', 'seen', 'stopped', 'first', 'passed', 'depth', 'first_at', 'passed_at'];

/** What a pixel that differs has in each list. */
function tracedRow({ blocks, differing }, pixel) {
  const rank = rankOf(differing, pixel);
  const of = (name) => blocks[name][rank];
  const vector = (name) => ['x', 'y', 'z'].map((axis) => of(`${name}_${axis}`));
  const hit = (triangle, t) => (triangle === noTriangle ? null : { triangle, t });
  return { origin: vector('origin'), direction: vector('direction'), near: of('near'),
           far: of('far'), seen: of('seen'), stopped: of('stopped'), depth: of('depth'),
           shot: !Number.isNaN(of('near')), leaves: Number.isNaN(of('leaves')) ? null : of('leaves'),
           first: hit(of('first'), of('first_at')), passed: hit(of('passed'), of('passed_at')) };
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
  blocks: (pixels, differing) =>
    Object.fromEntries(tracedLists.map((name) => [name, differing])),
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
