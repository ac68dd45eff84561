// The state of the open cell's page, and what buttons and keys do to it.

let openPage = null; // the cell's page that is shown, or null
let timesLeft = 0;

function leaveCell() {
  ++timesLeft;
  if (!openPage) return;
  clearInterval(openPage.blinking);
  openPage.resizes.disconnect();
  openPage = null;
}

/** Differing pixels, or those of one cause. */
function pixelsToStep({ opened, look }) {
  if (!look.cause) return opened.differing;
  const wanted = received.legend.causes.findIndex(({ name }) => name === look.cause);
  return opened.differing.filter((pixel) => opened.causes[pixel] === wanted);
}

function makePage(opened, pictures, look) {
  const page = { opened, pictures, look, blinking: null, painting: false };
  const canvases = () => [...page.stage.querySelectorAll('canvas')];

  page.paint = () => {
    page.painting = false;
    for (const canvas of canvases()) {
      paintPane(canvas, canvas.dataset.picture ?? null, look, opened, pictures);
      canvas.style.touchAction = look.zoom === null ? 'pan-x pan-y' : 'none';
    }
  };
  /** Paints at the next frame and keeps the link in step. */
  page.repaint = () => {
    if (!page.painting) requestAnimationFrame(page.paint);
    page.painting = true;
    const range = found('at');
    if (range && Number(range.value) !== look.at) range.value = look.at;
    rememberLink(linkOf(opened, look));
  };
  /** Builds the tools and panes again, for another view. */
  page.update = () => {
    const focused = document.activeElement?.id;
    page.tools.replaceChildren(viewButtons(page), zoomButtons(page), stepControls(page) ?? '');
    page.compare.replaceChildren(compareControls(page) ?? '');
    page.stage.className = look.view === 'side' ? 'stage side' : 'stage';
    page.stage.replaceChildren(...(look.view === 'side'
      ? picturesOf(opened.cell).map((name) => pane(page, name)) : [pane(page, null)]));
    if (focused) found(focused)?.focus();
    page.repaint();
  };
  page.setView = (view) => {
    look.view = view;
    if (view !== 'toggle') page.stopBlinking();
    page.update();
    announce(viewTitles[view]);
  };
  page.flip = () => {
    look.flipped = !look.flipped;
    const title = page.stage.querySelector('figcaption b');
    if (title) title.textContent = comparedTitle(look, opened.cell);
    page.repaint();
  };
  page.stopBlinking = () => {
    clearInterval(page.blinking);
    page.blinking = null;
  };
  page.blink = () => {
    if (look.view !== 'toggle') return;
    if (page.blinking !== null) page.stopBlinking();
    else page.blinking = setInterval(page.flip, 500);
    page.update();
  };
  page.choose = (side) => {
    const names = picturesOf(opened.cell);
    look.of[side] = names[(names.indexOf(look.of[side]) + 1) % names.length];
    page.update();
    announce(titleOf(opened.cell, look.of[side]));
  };
  page.shift = (by) => {
    look.at = hundredths(Math.min(1, Math.max(0, look.at + by)));
    page.repaint();
  };
  page.zoom = (steps) => {
    const [canvas] = canvases();
    if (canvas) zoomStep(look, opened, canvas, steps, look.zoom === null && look.pixel
      ? look.pixel.map((value) => value + 0.5) : undefined);
    page.repaint();
  };
  page.fit = () => {
    look.zoom = null;
    page.repaint();
  };
  page.zoomOnPixel = () => {
    look.zoom = 32;
    look.centre = look.pixel ? look.pixel.map((value) => value + 0.5)
                             : [opened.width / 2, opened.height / 2];
    page.repaint();
  };
  page.pan = (dx, dy) => {
    const [canvas] = canvases();
    if (look.zoom === null || !canvas) return;
    const step = canvas.clientWidth / look.zoom / 6;
    look.centre = [look.centre[0] + dx * step, look.centre[1] + dy * step];
    keepInside(look, opened);
    page.repaint();
  };
  page.hover = (point) => { page.readout.textContent = hoverWords(opened, point); };
  page.inspect = (x, y) => {
    look.pixel = [x, y];
    page.bringIntoSight();
    showPixel(page);
    page.repaint();
  };
  page.bringIntoSight = () => {
    const [canvas] = canvases();
    if (look.zoom === null || !canvas) return;
    const { shown } = paneView(canvas, look, opened);
    const [x, y] = look.pixel;
    if (x < shown.left + 1 || x >= shown.right - 1 || y < shown.top + 1 || y >= shown.bottom - 1)
      look.centre = [x + 0.5, y + 0.5];
  };
  page.moveBy = (dx, dy) => {
    const [x, y] = look.pixel ?? [opened.width >> 1, opened.height >> 1];
    if (isInside([x + dx, y + dy], opened)) page.inspect(x + dx, y + dy);
  };
  page.step = (by) => {
    const pixels = pixelsToStep(page);
    if (pixels.length === 0) return;
    const from = look.pixel ? look.pixel[1] * opened.width + look.pixel[0] : -1;
    const after = pixels.findIndex((pixel) => (by > 0 ? pixel > from : pixel >= from));
    const at = (by > 0 ? (after < 0 ? 0 : after)
                       : (after < 0 ? pixels.length : after) - 1 + pixels.length) % pixels.length;
    page.inspect(pixels[at] % opened.width, Math.floor(pixels[at] / opened.width));
  };
  page.stepToFirst = () => {
    const { first } = opened.cell;
    const [pixel] = pixelsToStep(page);
    if (!look.cause && first) page.inspect(first.x, first.y);
    else if (pixel !== undefined)
      page.inspect(pixel % opened.width, Math.floor(pixel / opened.width));
  };
  page.setCause = (name) => {
    look.cause = name;
    page.update();
    announce(name ? `Stepping through ${name}` : 'Stepping through every cause');
  };
  page.nextCause = () => {
    const names = ['', ...causesOf(opened.cell).map(([name]) => name)];
    page.setCause(names[(names.indexOf(look.cause) + 1) % names.length]);
  };
  return page;
}

/** The page of an opened cell: its state and its elements. */
async function filledPage(results, opened, params) {
  const pictures = await loadedPictures(opened);
  const look = lookOf(params, opened);
  const page = makePage(opened, pictures, look);
  page.tools = element('div', { class: 'toolbar' });
  page.compare = element('div', {});
  page.stage = element('div', { class: 'stage' });
  page.readout = element('p', { class: 'readout', 'aria-hidden': 'true' }, ' ');
  page.inspector = element('section', { class: 'inspector', 'aria-label': 'Inspected pixel',
                                        id: 'inspector', tabindex: '-1' });
  return { page, body: element('div', { class: 'cell-body' },
    element('div', { class: 'look' }, page.tools, page.compare, page.stage, page.readout,
            legends(page), filteringSection(opened.scene, opened.cell) ?? '',
            howMade(results, opened)),
    page.inspector) };
}

async function showCell(results, scene, cell, params) {
  document.title = `${scene.name} / ${cell.name}: ${verdicts[verdictOf(cell)].words}`;
  const main = found('main');
  const head = cellHead(results, scene, cell);
  if (cell.error) {
    main.replaceChildren(head, alertLine(cell.error), howMade(results, { scene, cell }));
    return;
  }
  const before = timesLeft;
  main.replaceChildren(head, element('p', { class: 'quiet' }, 'Loading…'));
  const opened = await openCell(scene, cell);
  const { page, body } = await filledPage(results, opened, params);
  if (timesLeft !== before) return; // left while it loaded
  openPage = page;
  main.replaceChildren(head, ...warnings(opened), body);
  page.update();
  showPixel(page);
  page.resizes = new ResizeObserver(() => {
    page.repaint();
    familyOf(opened.cell).shown(page);
  });
  page.resizes.observe(page.stage);
}
