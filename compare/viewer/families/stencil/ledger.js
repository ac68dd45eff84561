// The ledger of a pixel that differs: the crossings along its eye ray with what each counted, and
// the drawing of them. Numbers are those of `shadowproof explain`.

const triangleWords = (seen) => (seen ? `triangle ${seen.triangle} of ${seen.mesh}` : 'background');

function pixelFacts(record) {
  const [technique] = record.techniques;
  const { inside, seen, margin } = record;
  return facts([
    ['Sees', triangleWords(seen) +
      (seen ? ` at ${printedPoint(seen.point)}, depth ${printed(seen.depth)}` : '')],
    ['Shown', triangleWords(technique.shown)],
    ['Decided', record.exactness],
    ['Margin along the ray', margin.depth === null ? null
      : `${printed(margin.depth)} to the nearest crossing`],
    ['Margin in the picture', margin.pixels === null ? 'no other class'
      : `${printed(margin.pixels)} ${margin.pixels === 1 ? 'pixel' : 'pixels'} to another class`],
    ['Inside', `${inside.eye} at the eye, ${inside.near} at near ${printed(record.near)}, ` +
      (inside.surface === null ? '' : `${inside.surface} at the surface, `) +
      `${inside.far} at far ${printed(record.far)}, ${inside.infinity} at infinity`],
    ['Masks', inside.let_through > 0 ? 'the light falls through holes in the casters of ' +
      `${inside.let_through} of those at the surface` : null],
    ['Ray', `from ${printedPoint(record.eye)} along ${printedPoint(record.direction)}`],
    ['Light', record.light.kind === 'directional'
      ? `${record.light.name} shining along ${printedPoint(record.light.direction)}`
      : `${record.light.name} at ${printedPoint(record.light.position)}`],
  ]);
}

/** What became of a crossing that is not counted, where `test` is the caster's. */
const statusWords = {
  counted: 'counted',
  beyond: { depth_pass: 'behind the surface, not asked for',
            depth_fail: 'in front of the surface, not asked for' },
  lost_near: 'lost: in front of the near plane',
  lost_far: 'lost: clipped at the far plane',
  lost_cap: 'lost: the cap is missing',
};
const wordsOfStatus = (status, test) =>
  (status === 'beyond' ? statusWords.beyond[test] : statusWords[status] ?? status);

/** What a counted crossing adds to a technique's counter. */
const testOf = (technique, i) => technique.tests?.[i] ?? technique.test;
const countedAs = (technique, i, change) =>
  (testOf(technique, i) === 'depth_fail' ? -change : change);

function ledgerRows(record) {
  const [technique] = record.techniques;
  let inside = record.inside.eye;
  let running = technique.start;
  const rows = record.crossings.map((crossing, i) => {
    const status = technique.statuses[i];
    const isCounted = status === 'counted';
    inside += crossing.change;
    if (isCounted) running += countedAs(technique, i, crossing.change);
    return element('tr', { class: status },
      element('td', { class: 'number depth' }, printed(crossing.depth)),
      element('td', { class: 'number change' }, signed(crossing.change)),
      element('td', { class: 'number inside' }, String(inside)),
      element('td', { class: 'what' },
              `${crossing.kind}${crossing.caster ? ` of ${triangleWords(crossing.caster)}` : ''}`),
      element('td', { class: 'fate' }, isCounted
        ? `counted ${signed(countedAs(technique, i, crossing.change))}`
        : wordsOfStatus(status, testOf(technique, i))),
      element('td', { class: 'number running' }, isCounted ? signed(running) : ''));
  });
  return { rows, running };
}

function darkCapRow(record, running) {
  const [technique] = record.techniques;
  if (technique.test !== 'depth_fail' || technique.dark_caps === 0) return null;
  const isCounted = technique.dark_cap === 'counted';
  return element('tr', { class: technique.dark_cap },
    element('td', { class: 'number' }, 'infinity'), element('td', {}), element('td', {}),
    element('td', { class: 'what' }, `${counted(technique.dark_caps, 'dark cap')}`),
    element('td', { class: 'fate' }, isCounted ? `counted ${signed(technique.dark_caps)}`
                                               : wordsOfStatus(technique.dark_cap, technique.test)),
    element('td', { class: 'number running' },
            isCounted ? signed(running + technique.dark_caps) : ''));
}

const ledgerRowsShown = 60;

function ledgerTable(record) {
  const { rows, running } = ledgerRows(record);
  const hidden = rows.splice(ledgerRowsShown);
  const heads = ['Depth', 'Change', 'Inside', 'Crossing', 'Counter', 'Sum'];
  const body = element('tbody', {},
    element('tr', { class: 'from' }, element('td', { class: 'number' }, 'eye'), element('td', {}),
            element('td', { class: 'number' }, String(record.inside.eye)), element('td', {}),
            element('td', {}), element('td', { class: 'number' }, String(record.techniques[0].start))),
    rows, darkCapRow(record, running) ?? '');
  const all = hidden.length === 0 ? null
    : button('all-crossings', `Show ${grouped(hidden.length)} more crossings`, (event) => {
      body.append(...hidden);
      event.target.remove();
    });
  return element('div', { class: 'scroll', role: 'region', tabindex: '0',
                          'aria-labelledby': 'ledger-title' },
    element('table', { class: 'ledger' }, element('thead', {}, element('tr', {}, heads.map((head) =>
      element('th', { scope: 'col' }, head)))), body), all);
}

/** Predicted and read back, in one line under the ledger. */
function counterLine(technique, bits) {
  const equal = technique.stored === technique.read_back;
  return element('p', { class: equal ? 'counter' : 'counter unequal' },
    'Predicted ', element('b', { id: 'predicted' }, String(technique.predicted)), ', stored ',
    element('b', { id: 'stored' }, String(technique.stored)), ', read back ',
    element('b', { id: 'read-back' }, String(technique.read_back)),
    equal ? '.'
          : `: not what the pixel’s centre predicts (${counterWords(technique.read_back, bits)}).`);
}

/** The drawing, as wide as the room that there is. */
function drawCutaway(page) {
  const place = found('cutaway');
  if (!place) return;
  const width = Math.max(340, Math.round(place.clientWidth));
  if (page.drawnWidth === width && page.drawn === page.record) return;
  page.drawnWidth = width;
  page.drawn = page.record;
  place.innerHTML = cutaway(page.record, 0, width); // made by cutaway.js, which escapes names
}

function saveDrawing(page) {
  const { scene, x, y, techniques } = page.record;
  const url = URL.createObjectURL(new Blob([cutaway(page.record, 0)], { type: 'image/svg+xml' }));
  const link = element('a', { href: url,
                              download: `${scene}-${techniques[0].name}-${x}-${y}.svg` });
  link.click();
  setTimeout(() => URL.revokeObjectURL(url), 1000);
  announce('Drawing saved');
}
