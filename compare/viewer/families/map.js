// The section of shadow maps: the texel that a pixel reads, in the map and as its rays cut the
// surface, and the comparison, drawn along the ray from the light.

const { short } = cutawayComparison;

/** The comparison as the command draws it, too. */
function comparisonDrawing(record) {
  const { tag, colors } = cutawaySvg;
  const [width, height] = [600, cutawayComparison.height];
  const title = 'From the light to the surface: what the texel stores, the bias, the point that ' +
                'is compared, and the texel’s footprint around it';
  const drawing = element('div', { id: 'comparison', class: 'comparison' });
  drawing.innerHTML = tag('svg', { xmlns: 'http://www.w3.org/2000/svg', role: 'img',
                                   viewBox: `0 0 ${width} ${height}`, 'font-family': 'sans-serif' },
    tag('title', {}, title) +
    tag('rect', { x: 0, y: 0, width, height, fill: colors.paper, class: 'cut-fill-paper' }) +
    cutawayComparison.draw(record, 0, width)); // cutawaySvg escapes all text
  return drawing;
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

/**
 * Brighter where the texel's surface is closer to the light; the texels as a chequered pattern, the
 * faces told apart by a tint. Black where the map is not asked. The numbers are those of
 * asked_texels in compare/maps/map_report.cpp.
 */
const texelPicture = (texels, width, height) => drawnPicture(width, height, texels, (number) => {
  if (number === 0) return [0, 0, 0];
  const share = Math.floor((number - 1) / 6) / 40;
  const [face, parity] = [(number - 1) % 6 >> 1, (number - 1) % 2];
  const gray = Math.round(255 * (1 - 0.75 * share - 0.12 * parity));
  return [gray - (gray >> 3) * face, gray, gray - Math.floor(gray / 5)];
});

/** What the map holds for one of the pixels that differ, by its rank among them. */
function mapRecord({ blocks, cellFile }, rank) {
  if (!blocks?.map_asked || !blocks.map_asked[rank]) return null;
  return { face: blocks.map_face[rank], x: blocks.map_x[rank], y: blocks.map_y[rank],
           stored: blocks.map_stored[rank], own: blocks.map_own[rank],
           shown: blocks.map_shown[rank], bias: cellFile.map.bias, size: cellFile.map.size,
           value: cellFile.map.value, slopeBias: cellFile.map.slope_bias ?? 0,
           offsetUnits: cellFile.map.offset_units ?? 0, lit: blocks.map_lit[rank],
           width: blocks.map_width[rank], foot: [blocks.map_foot_x[rank], blocks.map_foot_y[rank]],
           filter: cellFile.map.filter ?? 0, average: cellFile.map.average,
           edges: cellFile.map.edges, format: cellFile.map.format,
           near: cellFile.map.near, far: cellFile.map.far };
}

/** Of a texel on the surface; without an end where the light's rays do not all meet the surface. */
const footprintSide = (length) => (Number.isFinite(length) ? printed(length, 3) : 'endless');

addFamily('map', {
  blocks: (pixels, differing) => ({
    map_asked: differing, map_face: differing, map_x: differing, map_y: differing,
    map_stored: differing, map_own: differing, map_shown: differing, map_lit: differing,
    map_width: differing, map_foot_x: differing, map_foot_y: differing,
    map_faces: null, texels: pixels,
  }),
  pictures: { texels: 'Texels asked' },
  drawn({ blocks, width, height }) {
    const texels = blocks?.texels;
    return [['texels', texels ? texelPicture(texels, width, height) : null, 'texels']];
  },
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
      element('p', { id: 'compared' }, cutawayComparison.sentence(record)),
      record.filter > 0
        ? element('p', { id: 'averaged' }, cutawayComparison.averaged(record)) : '',
      mapDrawing(opened, record),
      facts([
        ['Texel', `(${record.x}, ${record.y}) of face ${record.face}, ${record.size} a side`],
        ['Stored', `${short(record.stored)} (${record.value})`],
        ['Bias', short(record.bias)],
        ...(record.slopeBias > 0 ? [['Slope bias', `${record.slopeBias}, in what is stored`]] : []),
        ...(record.offsetUnits > 0 ? [['Offset units', `${record.offsetUnits}, in what is stored`]] : []),
        ['Own point', short(record.own)],
        ['Footprint', `${Array.from(record.foot, footprintSide).join(' × ')} on the surface`],
        ['Texel shows', record.shown === noTriangle ? 'nothing' : `triangle ${record.shown}`]])];
  },
});
