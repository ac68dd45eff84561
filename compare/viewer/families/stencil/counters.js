// Stored counters: as numbers, colours, a picture and a table.

/** A stored counter as the signed count that it stands for: 255 of 8 bits is -1. */
const asCount = (stored, bits) => (stored >= 2 ** (bits - 1) ? stored - 2 ** bits : stored);

/** The blocks of the counters, null where they could not be loaded, and the bits of each. */
const countersOf = ({ blocks, cellFile }) => ({
  predicted: blocks?.predicted ?? null, readBack: blocks?.read_back ?? null,
  faces: blocks?.faces ?? null, bits: cellFile?.counting?.bits ?? 8,
});

/** "255 (-1)" of 8 bits. */
const counterWords = (stored, bits) => {
  const count = asCount(stored, bits);
  return count < 0 ? `${stored} (${count})` : String(stored);
};

/** Colours of a signed counter: none dark, positive from blue to yellow, negative red. */
function counterColor(count) {
  const up = [[32, 92, 150], [76, 150, 190], [130, 190, 180], [190, 215, 140], [240, 228, 66]];
  const down = [[213, 94, 0], [160, 52, 60], [204, 121, 167], [235, 180, 210]];
  if (count === 0) return [22, 22, 28];
  const colors = count > 0 ? up : down;
  return colors[Math.min(Math.abs(count), colors.length) - 1];
}

const counterPicture = (values, width, height, bits) =>
  drawnPicture(width, height, values, (value) => counterColor(asCount(value, bits)));

/** Faces at a pixel from which on the next picture tells no more apart. */
const mostFaces = 84;

/**
 * The dimmed claim, overlaid with the number of volume faces that nothing hides at each pixel. Full
 * colour is the largest number at any pixel, at least six.
 */
function volumePicture(faces, claim, width, height) {
  const full = [0xff, 0xc0, 0x40];
  let most = 6;
  for (const count of faces) if (count > most) most = count;
  most = Math.min(mostFaces, most);
  const kinds = new Uint16Array(faces.length);
  for (let i = 0; i < kinds.length; ++i) kinds[i] = claim[i] << 8 | Math.min(faces[i], most);
  return drawnPicture(width, height, kinds, (kind) => dimmedColor(kind >> 8).map((value, k) =>
    Math.min(255, value + Math.trunc(full[k] * (kind & 255) / most))));
}

const countersShown = 12;

function counterRows(opened) {
  const { predicted, readBack, bits } = countersOf(opened);
  const before = predicted && talliedAll(predicted);
  const after = readBack && talliedAll(readBack);
  const values = [...new Set([...before?.keys() ?? [], ...after?.keys() ?? []])]
    .sort((a, b) => Math.abs(asCount(a, bits)) - Math.abs(asCount(b, bits)) || a - b);
  const rows = values.slice(0, countersShown).map((value) => {
    const count = asCount(value, bits);
    return element('tr', {},
      element('th', { scope: 'row' }, swatch(`rgb(${counterColor(count).join(',')})`),
              count < 0 ? `${value} (${count})` : String(value)),
      element('td', { class: 'number' }, before ? grouped(before.get(value) ?? 0) : '?'),
      element('td', { class: 'number' }, after ? grouped(after.get(value) ?? 0) : '?'));
  });
  if (values.length > countersShown)
    rows.push(element('tr', {}, element('td', { colspan: 3 },
                                        `and ${values.length - countersShown} more values`)));
  return rows;
}
