// The first page: what failed and why, then every cell as a matrix of scenes and techniques.

const cellLink = (scene, cell, params = {}) => routeText(`${scene.folder}/${cell.name}`, params);

const allCells = (results) => results.scenes.flatMap((scene) =>
  (scene.techniques ?? []).map((cell) => ({ scene, cell })));

const sceneFails = (scene) => Boolean(scene.error) || (scene.no_longer_provoked ?? []).length > 0 ||
  (scene.techniques ?? []).some(isFailing);

const severity = (cell) => (isFailing(cell) ? 10 : 0) + verdictNames.length - 1 - verdictNames.indexOf(verdictOf(cell));

const worstOf = (scene) =>
  (scene.error ? 20 : Math.max(0, ...(scene.techniques ?? []).map(severity)));

/** Failures first, otherwise as they were run. */
const scenesInOrder = (results) => [...results.scenes].sort((a, b) =>
  sceneFails(b) - sceneFails(a) || worstOf(b) - worstOf(a));

function techniqueNames(results) {
  return [...new Set(allCells(results).map(({ cell }) => cell.name))];
}

function headline(results) {
  const cells = allCells(results);
  const failing = cells.filter(({ cell }) => isFailing(cell)).length;
  const unread = results.scenes.filter((scene) => scene.error).length;
  if (results.passed) return `Passed: ${counted(cells.length, 'cell')} as predicted`;
  if (failing > 0) return `Failed: ${grouped(failing)} of ${counted(cells.length, 'cell')}`;
  if (unread > 0) return `Failed: ${counted(unread, 'scene')} could not be read`;
  return 'Failed';
}

/** What fails in a merged report, whose cells may have been judged by gates of their own. */
function allGateWords(results) {
  const others = allCells(results).filter(({ cell }) => cell.gate).length;
  const apart = others === 0 ? ''
    : ` ${counted(others, 'cell')} ${others === 1 ? 'was' : 'were'} judged by another gate.`;
  return gateWords(results) + apart;
}

function banner(results) {
  const cells = allCells(results);
  const agree = cells.filter(({ cell }) => verdictOf(cell) === 'agrees').length;
  const predicted = cells.filter(({ cell }) => verdictOf(cell) === 'fails_as_predicted').length;
  const { shard } = results;
  const part = shard ? `Part ${shard.number} of ${shard.of} of a run. ` : '';
  return element('section', { class: `banner ${results.passed ? 'passed' : 'failed'}` },
    element('h1', {}, element('span', { 'aria-hidden': 'true' }, results.passed ? '✓ ' : '✕ '),
            headline(results)),
    element('p', {}, `${part}${grouped(agree)} agree, ${grouped(predicted)} fail as predicted. ` +
                     allGateWords(results)),
    baselineLine(results));
}

/** How far a cell is from the baseline: "12 new, 3 gone". */
function sinceWords(cell) {
  const since = cell.since;
  if (!since) return '';
  if (since.status) return since.status;
  return ['new', 'gone', 'changed'].filter((kind) => since[kind] > 0)
    .map((kind) => `${grouped(since[kind])} ${kind}`).join(', ');
}

/** Where a cell first left the baseline, as a link to that pixel. Null where it did not. */
function sinceLine(scene, cell) {
  const words = sinceWords(cell);
  if (!words) return null;
  const { first } = cell.since;
  return element('p', { class: 'since' }, `Since the baseline: ${words}`, first ? [', first at ',
    element('a', { href: cellLink(scene, cell, { pixel: `${first.x},${first.y}`, zoom: 16 }) },
            `(${first.x}, ${first.y})`),
    `: ${first.cause ?? 'no difference'}, was ${first.was ?? 'no difference'}`] : null);
}

function baselineLine(results) {
  if (!results.baseline) return null;
  const changed = allCells(results).filter(({ cell }) => sinceWords(cell)).length;
  return element('p', {}, `Compared with ${results.baseline.file}: ` +
    (changed ? `${counted(changed, 'cell')} changed.` : 'nothing changed.'));
}

/** A picture, or a message if it cannot be shown. */
function thumbnail(path, alt) {
  const image = element('img', { src: path, alt, loading: 'lazy', width: 112, height: 112 });
  image.addEventListener('error', () =>
    image.replaceWith(element('span', { class: 'broken' }, `${path} is missing or damaged`)));
  return image;
}

function failureCard({ scene, cell }) {
  const verdict = verdictOf(cell);
  const href = cellLink(scene, cell);
  const { first } = cell;
  return element('li', { class: `failure ${verdict}` },
    cell.images ? element('a', { href, class: 'thumb', tabindex: '-1', 'aria-hidden': 'true' },
                          thumbnail(cell.images.cause, '')) : null,
    element('div', {},
      element('h3', {}, element('a', { href }, `${scene.name} / ${cell.name}`), ' ',
              badge(verdict)),
      element('p', {}, reasonOf(cell)),
      first ? element('p', {}, element('a', {
        href: cellLink(scene, cell, { pixel: `${first.x},${first.y}`, zoom: 16 }),
      }, `First pixel (${first.x}, ${first.y}): ${first.cause}`)) : null,
      sinceLine(scene, cell)));
}

function sceneCard(scene) {
  const words = scene.error ? scene.error
    : `This scene no longer provokes ${scene.no_longer_provoked.join(', ')}.`;
  return element('li', { class: 'failure error' }, element('div', {},
    element('h3', {}, scene.name, ' ', badge('error')),
    element('p', {}, words)));
}

const failuresShown = 8;

/** What failed and why, before anything else. */
function failures(results) {
  const scenes = results.scenes.filter((scene) =>
    scene.error || (scene.no_longer_provoked ?? []).length > 0);
  const cells = allCells(results).filter(({ cell }) => isFailing(cell))
    .sort((a, b) => severity(b.cell) - severity(a.cell));
  if (scenes.length + cells.length === 0) return null;
  const cards = [...scenes.map(sceneCard), ...cells.map(failureCard)];
  const more = cards.length - failuresShown;
  return element('section', { 'aria-labelledby': 'failed-title' },
    element('h2', { id: 'failed-title' }, 'What failed, and why'),
    element('ul', { class: 'failures' }, cards.slice(0, failuresShown)),
    more > 0 ? element('p', { class: 'quiet' }, `And ${grouped(more)} more, in the matrix below.`)
             : null);
}

const searchedText = (scene, cell) =>
  [scene.name, scene.file, cell.name, verdicts[verdictOf(cell)].words, cell.error ?? '',
   ...Object.keys(cell.causes ?? {})].join(' ').toLowerCase();

/** Whether a cell passes the filter: { cause, find, verdict }. */
function isWanted(scene, cell, filter) {
  if (filter.cause && !cell.causes?.[filter.cause]) return false;
  if (filter.verdict && verdictOf(cell) !== filter.verdict) return false;
  const text = searchedText(scene, cell);
  return (filter.find ?? '').toLowerCase().split(/\s+/).every((word) => text.includes(word));
}

function matrixEntry(scene, cell, filter, compact) {
  if (!cell) return element('td', { class: 'none' }, '–');
  const verdict = verdictOf(cell);
  if (!isWanted(scene, cell, filter)) return element('td', { class: 'none' }, '·');
  const { mark } = verdicts[verdict];
  const words = isButForEdges(cell) ? 'agrees but for edges' : verdicts[verdict].words;
  const beyond = beyondEdges(cell);
  const [worst, ...others] = causesOf(cell).filter(([name]) => beyond === 0 || name !== 'edge');
  const pixels = beyond || cell.differing || 0;
  const causes = worst ? ` ${worst[0]}${others.length > 0 ? ` and ${others.length} more` : ''}` : '';
  const why = pixels > 0 ? `${grouped(pixels)}${compact ? '' : causes}` : '';
  const color = cell.color && !compact ? `colour ${fewSteps(cell.color.largest)}/255` : '';
  const since = sinceWords(cell);
  const edges = isButForEdges(cell) ? ' edges' : '';
  return element('td', { class: `${verdict}${edges}${isFailing(cell) ? ' failing' : ''}` },
    element('a', { href: cellLink(scene, cell), title: `${scene.name} / ${cell.name}: ${words}` },
      element('b', {}, mark,
              compact ? element('i', { class: 'unseen' }, ` ${words}`) : ` ${words}`),
      element('span', {}, why || color || ' '),
      why && color ? element('span', {}, color) : null,
      since ? element('span', { class: 'since' }, `Δ ${since}`) : null,
      element('i', { class: 'unseen' }, `, ${scene.name}, ${cell.name}`)));
}

function matrixRow(scene, techniques, filter, compact) {
  const head = element('th', { scope: 'row' }, scene.name);
  if (scene.error)
    return element('tr', {}, head, element('td', {
      class: 'unread error', colspan: techniques.length || 1,
    }, element('b', {}, '! could not be read'), element('span', {}, scene.error)));
  return element('tr', {}, head, techniques.map((name) =>
    matrixEntry(scene, scene.techniques.find((cell) => cell.name === name), filter, compact)));
}

/** Rows and columns without a wanted cell are left out. */
function matrix(results, filter) {
  const wanted = allCells(results).filter(({ scene, cell }) => isWanted(scene, cell, filter));
  const filtered = filter.cause || filter.find || filter.verdict;
  const techniques = techniqueNames(results).filter((name) =>
    !filtered || wanted.some(({ cell }) => cell.name === name));
  const scenes = scenesInOrder(results).filter((scene) =>
    (scene.error && !filtered) || wanted.some((each) => each.scene === scene));
  const compact = techniques.length > 8;
  if (results.scenes.length === 0)
    return element('p', { class: 'quiet' }, 'There was nothing to try in this part of the run.');
  if (scenes.length === 0) return element('p', { class: 'quiet' }, 'No cell is like that.');
  return element('table', { class: compact ? 'matrix compact' : 'matrix' },
    element('thead', {}, element('tr', {}, element('th', { scope: 'col' }, 'Scene'),
      techniques.map((name) => element('th', { scope: 'col' }, element('span', {}, name))))),
    element('tbody', {}, scenes.map((scene) => matrixRow(scene, techniques, filter, compact))));
}

function causesIn(results) {
  const pixels = new Map();
  for (const { cell } of allCells(results))
    for (const [name, count] of Object.entries(cell.causes ?? {}))
      pixels.set(name, (pixels.get(name) ?? 0) + count);
  return received.legend.causes.filter(({ name }) => pixels.has(name))
    .map((cause) => ({ ...cause, pixels: pixels.get(cause.name) }));
}

/** The verdicts with their marks and counts: a legend, and buttons that filter. */
function verdictButtons(results, filter, choose) {
  const cells = allCells(results);
  return element('div', { class: 'chips', role: 'group', 'aria-label': 'Filter by verdict' },
    verdictNames.map((name) => {
      const own = cells.filter(({ cell }) => verdictOf(cell) === name);
      const count = own.length;
      const butForEdges = own.filter(({ cell }) => isButForEdges(cell)).length;
      const apart = butForEdges > 0 ? `, ${grouped(butForEdges)} of them but for edges` : '';
      const { mark, words, meaning } = verdicts[name];
      return count === 0 ? null : element('button', {
        type: 'button', class: `chip ${name}`, title: meaning,
        'aria-pressed': String(filter.verdict === name),
        onclick: () => choose({ verdict: filter.verdict === name ? '' : name }),
      }, element('b', {}, `${mark} ${words}`), ` ${grouped(count)}${apart}`);
    }));
}

function filterControls(results, filter, choose) {
  return element('form', { class: 'filters', role: 'search', onsubmit: (e) => e.preventDefault() },
    verdictButtons(results, filter, choose),
    element('label', {}, 'Cause ', element('select', {
      id: 'filter-cause', onchange: (event) => choose({ cause: event.target.value }),
    }, element('option', { value: '' }, 'any'),
       causesIn(results).map(({ name, pixels }) => element('option', {
         value: name, selected: filter.cause === name }, `${name} (${grouped(pixels)})`)))),
    element('label', {}, 'Find ', element('input', {
      type: 'search', id: 'filter-find', value: filter.find, placeholder: 'scene, technique…',
      oninput: (event) => choose({ find: event.target.value }) })));
}

function causeLegendList(results) {
  const causes = causesIn(results);
  if (causes.length === 0) return null;
  // Causes that no picture has together share colours. This list may hold them all: there each
  // has a shape of its own.
  const shapeOf = ({ color }, i) =>
    swatchShapes[causes.slice(0, i).filter((each) => each.color === color).length];
  return element('ul', { class: 'legend-line', 'aria-label': 'Causes' }, causes.map((cause, i) =>
    element('li', {}, swatch(cause.color, shapeOf(cause, i)), causeLink(cause.name), ` ${cause.meaning}`)));
}

function madeWith(results) {
  const { gl } = results;
  return facts([['shadowproof', results.version], ['OpenGL', gl?.version],
                ['Renderer', gl?.renderer],
                ['Depth, stencil, subpixel bits',
                 gl && `${gl.depth_bits}, ${gl.stencil_bits}, ${gl.subpixel_bits}`],
                ['Embree', results.embree], ['Baseline', results.baseline?.file],
                ['Settings', results.arguments?.join(' ')]]);
}

/** Columns of a table that its scrolling frame hides at the right. */
function columnsBeyond(frame) {
  const end = frame.getBoundingClientRect().right + 1;
  return [...frame.querySelectorAll('thead th')]
    .filter((head) => head.getBoundingClientRect().right > end).length;
}

function showOverview(results, params) {
  const filter = Object.fromEntries(['cause', 'find', 'verdict'].map((key) =>
    [key, params.get(key) ?? '']));
  const table = element('div', { class: 'scroll', role: 'region', tabindex: '0',
                                 'aria-label': 'Matrix' });
  const controls = element('div', {});
  const beyond = element('p', { class: 'beyond quiet', 'aria-hidden': 'true' });
  const sayWhatIsBeyond = () => {
    const columns = columnsBeyond(table);
    beyond.textContent = columns > 0 ? `${counted(columns, 'technique')} more to the right →` : '';
  };
  table.addEventListener('scroll', sayWhatIsBeyond);
  new ResizeObserver(sayWhatIsBeyond).observe(table);
  const draw = (all) => {
    table.replaceChildren(matrix(results, filter));
    sayWhatIsBeyond();
    if (all) controls.replaceChildren(filterControls(results, filter, choose));
  };
  const choose = (change) => {
    const focused = document.activeElement?.className;
    Object.assign(filter, change);
    draw(!('find' in change));
    if ('cause' in change) found('filter-cause').focus();
    if ('verdict' in change)
      [...controls.querySelectorAll('button')].find((b) => b.className === focused)?.focus();
    const cells = allCells(results);
    const wanted = cells.filter(({ scene, cell }) => isWanted(scene, cell, filter)).length;
    announce(`${grouped(wanted)} of ${counted(cells.length, 'cell')}`);
    rememberLink(routeText('', filter));
  };
  draw(true);
  document.title = `shadowproof: ${results.passed ? 'passed' : 'failed'}`;
  found('main').replaceChildren(
    banner(results), failures(results) ?? '',
    element('section', { 'aria-labelledby': 'matrix-title' },
      element('h2', { id: 'matrix-title' }, 'Every scene and technique'), controls, beyond, table,
      causeLegendList(results) ?? ''),
    runTimePlot(results) ?? '',
    element('section', { 'aria-labelledby': 'made-title' },
      element('h2', { id: 'made-title' }, 'Made with'), madeWith(results)));
}
