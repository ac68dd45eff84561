// Bundled scenes as a production pipeline hands them on: by glTF-Transform and its encoders, quantized
// and compressed by Draco and by meshopt. They verify; and their truth is that of the same file as
// other decoders than ours decompress it.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { NodeIO } from '@gltf-transform/core';
import { ALL_EXTENSIONS, EXTMeshoptCompression, KHRDracoMeshCompression } from '@gltf-transform/extensions';
import { dedup, draco, meshopt, prune, weld } from '@gltf-transform/functions';
import draco3d from 'draco3dgltf';
import { MeshoptDecoder, MeshoptEncoder } from 'meshoptimizer';
import { scratch, shadowproof } from './shadowproof.mjs';

await MeshoptEncoder.ready;
await MeshoptDecoder.ready;
const io = new NodeIO().registerExtensions(ALL_EXTENSIONS).registerDependencies({
  'draco3d.decoder': await draco3d.createDecoderModule(),
  'draco3d.encoder': await draco3d.createEncoderModule(),
  'meshopt.decoder': MeshoptDecoder,
  'meshopt.encoder': MeshoptEncoder,
});

const ways = {
  draco: [draco({ method: 'edgebreaker' })],
  draco_in_order: [draco({ method: 'sequential', quantizePosition: 16 })],
  meshopt: [meshopt({ encoder: MeshoptEncoder, level: 'medium' })],
  optimized: [dedup(), weld(), prune(), meshopt({ encoder: MeshoptEncoder, level: 'high' })],
};
// A sanitizer makes a run some twenty times as long; what decodes is reached by two scenes.
const sanitized = Boolean(process.env.SHADOWPROOF_SANITIZED);
const scenes = sanitized ? ['ordinary', 'walking_figure']
  : ['ordinary', 'open_lid', 'many_lights', 'bumpy_torus', 'walking_figure', 'nested'];
const size = ['--size', sanitized ? '32x32' : '96x96'];
/** Of a scene without bumps the techniques read positions and triangles, in no more ways than these. */
const techniques = (scene) => sanitized ? ['--technique', 'zfail_half_edge']
  : scene.startsWith('bumpy') ? []
    : ['--technique', 'zpass,zfail_half_edge,zfail_geometry_shader,auto,traced_offset'];

/** A scene compressed in one of the ways, and the same file decompressed by glTF-Transform. */
async function write(scene, way) {
  const document = await io.read(join(process.env.SHADOWPROOF_SCENES, `${scene}.gltf`));
  // What is compressed is another scene: it need not provoke what this one does.
  document.getRoot().setExtras({});
  await document.transform(...ways[way]);
  const compressed = join(scratch, `${scene}.${way}.glb`);
  await io.write(compressed, document);
  const again = await io.read(compressed);
  for (const extension of again.getRoot().listExtensionsUsed())
    if ([KHRDracoMeshCompression, EXTMeshoptCompression].some((kind) => extension instanceof kind))
      extension.dispose();
  const plain = join(scratch, `${scene}.${way}.plain.glb`);
  await io.write(plain, again);
  return { compressed, plain };
}

const truth = (file) => {
  const image = `${file}.png`;
  const run = shadowproof(['render', file, '--size', '160x120', '-o', image]);
  assert.equal(run.code, 0, run.err);
  return readFileSync(image);
};
const json = (glb) => glb.toString('latin1', 20, 20 + glb.readUInt32LE(12));

for (const scene of scenes)
  for (const way of Object.keys(ways))
    test(`${scene}, compressed: ${way}, verifies, and has the truth of what other decoders read`, async () => {
      const { compressed, plain } = await write(scene, way);
      const extension = way.startsWith('draco') ? 'KHR_draco_mesh_compression' : 'EXT_meshopt_compression';
      assert.ok(json(readFileSync(compressed)).includes(extension));
      assert.ok(!json(readFileSync(plain)).includes(extension));
      assert.deepEqual(truth(compressed), truth(plain));
      const results = `${compressed}.json`;
      const run = shadowproof(['verify', compressed, ...size, ...techniques(scene), '-q', '--json', results, '--out',
                               `${compressed}.report`]);
      assert.equal(run.code, 0, run.out + run.err);
      for (const each of JSON.parse(readFileSync(results)).scenes)
        for (const technique of each.techniques)
          assert.equal(technique.causes?.unexplained ?? 0, 0, `${each.name} ${technique.name}`);
    });
