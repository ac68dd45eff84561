// Places for the labels of a plot, which do not overlap. Numbers alone: no element is made here.

const plotFont = 11; // pixels; letters of a monospaced font are 0.61 of that wide
const textWidth = (words) => 0.61 * plotFont * words.length;

const overlap = (a, b) => a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;

/**
 * Places for labels of marks: { x, y, leader } of the text's start and baseline, or null where none
 * is free. `marks`: { x, y, text }. `bars`: boxes that a label keeps off where it can.
 */
function placeLabels(marks, box, bars = []) {
  const boxes = marks.map(({ x, y }) =>
    ({ left: x - 7, right: x + 7, top: y - 7, bottom: y + 7 }));
  const shifts = Array.from({ length: 17 }, (_, k) => (k % 2 ? -13 : 13) * ((k + 1) >> 1));
  const placed = ({ x, y, text }, avoided) => {
    const width = textWidth(text);
    for (const shift of shifts)
      for (const left of [x + 11, x - 11 - width, x - width / 2]) {
        if (left === x - width / 2 && shift === 0) continue; // on the mark itself
        const place = { left, right: left + width, top: y + shift - 6, bottom: y + shift + 6 };
        const inside = place.left >= box.left && place.right <= box.right &&
                       place.top >= box.top && place.bottom <= box.bottom;
        if (inside && !avoided.some((other) => overlap(place, other))) return { place, shift };
      }
    return null;
  };
  return marks.map((one) => {
    const found = placed(one, [...boxes, ...bars]) ?? placed(one, boxes);
    if (found === null) return null;
    const { place, shift } = found;
    boxes.push(place);
    const end = Math.max(place.left, Math.min(place.right, one.x));
    return { x: place.left, y: one.y + shift + 4,
             leader: Math.abs(shift) < 13 ? null
               : [one.x, one.y, end, one.y + shift - Math.sign(shift) * 6] };
  });
}
