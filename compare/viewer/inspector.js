// One pixel: both values, what is seen, the ledger of the crossings with what each counted, and
// the drawing. Numbers are those of `shadowproof explain`.

const valueChip = (label, value, color) => element('span', { class: 'value' },
  `${label} `, swatch(color), element('b', {}, value));

const grays = { background: '#000000', shadowed: '#404040', 'partly lit': '#a0a0a0',
                lit: '#ffffff' };

/** Truth and claim side by side, and the cause. */
function verdictLine(truth, claim, cause) {
  return element('p', { class: 'values' },
    valueChip('truth', truth, grays[truth]), valueChip('claim', claim, grays[claim]),
    cause ? element('span', { class: 'value' }, 'cause ', swatch(causeLegend(cause).color),
                    element('b', {}, cause)) : null);
}

const counterWords = (stored, bits) => {
  const count = asCount(stored, bits);
  return count < 0 ? `${stored} (${count})` : String(stored);
};

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
    ['Ray', `from ${printedPoint(record.eye)} along ${printedPoint(record.direction)}`],
    ['Light', record.light.kind === 'directional'
      ? `${record.light.name} shining along ${printedPoint(record.light.direction)}`
      : `${record.light.name} at ${printedPoint(record.light.position)}`],
  ]);
}

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
  if (!place || !page.record) return;
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

function differingPixel(page, pixel) {
  const { visibility, claim, causes } = page.opened;
  const { name, meaning } = received.legend.causes[causes[pixel]];
  // First, as it fails where the evidence cannot be shown.
  const evidence = familyOf(page.opened.cell).differing(page, pixel);
  return [
    verdictLine(visibility && visibilityNames[visibility[pixel]],
                claim && visibilityNames[claim[pixel]], name),
    element('p', { class: 'why' }, `${name}: ${meaning}.`),
    ...pixelColors(page.opened, pixel),
    ...evidence];
}

/** A pixel without a cause. Says "agree" only where both values are there and equal. */
function otherPixel(page, pixel) {
  const { opened } = page;
  const { visibility, claim, causes } = opened;
  if (!visibility || !claim || !causes)
    return [alertLine(`Nothing can be said of this pixel: ${opened.problems.join('; ')}.`)];
  const truth = visibilityNames[visibility[pixel]];
  const said = visibilityNames[claim[pixel]];
  const agrees = truth === said && causes[pixel] === noDifference;
  return [
    verdictLine(truth, said, null),
    agrees ? element('p', { class: 'why' }, isUnpredicted(opened.colorVerdict?.[pixel])
      ? 'Truth and claim agree here on visibility.' : 'Truth and claim agree here.')
           : alertLine('Truth and claim differ here, and the results have no cause for it.'),
    ...pixelColors(opened, pixel),
    ...familyOf(opened.cell).agreeing(page, pixel)];
}

function pixelBody(page, x, y) {
  const { opened } = page;
  const pixel = y * opened.width + x;
  page.record = null;
  if (!opened.causes || opened.causes[pixel] === noDifference) return otherPixel(page, pixel);
  try {
    return differingPixel(page, pixel);
  } catch (error) {
    return [alertLine(`This pixel differs, and its ledger cannot be shown: ${error.message}.`),
            ...pixelColors(opened, pixel)];
  }
}

/** Input of a pixel by its coordinates. */
function pixelForm(page) {
  const { opened, look } = page;
  const value = look.pixel ? look.pixel.join(',') : '';
  return element('form', { class: 'goto', onsubmit: (event) => {
    event.preventDefault();
    const pixel = pairOf(found('goto').value);
    if (pixel && isInside(pixel, opened)) page.inspect(...pixel.map(Math.floor));
    else announce('No such pixel');
  } }, element('label', {}, 'Pixel ',
               element('input', { id: 'goto', value, size: 8, autocomplete: 'off' })),
     element('button', { type: 'submit' }, 'Go'),
     button('copy-link', 'Copy link', () => copyAndSay(
       location.href.replace(/#.*/, '') + linkOf(opened, look), 'the link')));
}

/** Fills the inspector with the pixel that the page's look names. */
function showPixel(page) {
  const { opened, look } = page;
  const focused = document.activeElement?.id;
  if (!look.pixel) {
    page.record = null;
    page.inspector.replaceChildren(element('h2', {}, 'No pixel differs'), pixelForm(page),
      element('p', { class: 'quiet' }, 'Click a pixel to see its values.'));
    return;
  }
  const [x, y] = look.pixel;
  const body = pixelBody(page, x, y).filter(Boolean);
  page.inspector.replaceChildren(
    element('div', { class: 'inspector-head' },
            element('h2', { id: 'pixel-title' }, `Pixel (${x}, ${y})`), pixelForm(page)),
    ...body,
    opened.cell.command ? commandLine('copy-explain', 'Explain this pixel on the command line',
                                      explainCommand(opened.cell.command, x, y)) : '');
  if (focused) found(focused)?.focus({ preventScroll: true });
  drawCutaway(page);
  announce(hoverWords(opened, [x, y]));
}
