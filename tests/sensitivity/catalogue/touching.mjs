// A light on a caster: what is drawn of volumes that hold half of the world, on the scene that has
// one, and faults of every kind that are tried there once more.
import { faults as geometry } from './geometry.mjs';
import { faults as numbers } from './numbers.mjs';
import { faults as state } from './state.mjs';

const again = [
  'light_cap_doubled', 'light_caps_missing', 'light_caps_flipped', 'one_light_cap_missing', 'dark_caps_missing',
  'those_that_face_away', 'first_triangle_never_faces', 'casters_lose_a_triangle',
  'sides_lack_a_half', 'sides_lack_other_half', 'some_sides_missing', 'side_wound_backwards', 'all_sides_unflipped',
  'lit_from_behind', 'near_caps_missing', 'cut_sides_missing', 'far_segments_missing',
  'steps_exchanged', 'back_steps_both_up', 'decrement_saturates', 'fronts_not_counted', 'backs_not_counted',
  'counted_depth_or_equal', 'volumes_culled', 'volumes_write_depth', 'stencil_of_2_bits',
  'light_moved_1e-4', 'light_moved_1e-5', 'light_at_infinity', 'first_mesh_casts_nothing', 'shift_1_16_of_a_pixel',
];
const split = 'raster/volumes/split_volume.cpp';
const ends = 'scenes/mesh/split_far_ends.cpp';
const cap = 'caps.emplace_back(part.z, part.y, part.x);';
const along = 'chosen_light(scene).position + distance * direction';
const facing = 'if (side(scene, triangle, light) > 0) facing.push_back(triangle);';
const occluder = 'occluders.insert(occluders.end(), fan.begin(), fan.end());';
const middle = 'cut.caps.emplace_back(cutter.middle(), from, to);';
const own = [
  { name: 'no_volumes', file: 'raster/volumes/volume.cpp', right: facing, wrong: ';' },
  { name: 'all_triangles_face', file: 'raster/volumes/volume.cpp', right: facing, wrong: 'facing.push_back(triangle);' },
  { name: 'caps_not_split', file: split, right: 'numbers.split.behind(triangle) == nullptr', wrong: 'true', why: 'Which half of the sky the cap then covers is chance, and the right one is as likely.' },
  { name: 'caps_of_touching_missing', file: split, right: cap, wrong: 'static_cast<void>(part);' },
  ...['x', 'y', 'z'].map((k) => ({ name: `cap_part_${k}_missing`, file: split, right: cap, wrong: `if (part.y != far_end(corners.${k})) caps.emplace_back(part.z, part.y, part.x);` })),
  { name: 'split_caps_wound_back', file: split, right: cap, wrong: 'caps.emplace_back(part.x, part.y, part.z);' },
  { name: 'split_caps_doubled', file: split, right: cap, wrong: 'caps.emplace_back(part.z, part.y, part.x); caps.emplace_back(part.z, part.y, part.x);' },
  { name: 'split_in_front', file: ends, right: along, wrong: 'chosen_light(scene).position - distance * direction' },
  { name: 'split_askew', file: ends, right: along, wrong: 'chosen_light(scene).position + distance * (direction + glm::dvec3(2, 0, 0))', why: 'Any point of the cap will do.' },
  { name: 'split_point_in_light', file: ends, right: along, wrong: 'chosen_light(scene).position + 0.0 * distance * direction' },
  { name: 'split_end_in_place', file: split, right: 'split.emplace_back(high, far_low, far_high);', wrong: 'split.emplace_back(high, far_low, high);' },
  { name: 'other_end_in_place', file: split, right: 'split.emplace_back(high, low, far_low);', wrong: 'split.emplace_back(high, low, low);' },
  { name: 'near_cap_fan_missing', techniques: 'zpass_capped', file: 'raster/volumes/near_cap.cpp', right: middle, wrong: 'static_cast<void>(from); static_cast<void>(to);' },
  { name: 'near_cap_fan_back', techniques: 'zpass_capped', file: 'raster/volumes/near_cap.cpp', right: middle, wrong: 'cut.caps.emplace_back(cutter.middle(), to, from);' },
  { name: 'occluding_fan_missing', techniques: 'zp_plus', file: 'raster/volumes/near_plane.cpp', right: occluder, wrong: ';' },
  { name: 'occluding_fan_twice', techniques: 'zp_plus', file: 'raster/volumes/near_plane.cpp', right: occluder, wrong: 'occluders.insert(occluders.end(), fan.begin(), fan.end()); occluders.insert(occluders.end(), fan.begin(), fan.end());' },
];
const whys = {
  cap_part_y_missing: 'This part of the cap is not seen.', cap_part_z_missing: 'This part of the cap is not seen.',
  casters_lose_a_triangle: 'That triangle is of the floor.', near_caps_missing: 'The one near cap of these scenes is a fan.',
};
export const faults = [
  ...own,
  ...[...geometry, ...state, ...numbers].filter(({ name }) => again.includes(name)).map(({ why, ...fault }) => fault),
].map((fault) => ({ ...fault, why: fault.why ?? whys[fault.name], name: `on_caster_${fault.name}`, kind: 'touching', scenes: 'light_on_face,light_on_edge' }));
