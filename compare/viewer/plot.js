// Error against run time: each cell is a small mark, each technique a labelled one at its median
// time and worst error. Logarithmic axes; zero error has a line of its own below 1.

const plotShapes = {
  agrees: (x, y) => `M${x - 4} ${y}a4 4 0 1 0 8 0a4 4 0 1 0-8 0z`,
  fails_as_predicted: (x, y) => `M${x} ${y - 5}l5 9h-10z`,
  defect: (x, y) => `M${x - 4} ${y - 4}h8v8h-8z`,
  unexplained: (x, y) => `M${x} ${y - 6}l6 6l-6 6l-6-6z`,
};

const median = (values) => {
  const sorted = [...values].sort((a, b) => a - b);
  const middle = sorted.length >> 1;
  return sorted.length % 2 ? sorted[middle] : (sorted[middle - 1] + sorted[middle]) / 2;
};

/** A technique over all its scenes: { name, ms, beyond, scene of the worst error }. */
function summarised(cells) {
  const byName = new Map();
  for (const each of cells) {
    if (!byName.has(each.cell.name)) byName.set(each.cell.name, []);
    byName.get(each.cell.name).push(each);
  }
  return [...byName].map(([name, own]) => {
    const worst = own.reduce((a, b) => (beyondEdges(b.cell) > beyondEdges(a.cell) ? b : a));
    return { name, ms: median(own.map(({ cell }) => cell.ms)), beyond: beyondEdges(worst.cell),
             scene: worst.scene.name };
  });
}

function plotScales(cells, width, height) {
  const times = cells.map(({ cell }) => Math.max(cell.ms, 0.01));
  const low = Math.min(...times) / 1.15;
  const high = Math.max(...times) * 1.15;
  const most = Math.max(10, ...cells.map(({ cell }) => beyondEdges(cell)));
  const decades = Math.ceil(Math.log10(most));
  const box = { left: 74, right: width - 16, top: 14, zero: height - 48, one: height - 82 };
  return {
    box, low, high, decades,
    x: (ms) => box.left + 10 + (Math.log(Math.max(ms, 0.01) / low) / Math.log(high / low)) *
                               (box.right - box.left - 20),
    y: (count) => (count < 1 ? box.zero
      : box.one - Math.log10(count) / decades * (box.one - box.top)),
  };
}

function plotAxes({ box, low, high, decades, x, y }, width, height) {
  const text = (at, words, anchor = 'middle') =>
    svgElement('text', { x: at[0], y: at[1], 'text-anchor': anchor }, words);
  const rule = (x1, y1, x2, y2) => svgElement('path', { d: `M${x1} ${y1}L${x2} ${y2}` });
  const parts = [];
  for (const ms of roundValues(low, high))
    parts.push(rule(x(ms), box.top, x(ms), box.zero), text([x(ms), box.zero + 20], String(ms)));
  for (let decade = 0; decade <= decades; ++decade)
    parts.push(rule(box.left, y(10 ** decade), box.right, y(10 ** decade)),
               text([box.left - 8, y(10 ** decade) + 4], grouped(10 ** decade), 'end'));
  parts.push(rule(box.left, box.zero, box.right, box.zero),
             text([box.left - 8, box.zero + 4], '0', 'end'),
             text([(box.left + box.right) / 2, height - 6], 'milliseconds to draw'));
  const title = text([0, 0], 'pixels beyond edges');
  title.setAttribute('transform', `translate(13 ${(box.top + box.zero) / 2}) rotate(-90)`);
  return svgElement('g', { class: 'axes' }, ...parts, title);
}

/** Rings with their names; a name for which there is no room stands in the table alone. */
function plotLabels(techniques, { x, y, box }) {
  const marks = techniques.map(({ name, ms, beyond }) => ({ x: x(ms), y: y(beyond), text: name }));
  const places = placeLabels(marks, { ...box, bottom: box.zero + 14 });
  return marks.map((mark, i) => {
    const { x: left, y: row, leader } = places[i] ?? {};
    return svgElement('g', { class: 'technique' },
      leader ? svgElement('path', {
        d: `M${leader[0]} ${leader[1]}L${leader[2]} ${leader[3]}` }) : '',
      svgElement('circle', { cx: mark.x, cy: mark.y, r: 8 }),
      places[i] ? svgElement('text', { x: left, y: row }, mark.text) : '');
  });
}

function plotPicture(cells, techniques, width) {
  const height = Math.max(330, 18 * techniques.length);
  const scales = plotScales(cells, width, height);
  const dots = cells.map(({ scene, cell }) => {
    const verdict = verdictOf(cell);
    const shape = svgElement('path', {
      d: plotShapes[verdict](scales.x(cell.ms), scales.y(beyondEdges(cell))),
      class: `dot ${verdict}` });
    shape.append(svgElement('title', {},
      `${scene.name} / ${cell.name}: ${milliseconds(cell.ms)}, ` +
      `${counted(beyondEdges(cell), 'pixel')} beyond edges, ${verdicts[verdict].words}`));
    shape.addEventListener('click', () => { location.hash = cellLink(scene, cell); });
    return shape;
  });
  return svgElement('svg', { class: 'plot', role: 'img', viewBox: `0 0 ${width} ${height}`, width,
                             height, 'aria-label': 'Pixels beyond edges against milliseconds; ' +
                                                   'the same numbers stand in the table below' },
    plotAxes(scales, width, height), ...dots, ...plotLabels(techniques, scales));
}

function plotTable(techniques) {
  return element('details', {}, element('summary', {}, 'As a table'),
    element('div', { class: 'scroll', role: 'region', tabindex: '0', 'aria-label': 'Techniques' },
      element('table', { class: 'numbers' },
        element('thead', {}, element('tr', {},
          ['Technique', 'Median time', 'Most pixels beyond edges', 'On scene'].map((head) =>
            element('th', { scope: 'col' }, head)))),
        element('tbody', {}, techniques.map((each) => element('tr', {},
          element('th', { scope: 'row' }, each.name), element('td', {}, milliseconds(each.ms)),
          element('td', {}, grouped(each.beyond)),
          element('td', {}, each.beyond ? each.scene : '–')))))));
}

/** Null where nothing ran. */
function runTimePlot(results) {
  const cells = allCells(results).filter(({ cell }) => !cell.error && Number.isFinite(cell.ms));
  if (cells.length === 0) return null;
  const techniques = summarised(cells);
  const width = Math.max(340, Math.min(880, document.documentElement.clientWidth - 56));
  return element('section', { 'aria-labelledby': 'plot-title' },
    element('h2', { id: 'plot-title' }, 'Error against run time'),
    element('p', { class: 'quiet' },
            'Each mark is a cell. A ring is a technique: its median time, its worst scene.'),
    element('div', { class: 'scroll', role: 'region', tabindex: '0', 'aria-label': 'Plot' },
      plotPicture(cells, techniques, width)),
    plotTable(techniques));
}
