// Renders a scene with three.js in a headless Chromium, with shadow maps and nothing else that
// changes a colour:
//
//   shadowproof check my.glb --renderer 'node three.mjs {scene} {view} {out} {unlit}' --name three
//
// With MATERIALS=file surfaces are shaded as the file has them, textures, highlights and smooth
// normals included. A picture without shadows says then what light adds at each pixel:
//
//   MATERIALS=file shadowproof check my.glb --name three \
//     --renderer 'node three.mjs {scene} {view} {out} {unlit} {unshadowed}'
//
// Needs `npm install three playwright-core` in the current folder (or the one that MODULES names),
// and Chromium (CHROMIUM names it). MAP_SIZE, BIAS and NORMAL_BIAS are those of the light's shadow,
// and HALF_SIDE is half the square that a directional light's map holds; what is not given is
// three.js's own. MAP_TYPE is that of the shadow map: BasicShadowMap, one comparison, where nothing is
// said here; three.js itself takes PCFShadowMap then, which averages 17, or 9 of a point light.
import { readFileSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { basename, dirname, join, resolve } from 'node:path';

const [scene, viewFile, out, unlit, unshadowed] = process.argv.slice(2);
const require = createRequire(join(resolve(process.env.MODULES ?? '.'), 'recipe.js'));
const { chromium } = require('playwright-core');
const three = dirname(dirname(require.resolve('three')));
const view = JSON.parse(readFileSync(viewFile, 'utf8'));
const shadow = { mapSize: process.env.MAP_SIZE, bias: process.env.BIAS,
                 normalBias: process.env.NORMAL_BIAS, halfSide: process.env.HALF_SIDE,
                 type: process.env.MAP_TYPE ?? 'BasicShadowMap' };
const ownMaterials = process.env.MATERIALS === 'file';

/** Runs in the page: renders with the light on, with it off, and with it on but without shadows;
 * three pictures as data URLs. */
async function render({ view, shadow, ownMaterials, file }) {
  const THREE = await import('three');
  const { GLTFLoader } = await import('three/addons/loaders/GLTFLoader.js');
  const renderer = new THREE.WebGLRenderer({ antialias: false, preserveDrawingBuffer: true });
  renderer.setPixelRatio(1);
  renderer.setSize(view.width, view.height);
  renderer.toneMapping = THREE.NoToneMapping;
  renderer.shadowMap.enabled = true;
  if (!(shadow.type in THREE)) throw new Error(`MAP_TYPE: three.js has no ${shadow.type}`);
  renderer.shadowMap.type = THREE[shadow.type];
  const { scene } = await new GLTFLoader().loadAsync(file);
  const fileLights = [];
  scene.traverse((object) => {
    if (object.isLight) fileLights.push(object);
    if (!object.isMesh) return;
    object.castShadow = object.receiveShadow = true;
    // Without normals, three.js's shadows are looked up nowhere.
    if (!ownMaterials || !object.geometry.hasAttribute('normal')) {
      object.geometry = object.geometry.toNonIndexed();
      object.geometry.computeVertexNormals();
    }
    if (ownMaterials) return;
    // Flat: the file may have no normals, and smooth ones are dark where faces are not averted.
    // An alpha mask is kept, and read at its full size, as the truth reads it.
    const { side, alphaTest, map } = object.material;
    const mask = alphaTest > 0 && map ? { alphaTest, map } : {};
    if (mask.map) Object.assign(map, { minFilter: THREE.LinearFilter, generateMipmaps: false });
    object.material = new THREE.MeshLambertMaterial({ side, flatShading: true, ...mask });
  });
  for (const light of fileLights) light.parent.remove(light);
  const { kind, outer_cone_degrees } = view.light;
  const light = kind === 'directional' ? new THREE.DirectionalLight()
    : kind === 'spot' ? new THREE.SpotLight(0xffffff, 1, 0, outer_cone_degrees / 180 * Math.PI)
      : new THREE.PointLight();
  light.intensity = 2;
  light.decay = 0; // no fall-off
  light.castShadow = true;
  if (shadow.mapSize) light.shadow.mapSize.set(Number(shadow.mapSize), Number(shadow.mapSize));
  if (shadow.bias) light.shadow.bias = Number(shadow.bias);
  if (shadow.normalBias) light.shadow.normalBias = Number(shadow.normalBias);
  if (shadow.halfSide) {
    const half = Number(shadow.halfSide);
    Object.assign(light.shadow.camera, { left: -half, right: half, bottom: -half, top: half });
  }
  scene.add(light, new THREE.AmbientLight(0xffffff, 0.3));
  // As `shadowproof export-view` has it in engines.three.code.
  const own = view.engines.three;
  const { field_of_view, extent, near, far } = own.camera;
  const camera = extent
    ? new THREE.OrthographicCamera(-extent.width / 2, extent.width / 2, extent.height / 2,
                                   -extent.height / 2, near, far)
    : new THREE.PerspectiveCamera(field_of_view.vertical_degrees, view.width / view.height, near,
                                  far);
  camera.position.fromArray(own.camera.position);
  camera.quaternion.fromArray(own.camera.rotation);
  light.position.fromArray(own.light.position);
  if (own.light.direction) {
    light.target.position.fromArray(own.light.position)
      .add(new THREE.Vector3().fromArray(own.light.direction));
    scene.add(light.target);
  }
  const picture = () => {
    renderer.render(scene, camera);
    return renderer.domElement.toDataURL('image/png');
  };
  const on = picture();
  light.shadow.intensity = 0; // not `castShadow = false`, after which other shaders are used
  const withoutShadows = picture();
  light.intensity = 0; // not `visible = false`, likewise
  return [on, picture(), withoutShadows];
}

const page = `<!doctype html><script type="importmap">
{"imports": {"three": "/three/build/three.module.js", "three/addons/": "/three/examples/jsm/"}}
</script>`;
const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
  args: ['--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist',
         ...(process.getuid?.() === 0 ? ['--no-sandbox'] : [])],
});
try {
  const tab = await browser.newPage();
  tab.on('console', (message) => message.type() === 'error' && console.error(message.text()));
  // All files come from here: three's, and those beside the scene.
  await tab.route('**/*', (route) => {
    const path = decodeURIComponent(new URL(route.request().url()).pathname);
    if (path === '/') return route.fulfill({ body: page, contentType: 'text/html' });
    const file = path.startsWith('/three/') ? join(three, path.slice('/three/'.length))
      : join(dirname(scene), path.slice('/scene/'.length));
    return route.fulfill({ path: file });
  });
  await tab.goto('http://recipe.invalid/');
  const pictures = await tab.evaluate(render, {
    view, shadow, ownMaterials, file: `/scene/${encodeURIComponent(basename(scene))}` });
  for (const [i, file] of [out, unlit, unshadowed].entries())
    if (file) writeFileSync(file, Buffer.from(pictures[i].split(',')[1], 'base64'));
} finally {
  await browser.close();
}
