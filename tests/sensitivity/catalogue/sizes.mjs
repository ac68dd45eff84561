// Faults of any size, AMOUNT, of which the smallest is measured that is caught. `largest`, `aim`:
// powers of two, the size that is tried first and the one that must be caught.
import { camera, moved, other, passes, shift } from './numbers.mjs';

const bias = 'transform.light = split(light);';
const light = 's.lights[s.light]';
const bytes = 'static_cast<float>(std::round(255 * number) / 255)';
const cube = 'upload_cube(gl, make_normalisation_cube(model.cube_size))';
const diffuse = 'return self_shadow(l_normal) * max(0, l_perturbed);';
const asked = { file: 'raster/glsl/maps/map_light_cube.frag', right: 'texture(map, surface.from_light).r' };
const compared = { file: 'raster/glsl/maps/map_test.glsl', right: 'stored * planes.y + bias < length(surface.from_light)' };
const stored = { file: 'raster/glsl/maps/map_distance.frag', right: 'length(surface.from_light) / far' };
const snapping = '2^-9 pixels: half a step of snapping to 1/256';
const border = `${snapping}, at the picture's border`;
const outline = `${snapping}, at outlines`;
const floats = '2^-24 of each number: roundings of floats';
const centres = 'no border is drawn: a pixel tells on which side its centre is';
const texels = '2^-24 of each number: roundings of floats; it shows at borders of texels alone';
const step = '2^-24: a step of 24 bits';
export const faults = [
  { name: 'viewport_shift', unit: 'pixels', largest: -1, aim: -6, own: snapping, ...shift('AMOUNT', '0') },
  { name: 'field_of_view', unit: 'of its tangent', largest: -4, aim: -10, own: border, ...camera('c.half_height *= 1 + AMOUNT') },
  { name: 'camera_roll', unit: 'radians', largest: -4, aim: -10, own: border, ...other('const glm::dvec3 r = s.camera.right; s.camera.right = glm::normalize(r + AMOUNT * s.camera.up); s.camera.up = glm::normalize(s.camera.up - AMOUNT * r)') },
  { name: 'near_plane', unit: 'of its depth', largest: -4, aim: -10, own: floats, ...camera('c.near *= 1 + AMOUNT') },
  { name: 'depth_bias', unit: 'of the range of depths', largest: -10, aim: -16, own: '2^-21 of a depth: its eight roundings', file: passes, right: bias, wrong: `${bias} for (int k = 0; k < 4; ++k) transform.clip_from_relative[k][2] += static_cast<float>(AMOUNT) * transform.clip_from_relative[k][3];` },
  { name: 'light_displaced', unit: "of the scene's size", largest: -6, aim: -17, own: outline, ...moved('AMOUNT') },
  { name: 'eye_displaced', unit: "of the scene's size", largest: -6, aim: -17, own: outline, ...other('s.camera.eye += glm::dvec3(AMOUNT * size, 0, 0)') },
  { name: 'vertex_displaced', unit: "of the scene's size", largest: -4, aim: -13, own: outline, ...other('s.positions[s.positions.size() / 2] += glm::vec3(0, static_cast<float>(AMOUNT * size), 0)') },
  { name: 'cone_width', unit: 'of its angle', largest: -4, aim: -9, own: centres, ...other(`${light}.outer_cone *= 1 - AMOUNT`) },
  { name: 'ambient_light', unit: 'of the light', largest: -3, aim: -12, own: floats, techniques: 'bump_eye_space,bump_tangent_space', ...other('s.ambient *= 1 + AMOUNT') },
  { name: 'diffuse_term', unit: 'of the term', largest: -3, aim: -12, own: floats, file: 'raster/glsl/lighting/lighting.glsl', right: diffuse, wrong: 'return (1 - AMOUNT) * self_shadow(l_normal) * max(0, l_perturbed);' },
  { name: 'bump_texels', unit: 'a step of a component', largest: -2, aim: -6, own: 'none: its bytes are known', techniques: 'bump_three_pass,bump_one_pass', file: 'scenes/surface/bump_forms.cpp', right: bytes, wrong: 'static_cast<float>(std::round(255 * std::round(number / AMOUNT) * AMOUNT) / 255)' },
  { name: 'normalisation_cube', unit: 'of its 64 texels a side are left out', largest: -1, aim: -2, own: 'none: its size is known', techniques: 'bump_three_pass,bump_one_pass', file: 'raster/lighting/lit_scene.cpp', right: cube, wrong: 'upload_cube(gl, make_normalisation_cube(static_cast<int>(std::lround(64 - 64 * AMOUNT))))' },
  { name: 'map_lookup', unit: 'of the distance aside', largest: -3, aim: -9, own: texels, ...asked, wrong: 'texture(map, surface.from_light + vec3(0, AMOUNT * length(surface.from_light), 0)).r' },
  { name: 'map_stored_distance', unit: 'of the distance', largest: -6, aim: -15, own: step, ...stored, wrong: 'length(surface.from_light) * (1 + AMOUNT) / far' },
  { name: 'map_bias', unit: "of the light's far plane", largest: -6, aim: -12, own: step, ...compared, wrong: 'stored * planes.y + bias + AMOUNT * planes.y < length(surface.from_light)' },
  { name: 'mask_cutoff', unit: 'of alpha', largest: -2, aim: -8, own: `${snapping}, times alpha's slope`, techniques: 'zpass,zfail_reversed,cube_map_six_pass', file: passes, right: 'float_not_below(mask.least)', wrong: 'static_cast<float>(mask.least + AMOUNT)' },
].map((fault) => ({ kind: 'sizes', ...fault }));
