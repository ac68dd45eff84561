// Pointer and wheel on the panes. All panes share one look (zoom and place), so that they move
// together.

/** Zooms to `zoom`, and keeps the picture point `around` where it is on the screen. */
function zoomTo(look, opened, pane, zoom, around = visibleMiddle(look, opened)) {
  const fit = fitZoom(pane, opened);
  const before = look.zoom ?? fit;
  const middle = visibleMiddle(look, opened);
  if (zoom <= fit * 1.001) {
    look.zoom = null;
    look.centre = [opened.width / 2, opened.height / 2];
    return;
  }
  look.zoom = hundredths(Math.min(zoom, zooms[zooms.length - 1]));
  look.centre = middle.map((value, i) => around[i] + (value - around[i]) * before / look.zoom);
  keepInside(look, opened);
}

/** What a link holds, so that it restores just what was seen. */
const hundredths = (value) => Math.round(value * 100) / 100;

function keepInside(look, opened) {
  look.centre = [opened.width, opened.height].map((most, i) =>
    hundredths(Math.min(Math.max(look.centre[i], 0), most)));
}

function zoomStep(look, opened, pane, steps, around) {
  const now = look.zoom ?? fitZoom(pane, opened);
  const next = steps > 0 ? zooms.find((zoom) => zoom > now * 1.01)
                         : [...zooms].reverse().find((zoom) => zoom < now * 0.99);
  zoomTo(look, opened, pane, next ?? now, around);
}

/** Picture point under a pointer event. */
function pointUnder(event, pane, look, opened) {
  const box = pane.getBoundingClientRect();
  const view = paneView(pane, look, opened);
  return [view.fromX(event.clientX - box.left), view.fromY(event.clientY - box.top)];
}

const isInside = ([x, y], opened) => x >= 0 && y >= 0 && x < opened.width && y < opened.height;

/** `changed()` after each change of the look, `inspect(x, y)` on a click, `hover(point)` else. */
function listenToPane(pane, look, opened, { changed, inspect, hover }) {
  const down = new Map(); // pointers on the pane
  let moved = 0;
  let spread = 0;
  const distance = () => {
    const [a, b] = [...down.values()];
    return Math.hypot(a.clientX - b.clientX, a.clientY - b.clientY);
  };
  pane.addEventListener('wheel', (event) => {
    event.preventDefault();
    zoomStep(look, opened, pane, event.deltaY < 0 ? 1 : -1, pointUnder(event, pane, look, opened));
    changed();
  }, { passive: false });
  pane.addEventListener('pointerdown', (event) => {
    down.set(event.pointerId, event);
    moved = 0;
    if (down.size === 2) spread = distance();
    if (look.zoom !== null || sliderGrabbed(event, pane, look))
      pane.setPointerCapture(event.pointerId);
  });
  pane.addEventListener('pointermove', (event) => {
    const before = down.get(event.pointerId);
    if (!before) {
      hover(pointUnder(event, pane, look, opened));
      return;
    }
    const [dx, dy] = [event.clientX - before.clientX, event.clientY - before.clientY];
    moved += Math.abs(dx) + Math.abs(dy);
    down.set(event.pointerId, event);
    if (down.size === 2) {
      const wider = distance();
      if (spread > 0)
        zoomTo(look, opened, pane, (look.zoom ?? fitZoom(pane, opened)) * wider / spread,
               pointUnder(event, pane, look, opened));
      spread = wider;
    } else if (sliderGrabbed(before, pane, look)) {
      const box = pane.getBoundingClientRect();
      look.at = hundredths(Math.min(1, Math.max(0, (event.clientX - box.left) / box.width)));
    } else if (look.zoom !== null) {
      look.centre = [look.centre[0] - dx / look.zoom, look.centre[1] - dy / look.zoom];
      keepInside(look, opened);
    }
    changed();
  });
  const up = (event) => {
    const was = down.delete(event.pointerId);
    if (!was || event.type !== 'pointerup' || moved > 6) return;
    const point = pointUnder(event, pane, look, opened);
    if (isInside(point, opened)) inspect(...point.map(Math.floor));
  };
  pane.addEventListener('pointerup', up);
  pane.addEventListener('pointercancel', up);
  pane.addEventListener('pointerleave', () => hover(null));
}

/** Whether a pointer is on the line between the two pictures of the slide view. */
function sliderGrabbed(event, pane, look) {
  if (look.view !== 'slide' || pane.dataset.picture) return false;
  const box = pane.getBoundingClientRect();
  return Math.abs(event.clientX - box.left - look.at * box.width) < 14;
}
