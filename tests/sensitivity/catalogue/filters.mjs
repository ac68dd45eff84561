// Mipmaps of bumps and decals, their levels, and the highlights of what they leave.
const mipmap = 'raster/glsl/lighting/mipmap.glsl';
const filtered = 'raster/glsl/lighting/filtered.glsl';
const lit = 'raster/glsl/lighting/bump_filtered.frag';
const pyramid = 'scenes/surface/bump_pyramid.cpp';
const log = 'texels > 1 ? log2_of(texels) : 0';
const between = 'kept - float(finer)';
const decalLookup = 'filtered(decal_map, decal_wrap_s, decal_wrap_t, surface.decal_at, over)';
const bumpLookup = 'filtered(bump_map, bump_wrap_s, bump_wrap_t, surface.bump_at, over)';
const finest = 'Footprint(0, 1, vec2(0))';
const highlight = 'highlight_shadow(l.z, h.z) * filtered_highlight(h, bumps)';
const techniques = 'bump_mipmapped,bump_mipmapped_dimmed,bump_toksvig,bump_lean';
const asked = 'Only where --anisotropy asks for it.';
export const faults = [
  { name: 'level_a_fiftieth_off', file: mipmap, right: log, wrong: 'texels > 1 ? log2_of(texels) + 0.02 : 0' },
  { name: 'level_of_the_square', file: mipmap, right: log, wrong: 'texels > 1 ? 2 * log2_of(texels) : 0' },
  { name: 'level_half_up', file: mipmap, right: log, wrong: 'texels > 0.5 ? log2_of(texels) + 1 : 0' },
  { name: 'level_of_the_shorter_side', file: mipmap, right: 'float longer = sqrt(max(xx, yy));', wrong: 'float longer = sqrt(min(xx, yy));' },
  { name: 'level_of_the_mean_side', file: mipmap, right: 'float longer = sqrt(max(xx, yy));', wrong: 'float longer = sqrt(0.5 * (xx + yy));' },
  { name: 'levels_not_mixed', file: mipmap, right: between, wrong: '(kept - float(finer)) * 0' },
  { name: 'levels_mixed_at_the_middle', file: mipmap, right: between, wrong: 'clamp(2 * (kept - float(finer)) - 0.5, 0, 1)' },
  { name: 'levels_mixed_in_8_bits', file: mipmap, right: between, wrong: 'floor((kept - float(finer)) * 256 + 0.5) / 256', why: 'A quarter of a step at most: snapping moves pixels over more.' },
  { name: 'coarser_level_is_the_finer', file: mipmap, right: 'min(finer + 1, top)', wrong: 'finer' },
  { name: 'one_lookup_more', file: mipmap, right: 'min(most, ceil(longer / shorter))', wrong: 'min(most, ceil(longer / shorter) + 1)', why: asked },
  { name: 'lookups_along_the_shorter_side', file: mipmap, right: 'xx >= yy ? across : down', wrong: 'xx >= yy ? down : across', why: asked },
  { name: 'lookups_bunched', file: mipmap, right: 'float(i) / (over.probes + 1) - 0.5', wrong: '0.9 * (float(i) / (over.probes + 1) - 0.5)', why: asked },
  { name: 'level_sizes_rounded_up', file: mipmap, right: 'max(textureSize(map, 0) >> level, ivec2(1))', wrong: 'max((textureSize(map, 0) + (1 << level) - 1) >> level, ivec2(1))', why: 'All bundled maps have sizes of powers of two.' },
  { name: 'steps_along_rows_alone', file: filtered, right: 'Steps(dFdxFine(at), dFdyFine(at))', wrong: 'Steps(dFdxFine(at), dFdxFine(at))' },
  { name: 'steps_1_percent_off', file: filtered, right: 'Steps(dFdxFine(at), dFdyFine(at))', wrong: 'Steps(1.01 * dFdxFine(at), 1.01 * dFdyFine(at))' },
  { name: 'steps_over_two_pixels', file: filtered, right: 'Steps(dFdxFine(at), dFdyFine(at))', wrong: 'Steps(2 * dFdxFine(at), 2 * dFdyFine(at))' },
  { name: 'decals_not_filtered', file: filtered, right: decalLookup, wrong: `filtered(decal_map, decal_wrap_s, decal_wrap_t, surface.decal_at, ${finest})` },
  { name: 'bumps_not_filtered', file: filtered, right: bumpLookup, wrong: `filtered(bump_map, bump_wrap_s, bump_wrap_t, surface.bump_at, ${finest})` },
  { name: 'level_of_the_decal_for_bumps', file: filtered, right: 'textureSize(bump_map, 0)', wrong: 'textureSize(decal_map, 0)', why: 'Both maps of the scene have one size.' },
  { name: 'mean_normal_not_normalised', file: filtered, right: 'if (size > 0) bumps.normal = mean.xyz / size;', wrong: 'if (size > 0) bumps.normal = mean.xyz;' },
  { name: 'toksvig_not_dimmed', file: filtered, right: '(1 + kept * exponent) / (1 + exponent)', wrong: '1.0' },
  { name: 'toksvig_not_widened', file: filtered, right: 'power_of(max(0, cosine), kept * exponent)', wrong: 'power_of(max(0, cosine), exponent)' },
  { name: 'toksvig_by_the_squared_length', file: filtered, right: 'bumps.mean_length = min(size, 1);', wrong: 'bumps.mean_length = min(size * size, 1);' },
  { name: 'lean_without_covariance', file: filtered, right: 'float covariance = bumps.spread.z;', wrong: 'float covariance = 0;' },
  { name: 'lean_with_second_moments', file: filtered, right: 'mean.zw - mean.xy * mean.xy', wrong: 'mean.zw' },
  { name: 'lean_of_a_duller_surface', file: filtered, right: 'float own = 1 / exponent;', wrong: 'float own = 1.01 / exponent;' },
  { name: 'lean_not_dimmed', file: filtered, right: 'exp2_of(-0.5 * log2_of_e * square) / sqrt(determinant)', wrong: 'exp2_of(-0.5 * log2_of_e * square) / own' },
  { name: 'lean_about_the_surface', file: filtered, right: 'h.xy - h.z * bumps.slope', wrong: 'h.xy' },
  { name: 'lean_in_powers_of_e', file: filtered, right: 'exp2_of(-0.5 * log2_of_e * square) / sqrt(determinant)', wrong: 'exp2_of(-0.5 * square) / sqrt(determinant)' },
  { name: 'dim_factor_ignored', file: lit, right: 'dimmed * diffuse_term(l.z, dot(l, bumps.normal))', wrong: 'diffuse_term(l.z, dot(l, bumps.normal))' },
  { name: 'dim_factor_for_highlights', file: lit, right: highlight, wrong: `dimmed * ${highlight}` },
  { name: 'filtered_highlight_not_dimmed', file: lit, right: highlight, wrong: 'filtered_highlight(h, bumps)' },
  { name: 'ambient_decals_not_filtered', file: 'raster/glsl/lighting/ambient_filtered.frag', right: 'filtered_decal(steps).rgb', wrong: 'decal().rgb' },
  { name: 'logarithm_of_four_digits', file: 'raster/glsl/lighting/powers.glsl', right: 't * sum * log2_of_e', wrong: 't * sum * 1.4429', why: 'A hundredth of a step at most.' },
  { name: 'pyramid_of_heights_upside_down', file: pyramid, right: 'unit_or_up({-slope.x, slope.y, 1})', wrong: 'unit_or_up({-slope.x, -slope.y, 1})' },
  { name: 'pyramid_of_bytes', file: pyramid, right: 'unit_or_up({scale * m.x, scale * m.y, m.z})', wrong: 'glm::round(unit_or_up({scale * m.x, scale * m.y, m.z}) * 127.0) / 127.0' },
  { name: 'dim_factor_of_1', file: pyramid, right: 'static_cast<float>(glm::length(mean))', wrong: '1.0F' },
  { name: 'slopes_of_raw_normals', file: pyramid, right: 'glm::dvec2(n) / std::max(n.z, least_cosine_of_slopes)', wrong: 'glm::dvec2(n)' },
  { name: 'texels_an_eighth_aside', file: 'scenes/surface/mipmap.cpp', right: 'texel * size', wrong: '(texel + (coarse < fine ? 0.125 : 0.0)) * size' },
  { name: 'shares_1_percent_off', file: 'scenes/surface/mipmap.cpp', right: 'across / size', wrong: '(coarse < fine ? 0.99 : 1.0) * across / size' },
].map((fault) => ({ ...fault, kind: 'filters', techniques, scenes: 'distant_bumps' }));
