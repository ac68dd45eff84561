// Shadow maps: how they are drawn, stored, looked up and compared.
const pass = 'raster/maps/map_pass.cpp';
const shadows = 'raster/maps/map_shadows.cpp';
const test = 'raster/glsl/maps/map_test.glsl';
const cube = 'raster/glsl/maps/map_light_cube.frag';
const spot = 'raster/glsl/maps/map_light_spot.frag';
const filtered = 'raster/glsl/maps/map_light_spot_filtered.frag';
const filteredCube = 'raster/glsl/maps/map_light_cube_filtered.frag';
const block = 'raster/glsl/maps/map_block.glsl';
const ramp = 'raster/glsl/maps/map_light_ramp.frag';
const rampDrawn = { file: 'raster/glsl/maps/map_ramp.frag', right: 'step_at((map_from_world * surface.from_light).z)' };
const inStencil = 'raster/glsl/maps/map_stencil_spot.frag';
const camera = (change) => ({ file: pass, right: 'seen_from_light.camera = map_camera(chosen_light(scene), model, face);', wrong: `seen_from_light.camera = map_camera(chosen_light(scene), model, face); Camera& c = seen_from_light.camera; ${change};` });
const asked = (wrong) => ({ file: cube, right: 'texture(map, surface.from_light).r', wrong });
const placed = (wrong) => ({ file: spot, right: 'vec3(0.5 * (place.xy + place.z), place.z)', wrong });
const compared = (wrong) => ({ file: test, right: 'stored * planes.y + bias < length(surface.from_light)', wrong });
const nearer = (wrong) => ({ file: test, right: 'float nearer = depth - bias;', wrong });
const stored = (wrong) => ({ file: 'raster/glsl/maps/map_distance.frag', right: 'length(surface.from_light) / far', wrong });
export const faults = [
  // The map.
  { name: 'map_not_cleared', file: pass, right: 'gl.ClearNamedFramebufferfv(framebuffer, GL_DEPTH, 0, &farthest_depth);', wrong: '' },
  { name: 'map_cleared_to_half', file: pass, right: 'gl.ClearNamedFramebufferfv(framebuffer, GL_DEPTH, 0, &farthest_depth);', wrong: 'const GLfloat half = 0.5F; gl.ClearNamedFramebufferfv(framebuffer, GL_DEPTH, 0, &half);' },
  { name: 'map_keeps_the_farthest', file: pass, right: 'gl.DepthFunc(GL_LESS);', wrong: 'gl.DepthFunc(GL_GREATER);' },
  { name: 'map_keeps_the_last', file: pass, right: 'gl.DepthFunc(GL_LESS);', wrong: 'gl.DepthFunc(GL_ALWAYS);' },
  { name: 'map_culls_backs', file: pass, right: 'set_culling(gl, pass.model.culling);', wrong: 'set_culling(gl, MapCulling::back);' },
  { name: 'map_culls_fronts', file: pass, right: 'set_culling(gl, pass.model.culling);', wrong: 'set_culling(gl, MapCulling::front);' },
  { name: 'map_faces_in_another_order', ...camera('c = map_camera(chosen_light(scene), model, face ^ 1U)') },
  { name: 'map_faces_rotated', ...camera('std::swap(c.right, c.up); c.right = -c.right') },
  { name: 'map_face_mirrored', ...camera('if (face == 3 || model.faces() == 1) c.right = -c.right') },
  { name: 'map_face_upside_down', ...camera('if (face == 3 || model.faces() == 1) c.up = -c.up') },
  { name: 'map_light_moved_1e-2', ...camera('seen_from_light.lights.front().position += glm::dvec3(1e-2 * model.far, 0, 0); c.eye = seen_from_light.lights.front().position') },
  { name: 'map_light_moved_1e-4', ...camera('seen_from_light.lights.front().position += glm::dvec3(1e-4 * model.far, 0, 0); c.eye = seen_from_light.lights.front().position') },
  { name: 'map_of_another_light', ...camera('c.eye = scene.lights[(scene.light + 1) % scene.lights.size()].position; seen_from_light.lights.front().position = c.eye') },
  { name: 'map_wider_by_a_percent', ...camera('c.half_height *= 1.01') },
  { name: 'map_wider_by_a_thousandth', ...camera('c.half_height *= 1.001') },
  { name: 'map_half_a_texel_aside', ...camera('c.forward += c.right * (c.half_height / model.size)') },
  { name: 'map_turned_1e-3', ...camera('c.forward = glm::normalize(c.forward + 1e-3 * c.up); c.up = glm::cross(c.right, c.forward)') },
  { name: 'map_casters_all_but_one', file: pass, right: 'if (!mesh.casts) continue;', wrong: 'if (!mesh.casts || &mesh == &scene.meshes.back()) continue;' },
  { name: 'map_of_all_meshes', file: pass, right: 'if (!mesh.casts) continue;', wrong: '', why: 'Every bundled mesh casts.' },
  { name: 'map_a_triangle_lost', file: pass, right: 'runs.push_back({mesh.first_triangle, mesh.triangle_count, true, mask});', wrong: 'runs.push_back({mesh.first_triangle, mesh.triangle_count - 1, true, mask});' },
  { name: 'map_of_32_bits_stored_in_16', file: pass, right: 'return GL_DEPTH_COMPONENT32F;', wrong: 'return GL_DEPTH_COMPONENT16;', techniques: 'cube_map_six_pass' },
  { name: 'map_of_24_bits_stored_in_16', file: pass, right: 'return GL_DEPTH_COMPONENT24;', wrong: 'return GL_DEPTH_COMPONENT16;', techniques: 'spot_map' },
  { name: 'map_linear_filter', file: pass, right: 'gl.TextureParameteri(texture.name(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);', wrong: 'gl.TextureParameteri(texture.name(), GL_TEXTURE_MAG_FILTER, GL_LINEAR); gl.TextureParameteri(texture.name(), GL_TEXTURE_MIN_FILTER, GL_LINEAR);' },
  { name: 'map_viewport_of_half_the_size', file: pass, right: 'gl.Viewport(0, 0, pass.model.size, pass.model.size);', wrong: 'gl.Viewport(0, 0, pass.model.size / 2, pass.model.size / 2);' },
  { name: 'map_viewport_a_texel_short', file: pass, right: 'gl.Viewport(0, 0, pass.model.size, pass.model.size);', wrong: 'gl.Viewport(0, 0, pass.model.size - 1, pass.model.size - 1);' },
  { name: 'map_depths_clamped', file: pass, right: 'gl.Disable(GL_DEPTH_CLAMP);', wrong: 'gl.Enable(GL_DEPTH_CLAMP);' },
  { name: 'map_distances_in_world_units', ...stored('length(surface.from_light)') },
  { name: 'map_distances_squared', ...stored('dot(surface.from_light, surface.from_light) / (far * far)') },
  { name: 'map_distances_along_an_axis', ...stored('max(max(abs(surface.from_light.x), abs(surface.from_light.y)), abs(surface.from_light.z)) / far') },
  { name: 'map_distances_a_thousandth_off', ...stored('length(surface.from_light) * 1.001 / far') },
  { name: 'map_distances_1e-5_off', ...stored('length(surface.from_light) * 1.00001 / far') },
  { name: 'map_one_layer_missing', file: 'raster/glsl/maps/map_cube.geom', right: 'face < 6', wrong: 'face < 5' },
  { name: 'map_layers_exchanged', file: 'raster/glsl/maps/map_cube.geom', right: 'gl_Layer = face;', wrong: 'gl_Layer = face ^ 1;' },
  { name: 'map_vertices_of_one_corner', file: 'raster/glsl/maps/map_cube.geom', right: 'clip_from_light[face] * vec4(corner[k].from_light, 1)', wrong: 'clip_from_light[face] * vec4(corner[k].from_light, 1.001)', why: 'It moves nothing but the near plane, by a thousandth.' },
  // The question.
  { name: 'map_asked_the_other_way', ...asked('texture(map, -surface.from_light).r') },
  { name: 'map_asked_with_z_mirrored', ...asked('texture(map, surface.from_light * vec3(1, 1, -1)).r') },
  { name: 'map_asked_a_hundredth_aside', ...asked('texture(map, surface.from_light + vec3(0.01 * length(surface.from_light), 0, 0)).r') },
  { name: 'map_asked_a_thousandth_aside', ...asked('texture(map, surface.from_light + vec3(0, 0.001 * length(surface.from_light), 0)).r') },
  { name: 'map_asked_1e-5_aside', ...asked('texture(map, surface.from_light * vec3(1.00001, 1, 0.99999)).r'), why: 'A hundredth of a texel: what it changes is as near to the border of a texel as interpolation is off.' },
  { name: 'spot_asked_without_division', ...placed('vec3(0.5 * (place.xy + 1), 1)') },
  { name: 'spot_asked_upside_down', ...placed('vec3(0.5 * (vec2(place.x, -place.y) + place.z), place.z)') },
  { name: 'spot_asked_half_a_texel_aside', ...placed('vec3(0.5 * (place.xy + place.z) + 0.5 / 1024 * place.z, place.z)') },
  { name: 'spot_asked_1_64_of_a_texel_aside', ...placed('vec3(0.5 * (place.xy + place.z) + 0.015625 / 1024 * place.z, place.z)'), why: 'What it changes is as near to the border of a texel as interpolation is off.' },
  // The comparison.
  { name: 'map_bias_left_out', ...compared('stored * planes.y < length(surface.from_light)') },
  { name: 'map_bias_doubled', ...compared('stored * planes.y + 2 * bias < length(surface.from_light)') },
  { name: 'map_bias_with_the_other_sign', ...compared('stored * planes.y - bias < length(surface.from_light)') },
  { name: 'map_bias_a_hundredth_off', ...compared('stored * planes.y + 1.01 * bias < length(surface.from_light)') },
  { name: 'map_bias_not_in_world_units', ...compared('(stored + bias) * planes.y < length(surface.from_light)') },
  { name: 'map_compared_the_other_way', ...compared('stored * planes.y + bias > length(surface.from_light)') },
  { name: 'map_compared_with_near', ...compared('stored * planes.x + bias < length(surface.from_light)') },
  { name: 'depth_bias_left_out', ...nearer('float nearer = depth;') },
  { name: 'depth_bias_a_hundredth_off', ...nearer('float nearer = depth - 1.01 * bias;'), why: 'It changes a single pixel, whose point may ask another texel that answers so.' },
  { name: 'depth_not_made_a_window_depth', file: test, right: 'planes.y / (planes.y - planes.x) * (1 - planes.x / nearer)', wrong: 'nearer / planes.y' },
  { name: 'map_not_asked', file: cube, right: 'ask_shadows && is_shadowed', wrong: 'false && is_shadowed' },
  { name: 'map_asked_of_all', file: cube, right: 'ask_shadows && is_shadowed', wrong: 'is_shadowed', why: 'Every bundled mesh receives.' },
  // The filter.
  ...[
    ['block_a_texel_aside', 'floor(place - 0.5 * float(side - 1))', 'floor(place - 0.5 * float(side + 1))'],
    ['block_half_a_texel_aside', 'floor(place - 0.5 * float(side - 1))', 'floor(place - 0.5 * float(side))'],
    ['block_of_a_row_less', 'int y = 0; y < side; ++y', 'int y = 1; y < side; ++y'],
    ['block_of_one_texel', 'stored_at(first + ivec2(x, y))', 'stored_at(first)'],
    ['share_of_shadow', 'if (!is_shadowed(stored, depth)) ++lit;', 'if (is_shadowed(stored, depth)) ++lit;'],
    ['share_one_too_high', 'float(64 + lit) / 255', '(lit < all - 1 ? float(65 + lit) / 255 : 1)'],
    ['share_rounded_to_all_or_none', 'if (lit == 0) discard;', 'if (2 * lit < all) discard; lit = all;'],
    ['values_averaged_instead', 'if (averages_values) lit', 'if (true) lit'],
  ].map(([name, right, wrong]) => ({ name: `pcf_${name}`, file: block, right, wrong, techniques: 'spot_map_pcf,cube_map_pcf' })),
  { name: 'pcf_block_not_clamped', file: filtered, right: 'clamp(texel, 0, textureSize(map, 0).x - 1)', wrong: 'texel % textureSize(map, 0).x', techniques: 'spot_map_pcf' },
  ...[
    ['block_seamless', 'if (!seamless) along = clamp(along, -most, most);', ''],
    ['block_upside_down', '0.5 * (place.xy + 1)', '0.5 * (1 - place.xy)'],
    ['block_a_16th_of_a_texel_aside', '0.5 * (place.xy + 1)', '0.5 * (place.xy + 1 + 0.125 / textureSize(map, 0).x)'],
    ['face_mirrored', 'vec3(towards * major, -t, -towards * s)', 'vec3(towards * major, -t, towards * s)'],
    ['face_upside_down', 'vec3(s, towards * major, towards * t)', 'vec3(s, towards * major, -towards * t)'],
    ['opposite_face', '(face & 1) == 0 ? 1 : -1', '(face & 1) == 0 ? -1 : 1'],
  ].map(([name, right, wrong]) => ({ name: `cube_pcf_${name}`, file: filteredCube, right, wrong, techniques: 'cube_map_pcf' })),
  // A ramp in place of depths.
  ...[
    { name: 'not_cleared', file: pass, right: 'gl.ClearNamedFramebufferfv(framebuffer, GL_COLOR, 0, last_step.data());', wrong: '' },
    { name: 'of_seven_bits', file: pass, right: 'steps[step] = static_cast<std::uint8_t>(step);', wrong: 'steps[step] = static_cast<std::uint8_t>(step & 0xfeU);' },
    { name: 'a_step_aside', file: pass, right: 'steps[step] = static_cast<std::uint8_t>(step);', wrong: 'steps[step] = static_cast<std::uint8_t>(step > 0 ? step - 1 : 0);' },
    { name: 'of_window_depths', ...rampDrawn, wrong: 'gl_FragCoord.z' },
    { name: 'of_distances', ...rampDrawn, wrong: 'step_at(length(surface.from_light))' },
    { name: 'a_hundredth_off', ...rampDrawn, wrong: 'step_at(1.01 * (map_from_world * surface.from_light).z)' },
    { name: 'compared_without_bias', file: ramp, right: 'step_at(place.z - bias)', wrong: 'step_at(place.z)' },
    { name: 'compared_a_step_later', file: ramp, right: 'steps_behind > 0.5', wrong: 'steps_behind > 1.5' },
    { name: 'compared_a_step_earlier', file: ramp, right: 'steps_behind > 0.5', wrong: 'steps_behind > -0.5' },
    { name: 'compared_the_other_way', file: ramp, right: 'steps_behind > 0.5', wrong: 'steps_behind < -0.5' },
    { name: 'asked_without_division', file: ramp, right: 'textureProj(map, projected).r', wrong: 'texture(map, projected.xy).r' },
  ].map((fault) => ({ ...fault, name: `ramp_${fault.name}`, techniques: 'spot_map_dual_texture' })),
  // The answers, kept in the stencil.
  ...[
    { name: 'of_what_is_lit', file: inStencil, right: 'if (!is_shadowed(', wrong: 'if (is_shadowed(' },
    { name: 'not_written', file: shadows, right: 'gl.StencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);', wrong: 'gl.StencilOp(GL_KEEP, GL_KEEP, GL_KEEP);' },
    { name: 'written_as_zero', file: shadows, right: 'gl.StencilFunc(GL_ALWAYS, 1, ~0U);', wrong: 'gl.StencilFunc(GL_ALWAYS, 0, ~0U);' },
    { name: 'masked', file: shadows, right: 'gl.StencilMask(~0U);', wrong: 'gl.StencilMask(0);' },
    { name: 'not_asked', file: shadows, right: 'in_stencil ? Counter::stencil : Counter::none', wrong: 'Counter::none' },
    { name: 'of_all_depths', file: shadows, right: 'gl.DepthFunc(GL_EQUAL);', wrong: 'gl.DepthFunc(GL_ALWAYS);', why: 'The shader asks for the triangle that is seen.' },
  ].map((fault) => ({ ...fault, name: `map_stencil_${fault.name}`, techniques: 'spot_map_stencil' })),
].map((fault) => ({ kind: 'map', ...fault }));
