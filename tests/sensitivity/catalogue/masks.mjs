// Alpha masks: which surfaces, casters and rays read them, and how.
const mask = 'raster/glsl/passes/mask.glsl';
const passes = 'raster/passes/passes.cpp';
const pass = 'raster/maps/map_pass.cpp';
const rays = 'raster/traced/float_mask.cpp';
const traced = 'traced_epsilon,traced_offset,traced_skip';
const symmetric = 'The bundled mask is symmetric.';
const some = 'zpass,zfail_reversed,auto,cube_map_six_pass,traced_epsilon';
const read = (wrong) => ({ file: mask, techniques: some, right: 'return between(row_of_alpha(s, t.first), row_of_alpha(s, t.second), t.fraction) < least_alpha;', wrong });
const alpha = 'between(row_of_alpha(s, t.first), row_of_alpha(s, t.second), t.fraction)';
const across = (wrong) => ({ file: mask, techniques: some, right: 'Taps s = taps_at(mask_wrap_s, size.x, masked.at.x);', wrong });
const down = (wrong) => ({ file: mask, techniques: some, right: 'Taps t = taps_at(mask_wrap_t, size.y, masked.at.y);', wrong });
const row = (wrong) => ({ file: mask, techniques: some, right: 'texelFetch(mask_alpha, ivec2(s.second, row), 0).r, s.fraction);', wrong });
const solid = (name, frag, techniques) => ({ name, file: `raster/glsl/${frag}`, right: 'if (is_left_out()) discard;', wrong: '', techniques });
const uploaded = (wrong) => ({ file: passes, techniques: some, right: 'at.resize(vertices);', wrong: `at.resize(vertices); ${wrong}` });
const stands = (wrong) => ({ file: rays, techniques: traced, right: 'return double{alpha_at(scene.masks[mask], at)} >= scene.masks[mask].least;', wrong });
export const faults = [
  // Who reads them.
  solid('mask_of_surfaces_unread', 'passes/surface_masked.frag', 'zpass,zfail_reversed,auto,cube_map_six_pass'),
  solid('mask_of_map_distances_unread', 'maps/map_distance_masked.frag', 'cube_map_six_pass,cube_map_geometry_shader'),
  { name: 'mask_of_casters_unread', file: pass, right: 'scene.materials[mesh.material].mask', wrong: 'no_mask' },
  { name: 'mask_of_rays_unread', ...stands('return true;') },
  { name: 'mask_lets_all_rays_through', ...stands('return false;') },
  // How.
  { name: 'mask_inverted', ...read(`return ${alpha} >= least_alpha;`) },
  { name: 'mask_cutoff_of_a_half', ...read(`return ${alpha} < 0.5;`) },
  { name: 'mask_cutoff_a_byte_off', ...read(`return ${alpha} < least_alpha + 1.0 / 255.0;`) },
  { name: 'mask_cutoff_1e-4_off', ...read(`return ${alpha} < least_alpha + 1e-4;`), why: 'Half a step of snapping changes alpha as much at the two texels.' },
  { name: 'mask_cutoff_itself_left_out', ...read(`return ${alpha} <= least_alpha;`), why: 'No texel of the bundled mask has the cutoff, and between texels it is met at no pixel.' },
  { name: 'mask_rows_exchanged', ...read(`return between(row_of_alpha(s, t.second), row_of_alpha(s, t.first), t.fraction) < least_alpha;`) },
  { name: 'mask_of_the_upper_row', ...read('return row_of_alpha(s, t.first) < least_alpha;') },
  { name: 'mask_of_the_nearest_texel', ...read('return texelFetch(mask_alpha, ivec2(s.fraction < 0.5 ? s.first : s.second, t.fraction < 0.5 ? t.first : t.second), 0).r < least_alpha;') },
  { name: 'mask_smoothed_between_texels', ...read(`return between(row_of_alpha(s, t.first), row_of_alpha(s, t.second), t.fraction * t.fraction * (3 - 2 * t.fraction)) < least_alpha;`) },
  { name: 'mask_of_the_left_texel', ...row('texelFetch(mask_alpha, ivec2(s.first, row), 0).r, s.fraction);') },
  { name: 'mask_mirrored', ...across('Taps s = taps_at(mask_wrap_s, size.x, 1 - masked.at.x);'), why: symmetric },
  { name: 'mask_of_clamped_coordinates', ...across('Taps s = taps_at(wrap_clamp_to_edge, size.x, masked.at.x);'), why: 'The bundled mask is symmetric: beyond its border it goes on as it is there, and no coordinate is further out.' },
  { name: 'mask_half_a_texel_aside', ...across('Taps s = taps_at(mask_wrap_s, size.x, masked.at.x + 0.5 / float(size.x));') },
  { name: 'mask_a_hundredth_texel_aside', ...across('Taps s = taps_at(mask_wrap_s, size.x, masked.at.x + 0.01 / float(size.x));') },
  { name: 'mask_upside_down', ...down('Taps t = taps_at(mask_wrap_t, size.y, 1 - masked.at.y);'), why: symmetric },
  { name: 'mask_axes_exchanged', ...down('Taps t = taps_at(mask_wrap_t, size.y, masked.at.x); s = taps_at(mask_wrap_s, size.x, masked.at.y);') },
  { name: 'mask_coordinates_of_another_vertex', ...uploaded('std::rotate(at.begin(), at.begin() + 1, at.end());') },
  { name: 'mask_coordinates_in_halves', ...uploaded('for (glm::vec2& place : at) place = glm::round(place * 1024.0F) / 1024.0F;'), why: 'The bundled coordinates are round.' },
  { name: 'mask_cutoff_below', file: passes, techniques: some, right: 'float_not_below(mask.least)', wrong: 'std::nextafter(static_cast<float>(mask.least), 0.0F)', why: 'By one step of a float, which no alpha is between.' },
  { name: 'mask_of_rays_mirrored', file: rays, techniques: traced, right: 'float_taps(mask.wrap_s, mask.alpha.width, at.x, mask.nearest)', wrong: 'float_taps(mask.wrap_s, mask.alpha.width, 1 - at.x, mask.nearest)', why: symmetric },
  { name: 'mask_of_rays_cutoff_of_a_half', ...stands('return double{alpha_at(scene.masks[mask], at)} >= 0.5;') },
  { name: 'mask_of_rays_cutoff_a_byte_off', ...stands('return double{alpha_at(scene.masks[mask], at)} >= scene.masks[mask].least + 1.0 / 255;') },
  { name: 'mask_of_rays_a_hundredth_texel_aside', ...stands('return double{alpha_at(scene.masks[mask], at + glm::vec2(0.01F / static_cast<float>(scene.masks[mask].alpha.width), 0))} >= scene.masks[mask].least;') },
  { name: 'mask_of_rays_weights_exchanged', file: rays, techniques: traced, right: 'weights.x * scene.mask_at[t.y] + weights.y * scene.mask_at[t.z]', wrong: 'weights.y * scene.mask_at[t.y] + weights.x * scene.mask_at[t.z]' },
  { name: 'mask_of_rays_by_the_nearest_texel', file: rays, techniques: traced, right: 'if (mask.nearest) return mask.alpha.at(s.first, t.first);', wrong: 'return mask.alpha.at(s.fraction < 0.5F ? s.first : s.second, t.fraction < 0.5F ? t.first : t.second);' },
].map((fault) => ({ kind: 'masks', ...fault }));
