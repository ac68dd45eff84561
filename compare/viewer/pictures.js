// The pictures of a cell: panes that zoom and pan as one, or two in one pane that slide, blend or
// toggle. They are four of every claim, three of colours where it has some, and those of its family.
// A pane is a canvas that shows the picture's pixels as they are, by nearest sampling.

const pictureNames = ['truth', 'claim', 'difference', 'cause'];
const colorPictureNames = ['true_color', 'claimed_color', 'color_error'];
const pictureTitles = { true_color: 'True colour', claimed_color: 'Claimed colour',
                        color_error: 'Colour error', truth: 'Truth', claim: 'Claim',
                        difference: 'Difference', cause: 'Cause' };

/** The names of a cell's pictures, colours first. */
const picturesOf = (cell) =>
  [...(cell.color ? colorPictureNames : []), ...pictureNames,
   ...Object.keys(familyOf(cell).pictures)];

const titleOf = (cell, name) => pictureTitles[name] ?? familyOf(cell).pictures[name];

/** The two that are compared until others are chosen. */
const comparedFirst = (cell) =>
  (cell.color ? ['true_color', 'claimed_color'] : ['truth', 'claim']);

const zooms = [0.25, 0.5, 1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64, 96];
const valueNames = { 0: 'none', 64: 'dark', [partlyLit]: 'part', 255: 'lit' };

/** A PNG of the report: { image } or { problem } in words. */
function loadedImage(path, width, height) {
  return new Promise((resolve) => {
    const image = new Image();
    image.onload = () => resolve(image.naturalWidth === width && image.naturalHeight === height
      ? { image }
      : { problem: `${path} is ${image.naturalWidth}×${image.naturalHeight} pixels; ` +
                   `the results are of ${width}×${height}` });
    image.onerror = () => resolve({ problem: `${path} is missing or damaged` });
    image.src = path;
  });
}

/** A picture's value at one pixel, as a word that fits into the pixel. */
function pixelWord(opened, name, pixel) {
  const { visibility, claim, share, causes, trueColor, claimedColor, colorVerdict } = opened;
  const family = familyOf(opened.cell);
  if (name in family.pictures) return family.word(opened, name, pixel);
  switch (name) {
  case 'true_color': return trueColor ? bytesAt(trueColor, pixel).join(' ') : '';
  case 'claimed_color': return claimedColor ? bytesAt(claimedColor, pixel).join(' ') : '';
  case 'color_error': return !colorVerdict ? ''
    : isUnpredicted(colorVerdict[pixel]) ? 'unpredicted'
    : colorVerdict[pixel] === colorBeyond ? 'beyond' : '';
  case 'truth': return visibility ? valueNames[visibility[pixel]] : '';
  case 'claim': return !claim ? ''
    : claim[pixel] === partlyLit && share ? `${Math.round(100 * share[pixel])}%`
    : valueNames[claim[pixel]];
  case 'cause': return !causes || causes[pixel] === noDifference ? ''
    : received.legend.causes[causes[pixel]].name;
  default: return !visibility || !claim || claim[pixel] === visibility[pixel] ? ''
    : received.legend.contradictions[contradictionOf(visibility[pixel], claim[pixel])].name;
  }
}

const isDark = ([red, green, blue]) => 0.3 * red + 0.59 * green + 0.11 * blue < 120;
const colorBytes = (color) => [1, 3, 5].map((at) => parseInt(color.slice(at, at + 2), 16));
/** That of a claim under marks. */
const dimmedColor = (claim) => colorBytes(received.legend.dimmed[claim]);

/** Black or white, whichever is read on the pixel's own colour. */
function pixelInk(opened, name, pixel) {
  const { visibility, claim, causes, trueColor, claimedColor, colorVerdict } = opened;
  const family = familyOf(opened.cell);
  const colors = {
    true_color: () => bytesAt(trueColor, pixel),
    claimed_color: () => bytesAt(claimedColor, pixel),
    color_error: () => colorBytes(
      causeLegend(isUnpredicted(colorVerdict[pixel]) ? 'unexplained' : 'shading').color),
    truth: () => [visibility[pixel], visibility[pixel], visibility[pixel]],
    claim: () => [claim[pixel], claim[pixel], claim[pixel]],
    cause: () => colorBytes(received.legend.causes[causes[pixel]].color),
    difference: () => colorBytes(
      received.legend.contradictions[contradictionOf(visibility[pixel], claim[pixel])].color),
  };
  const color = name in family.pictures ? family.color(opened, name, pixel) : colors[name]();
  return isDark(color) ? '#ffffff' : '#000000';
}

/** A canvas whose bytes are set by `paint(data)`: red, green, blue and 255 of each pixel. */
function paintedPicture(width, height, paint) {
  const canvas = element('canvas', { width, height });
  const context = canvas.getContext('2d');
  const image = context.createImageData(width, height);
  image.data.fill(255);
  paint(image.data);
  context.putImageData(image, 0, 0);
  return canvas;
}

/** Colours, three bytes for each pixel, as a canvas. */
const colorPicture = (colors, width, height) => paintedPicture(width, height, (data) => {
  for (let i = 0, from = 0; i < data.length; i += 4, from += 3) {
    data[i] = colors[from];
    data[i + 1] = colors[from + 1];
    data[i + 2] = colors[from + 2];
  }
});

/** A number for each pixel as a canvas; `colorOf` says a number's colour: [red, green, blue]. */
const drawnPicture = (width, height, numbers, colorOf) => paintedPicture(width, height, (data) => {
  const pixels = new Uint32Array(data.buffer);
  const colors = new Map(); // a pixel's four bytes as they lie, in one number
  let last = -1;
  let color = 0;
  for (let i = 0; i < pixels.length; ++i) {
    if (numbers[i] !== last) {
      last = numbers[i];
      color = colors.get(last);
      if (color === undefined) {
        [color] = new Uint32Array(Uint8Array.from([...colorOf(last), 255]).buffer);
        colors.set(last, color);
      }
    }
    pixels[i] = color;
  }
});

const lastErrorShade = 45;
/** Black for half a step of 1/255 and less, then five shades an octave up to all 255 steps. */
const errorShade = (error) =>
  (error > 0.5 ? Math.min(lastErrorShade, Math.round(5 * (1 + Math.log2(error)))) : 0);

/** How far colours are off, lighter for further; what is beyond its bound, or unpredicted, has its cause's colour. */
function errorPicture(opened) {
  const { colorVerdict, width, height } = opened;
  const marks = [dimmedColor(0), ...['shading', 'unexplained'].map((cause) =>
    colorBytes(causeLegend(cause).color))];
  const [unjudged, beyond, unpredicted] = [0, 1, 2].map((mark) => lastErrorShade + 1 + mark);
  const shades = colorVerdict.map((verdict, pixel) => (
    verdict === colorNotJudged ? unjudged : verdict === colorBeyond ? beyond
      : isUnpredicted(verdict) ? unpredicted : errorShade(errorAt(opened, pixel))));
  return drawnPicture(width, height, shades, (shade) => marks[shade - unjudged] ??
    [0xff, 0xf4, 0xc8].map((value) => Math.trunc(value * shade / lastErrorShade)));
}

/**
 * The colours of a cell that has some, drawn: [name, canvas or null, the block that is lacking then,
 * and whether that is the scene's].
 */
function drawnColors(opened) {
  const { cell, trueColor, claimedColor, colorVerdict, width, height } = opened;
  if (!cell.color) return [];
  const picture = (colors) => colors && colorPicture(colors, width, height);
  const right = cell.color.filter ? 'mean_color' : 'color';
  return [
    ['true_color', picture(trueColor), right, true],
    ['claimed_color', picture(claimedColor), 'color', false],
    ['color_error', trueColor && claimedColor && colorVerdict && errorPicture(opened),
     !trueColor ? right : claimedColor ? 'color_verdict' : 'color', !trueColor]];
}

async function loadedPictures(opened) {
  const { scene, cell, width, height } = opened;
  const paths = { ...cell.images, truth: scene.images?.truth };
  const pictures = {};
  const drawn = [...drawnColors(opened), ...familyOf(cell).drawn(opened)];
  const fromFiles = picturesOf(cell).filter((name) => !drawn.some(([other]) => other === name));
  await Promise.all(fromFiles.map(async (name) => {
    pictures[name] = paths[name] ? await loadedImage(paths[name], width, height)
      : { problem: `the results name no picture of the ${titleOf(cell, name).toLowerCase()}` };
  }));
  for (const [name, image, block, isOfScene = false] of drawn) {
    const file = isOfScene ? `${scene.folder}/scene.js` : `${opened.id}.cell.js`;
    pictures[name] = image ? { image }
      : { problem: opened.problems.find((text) => text.startsWith(`${file}: block ${block} `)) ??
                   `${file} is missing or damaged` };
  }
  return pictures;
}

/** CSS pixels per picture pixel at which a pane shows the whole picture. */
const fitZoom = (pane, opened) =>
  Math.min(pane.clientWidth / opened.width, pane.clientHeight / opened.height) || 1;

function visibleMiddle(look, opened) {
  return look.zoom === null ? [opened.width / 2, opened.height / 2] : look.centre;
}

/** Draws one picture into a pane's canvas; `alpha` and `clip` (0..1 from, to) are for comparing. */
function paintPicture(context, picture, view, { alpha = 1, clip = [0, 1] } = {}) {
  const { canvas } = context;
  if (!picture.image) return;
  context.save();
  context.beginPath();
  context.rect(clip[0] * canvas.width, 0, (clip[1] - clip[0]) * canvas.width, canvas.height);
  context.clip();
  context.globalAlpha = alpha;
  context.imageSmoothingEnabled = view.scale < 1;
  context.imageSmoothingQuality = 'high';
  const { left, top, right, bottom } = view.shown;
  if (right > left && bottom > top)
    context.drawImage(picture.image, left, top, right - left, bottom - top,
                      view.toX(left), view.toY(top), (right - left) * view.scale,
                      (bottom - top) * view.scale);
  context.restore();
}

/** From picture to canvas: { scale, toX, toY, shown: the part of the picture in sight }. */
function paneView(canvas, look, opened) {
  const ratio = window.devicePixelRatio || 1;
  const zoom = look.zoom ?? fitZoom(canvas, opened);
  const [x, y] = visibleMiddle(look, opened);
  const scale = zoom * ratio;
  const left = x - canvas.width / 2 / scale;
  const top = y - canvas.height / 2 / scale;
  return {
    scale, zoom, ratio,
    toX: (at) => (at - left) * scale,
    toY: (at) => (at - top) * scale,
    fromX: (at) => left + at * ratio / scale,
    fromY: (at) => top + at * ratio / scale,
    shown: { left: Math.max(0, Math.floor(left)), top: Math.max(0, Math.floor(top)),
             right: Math.min(opened.width, Math.ceil(left + canvas.width / scale)),
             bottom: Math.min(opened.height, Math.ceil(top + canvas.height / scale)) },
  };
}

function paintGrid(context, view) {
  if (view.zoom < 10) return;
  const { left, top, right, bottom } = view.shown;
  context.strokeStyle = 'rgba(128, 128, 140, 0.55)';
  context.lineWidth = 1;
  context.beginPath();
  for (let x = left; x <= right; ++x) {
    const at = Math.round(view.toX(x)) + 0.5;
    context.moveTo(at, view.toY(top));
    context.lineTo(at, view.toY(bottom));
  }
  for (let y = top; y <= bottom; ++y) {
    const at = Math.round(view.toY(y)) + 0.5;
    context.moveTo(view.toX(left), at);
    context.lineTo(view.toX(right), at);
  }
  context.stroke();
}

/** A word in its pixel, one line per part, as large as fits; nothing if none fits. */
function paintWord(context, view, word, x, y) {
  const lines = word.split(/[_ ]/);
  const longest = Math.max(3, ...lines.map((line) => line.length));
  const size = Math.min(13, view.zoom * 0.88 / (0.64 * longest), view.zoom * 0.74 / lines.length);
  if (size < 6) return;
  context.font = `600 ${size * view.ratio}px system-ui, sans-serif`;
  lines.forEach((line, i) => context.fillText(line, view.toX(x + 0.5),
    view.toY(y + 0.5) + (i - (lines.length - 1) / 2) * size * 1.1 * view.ratio));
}

function paintWords(context, view, opened, name) {
  if (view.zoom < 24) return;
  const { left, top, right, bottom } = view.shown;
  context.textAlign = 'center';
  context.textBaseline = 'middle';
  for (let y = top; y < bottom; ++y)
    for (let x = left; x < right; ++x) {
      const pixel = y * opened.width + x;
      const word = pixelWord(opened, name, pixel);
      if (!word) continue;
      context.fillStyle = pixelInk(opened, name, pixel);
      paintWord(context, view, word, x, y);
    }
}

/** The inspected pixel: its outline, or a ring where it is too small for one. */
function paintMark(context, view, pixel) {
  if (!pixel) return;
  const [x, y] = pixel;
  const outline = (color, width, grow) => {
    context.strokeStyle = color;
    context.lineWidth = width * view.ratio;
    context.beginPath();
    if (view.zoom >= 8)
      context.rect(view.toX(x) - grow, view.toY(y) - grow, view.scale + 2 * grow,
                   view.scale + 2 * grow);
    else
      context.arc(view.toX(x + 0.5), view.toY(y + 0.5), 9 * view.ratio, 0, 2 * Math.PI);
    context.stroke();
  };
  outline('#000000', 4.5, 1);
  outline('#ffffff', 2, 1);
}

function paintSplit(context, at, ratio) {
  const x = at * context.canvas.width;
  context.fillStyle = '#000000';
  context.fillRect(x - 2 * ratio, 0, 4 * ratio, context.canvas.height);
  context.fillStyle = '#ffffff';
  context.fillRect(x - ratio, 0, 2 * ratio, context.canvas.height);
}

/** Paints one pane: a picture of its own, or two compared as the view says. */
function paintPane(canvas, name, look, opened, pictures) {
  const ratio = window.devicePixelRatio || 1;
  canvas.width = Math.max(1, Math.round(canvas.clientWidth * ratio));
  canvas.height = Math.max(1, Math.round(canvas.clientHeight * ratio));
  const context = canvas.getContext('2d');
  const view = paneView(canvas, look, opened);
  const [left, right] = look.of;
  context.fillStyle = '#0c0c10';
  context.fillRect(0, 0, canvas.width, canvas.height);
  if (name) {
    paintPicture(context, pictures[name], view);
  } else if (look.view === 'slide') {
    paintPicture(context, pictures[left], view, { clip: [0, look.at] });
    paintPicture(context, pictures[right], view, { clip: [look.at, 1] });
  } else if (look.view === 'blend') {
    paintPicture(context, pictures[left], view);
    paintPicture(context, pictures[right], view, { alpha: look.at });
  } else {
    paintPicture(context, pictures[look.flipped ? right : left], view);
  }
  paintGrid(context, view);
  const told = name ?? (look.view === 'toggle' ? look.of[look.flipped ? 1 : 0] : null);
  if (told && pictures[told].image) paintWords(context, view, opened, told);
  if (!name && look.view === 'slide') paintSplit(context, look.at, ratio);
  paintMark(context, view, look.pixel);
}
