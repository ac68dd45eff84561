// The section of shadow maps: the texel that a pixel reads, in the map and as its rays cut the
// surface, and the comparison, drawn along the ray from the light.

/** As many digits as a float has without its last. */
const short = (length) => String(Number(length.toPrecision(6)));

/** How far along the ray a texel's footprint reaches, for each unit that it reaches across it. */
const steepness = ({ width, foot }) =>
  Math.sqrt(Math.max((Math.max(...foot) / width) ** 2 - 1, 0));

/**
 * The light on the left, far off; what the texel stores, the same with the bias, and the pixel's
 * point, as close as they are. The texel's own rays cut its footprint out of the surface, which is
 * as steep as the surface is to them.
 */
function comparisonDrawing(record) {
  const { stored, bias, own } = record;
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
                    'bias, the point that is compared, and the texel’s footprint around it');
  const half = 20;
  const lean = Math.min(half * steepness(record), 55);
  const border = (side) => svg('line', { x1: 40, y1: 50, x2: place(own) + side * lean,
                                         y2: 50 + side * half, class: 'ray border' });
  return svg('svg', { id: 'comparison', viewBox: '0 0 600 100', role: 'img', class: 'comparison' },
    title, border(-1), border(1),
    svg('line', { x1: place(own) - lean, y1: 50 - half, x2: place(own) + lean, y2: 50 + half,
                  class: 'footprint' }),
    svg('circle', { cx: 40, cy: 50, r: 6, class: 'light' }),
    svg('line', { x1: 40, x2: 120, y1: 50, y2: 50, class: 'ray skipped' }),
    svg('line', { x1: 120, x2: 580, y1: 50, y2: 50, class: 'ray' }),
    svg('line', { x1: place(stored), x2: place(stored + bias), y1: 50, y2: 50, class: 'bias' }),
    svg('text', { x: 40, y: 76, 'text-anchor': 'middle' }, 'light'),
    ...mark(stored, 'texel', false, 'stored'), ...mark(own, 'own point', true, 'own'));
}

/** OpenGL's order. */
const faceNames = ['+x', '−x', '+y', '−y', '+z', '−z'];

/** The faces of the map, brighter where a caster is nearer to the light, with the texel marked. */
function mapDrawing({ blocks, cellFile: { map } }, { face, x, y }) {
  const side = map.pictured;
  if (blocks.map_faces?.length !== map.faces * side * side) return '';
  const columns = Math.min(map.faces, 3);
  const canvas = element('canvas', { id: 'map-faces', role: 'img', class: 'map-faces',
    width: columns * side, height: Math.ceil(map.faces / columns) * side,
    'aria-label': `The map as the light sees it; texel (${x}, ${y}) of face ${face} is marked` });
  const pen = canvas.getContext('2d');
  for (let each = 0; each < map.faces; ++each) {
    const image = pen.createImageData(side, side);
    const pixels = blocks.map_faces.subarray(each * side * side, (each + 1) * side * side);
    pixels.forEach((share, i) => image.data.set([235 - 0.8 * share, 235 - 0.8 * share,
                                                 215 - 0.72 * share, 255], 4 * i));
    const [left, top] = [each % columns * side, Math.floor(each / columns) * side];
    pen.putImageData(image, left, top);
    pen.strokeStyle = 'black';
    pen.lineWidth = 1;
    pen.strokeRect(left + 0.5, top + 0.5, side - 1, side - 1);
    if (map.faces > 1 && side >= 32) {
      pen.fillStyle = 'black';
      pen.font = `${side / 10}px sans-serif`;
      pen.fillText(faceNames[each], left + side / 24, top + side / 8);
    }
    if (each !== face) continue;
    const centre = [left + (x + 0.5) * side / map.size, top + (y + 0.5) * side / map.size];
    for (const [color, width] of [['white', side / 24], ['#D55E00', side / 48]]) {
      pen.strokeStyle = color;
      pen.lineWidth = width;
      pen.beginPath();
      pen.arc(...centre, side / 18, 0, 2 * Math.PI);
      pen.stroke();
    }
  }
  return canvas;
}

/** What the map holds for one of the pixels that differ, by its rank among them. */
function mapRecord({ blocks, cellFile }, rank) {
  if (!blocks?.map_asked || !blocks.map_asked[rank]) return null;
  return { face: blocks.map_face[rank], x: blocks.map_x[rank], y: blocks.map_y[rank],
           stored: blocks.map_stored[rank], own: blocks.map_own[rank],
           shown: blocks.map_shown[rank], bias: cellFile.map.bias, size: cellFile.map.size,
           value: cellFile.map.value, slopeBias: cellFile.map.slope_bias ?? 0,
           offsetUnits: cellFile.map.offset_units ?? 0, lit: blocks.map_lit[rank],
           width: blocks.map_width[rank], foot: blocks.map_foot.subarray(2 * rank, 2 * rank + 2),
           filter: cellFile.map.filter ?? 0, average: cellFile.map.average,
           edges: cellFile.map.edges, format: cellFile.map.format,
           near: cellFile.map.near, far: cellFile.map.far };
}

/** The step of a ramp of 256 in which a depth lies. */
function stepOfRamp({ near, far }, depth) {
  return Math.max(0, Math.min(255, Math.floor(256 * (depth - near) / (far - near))));
}

/** The comparison as the technique makes it: of steps where the map is a ramp. */
function comparisonWords(record) {
  const compared = record.format === 'ramp8'
    ? { stored: stepOfRamp(record, record.stored), own: stepOfRamp(record, record.own - record.bias) }
    : { stored: record.stored + record.bias, own: record.own };
  const shadowed = compared.stored < compared.own;
  const [left, right] = record.format === 'ramp8'
    ? [`Step ${compared.stored} of the ramp`,
       `step ${compared.own}, in which ${short(record.own)} \u2212 ${short(record.bias)} lies`]
    : [`${short(record.stored)} + ${short(record.bias)}`, short(record.own)];
  return `${left} is ${shadowed ? 'less than' : 'not less than'} ${right}: ${shadowed ? 'shadowed' : 'lit'}.`;
}

/** What the block of texels around the point's own one says. */
function filterWords({ filter, average, edges, lit }) {
  if (filter === 0) return '';
  const beyond = { clamped: ', repeating the border of its face', seamless: ', across the edges of its face' };
  const block = `Of its own texel. The claim averages ${filter} × ${filter} texels${beyond[edges] ?? ''}`;
  return element('p', { id: 'averaged' }, average === 'values'
    ? `${block}: their values, which are compared once.`
    : `${block}: ${lit} of ${filter * filter} comparisons find light.`);
}

addFamily('map', {
  blocks: (pixels, differing) => ({
    map_asked: differing, map_face: differing, map_x: differing, map_y: differing,
    map_stored: differing, map_own: differing, map_shown: differing, map_lit: differing,
    map_width: differing, map_foot: 2 * differing,
    map_faces: null,
  }),
  pictures: { texels: 'Texels asked' },
  facts: ({ map, pixels }) => (map ? [
    ['Map', `${map.size} texels a side, ${map.value === 'distance' ? 'distances' : 'depths'} in ${map.format}`],
    ['Planes of the light', `${short(map.near)} to ${short(map.far)}, in the file's units`],
    ['Texels asked', grouped(map.texels)],
    ['Show another surface or texel than the centre',
     `${counted(map.straddling, 'pixel')}, ${short(100 * map.straddling / pixels)} %`]] : []),
  differing({ opened }, pixel) {
    const record = mapRecord(opened, rankOf(opened.differing, pixel));
    if (!record) return [element('p', { class: 'quiet' }, 'The map is not asked at this pixel.')];
    return [
      element('h3', {}, 'Comparison'),
      comparisonDrawing(record),
      element('p', { id: 'compared' }, comparisonWords(record)),
      filterWords(record),
      mapDrawing(opened, record),
      facts([
        ['Texel', `(${record.x}, ${record.y}) of face ${record.face}, ${record.size} a side`],
        ['Stored', `${short(record.stored)} (${record.value})`],
        ['Bias', short(record.bias)],
        ...(record.slopeBias > 0 ? [['Slope bias', `${record.slopeBias}, in what is stored`]] : []),
        ...(record.offsetUnits > 0 ? [['Offset units', `${record.offsetUnits}, in what is stored`]] : []),
        ['Own point', short(record.own)],
        ['Footprint', `${printed(record.foot[0], 3)} × ${printed(record.foot[1], 3)} on the surface`],
        ['Texel shows', record.shown === noTriangle ? 'nothing' : `triangle ${record.shown}`]])];
  },
});
