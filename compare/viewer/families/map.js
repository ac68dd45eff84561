// The section of shadow maps: the texel that a pixel reads, and the comparison, drawn along the ray
// from the light.

/** As many digits as a float has without its last. */
const short = (length) => String(Number(length.toPrecision(6)));

/**
 * The light on the left, far off; what the texel stores, the same with the bias, and the pixel's
 * point, as close as they are.
 */
function comparisonDrawing({ stored, bias, own }) {
  const least = Math.min(stored, stored + bias, own);
  const most = Math.max(stored, stored + bias, own);
  const room = Math.max(most - least, 1e-6 * most, 1e-30);
  const place = (length) => 160 + 380 * (length - least) / room;
  const svg = (name, attributes, ...children) => {
    const node = document.createElementNS('http://www.w3.org/2000/svg', name);
    for (const [key, value] of Object.entries(attributes)) node.setAttribute(key, value);
    node.append(...children);
    return node;
  };
  const mark = (length, words, below, kind) => [
    svg('line', { x1: place(length), x2: place(length), y1: below ? 50 : 24, y2: below ? 76 : 50,
                  class: kind }),
    svg('text', { x: place(length), y: below ? 92 : 18, 'text-anchor': 'middle' }, words)];
  const title = svg('title', {}, 'From the light to the surface: what the texel stores, the ' +
                    'bias, and the point that is compared');
  return svg('svg', { id: 'comparison', viewBox: '0 0 600 100', role: 'img', class: 'comparison' },
    title,
    svg('circle', { cx: 40, cy: 50, r: 6, class: 'light' }),
    svg('line', { x1: 40, x2: 120, y1: 50, y2: 50, class: 'ray skipped' }),
    svg('line', { x1: 120, x2: 580, y1: 50, y2: 50, class: 'ray' }),
    svg('line', { x1: place(stored), x2: place(stored + bias), y1: 50, y2: 50, class: 'bias' }),
    svg('text', { x: 40, y: 76, 'text-anchor': 'middle' }, 'light'),
    ...mark(stored, 'texel', false, 'stored'), ...mark(own, 'own point', true, 'own'));
}

/** What the map holds for one of the pixels that differ, by its rank among them. */
function mapRecord({ blocks, cellFile }, rank) {
  if (!blocks?.map_asked || !blocks.map_asked[rank]) return null;
  return { face: blocks.map_face[rank], x: blocks.map_x[rank], y: blocks.map_y[rank],
           stored: blocks.map_stored[rank], own: blocks.map_own[rank],
           shown: blocks.map_shown[rank], bias: cellFile.map.bias, size: cellFile.map.size,
           value: cellFile.map.value, slopeBias: cellFile.map.slope_bias ?? 0, lit: blocks.map_lit[rank],
           filter: cellFile.map.filter ?? 0, average: cellFile.map.average };
}

/** What the block of texels around the point's own one says. */
function filterWords({ filter, average, lit }) {
  if (filter === 0) return '';
  const block = `Of its own texel. The claim averages ${filter} × ${filter} texels`;
  return element('p', { id: 'averaged' }, average === 'values'
    ? `${block}: their values, which are compared once.`
    : `${block}: ${lit} of ${filter * filter} comparisons find light.`);
}

addFamily('map', {
  blocks: (pixels, differing) => ({
    map_asked: differing, map_face: differing, map_x: differing, map_y: differing,
    map_stored: differing, map_own: differing, map_shown: differing, map_lit: differing,
  }),
  pictures: { texels: 'Texels asked' },
  differing({ opened }, pixel) {
    const record = mapRecord(opened, rankOf(opened.differing, pixel));
    if (!record) return [element('p', { class: 'quiet' }, 'The map is not asked at this pixel.')];
    const inFront = record.stored + record.bias < record.own;
    return [
      element('h3', {}, 'Comparison'),
      comparisonDrawing(record),
      element('p', { id: 'compared' },
        `${short(record.stored)} + ${short(record.bias)} is ` +
        `${inFront ? 'less than' : 'not less than'} ${short(record.own)}: ` +
        `${inFront ? 'shadowed' : 'lit'}.`),
      filterWords(record),
      facts([
        ['Texel', `(${record.x}, ${record.y}) of face ${record.face}, ${record.size} a side`],
        ['Stored', `${short(record.stored)} (${record.value})`],
        ['Bias', short(record.bias)],
        ...(record.slopeBias > 0 ? [['Slope bias', `${record.slopeBias}, in what is stored`]] : []),
        ['Own point', short(record.own)],
        ['Texel shows', record.shown === noTriangle ? 'nothing' : `triangle ${record.shown}`]])];
  },
});
