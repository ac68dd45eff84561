// Renders a scene with POV-Ray, which traces its shadows, and is a second opinion on the truth:
//
//   shadowproof check my.glb --renderer 'node povray.mjs {scene} {view} {out} {unlit}' --name povray
//
// Needs POV-Ray 3.7 (Debian: povray; POVRAY names another) and `npm install @gltf-transform/core
// @gltf-transform/extensions` in the current folder (or the one that MODULES names). Skins and morph
// targets are not posed, and files with compressed geometry are not read.
import { spawnSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';

const [scene, viewFile, out, unlit] = process.argv.slice(2);
/** A package's ES module, in the folder that was named. */
function imported(name) {
  const folder = join(resolve(process.env.MODULES ?? '.'), 'node_modules', name);
  const { module } = JSON.parse(readFileSync(join(folder, 'package.json'), 'utf8'));
  return import(pathToFileURL(join(folder, module)));
}
const { NodeIO } = await imported('@gltf-transform/core');
const { ALL_EXTENSIONS } = await imported('@gltf-transform/extensions');
const view = JSON.parse(readFileSync(viewFile, 'utf8'));

const vector = (v) => `<${v.join(',')}>`;
const scaled = (v, by) => v.map((x) => x * by);
const column = (matrix, i) => matrix.slice(4 * i, 4 * i + 3);
const transformed = (m, [x, y, z]) =>
  [0, 1, 2].map((k) => m[k] * x + m[4 + k] * y + m[8 + k] * z + m[12 + k]);
const document = await new NodeIO().registerExtensions(ALL_EXTENSIONS).read(scene);
const shown = document.getRoot().getDefaultScene() ?? document.getRoot().listScenes()[0];
if (!shown) throw new Error(`${scene} has no scene`);

// Shadows of what lies nearer than a fixed length, some thousandths, are lost in POV-Ray: so the scene
// is made large. It knows nothing that is further away than ten million.
const large = 1e5;
const units = large / largestCoordinate();
function largestCoordinate() {
  const all = [...column(view.camera.matrix, 3), ...view.light.position ?? []];
  shown.traverse((node) => {
    for (const primitive of node.getMesh()?.listPrimitives() ?? []) {
      const positions = primitive.getAttribute('POSITION');
      for (let i = 0; i < (positions?.getCount() ?? 0); ++i)
        all.push(...transformed(node.getWorldMatrix(), positions.getElement(i, [])));
    }
  });
  return all.reduce((most, x) => Math.max(most, Math.abs(x)), 0);
}
const inUnits = (point) => scaled(point, units);

const less = (a, b) => a.map((x, k) => x - b[k]);
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];

/** Of a mode of glTF the places of triangle i's corners; what is no triangles has none. */
const cornersOf = {
  4: (i) => [3 * i, 3 * i + 1, 3 * i + 2],
  5: (i) => (i % 2 === 0 ? [i, i + 1, i + 2] : [i, i + 2, i + 1]), // a strip
  6: (i) => [i + 1, i + 2, 0], // a fan
};

/** Triangles of a primitive, as three points in world space. A mirrored node turns them over. */
function trianglesOf(primitive, matrix) {
  const positions = primitive.getAttribute('POSITION');
  const corners = cornersOf[primitive.getMode()];
  if (!positions || !corners) return [];
  const indices = primitive.getIndices();
  const count = indices ? indices.getCount() : positions.getCount();
  const points = Array.from({ length: positions.getCount() },
                            (_, i) => inUnits(transformed(matrix, positions.getElement(i, []))));
  const columns = [0, 1, 2].map((i) => column(matrix, i));
  const isMirrored = dot(cross(columns[0], columns[1]), columns[2]) < 0;
  const triangles = primitive.getMode() === 4 ? Math.floor(count / 3) : Math.max(count - 2, 0);
  return Array.from({ length: triangles }, (_, i) => {
    const [a, b, c] = corners(i).map((k) => points[indices ? indices.getScalar(k) : k]);
    return isMirrored ? [a, c, b] : [a, b, c];
  });
}

function mesh(triangles, words) {
  if (triangles.length === 0) return '';
  const each = triangles.map((corners) => `triangle { ${corners.map(vector).join(', ')} }`);
  return `mesh { ${each.join('\n')} texture { White } ${words} }\n`;
}

/** Where a triangle's back is towards the camera, a single-sided one is not seen, but casts. */
function surfaces() {
  const seen = [];
  const hidden = [];
  shown.traverse((node) => {
    const matrix = node.getWorldMatrix();
    for (const primitive of node.getMesh()?.listPrimitives() ?? []) {
      const doubleSided = primitive.getMaterial()?.getDoubleSided() ?? false;
      for (const [a, b, c] of trianglesOf(primitive, matrix)) {
        const isFront = dot(cross(less(b, a), less(c, a)), wayToEye(a)) > 0;
        (doubleSided || isFront ? seen : hidden).push([a, b, c]);
      }
    }
  });
  return mesh(seen, '') + mesh(hidden, 'no_image no_reflection');
}

function lightSource({ kind, position, direction, outer_cone_degrees: cone }) {
  if (kind === 'directional') {
    const away = 10 * large; // beyond all that casts
    return `light_source { ${vector(scaled(direction, -away))} rgb 1 parallel point_at <0,0,0> }`;
  }
  const from = inUnits(position);
  if (kind !== 'spot') return `light_source { ${vector(from)} rgb 1 }`;
  const at = from.map((x, k) => x + large * direction[k]);
  return `light_source { ${vector(from)} rgb 1 spotlight point_at ${vector(at)}
    radius ${cone} falloff ${cone} tightness 0 }`;
}

function camera({ matrix, yfov, extent }) {
  const height = extent ? inUnits([0, extent.height, 0])[1] : 2 * Math.tan(yfov / 2);
  return `camera { ${extent ? 'orthographic' : 'perspective'} location ${vector(eye)}
    right ${vector(scaled(column(matrix, 0), height * view.width / view.height))}
    up ${vector(scaled(column(matrix, 1), height))} direction ${vector(scaled(column(matrix, 2), -1))} }`;
}

const eye = inUnits(column(view.camera.matrix, 3));
const back = column(view.camera.matrix, 2);
const wayToEye = point => (view.camera.extent ? back : less(eye, point));
const still = `#version 3.7; global_settings { assumed_gamma 1 } background { rgb 0 }
#declare White = texture { pigment { rgb 1 } finish { ambient 0.1 diffuse 0.6 } }
${camera(view.camera)}
${surfaces()}
`;
const folder = mkdtempSync(join(tmpdir(), 'povray-'));
try {
  for (const [file, light] of [[out, lightSource(view.light)], [unlit, '']]) {
    if (!file) continue;
    const source = join(folder, 'scene.pov');
    writeFileSync(source, still + light);
    const run = spawnSync(process.env.POVRAY ?? 'povray',
      [`+I${source}`, `+O${file}`, `+W${view.width}`, `+H${view.height}`, '-D', '-A', '+FN8', '-GA'],
      { encoding: 'utf8' });
    if (run.error) throw run.error;
    if (run.status !== 0) throw new Error(run.stderr);
  }
} finally {
  rmSync(folder, { recursive: true });
}
