// Maps of directional lights: how their parallel camera draws, how they are looked up and compared.
const pass = 'raster/maps/map_pass.cpp';
const shadows = 'raster/maps/map_shadows.cpp';
const sun = 'raster/glsl/maps/map_light_sun.frag';
const test = 'raster/glsl/maps/map_test.glsl';
const draws = 'return clip_transform(seen_from_light, map_depth_model(model));';
const camera = (change) => ({ file: pass, right: draws, wrong: `if (Camera& p = seen_from_light.camera; model.shape == MapModel::Shape::sun) { ${change}; } ${draws}` });
const matrix = (right, wrong) => ({ file: 'scenes/camera.cpp', right, wrong });
const placed = (wrong) => ({ file: sun, right: '0.5 * (place.xy + 1)', wrong });
const compared = (wrong) => ({ file: test, right: '(nearer - planes.x) / (planes.y - planes.x)', wrong });
const origin = (wrong) => ({ file: shadows, right: 'split(map_camera(chosen_light(scene), model, 0).eye)', wrong });
export const faults = [
  // The map.
  { name: 'sun_drawn_in_perspective', ...camera('p.projection = Projection::perspective') },
  { name: 'sun_depths_run_backwards', ...matrix('-2 / (far - near)', '2 / (far - near)') },
  { name: 'sun_depths_not_moved_to_the_planes', ...matrix('is_parallel ? middle : -2 * far * near / (far - near)', 'is_parallel ? -1 : -2 * far * near / (far - near)') },
  { name: 'sun_depths_a_thousandth_off', ...matrix('-2 / (far - near)', '-2.002 / (far - near)') },
  { name: 'sun_wider_by_a_thousandth', ...matrix('clip[0][0] = 1 / half.x;', 'clip[0][0] = (camera.is_orthographic() ? 0.999 : 1) / half.x;') },
  { name: 'sun_higher_by_a_percent', ...matrix('clip[1][1] = 1 / half.y;', 'clip[1][1] = (camera.is_orthographic() ? 0.99 : 1) / half.y;') },
  { name: 'sun_map_mirrored', ...camera('p.right = -p.right') },
  { name: 'sun_map_upside_down', ...camera('p.up = -p.up') },
  { name: 'sun_map_rotated', ...camera('std::swap(p.right, p.up)') },
  { name: 'sun_from_the_other_side', ...camera('p.forward = -p.forward') },
  { name: 'sun_half_a_texel_aside', ...camera('p.eye += p.right * (p.half_height / model.size)') },
  { name: 'sun_turned_1e-3', ...camera('p.forward = glm::normalize(p.forward + 1e-3 * p.up); p.up = glm::cross(p.right, p.forward)') },
  { name: 'sun_moved_along_by_1e-3', ...camera('p.eye += 1e-3 * (p.far - p.near) * p.forward') },
  // The question.
  { name: 'sun_light_pass_from_elsewhere', ...origin('split(map_camera(chosen_light(scene), model, 0).eye + glm::dvec3(0.01 * model.half_side, 0, 0))') },
  { name: 'sun_asked_upside_down', ...placed('0.5 * (vec2(place.x, -place.y) + 1)') },
  { name: 'sun_asked_without_the_shift', ...placed('0.5 * place.xy') },
  { name: 'sun_asked_in_perspective', ...placed('0.5 * (place.xy / place.z + 1)') },
  { name: 'sun_asked_half_a_texel_aside', ...placed('0.5 * (place.xy + 1) + 0.5 / 1024') },
  // The comparison.
  { name: 'sun_compared_from_the_eye', ...compared('nearer / planes.y') },
  { name: 'sun_compared_in_perspective', ...compared('planes.y / (planes.y - planes.x) * (1.0 - planes.x / nearer)') },
  { name: 'sun_compared_without_near', ...compared('nearer / (planes.y - planes.x)') },
  { name: 'sun_compared_with_distances', file: sun, right: '.r, place.z)', wrong: '.r, length(surface.from_light))' },
  { name: 'sun_bias_left_out', file: test, right: 'float nearer = depth - bias;', wrong: 'float nearer = depth;' },
  { name: 'sun_bias_in_window_depths', file: test, right: 'float nearer = depth - bias;', wrong: 'float nearer = depth - bias * (planes.y - planes.x);' },
  { name: 'sun_not_asked', file: sun, right: 'ask_shadows && is_shadowed', wrong: 'false && is_shadowed' },
  { name: 'sun_asked_of_all', file: sun, right: 'ask_shadows && is_shadowed', wrong: 'is_shadowed', why: 'On no bundled scene with a directional light is there a surface without shadows.' },
].map((fault) => ({ kind: 'map', techniques: 'sun_map', ...fault })).concat([
  // A polygon offset that nobody asked for.
  ...[['unasked', '1.1F, 0'], ['of_units', '0, 64']].map(([name, offset]) => ({
    name: `map_polygon_offset_${name}`, file: pass,
    right: `gl.PolygonOffset(static_cast<GLfloat>(pass.model.slope_bias),
                     static_cast<GLfloat>(pass.model.offset_units));`,
    wrong: `gl.Enable(GL_POLYGON_OFFSET_FILL); gl.PolygonOffset(${offset});` })),
].map((fault) => ({ kind: 'map', techniques: 'spot_map,sun_map', ...fault })));
