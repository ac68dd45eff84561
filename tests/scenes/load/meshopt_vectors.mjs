// Writes meshopt_vectors.json, which meshopt_test.cpp reads: streams of every mode, filter and
// version by meshoptimizer's encoder, and what its own decoder makes of them.
//   node tests/scenes/load/meshopt_vectors.mjs
import { writeFileSync } from 'node:fs';
import { MeshoptDecoder as decoder, MeshoptEncoder as encoder } from 'meshoptimizer';

await encoder.ready;
await decoder.ready;

let seed = 20261125;
/** A number from 0 to below `end`, the same in every run. */
const below = (end) => {
  seed = (Math.imul(seed, 1664525) + 1013904223) >>> 0;
  return Math.floor((seed / 2 ** 32) * end);
};
const base64 = (bytes) => Buffer.from(bytes).toString('base64');
const vectors = [];

function add(mode, filter, count, stride, stream) {
  const target = new Uint8Array(count * stride);
  decoder.decodeGltfBuffer(target, count, stride, stream, mode, filter === 'NONE' ? undefined : filter);
  vectors.push({ mode, filter, count, stride, stream: base64(stream), decoded: base64(target) });
}

// Steps of every size, so that groups of all widths occur: constant, by bits, by bytes, at random.
function walk(count, stride, width) {
  const values = new Uint8Array(count * stride);
  const view = new DataView(values.buffer);
  for (let k = 0; k + width <= stride; k += width) {
    let at = below(200);
    for (let i = 0; i < count; i += 1) {
      const calm = Math.floor(i / 16) % 6;
      at += below([1, 2, 4, 14, 300, 70000][calm]) - (calm > 2 ? below(8) : 0);
      const put = { 1: 'setUint8', 2: 'setUint16', 4: 'setUint32' }[width];
      view[put](i * stride + k, at >>> 0 & (2 ** (8 * width) - 1 >>> 0), true);
    }
  }
  return values;
}

for (const version of [0, 1])
  for (const [count, stride, width] of [[1, 4, 4], [16, 8, 2], [17, 12, 4], [130, 4, 1], [300, 16, 4]])
    for (const level of version === 1 ? [0, 2, 3] : [2])
      add('ATTRIBUTES', 'NONE', count, stride,
          encoder.encodeVertexBufferLevel(walk(count, stride, width), count, stride, level, version));
const floats = new Float32Array(40 * 3);
floats.forEach((_, i) => { floats[i] = Math.fround(Math.sin(i) * 2 ** (i % 7)); });
add('ATTRIBUTES', 'NONE', 40, 12,
    encoder.encodeVertexBufferLevel(new Uint8Array(floats.buffer), 40, 12, 3, 1));

const units = new Float32Array(40 * 4);
for (let i = 0; i < 40; i += 1) {
  const v = [0, 1, 2, 3].map(() => below(2001) - 1000.5);
  const isVector = Math.hypot(v[0], v[1], v[2]);
  units.set([v[0] / isVector, v[1] / isVector, v[2] / isVector, i % 2], 4 * i);
}
const turns = units.map((_, i) => {
  const first = i - (i % 4);
  return units[i] / Math.hypot(...units.slice(first, first + 4));
});
const colors = units.map((value) => Math.abs(value));
for (const version of [0, 1]) {
  const encoded = (bytes, count, stride) =>
    encoder.encodeVertexBufferLevel(bytes, count, stride, 2, version);
  add('ATTRIBUTES', 'OCTAHEDRAL', 40, 4, encoded(encoder.encodeFilterOct(units, 40, 4, 8), 40, 4));
  add('ATTRIBUTES', 'OCTAHEDRAL', 40, 8, encoded(encoder.encodeFilterOct(units, 40, 8, 12), 40, 8));
  add('ATTRIBUTES', 'QUATERNION', 40, 8, encoded(encoder.encodeFilterQuat(turns, 40, 8, 12), 40, 8));
  for (const kind of ['Separate', 'SharedVector', 'SharedComponent'])
    add('ATTRIBUTES', 'EXPONENTIAL', 40, 12,
        encoded(encoder.encodeFilterExp(floats, 40, 12, 15, kind), 40, 12));
}
add('ATTRIBUTES', 'COLOR', 40, 4,
    encoder.encodeVertexBufferLevel(encoder.encodeFilterColor(colors, 40, 4, 8), 40, 4, 2, 1));
add('ATTRIBUTES', 'COLOR', 40, 8,
    encoder.encodeVertexBufferLevel(encoder.encodeFilterColor(colors, 40, 8, 12), 40, 8, 2, 1));

// A grid, whose triangles share edges; a fan; triangles at random; and again from 0.
const triangles = [];
for (let y = 0; y < 8; y += 1)
  for (let x = 0; x < 8; x += 1) {
    const a = 9 * y + x;
    triangles.push(a, a + 1, a + 9, a + 1, a + 10, a + 9);
  }
for (let i = 1; i < 9; i += 1) triangles.push(100, 100 + i, 101 + i);
for (let i = 0; i < 60; i += 1) triangles.push(below(60000));
triangles.push(0, 1, 2, 3, 4, 5, 2, 1, 6);
for (const stride of [2, 4]) {
  const bytes = new Uint8Array((stride === 2 ? new Uint16Array(triangles) : new Uint32Array(triangles)).buffer);
  add('TRIANGLES', 'NONE', triangles.length, stride,
      encoder.encodeIndexBuffer(bytes, triangles.length, stride));
  add('INDICES', 'NONE', triangles.length, stride,
      encoder.encodeIndexSequence(bytes, triangles.length, stride));
}

writeFileSync(new URL('meshopt_vectors.json', import.meta.url),
              `[\n${vectors.map((vector) => JSON.stringify(vector)).join(',\n')}\n]\n`);
