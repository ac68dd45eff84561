// One pixel: both values, its cause, its colours, and what its family's section shows of it.

const valueChip = (label, value, color) => element('span', { class: 'value' },
  `${label} `, swatch(color), element('b', {}, value));

const grayOf = (visibility) => `rgb(${visibility},${visibility},${visibility})`;

/** Truth and claim side by side, and the cause. */
function verdictLine({ visibility, claim, share }, pixel, cause) {
  return element('p', { class: 'values' },
    visibility && valueChip('truth', visibilityNames[visibility[pixel]],
                            grayOf(visibility[pixel])),
    claim && valueChip('claim', claimWords({ claim, share }, pixel), grayOf(claim[pixel])),
    cause ? element('span', { class: 'value' }, 'cause ', swatch(causeLegend(cause).color),
                    element('b', {}, cause)) : null);
}

/** Throws an Error that names what could not be loaded, if any. */
function requireData({ scene, id, sceneFile, cellFile, sceneBlocks, blocks, problems }) {
  if (!sceneFile || !cellFile) throw new Error(problems[0]);
  for (const [file, arrays] of [[`${scene.folder}/scene.js`, sceneBlocks], [`${id}.cell.js`, blocks]])
    for (const [name, array] of Object.entries(arrays))
      if (!array) throw new Error(problems.find((text) => text.startsWith(`${file}: block ${name} `)));
}

function differingPixel(page, pixel) {
  requireData(page.opened);
  const { name, meaning } = received.legend.causes[page.opened.causes[pixel]];
  // First, as it fails where the evidence cannot be shown.
  const evidence = familyOf(page.opened.cell).differing(page, pixel);
  return [
    verdictLine(page.opened, pixel, name),
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
  const agrees = visibility[pixel] === claim[pixel] && causes[pixel] === noDifference;
  return [
    verdictLine(opened, pixel, null),
    agrees ? element('p', { class: 'why' }, isUnpredicted(opened.colorVerdict?.[pixel])
      ? 'Truth and claim agree here on visibility.' : 'Truth and claim agree here.')
           : alertLine('Truth and claim differ here, and the results have no cause for it.'),
    ...pixelColors(opened, pixel),
    ...familyOf(opened.cell).agreeing(page, pixel)];
}

function pixelBody(page, x, y) {
  const { opened } = page;
  const pixel = y * opened.width + x;
  if (!opened.causes || opened.causes[pixel] === noDifference) return otherPixel(page, pixel);
  try {
    return differingPixel(page, pixel);
  } catch (error) {
    return [alertLine(`This pixel differs, and its evidence cannot be shown: ${error.message}.`),
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
  familyOf(opened.cell).shown(page);
  announce(hoverWords(opened, [x, y]));
}
