// Where everything of a benchmark's plot stands. Numbers alone: no element is made here.

const rowHeight = 16; // of a point in the band of those that are right

/**
 * Techniques that no other beats: at most as slow and as wrong, and better in one. By time. The
 * truth is their yardstick, and not among them.
 */
function frontOf(all) {
  const figures = all.filter(({ point }) => point.technique !== 'truth');
  return figures.filter((one) => !figures.some((other) =>
    other.ms <= one.ms && other.error <= one.error &&
    (other.ms < one.ms || other.error < one.error)))
    .sort((a, b) => a.ms - b.ms || b.error - a.error);
}

/** A logarithmic scale from values to pixels. */
function logScale(low, high, from, to) {
  const span = Math.log(high / low);
  return (value) => from + (span === 0 ? 0.5 : Math.log(value / low) / span) * (to - from);
}

/** The decades that hold all errors above zero. */
function decadesOf(errors) {
  const above = errors.filter((error) => error > 0);
  if (above.length === 0) return null;
  const low = Math.floor(Math.log10(Math.min(...above)));
  return [low, Math.max(low + 1, Math.ceil(Math.log10(Math.max(...above))))];
}

/**
 * The plot of one scene's points by one kind of error. `older`: points of another run, or none.
 * { width, height, box, band, xTicks, yTicks, marks, front, arrows, unlabelled }
 */
function benchLayout(points, older, kind, width) {
  const figures = points.filter((point) => kind.of(point) !== null && point.ms.median > 0)
    .map((point) => ({ point, ms: point.ms.median, error: kind.of(point) }))
    .sort((a, b) => a.ms - b.ms);
  const before = figures.map(({ point }) => older.find((other) => samePoint(point, other)))
    .map((point) => (point && kind.of(point) !== null && point.ms.median > 0 ? point : null));
  const known = [...points.filter((point) => kind.of(point) !== null), ...before.filter(Boolean)];
  const times = known.flatMap(({ ms }) => [ms.low, ms.high]).filter((ms) => ms > 0);
  const low = Math.min(...times) / 1.2;
  const high = Math.max(...times) * 1.2;
  const decades = decadesOf(known.map(kind.of));
  const right = figures.filter(({ error }) => error === 0);
  const upper = decades === null ? 0 : Math.max(170, 62 * (decades[1] - decades[0]));
  const rows = Math.max(right.length, before.some((point) => point && kind.of(point) === 0) ? 1 : 0);
  const box = { left: 88, right: width - 20, top: 74, bottom: 74 + upper };
  const band = { top: box.bottom + (upper > 0 && rows > 0 ? 12 : 0), bottom: 0 };
  band.bottom = band.top + (rows > 0 ? rowHeight * rows + 8 : 0);
  const x = logScale(low, high, box.left, box.right);
  const upwards = decades && logScale(10 ** decades[0], 10 ** decades[1], box.bottom - 8, box.top + 8);
  const y = (error, row) => (error === 0 ? band.top + 4 + rowHeight * (row + 0.5) : upwards(error));

  const rowOf = new Map(right.map((figure, row) => [figure.point, row]));
  const marks = figures.map(({ point, ms, error }) => ({
    point, x: x(ms), y: y(error, rowOf.get(point) ?? 0), low: x(point.ms.low), high: x(point.ms.high),
    right: error === 0, label: null }));
  const best = frontOf(figures);
  labelMarks(marks, box, best.map(({ point }) => point));
  const arrows = marks.flatMap((mark, i) => {
    const then = before[figures.findIndex(({ point }) => point === mark.point)];
    if (!then) return [];
    const from = [x(then.ms.median), y(kind.of(then), rowOf.get(mark.point) ?? 0)];
    return [{ from, to: [mark.x, mark.y], change: changeOf(then, mark.point), index: i }];
  });
  return {
    width, height: band.bottom + 46, box, band, marks, arrows,
    xTicks: roundValues(low, high).map((value) => ({ value, at: x(value) })),
    yTicks: decades === null ? [] : Array.from({ length: decades[1] - decades[0] + 1 }, (_, k) =>
      ({ value: 10 ** (decades[0] + k), at: upwards(10 ** (decades[0] + k)) })),
    front: best.map(({ point }) => marks.find((mark) => mark.point === point)),
    unlabelled: marks.filter(({ label }) => label === null).length,
  };
}

/** Each right point has a row, and its label beside its interval; the others what is free. */
function labelMarks(marks, box, front) {
  for (const mark of marks.filter(({ right }) => right)) {
    const width = textWidth(pointName(mark.point));
    const after = Math.max(mark.high, mark.x + 7) + 6;
    const fits = after + width <= box.right;
    mark.label = { x: fits ? after : Math.min(mark.low, mark.x - 7) - 6 - width, y: mark.y + 4,
                   leader: null };
  }
  // What has the least room around it comes last: the front first, then the quick.
  const wrong = marks.filter(({ right }) => !right)
    .sort((a, b) => front.includes(b.point) - front.includes(a.point));
  const bars = wrong.map(({ low, high, y }) => ({ left: low, right: high, top: y - 1, bottom: y + 1 }));
  const places = placeLabels(wrong.map(({ x, y, point }) => ({ x, y, text: pointName(point) })),
                             box, bars);
  wrong.forEach((mark, i) => { mark.label = places[i]; });
}

/** Heights of labels at the right end of lines, in the order given, none above another. */
function spreadOut(heights, least, top, bottom) {
  const order = heights.map((height, i) => ({ height, i })).sort((a, b) => a.height - b.height);
  let free = top;
  for (const each of order) {
    each.height = Math.max(each.height, free);
    free = each.height + least;
  }
  free = bottom;
  for (const each of order.reverse()) {
    each.height = Math.min(each.height, free);
    free = each.height - least;
  }
  const spread = [];
  for (const { height, i } of order) spread[i] = height;
  return spread;
}
