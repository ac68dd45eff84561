// Small files that ask for much memory, made by the tests that hold what is done about them.
import { writeFileSync } from 'node:fs';
import * as zlib from 'node:zlib';

const { deflateSync } = zlib;

// Node.js 18, which Debian 12 has, knows none.
const crc = zlib.crc32 ?? ((bytes) => {
  let sum = ~0;
  for (const byte of bytes) {
    sum ^= byte;
    for (let k = 0; k < 8; ++k) sum = (sum >>> 1) ^ (0xedb88320 & -(sum & 1));
  }
  return ~sum >>> 0;
});

function chunk(type, content) {
  const body = Buffer.concat([Buffer.from(type, 'latin1'), content]);
  const ends = Buffer.alloc(8);
  ends.writeUInt32BE(content.length, 0);
  ends.writeUInt32BE(crc(body) >>> 0, 4);
  return Buffer.concat([ends.subarray(0, 4), body, ends.subarray(4)]);
}

/** An even PNG of one bit a pixel: some 8192 x 8192 in 8 KB. `more`: chunks before its pixels. */
export function evenPng(width, height, more = []) {
  const head = Buffer.alloc(13);
  head.writeUInt32BE(width, 0);
  head.writeUInt32BE(height, 4);
  head[8] = 1;
  return Buffer.concat([Buffer.from('\x89PNG\r\n\x1a\n', 'latin1'), chunk('IHDR', head),
    ...more.map(([type, content]) => chunk(type, content)),
    chunk('IDAT', deflateSync(Buffer.alloc((1 + Math.ceil(width / 8)) * height), { level: 9 })),
    chunk('IEND', Buffer.alloc(0))]);
}

/** A compressed text of that many bytes, for a zTXt chunk. */
export const longText = (bytes) =>
  ['zTXt', Buffer.concat([Buffer.from('Comment\0\0', 'latin1'), deflateSync(Buffer.alloc(bytes))])];

export const dataUri = (bytes) =>
  `data:application/octet-stream;base64,${Buffer.from(bytes).toString('base64')}`;

/** One triangle, in one node. Accessor 0 its positions; everything may be changed. */
export function triangle() {
  const positions = Buffer.from(new Float32Array([0, 0, 0, 1, 0, 0, 0, 1, 0]).buffer);
  return {
    asset: { version: '2.0' },
    scene: 0,
    scenes: [{ nodes: [0] }],
    nodes: [{ mesh: 0 }],
    meshes: [{ primitives: [{ attributes: { POSITION: 0 } }] }],
    accessors: [{ bufferView: 0, componentType: 5126, count: 3, type: 'VEC3',
                  min: [0, 0, 0], max: [1, 1, 0] }],
    bufferViews: [{ buffer: 0, byteLength: positions.length }],
    buffers: [{ byteLength: positions.length, uri: dataUri(positions) }],
  };
}

/** The triangle with a normal map and a decal, both of one picture. */
export function textured(picture) {
  const gltf = triangle();
  const at = Buffer.from(new Float32Array([0, 1, 1, 1, 0, 0]).buffer);
  gltf.buffers.push({ byteLength: at.length, uri: dataUri(at) });
  gltf.bufferViews.push({ buffer: 1, byteLength: at.length });
  gltf.accessors.push({ bufferView: 1, componentType: 5126, count: 3, type: 'VEC2' });
  Object.assign(gltf.meshes[0].primitives[0], { material: 0 });
  gltf.meshes[0].primitives[0].attributes.TEXCOORD_0 = 1;
  gltf.images = [{ uri: dataUri(picture) }];
  gltf.textures = [{ source: 0 }];
  gltf.materials = [{ normalTexture: { index: 0 },
                      pbrMetallicRoughness: { baseColorTexture: { index: 0 } } }];
  return gltf;
}

/** By name: writes the file, and says how large it is. */
export const attacks = {
  'texture.gltf': () => JSON.stringify(textured(evenPng(8192, 8192))),
  'sparse.gltf': () => {
    const gltf = triangle();
    delete gltf.accessors[0].bufferView; // all zero, without a byte in the file
    gltf.accessors[0].count = 15_000_000;
    return JSON.stringify(gltf);
  },
  'instances.gltf': () => {
    const gltf = triangle();
    delete gltf.accessors[0].bufferView;
    gltf.accessors[0].count = 300_000;
    gltf.nodes = Array.from({ length: 160 }, () => ({ mesh: 0 }));
    gltf.scenes[0].nodes = gltf.nodes.map((_, i) => i);
    return JSON.stringify(gltf);
  },
  'nodes.gltf': () => {
    const gltf = triangle();
    gltf.nodes = Array.from({ length: 1_000_000 }, (_, i) => (i === 0 ? { mesh: 0 } : {}));
    return JSON.stringify(gltf);
  },
  'names.gltf': () => {
    const gltf = triangle();
    gltf.meshes[0].name = 'n'.repeat(1_000_000);
    gltf.nodes = Array.from({ length: 2000 }, () => ({ mesh: 0 }));
    gltf.scenes[0].nodes = gltf.nodes.map((_, i) => i);
    return JSON.stringify(gltf);
  },
  'morphs.gltf': () => {
    const gltf = triangle();
    const [primitive] = gltf.meshes[0].primitives;
    delete gltf.accessors[0].bufferView;
    gltf.accessors[0].count = 3_000_000;
    primitive.targets = Array.from({ length: 200 }, () => ({ POSITION: 0 }));
    gltf.meshes[0].weights = primitive.targets.map(() => 1);
    return JSON.stringify(gltf);
  },
  'skin.gltf': () => {
    const gltf = triangle();
    const joints = Array.from({ length: 200_000 }, () => 0);
    gltf.skins = [{ joints }];
    gltf.nodes = Array.from({ length: 1000 }, () => ({ mesh: 0, skin: 0 }));
    gltf.scenes[0].nodes = gltf.nodes.map((_, i) => i);
    return JSON.stringify(gltf);
  },
  'model.md2': () => {
    const header = new Uint32Array([0x32504449, 8, 1, 1, 40 + 4 * 65535, 0, 65535, 1, 10_000_000,
                                    0, 1, 68, 68, 72, 72, 72, 72]);
    return Buffer.concat([Buffer.from(header.buffer), Buffer.alloc(1000)]);
  },
};

export function writeAttack(folder, name) {
  const content = attacks[name]();
  writeFileSync(`${folder}/${name}`, content);
  return content.length;
}
