// The page of a benchmark: one scene's plot at a time, its points by mouse and keyboard, exports.

const state = { run: null, older: null, scene: null, kind: errorKinds[0], at: -1, layout: null };

const scenesOf = (run) => [...new Set(run.points.map(({ scene }) => scene))];

const isDark = () => {
  const theme = document.documentElement.dataset.theme;
  return theme ? theme === 'dark' : matchMedia('(prefers-color-scheme: dark)').matches;
};

const plotTitle = () => {
  const scene = state.run.scenes.find(({ name }) => name === state.scene);
  return `Error against run time: ${state.scene}` +
         (scene ? `, ${scene.width}x${scene.height}` : '');
};

const pointsOf = (run) => (run?.points ?? []).filter(({ scene }) => scene === state.scene);

/** Pixels across: what the window gives, within reason. */
const plotWidth = () => Math.max(760, Math.min(1400, document.documentElement.clientWidth - 70));

function pointsPicture(ink) {
  state.layout = benchLayout(pointsOf(state.run), pointsOf(state.older), state.kind, plotWidth());
  return benchPicture(state.layout, state.kind, plotTitle(), ink);
}

const marksDrawn = () => [...document.querySelectorAll('#plot .point')];

/** Names the point: in a note beside it, and to screen readers by its own label. */
function showNote(index) {
  const note = found('note');
  const each = state.layout.marks[index];
  note.hidden = !each;
  if (!each) return;
  note.replaceChildren(element('b', {}, pointName(each.point)), element('br'),
                       timeWords(each.point.ms), element('br'), errorWords(each.point));
  const frame = found('plot');
  const scale = frame.firstElementChild.getBoundingClientRect().width / state.layout.width;
  const x = each.x * scale;
  note.style.left = `${x > frame.clientWidth / 2 ? Math.max(0, x - note.offsetWidth - 14) : x + 14}px`;
  note.style.top = `${each.y * scale + 24}px`;
}

/** What shows the pictures of a point. Those of the truth are the same however it is traced. */
function showsCommand(point) {
  if (point.technique !== 'truth') return point.command.replace('shadowproof bench', 'shadowproof verify');
  const scene = point.command.replace('shadowproof bench', 'shadowproof render').replace(/ --gl \w+/, '');
  const samples = isMean(point) ? ` --aov color --samples ${Math.sqrt(point.settings.samples)}` : '';
  return `${scene}${samples} -o truth.png`;
}

/** The point's whole story, below the plot. */
function choosePoint(index) {
  const { point } = state.layout.marks[index];
  const before = pointsOf(state.older).find((other) => samePoint(point, other));
  found('chosen').replaceChildren(
    element('h2', {}, pointName(point)),
    facts([['Time', timeWords(point.ms)], ['Of which', stageWords(point)], ['Error', errorWords(point)],
           ['Made with', settingsWords(point.own)],
           ['In the older run', before && `${timeWords(before.ms)}; ${errorWords(before)}`]]),
    ...(point.pictures ? [element('p', {}, element('a', { id: 'pictures', href: point.pictures },
      'Its pictures, and why pixels are wrong'))] : []),
    commandLine('measure', 'Measures it again', point.command),
    commandLine('verify', 'Shows its pictures, and why pixels are wrong', showsCommand(point)));
}

/** Moves to a point by keyboard. */
function goTo(index) {
  const marks = marksDrawn();
  if (marks.length === 0) return;
  state.at = Math.max(0, Math.min(marks.length - 1, index));
  marks.forEach((each, i) => each.setAttribute('tabindex', i === state.at ? '0' : '-1'));
  marks[state.at].focus();
}

const plotKeys = {
  ArrowRight: () => goTo(state.at + 1), ArrowLeft: () => goTo(state.at - 1),
  Home: () => goTo(0), End: () => goTo(Infinity),
  Enter: () => choosePoint(state.at), ' ': () => choosePoint(state.at),
  Escape: () => { found('note').hidden = true; },
};

function watchMarks() {
  marksDrawn().forEach((each, i) => {
    each.addEventListener('pointerenter', () => showNote(i));
    each.addEventListener('pointerleave', () => showNote(state.at));
    each.addEventListener('focus', () => { state.at = i; showNote(i); });
    each.addEventListener('blur', () => { state.at = -1; found('note').hidden = true; });
    each.addEventListener('click', () => { goTo(i); choosePoint(i); });
    each.addEventListener('keydown', (event) => {
      if (!plotKeys[event.key] || event.ctrlKey || event.altKey || event.metaKey) return;
      event.preventDefault();
      plotKeys[event.key]();
    });
  });
  marksDrawn()[0]?.setAttribute('tabindex', '0');
}

function pointTable() {
  const points = [...pointsOf(state.run)].sort((a, b) => a.ms.median - b.ms.median);
  const best = frontOf(points.filter((point) => state.kind.of(point) !== null)
    .map((point) => ({ point, ms: point.ms.median, error: state.kind.of(point) })))
    .map(({ point }) => point);
  return element('table', { class: 'numbers' },
    element('thead', {}, element('tr', {}, ['Technique', 'Time', 'Error', 'Front'].map((head) =>
      element('th', { scope: 'col' }, head)))),
    element('tbody', {}, points.map((point) => element('tr', {},
      element('th', { scope: 'row' }, pointName(point)), element('td', {}, timeWords(point.ms)),
      element('td', {}, errorWords(point)),
      element('td', {}, best.includes(point) ? 'yes' : '–')))));
}

/** What the arrows say, in words. */
function changeList() {
  if (!state.older) return null;
  const many = (change) => state.layout.arrows.filter((arrow) => arrow.change === change).length;
  return `Since the older run: ${counted(many('loss'), 'loss', 'losses')} (full arrows), ` +
         `${counted(many('gain'), 'gain')} (broken arrows), ` +
         `${grouped(many('same'))} within their intervals (thin arrows).`;
}

function draw() {
  if (!state.run) return;
  if (state.scene) drawPoints();
  drawGrowth();
}

function drawPoints() {
  found('plot').replaceChildren(pointsPicture(isDark() ? darkInk : lightInk),
    element('div', { id: 'note', class: 'note', hidden: true, 'aria-hidden': 'true' }));
  state.at = -1;
  watchMarks();
  const { unlabelled } = state.layout;
  found('said-below').textContent = [changeList(), unlabelled > 0
    ? `${counted(unlabelled, 'label')} had no room: point at the mark, or see the table.` : '']
    .filter(Boolean).join(' ');
  found('table').replaceChildren(pointTable());
  found('chosen').replaceChildren();
}

function drawGrowth() {
  const axes = [...new Set(state.run.scaling.map(({ axis }) => axis))];
  found('growth').replaceChildren(...axes.map((axis) => {
    const growths = state.run.scaling.filter((each) => each.axis === axis);
    const name = `growth-${axis.replaceAll(' ', '-')}`;
    const onPaper = () => growthPicture(growths, axis, lightInk);
    return element('section', {}, element('h2', {}, `Growth with ${axis}`),
      element('div', { class: 'toolbar' },
        element('button', { type: 'button', id: `${name}-svg`, 'aria-label': `Save as SVG: growth with ${axis}`,
                            onclick: () => saveSvg(onPaper(), name) }, 'Save as SVG'),
        element('button', { type: 'button', id: `${name}-png`, 'aria-label': `Save as PNG: growth with ${axis}`,
                            onclick: () => savePng(onPaper(), name) }, 'Save as PNG')),
      element('div', { class: 'scroll', tabindex: '0', role: 'region',
                       'aria-label': `Growth with ${axis}` },
        growthPicture(growths, axis, isDark() ? darkInk : lightInk)),
      growthTable(growths));
  }));
}

function save(blob, name) {
  const link = element('a', { href: URL.createObjectURL(blob), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}

const svgText = (picture) => new XMLSerializer().serializeToString(picture);

function saveSvg(picture, name) {
  save(new Blob([svgText(picture)], { type: 'image/svg+xml' }), `bench-${name}.svg`);
}

function savePng(picture, name) {
  const enlarged = 3; // 288 pixels to the inch where CSS has 96
  const image = new Image();
  image.onload = () => {
    const canvas = element('canvas', { width: enlarged * picture.getAttribute('width'),
                                       height: enlarged * picture.getAttribute('height') });
    canvas.getContext('2d').drawImage(image, 0, 0, canvas.width, canvas.height);
    canvas.toBlob((blob) => save(blob, `bench-${name}.png`), 'image/png');
  };
  image.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(svgText(picture))}`;
}

function choice(id, label, options, chosen, choose) {
  return element('label', {}, `${label} `, element('select', {
    id, onchange: (event) => { choose(event.target.value); drawPoints(); },
  }, options.map(([value, text]) =>
    element('option', { value, selected: value === chosen }, text))));
}

function machineWords({ version, gl, embree, machine, arguments: flags }) {
  return facts([['shadowproof', version], ['Driver', `${gl.renderer}, ${gl.version}`],
                ['Embree', embree], ['Processor', `${machine.processor}, ${machine.cores} cores`],
                ['System', machine.system], ['Flags', flags.join(' ')]]);
}

function leftOutList(run) {
  if (run.left_out.length === 0) return null;
  return element('details', {}, element('summary', {}, `Left out: ${run.left_out.length}`),
    element('ul', {}, run.left_out.map(({ scene, technique, settings, why }) =>
      element('li', {}, `${[scene, technique, settingsWords(settings)].filter(Boolean)
        .join(' ')}: ${why}`))));
}

/** The plot of a scene at a time, with its controls. */
function plotSection(run, scenes) {
  const kinds = errorKinds.filter((kind) => run.points.some((point) => kind.of(point) !== null));
  return [
    element('p', {}, 'How wrong each technique is, and what it costs. A bar is the 95 % interval ' +
      'of the median; dots are the range of samples too few for one. The broken line is the front: at each time, the least error that a technique ' +
      'has by then. Times compare points of one run with each other.'),
    element('div', { class: 'toolbar' },
      choice('scene', 'Scene', scenes.map((name) => [name, name]), state.scene,
             (name) => { state.scene = name; }),
      choice('kind', 'Error', kinds.map(({ id, words: text }) => [id, text]), state.kind.id,
             (id) => { state.kind = errorKinds.find((kind) => kind.id === id); }),
      element('button', { type: 'button', id: 'svg',
                          onclick: () => saveSvg(pointsPicture(lightInk), state.scene) }, 'Save as SVG'),
      element('button', { type: 'button', id: 'png',
                          onclick: () => savePng(pointsPicture(lightInk), state.scene) }, 'Save as PNG')),
    element('p', { class: 'quiet keys-line' }, 'Keys: Tab to the plot, arrows from point to point, ' +
      'Home, End, Enter for its commands.'),
    element('div', { id: 'plot', class: 'bench-plot' }),
    element('p', { id: 'said-below', class: 'quiet' }),
    element('section', { id: 'chosen', 'aria-live': 'polite', 'aria-label': 'Chosen point' }),
    element('details', {}, element('summary', {}, 'As a table'),
      element('div', { id: 'table', class: 'scroll', tabindex: '0', role: 'region',
                       'aria-label': 'Points' }))];
}

function showRun() {
  const { run, older } = state;
  const scenes = scenesOf(run);
  [state.scene] = scenes;
  found('main').replaceChildren(...[
    element('h1', {}, scenes.length > 0 ? 'Error against run time' : 'Growth of run time'),
    run.finished ? null : alertLine('This run was stopped before its end.'),
    ...(scenes.length > 0 ? plotSection(run, scenes) : []),
    element('div', { id: 'growth' }),
    leftOutList(run),
    element('h2', {}, 'Measured by'), machineWords(run),
    older ? element('h2', {}, 'The older run') : null,
    older ? machineWords(older) : null].filter(Boolean));
  draw();
}

window.shadowproofBench = (run, older) => {
  state.run = run;
  state.older = older;
  showRun();
};
found('theme').addEventListener('click', () => {
  document.documentElement.dataset.theme = isDark() ? 'light' : 'dark';
  draw();
});
matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => draw());
window.addEventListener('beforeprint', () => {
  document.documentElement.dataset.theme = 'light';
  draw();
});
