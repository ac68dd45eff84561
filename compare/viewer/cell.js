// The page of one cell: its pictures, the legend that counts, the inspector, and how it was made.

const views = ['side', 'slide', 'blend', 'toggle'];
const viewTitles = { side: 'Side by side', slide: 'Slide', blend: 'Blend', toggle: 'Toggle' };

/** What the cell's page shows: all that a link restores. */
function lookOf(params, opened) {
  const names = picturesOf(opened.cell);
  const of = (params.get('of') ?? '').split(',').filter((name) => names.includes(name));
  const pixel = pairOf(params.get('pixel'));
  const first = opened.cell.first ? [opened.cell.first.x, opened.cell.first.y] : null;
  const zoom = Number(params.get('zoom')) || null;
  const shown = pixel && isInside(pixel, opened) ? pixel.map(Math.floor) : first;
  return {
    view: views.includes(params.get('view')) ? params.get('view') : 'side',
    of: of.length === 2 ? of : comparedFirst(opened.cell),
    at: params.has('at') ? Math.min(1, Math.max(0, Number(params.get('at')) || 0)) : 0.5,
    flipped: params.get('flipped') === '1',
    zoom,
    centre: pairOf(params.get('centre')) ?? (shown ? shown.map((value) => value + 0.5)
                                                   : [opened.width / 2, opened.height / 2]),
    pixel: shown,
    cause: opened.cell.causes?.[params.get('cause')] ? params.get('cause') : '',
  };
}

function linkOf(opened, look) {
  const compared = look.view !== 'side';
  return routeText(opened.id, {
    view: compared ? look.view : null,
    of: compared ? look.of.join(',') : null,
    at: look.view === 'slide' || look.view === 'blend' ? look.at : null,
    flipped: look.view === 'toggle' && look.flipped ? 1 : null,
    zoom: look.zoom,
    centre: look.zoom === null ? null : look.centre.join(','),
    pixel: look.pixel ? look.pixel.join(',') : null,
    cause: look.cause,
  });
}

const button = (id, label, act, attributes = {}) =>
  element('button', { type: 'button', id, onclick: act, ...attributes }, label);

function viewButtons(page) {
  return element('div', { class: 'group', role: 'group', 'aria-label': 'View' },
    views.map((view) => button(`view-${view}`, viewTitles[view], () => page.setView(view),
                               { 'aria-pressed': String(page.look.view === view) })));
}

function pictureChoice(page, side, label) {
  return element('label', {}, `${label} `, element('select', {
    id: `choose-${side}`,
    onchange: (event) => { page.look.of[side] = event.target.value; page.update(); },
  }, picturesOf(page.opened.cell).map((name) => element('option', {
    value: name, selected: page.look.of[side] === name }, titleOf(page.opened.cell, name)))));
}

/** What the compared views need: which two, and how far. */
function compareControls(page) {
  const { look } = page;
  if (look.view === 'side') return null;
  const blinks = page.blinking !== null;
  return element('div', { class: 'toolbar' },
    pictureChoice(page, 0, look.view === 'toggle' ? 'First' : 'Left'),
    pictureChoice(page, 1, look.view === 'toggle' ? 'Second' : 'Right'),
    look.view === 'toggle'
      ? [button('flip', 'Flip', () => page.flip()),
         button('blink', blinks ? 'Stop' : 'Blink', () => page.blink(),
                { 'aria-pressed': String(blinks) })]
      : element('label', {}, look.view === 'slide' ? 'Slide ' : 'Blend ', element('input', {
          type: 'range', id: 'at', min: 0, max: 1, step: 0.01, value: look.at,
          oninput: (event) => { look.at = Number(event.target.value); page.repaint(); } })));
}

function zoomButtons(page) {
  return element('div', { class: 'group', role: 'group', 'aria-label': 'Zoom' },
    button('zoom-out', '−', () => page.zoom(-1), { 'aria-label': 'Zoom out' }),
    button('zoom-in', '+', () => page.zoom(1), { 'aria-label': 'Zoom in' }),
    button('zoom-fit', 'Fit', () => page.fit()),
    button('zoom-pixel', '1 pixel', () => page.zoomOnPixel(),
           { title: 'Zoom to the pixel that is inspected' }));
}

function stepControls(page) {
  const { cell, differing } = page.opened;
  if (differing.length === 0) return null;
  return element('div', { class: 'group', role: 'group', 'aria-label': 'Differing pixels' },
    button('previous', '‹', () => page.step(-1), { 'aria-label': 'Previous differing pixel' }),
    button('first', 'First', () => page.stepToFirst(), { 'aria-label': 'First differing pixel' }),
    button('next', '›', () => page.step(1), { 'aria-label': 'Next differing pixel' }),
    element('select', { id: 'cause', 'aria-label': 'Step through pixels of this cause',
                        onchange: (event) => page.setCause(event.target.value) },
      element('option', { value: '' }, `any cause (${grouped(cell.differing)})`),
      causesOf(cell).map(([name, pixels]) => element('option', {
        value: name, selected: page.look.cause === name }, `${name} (${grouped(pixels)})`))));
}

/** A pane with its name, or the reason why there is none. */
function pane(page, name) {
  const { scene, cell } = page.opened;
  const problem = name ? page.pictures[name].problem
    : page.look.of.map((each) => page.pictures[each].problem).find(Boolean);
  const title = name ? titleOf(cell, name) : comparedTitle(page.look, cell);
  const canvas = element('canvas', {
    class: 'pane', role: 'img', 'data-picture': name,
    style: `aspect-ratio:${page.opened.width}/${page.opened.height}`,
    'aria-label': `${title} of ${scene.name} by ${cell.name}` });
  if (problem)
    return element('figure', {}, element('figcaption', {}, element('b', {}, title)),
                   element('p', { class: 'broken' }, problem));
  listenToPane(canvas, page.look, page.opened, {
    changed: () => page.repaint(),
    inspect: (x, y) => page.inspect(x, y),
    hover: (point) => page.hover(point),
  });
  return element('figure', {}, element('figcaption', {}, element('b', {}, title)), canvas);
}

function comparedTitle({ view, of, flipped }, cell) {
  const [left, right] = of.map((name) => titleOf(cell, name));
  if (view === 'toggle') return flipped ? right : left;
  return view === 'slide' ? `${left} | ${right}` : `${left}, then ${right}`;
}

/** Under the pointer: coordinates and every value. */
function hoverWords(opened, point) {
  if (!point || !isInside(point, opened)) return ' ';
  const [x, y] = point.map(Math.floor);
  const pixel = y * opened.width + x;
  const truth = opened.visibility ? visibilityNames[opened.visibility[pixel]] : 'unknown';
  const claim = opened.claim ? claimWords(opened, pixel) : 'unknown';
  const cause = opened.causes && opened.causes[pixel] !== noDifference
    ? `, ${received.legend.causes[opened.causes[pixel]].name}` : '';
  const colors = opened.cell.color ? `; ${colorWords(opened, pixel)}` : '';
  return `(${x}, ${y})  truth ${truth}, claim ${claim}${cause}${colors}`;
}

function causeRows(page) {
  return causesOf(page.opened.cell).map(([name, pixels]) => {
    const { color, meaning } = causeLegend(name);
    return element('tr', {},
      element('th', { scope: 'row' }, element('button', {
        type: 'button', class: 'plain', title: `Go to the first pixel of ${name}`,
        onclick: () => { page.setCause(name); page.stepToFirst(); } }, swatch(color), name)),
      element('td', { class: 'number' }, grouped(pixels)), element('td', {}, meaning));
  });
}

function contradictionRows({ visibility, claim, differing }) {
  if (!visibility || !claim) return [];
  const counts = received.legend.contradictions.map(() => 0);
  differing.forEach((pixel) => {
    const kind = contradictionOf(visibility[pixel], claim[pixel]);
    if (kind >= 0) ++counts[kind];
  });
  return received.legend.contradictions.map(({ name, meaning, color }, i) => counts[i] === 0 ? null
    : element('tr', {}, element('th', { scope: 'row' }, swatch(color), name),
              element('td', { class: 'number' }, grouped(counts[i])), element('td', {}, meaning)));
}

function valueRows({ visibility, claim }) {
  const truth = visibility && tallied(visibility);
  const said = claim && tallied(claim);
  const values = said?.[partlyLit] ? [255, partlyLit, 64, 0] : [255, 64, 0];
  return values.map((value) => element('tr', {},
    element('th', { scope: 'row' }, swatch(`rgb(${value},${value},${value})`),
            visibilityNames[value]),
    element('td', { class: 'number' }, truth ? grouped(truth[value]) : '?'),
    element('td', { class: 'number' }, said ? grouped(said[value]) : '?')));
}

function legendTable(title, heads, rows) {
  const there = rows.filter(Boolean);
  if (there.length === 0) return null;
  return element('table', { class: 'legend' }, element('caption', {}, title),
    element('thead', {}, element('tr', {}, heads.map((head) =>
      element('th', { scope: 'col' }, head)))),
    element('tbody', {}, there));
}

const legends = (page) => element('div', { class: 'legends' },
  legendTable('Why pixels differ', ['Cause', 'Pixels', 'Meaning'], causeRows(page)),
  legendTable('How the claim contradicts', ['Difference', 'Pixels', 'Meaning'],
              contradictionRows(page.opened)),
  legendTable('Colour error', ['Colour', 'Pixels', 'Meaning'], colorErrorRows(page.opened.cell)),
  legendTable('Values', ['Class', 'Truth', 'Claim'], valueRows(page.opened)),
  familyOf(page.opened.cell).legends(page.opened));

function remarks(title, items) {
  return items?.length ? [element('p', { class: 'label' }, title),
                          element('ul', {}, items.map((item) => element('li', {}, item)))] : null;
}

/** Plan, times, versions and the command that makes this cell again. */
function howMade(results, { scene, cell }) {
  const { reference, provokes } = scene;
  const family = familyOf(cell);
  return element('section', { class: 'made', 'aria-labelledby': 'made-title' },
    element('h2', { id: 'made-title' }, 'How it was made'),
    cell.command ? commandLine('copy-command', 'Reproduce this cell', cell.command) : null,
    facts([
      ['Technique', cell.summary], ['Drawn in', cell.error ? null : milliseconds(cell.ms)],
      ['Gate', cell.gate ? gateWords(cell) : null],
      ...family.facts(cell),
      ['Truth traced in', reference && milliseconds(reference.ms)],
      ['Rays', reference && grouped(reference.rays)],
      ['Decided in exact arithmetic', reference && grouped(reference.exact_decisions)],
      ['File', scene.file], ['Size', `${scene.width} × ${scene.height}`],
      ['Triangles', scene.triangles && grouped(scene.triangles)], ['Light', scene.light],
      ['Provokes', provokes?.join(', ')]]),
    family.remarks(cell).map(([title, items]) => remarks(title, items)),
    remarks('Left out by the technique', cell.left_out),
    remarks('The plan: left out, as this scene does not need it', scene.left_out),
    remarks('Notes', scene.notes),
    madeWith(results));
}

/** Warnings above the pictures: unexplained evidence and colours, blank truth, damage. */
function warnings(opened) {
  const { scene, cell, problems } = opened;
  const said = [unpredictedWords(opened), ...problems].filter(Boolean);
  if (scene.reference && scene.reference.lit + scene.reference.shadowed === 0)
    said.unshift('The truth is blank: no pixel sees a surface.');
  return [...familyOf(cell).alarms(cell).filter(Boolean), ...said].map(alertLine);
}

function cellHead(results, scene, cell) {
  const cells = scenesInOrder(results).flatMap((each) =>
    (each.techniques ?? []).map((own) => ({ scene: each, cell: own })));
  const at = cells.findIndex((each) => each.cell === cell);
  const link = (step, id, words) => {
    const other = cells[at + step];
    return other ? element('a', {
      id, href: cellLink(other.scene, other.cell),
      title: `${other.scene.name} / ${other.cell.name}`,
    }, words) : null;
  };
  return element('header', { class: `cell-head ${verdictOf(cell)}` },
    element('nav', { 'aria-label': 'Cells' },
            element('a', { href: '#', id: 'to-overview' }, '← Overview'),
            link(-1, 'cell-before', '‹ Previous cell'), link(1, 'cell-after', 'Next cell ›')),
    element('h1', {}, `${scene.name} / ${cell.name} `, badge(verdictOf(cell))),
    cell.error ? null : element('p', {},
      element('b', {}, `${grouped(cell.differing)} of ${counted(cell.pixels, 'pixel')} differ. `),
      reasonOf(cell)),
    colorLine(scene, cell) ?? '',
    sinceLine(scene, cell) ?? '');
}
