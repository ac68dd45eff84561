// Numbers that are a little off: camera, planes, light, places, formats.
export const passes = 'raster/passes/passes.cpp';
const projection = 'clip_from_view(scene.camera, depth_model)';
export const camera = (change) => ({ file: passes, right: projection, wrong: `[&] { Camera c = scene.camera; ${change}; return clip_from_view(c, depth_model); }()` });
const drawn = { file: 'raster/render.cpp', right: 'draw_with(gpu, technique, scene, plan)' };
const extent = 'double size = 0; for (const glm::vec3& p : s.positions) size = std::max(size, glm::length(glm::dvec3(p) - glm::dvec3(s.positions[0])));';
export const other = (change) => ({ ...drawn, wrong: `[&] { Scene s = scene; ${extent} static_cast<void>(size); ${change}; return draw_with(gpu, technique, s, plan); }()` });
const light = 's.lights[s.light]';
export const moved = (size) => other(`${light}.kind == Light::Kind::directional ? ${light}.direction = glm::normalize(${light}.direction + glm::dvec3(0, ${size}, 0)) : ${light}.position += glm::dvec3(${size} * size, 0, 0)`);
export const shift = (x, y) => ({ file: passes, right: 'transform.light = split(light);', wrong: `transform.light = split(light); for (int k = 0; k < 4; ++k) { transform.clip_from_relative[k][0] += static_cast<float>(2.0 * ${x} / scene.camera.width) * transform.clip_from_relative[k][3]; transform.clip_from_relative[k][1] += static_cast<float>(2.0 * ${y} / scene.camera.height) * transform.clip_from_relative[k][3]; }` });
const measure = 'raster/volumes/volume_measure.cpp';
const shownDepth = 'gl.DepthFunc(reversed ? GL_GEQUAL : GL_LEQUAL);';
const fragments = (wrong) => ({ kind: 'figures', file: measure, right: 'frame.counted->volume_fragments = fragments;', wrong: `frame.counted->volume_fragments = ${wrong};` });
export const faults = [
  { name: 'shift_a_pixel', ...shift(1, 0) },
  { name: 'shift_half_a_pixel_up', ...shift(0, 0.5) },
  { name: 'shift_1_16_of_a_pixel', ...shift(1 / 16, 0) },
  { name: 'shift_1_64_of_a_pixel', ...shift(1 / 64, 1 / 64) },
  { name: 'near_plane_halved', ...camera('c.near *= 0.5') },
  { name: 'near_plane_1_percent_off', ...camera('c.near *= 1.01') },
  { name: 'far_plane_10_percent_off', file: passes, right: projection, wrong: '[&] { DepthModel m = depth_model; m.far *= 1.1; return clip_from_view(scene.camera, m); }()' },
  { name: 'field_of_view_1_percent_off', ...camera('c.half_height *= 1.01') },
  { name: 'field_of_view_a_thousandth_off', ...camera('c.half_height *= 1.001') },
  { name: 'aspect_a_pixel_off', ...camera('c.width += 1') },
  { name: 'matrix_multiplied_in_floats', file: passes, right: 'glm::mat4(projection * view_from_world(scene.camera))', wrong: 'glm::mat4(projection) * glm::mat4(view_from_world(scene.camera))', why: 'Less than the bound of the float transform, which does not tell in what order its matrices are multiplied.' },
  { name: 'eye_in_one_float', file: passes, right: 'transform.origin = split(scene.camera.eye);', wrong: 'transform.origin.high = glm::vec3(scene.camera.eye);', why: 'Less than the bound of the float transform: the eyes of the bundled scenes are near the origin.' },
  { name: 'light_at_infinity', file: passes, right: 'transform.light_w = static_cast<float>(light.w);', wrong: 'transform.light_w = 0;' },
  { name: 'extruded_from_elsewhere', file: passes, right: 'const glm::dvec4 light = homogeneous(chosen_light(scene));'.replace(/^.*= (.*);$/, '$1'), wrong: 'homogeneous(chosen_light(scene)) + glm::dvec4(0.02, 0, 0, 0)' },
  { name: 'light_moved_a_hundredth', ...moved('0.01') },
  { name: 'light_moved_a_thousandth', ...moved('1e-3') },
  { name: 'light_moved_1e-4', ...moved('1e-4') },
  { name: 'light_moved_1e-5', ...moved('1e-5') },
  { name: 'eye_moved_1e-3', ...other('s.camera.eye += glm::dvec3(1e-3 * size, 0, 0)') },
  { name: 'eye_moved_1e-5', ...other('s.camera.eye += glm::dvec3(1e-5 * size, 0, 0)') },
  { name: 'camera_turned_1e-4', ...other('s.camera.forward = glm::normalize(s.camera.forward + 1e-4 * s.camera.right); s.camera.right = glm::normalize(glm::cross(s.camera.forward, s.camera.up))') },
  { name: 'all_double_sided', ...other('for (Material& m : s.materials) m.double_sided = true') },
  { name: 'none_double_sided', ...other('for (Material& m : s.materials) m.double_sided = false') },
  { name: 'a_vertex_moved', ...other('s.positions[s.positions.size() / 2] += glm::vec3(0, 0.01F * static_cast<float>(size), 0)') },
  { name: 'a_vertex_moved_1e-4', ...other('s.positions[s.positions.size() / 2] += glm::vec3(0, 1e-4F * static_cast<float>(size), 0)') },
  { name: 'a_triangle_lost', ...other('s.triangles[s.triangles.size() / 3] = glm::uvec3(s.triangles[s.triangles.size() / 3].x)') },
  { name: 'positions_in_half_floats', ...other('for (glm::vec3& p : s.positions) for (int k = 0; k < 3; ++k) { std::uint32_t b; __builtin_memcpy(&b, &p[k], 4); b &= 0xffffe000U; __builtin_memcpy(&p[k], &b, 4); }') },
  { name: 'first_mesh_casts_nothing', ...other('for (Mesh& m : s.meshes) if (m.casts) { m.casts = false; break; }') },
  { name: 'first_mesh_receives_nothing', ...other('for (Mesh& m : s.meshes) if (m.receives) { m.receives = false; break; }') },
  { name: 'cone_a_tenth_of_a_percent_wider', ...other(`${light}.outer_cone *= 1.001`) },
  { name: 'cone_1e-4_narrower', ...other(`${light}.outer_cone *= 0.9999`), why: 'Its edge moves by less than a pixel.' },
  { name: 'cone_axis_turned', ...other(`${light}.direction = glm::normalize(${light}.direction + glm::dvec3(1e-3, 0, 0))`) },
  { name: 'inner_cone_for_outer', ...other(`${light}.outer_cone = ${light}.inner_cone`) },
  { name: 'spot_shines_everywhere', file: passes, right: 'spot ? static_cast<float>(std::cos(light.outer_cone)) : -2.0F', wrong: 'spot ? -2.0F : -2.0F' },
  { name: 'reversed_infinite_near_doubled', ...camera('c.near *= 2') },
  { name: 'depth_offset_1e-6', file: passes, right: 'transform.light = split(light);', wrong: 'transform.light = split(light); for (int k = 0; k < 4; ++k) transform.clip_from_relative[k][2] += 1e-6F * transform.clip_from_relative[k][3];' },
  { name: 'depth_offset_1e-4', file: passes, right: 'transform.light = split(light);', wrong: 'transform.light = split(light); for (int k = 0; k < 4; ++k) transform.clip_from_relative[k][2] += 1e-4F * transform.clip_from_relative[k][3];' },
  { name: 'light_low_dropped', file: 'raster/glsl/passes/project.vert', right: '(light_w * position - light_high) - light_low', wrong: '(light_w * position - light_high)', why: 'Only near_light has casters so close to its light that this tells: in pixels as near to the border of a shadow as the driver may move it.' },
  { name: 'finite_ends_for_infinite', file: 'raster/glsl/passes/project.vert', right: 'vec4(away, end_w)', wrong: 'vec4(relative + 10 * away, 1)' },
  { name: 'seen_triangle_not_asked', file: 'raster/glsl/passes/lit_side.glsl', right: 'if (seen != triangle_drawn[first_side + gl_PrimitiveID]) return false;', wrong: '' },
  { name: 'volume_fragments_doubled', ...fragments('2 * fragments') },
  { name: 'volume_fragments_halved', ...fragments('fragments / 2') },
  { name: 'volume_fragments_10_percent_more', ...fragments('fragments + fragments / 10') },
  { name: 'volume_fragments_hidden_left_out', kind: 'figures', file: measure, right: 'gl.DepthFunc(GL_ALWAYS);', wrong: shownDepth },
  { name: 'volume_fragments_saved_doubled', kind: 'figures', techniques: 'auto', file: 'raster/techniques/auto.cpp', right: 'static_cast<std::int64_t>(spent.counted->volume_fragments)', wrong: '2 * static_cast<std::int64_t>(spent.counted->volume_fragments)' },
  { name: 'volume_picture_empty', kind: 'figures', file: measure, right: 'draw_volumes();\n    end_adding(gl);', wrong: 'end_adding(gl);' },
  { name: 'volume_picture_counts_hidden', kind: 'figures', file: measure, right: shownDepth, wrong: 'gl.DepthFunc(GL_ALWAYS);' },
  { name: 'volume_picture_without_coincident', kind: 'figures', file: measure, right: shownDepth, wrong: 'gl.DepthFunc(reversed ? GL_GREATER : GL_LESS);' },
  { name: 'volume_picture_of_front_faces', kind: 'figures', file: measure, right: 'set_worth(gl, *pass, 1, 1);', wrong: 'set_worth(gl, *pass, 1, 0);' },
  { name: 'volume_picture_of_counters', kind: 'figures', file: measure, right: 'read_sum(gl, target)', wrong: 'converted<float>(frame.counted->counter, [](std::uint32_t counted) { return static_cast<float>(counted); })' },
  { name: 'volumes_measured_without_turned', kind: 'figures', file: 'raster/volumes/counted_light.cpp', right: 'part->volumes.draw();\n                part->volumes.draw_flipped();', wrong: 'part->volumes.draw();' },
].map((fault) => ({ kind: 'numbers', ...fault }));
