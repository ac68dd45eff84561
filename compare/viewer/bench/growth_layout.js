// Where everything of a plot of growth stands: times against sizes, the fitted lines, and the
// exponents beside them. Numbers alone: no element is made here.

const mean = (values) => values.reduce((sum, value) => sum + value, 0) / values.length;

/**
 * ms = c size^p through the middle of the logarithms of `points`, which least squares passes:
 * { from, to, middle, exponent, at }; `at(size, p)` is the time by exponent p, of which the interval has
 * two. `exponent`: { value, low, high }.
 */
function fittedLaw(points, exponent) {
  const middle = mean(points.map(({ size }) => Math.log(size)));
  const height = mean(points.map(({ ms }) => Math.log(ms.median)));
  return { from: points[0].size, to: points.at(-1).size, middle: Math.exp(middle), exponent,
           at: (size, p = exponent.value) => Math.exp(height + p * (Math.log(size) - middle)) };
}

/** The laws of a line: none, one, or two where it breaks. */
function lawsOf({ points, exponent, break: broken }) {
  if (broken)
    return [fittedLaw(points.filter(({ size }) => size <= broken.size), broken.below),
            fittedLaw(points.filter(({ size }) => size >= broken.size), broken.above)];
  return exponent ? [fittedLaw(points, exponent)] : [];
}

const exponentWords = ({ value, low, high }) =>
  `${value.toFixed(2)} [${low.toFixed(2)}, ${high.toFixed(2)}]`;

/** "1.02 [0.98, 1.06]"; "a: 0.11, from 64,000 on 0.98"; `letter` names the break. */
function lawWords({ exponent, break: broken }, letter) {
  if (broken)
    return `${letter}: ${broken.below.value.toFixed(2)}, from ${grouped(broken.size)} on ` +
           broken.above.value.toFixed(2);
  return exponent ? exponentWords(exponent) : 'fewer than 3 sizes';
}

/** "a", ... "z", "aa", ... */
const letterOf = (index) => (index >= 26 ? letterOf(Math.floor(index / 26) - 1) : '') +
                            String.fromCharCode(97 + index % 26);

/** The exponents that the panel shows: intervals may be wide, and are cut at its ends. */
function exponentRange(rows) {
  const values = rows.flatMap(({ laws }) => laws.map(({ exponent }) => exponent.value));
  return [Math.min(0, ...values) - 0.25, Math.max(1, ...values) + 0.25];
}

const growthWidth = 1100;
const growthFont = 10.5; // of names and exponents
const growthTextWidth = (words) => 0.61 * growthFont * words.length;

/**
 * { width, height, box, panel, x, y, p, isShown, sizes, times, exponents, rows }. A row: { growth, group,
 * places, laws, letter, y, words }. `box`: times against sizes; `panel`: the exponents, a row each.
 */
function growthLayout(growths) {
  const shown = growths.map((growth) => ({ ...growth,
    points: growth.points.filter(({ ms }) => ms.median > 0) }))
    .filter(({ points }) => points.length > 0);
  const breaking = shown.filter((growth) => growth.break);
  const rows = shown.map((growth) => {
    const letter = growth.break ? letterOf(breaking.indexOf(growth)) : null;
    return { growth, group: groupOf(growth), laws: lawsOf(growth), letter,
             words: lawWords(growth, letter) };
  });
  const names = Math.max(...rows.map(({ growth }) => growthTextWidth(growth.technique)), 60);
  const texts = Math.max(...rows.map(({ words: text }) => growthTextWidth(text)), 60);
  const panel = { right: growthWidth - texts - 24 };
  panel.left = panel.right - 170;
  const top = 96;
  const bottom = top + Math.max(300, 16 * rows.length);
  const box = { left: 74, right: panel.left - names - 60, top, bottom };
  const points = rows.flatMap(({ growth }) => growth.points);
  const sizes = [...new Set(points.map(({ size }) => size))].sort((a, b) => a - b);
  const times = points.map(({ ms }) => ms.median);
  const [low, high] = [Math.min(...times) / 1.3, Math.max(...times) * 1.3];
  const x = logScale(sizes[0] / 1.1, sizes.at(-1) * 1.1, box.left, box.right);
  const y = logScale(low, high, box.bottom, box.top);
  const [least, most] = exponentRange(rows);
  const p = (value) => panel.left + (Math.max(least, Math.min(most, value)) - least) /
                                    (most - least) * (panel.right - panel.left);
  for (const row of rows) row.places = row.growth.points.map(({ size, ms }) => [x(size), y(ms.median)]);
  const heights = spreadOut(rows.map(({ places }) => places.at(-1)[1]), 16, box.top + 6, box.bottom - 6);
  rows.forEach((row, i) => { row.y = heights[i]; });
  const isShown = (value) => value >= least && value <= most;
  return { width: growthWidth, height: bottom + 52, box, panel, x, y, p, isShown, rows, names,
           sizes: sizesThatFit(sizes, x), times: roundValues(low, high),
           exponents: [-1, -0.5, 0, 0.5, 1, 1.5, 2, 2.5, 3].filter((value) => value > least && value < most) };
}

/** Sizes whose words at the axis do not touch: [size, whether it has words]. */
function sizesThatFit(sizes, x) {
  let free = -Infinity;
  return sizes.map((size) => {
    const half = textWidth(grouped(size)) / 2;
    const fits = x(size) - half >= free;
    if (fits) free = x(size) + half + 6;
    return [size, fits];
  });
}
