// The volumes: caps, sides, winding.
const file = 'raster/volumes/volume.cpp';
const cap = 'volume.light_cap.push_back(corners);';
const dark = 'volume.dark_cap.emplace_back(corners.z + far_end, corners.y + far_end, corners.x + far_end);';
const facing = 'if (side(scene, triangle, light) > 0) facing.push_back(triangle);';
const oneSide = 'sides.emplace_back(high, low, low + position_count);';
const otherSide = 'sides.emplace_back(high, low + position_count, high + position_count);';
const lit = '(of_light > 0 && of_eye > 0) || (of_light < 0 && of_eye < 0)';
const around = 'return sign * side_of_triangle(a, b, c, place) < 0 &&\n           sign * side_of_edge(light, a, b, place) < 0 &&\n           sign * side_of_edge(light, b, c, place) < 0 &&\n           sign * side_of_edge(light, c, a, place) < 0;';
export const faults = [
  { name: 'one_light_cap_missing', file, right: cap, wrong: 'volume.light_cap.push_back(volume.light_cap.empty() ? glm::uvec3(corners.x) : corners);' },
  { name: 'last_light_caps_missing', file, right: cap, wrong: 'volume.light_cap.push_back(volume.light_cap.size() > 10 ? glm::uvec3(corners.x) : corners);' },
  { name: 'light_caps_flipped', file, right: cap, wrong: 'volume.light_cap.emplace_back(corners.y, corners.x, corners.z);' },
  { name: 'one_light_cap_flipped', file, right: cap, wrong: 'volume.light_cap.push_back(volume.light_cap.empty() ? glm::uvec3(corners.y, corners.x, corners.z) : corners);' },
  { name: 'light_cap_doubled', file: 'raster/volumes/volume_pass.cpp', right: 'if (caps.light) parts.emplace_back(volume.light_cap);', wrong: 'if (caps.light) { parts.emplace_back(volume.light_cap); parts.emplace_back(volume.light_cap); }' },
  { name: 'light_caps_missing', file: 'raster/volumes/volume_pass.cpp', right: 'if (caps.light) parts.emplace_back(volume.light_cap);', wrong: ';' },
  { name: 'dark_caps_missing', file: 'raster/volumes/volume_pass.cpp', right: 'if (caps.dark) parts.emplace_back(volume.dark_cap);', wrong: ';' },
  { name: 'dark_caps_always', file: 'raster/volumes/volume_pass.cpp', right: 'if (caps.dark) parts.emplace_back(volume.dark_cap);', wrong: 'parts.emplace_back(volume.dark_cap);', why: 'Where the plan leaves them out they are not seen.' },
  { name: 'dark_caps_not_reversed', file, right: dark, wrong: 'volume.dark_cap.emplace_back(corners.x + far_end, corners.y + far_end, corners.z + far_end);' },
  { name: 'one_dark_cap_missing', file, right: dark, wrong: 'volume.dark_cap.push_back(volume.dark_cap.empty() ? glm::uvec3(far_end) : glm::uvec3(corners.z + far_end, corners.y + far_end, corners.x + far_end));' },
  { name: 'dark_cap_where_it_is', file, right: dark, wrong: 'static_cast<void>(far_end); volume.dark_cap.emplace_back(corners.z, corners.y, corners.x);' },
  { name: 'planes_through_light_face', file, right: facing, wrong: 'if (side(scene, triangle, light) >= 0) facing.push_back(triangle);' },
  { name: 'those_that_face_away', file, right: facing, wrong: 'if (side(scene, triangle, light) < 0) facing.push_back(triangle);' },
  { name: 'first_triangle_never_faces', file, right: facing, wrong: 'if (triangle > 0 && side(scene, triangle, light) > 0) facing.push_back(triangle);' },
  { name: 'every_50th_never_faces', file, right: facing, wrong: 'if (triangle % 50 != 7 && side(scene, triangle, light) > 0) facing.push_back(triangle);' },
  { name: 'sides_lack_a_half', file, right: oneSide, wrong: ';' },
  { name: 'sides_lack_other_half', file, right: otherSide, wrong: ';' },
  { name: 'some_sides_missing', file, right: oneSide, wrong: 'if (low % 17 != 3) sides.emplace_back(high, low, low + position_count);' },
  { name: 'side_wound_backwards', file, right: oneSide, wrong: 'sides.emplace_back(low, high, low + position_count);' },
  { name: 'all_sides_unflipped', file, right: 'a < b ? volume.sides : volume.flipped_sides', wrong: 'volume.sides' },
  { name: 'surplus_edges_once', file, right: 'for (int i = 0; i < surplus; ++i) append_side(a, b, position_count, volume);', wrong: 'static_cast<void>(surplus); append_side(a, b, position_count, volume);', why: 'No bundled scene has an edge of more surplus than one.' },
  { name: 'edges_without_twin_lost', file, right: 'const bool inner = half_edge.twin != no_half_edge &&\n                               faces[mesh.half_edges[half_edge.twin].triangle] != 0;'.replace(/^[^=]*= ([^]*);$/, '$1'), wrong: 'half_edge.twin == no_half_edge || faces[mesh.half_edges[half_edge.twin].triangle] != 0' },
  { name: 'flipped_caps_not_flipped', file, right: 'volume.flipped_caps.emplace_back(caps[i].y, caps[i].x, caps[i].z);', wrong: 'volume.flipped_caps.push_back(caps[i]);' },
  { name: 'flipped_caps_missing', file, right: 'volume.flipped_caps.emplace_back(caps[i].y, caps[i].x, caps[i].z);', wrong: ';' },
  { name: 'hidden_caps_drawn', techniques: 'auto', file, right: 'if (is(special.hidden, triangle)) continue;', wrong: ';' },
  { name: 'casters_lose_a_triangle', file: 'raster/volumes/caster_parts.cpp', right: 'part->scene.triangles.push_back(triangles[triangle]);', wrong: 'part->scene.triangles.push_back(triangle == 5 ? glm::uvec3(0) : triangles[triangle]);' },
  { name: 'lit_planes_through_light', file: 'raster/passes/lit_sides.cpp', right: lit, wrong: '(of_light >= 0 && of_eye > 0) || (of_light <= 0 && of_eye < 0)' },
  { name: 'lit_from_behind', file: 'raster/passes/lit_sides.cpp', right: lit, wrong: 'of_light * of_eye != 0' },
  { name: 'lit_fronts_only', file: 'raster/passes/lit_sides.cpp', right: lit, wrong: 'of_light > 0 && of_eye > 0' },
  { name: 'eye_behind_planes_only', techniques: 'zpass_eye_count', file: 'raster/volumes/eye_count.cpp', right: around, wrong: 'return sign * side_of_triangle(a, b, c, place) < 0 && sign * side_of_edge(light, a, b, place) < 0 && sign * side_of_edge(light, b, c, place) < 0;' },
  { name: 'near_caps_missing', techniques: 'zpass_capped', file: 'raster/volumes/near_cap.cpp', right: 'append_fan(loop_of(segments), cut.caps);', wrong: ';' },
  { name: 'cut_sides_missing', techniques: 'zpass_capped', file: 'raster/volumes/near_cap.cpp', right: 'for (int i = 0; i < surplus; ++i) append_fan(part.points, cut.sides);', wrong: 'static_cast<void>(surplus);' },
  { name: 'far_segments_missing', techniques: 'zpass_capped', file: 'raster/volumes/near_cap.cpp', right: 'add_segment(part);', wrong: ';' },
  { name: 'cut_off_by_a_thousandth', techniques: 'zpass_capped', file: 'raster/volumes/near_cap.cpp', right: 'return -at.z - scene_.camera.near * at.w;', wrong: 'return -at.z - 1.001 * scene_.camera.near * at.w;' },
  { name: 'first_occluder_missing', techniques: 'zp_plus', file: 'raster/volumes/near_plane.cpp', right: 'occluders.push_back(corners);', wrong: 'occluders.push_back(occluders.empty() ? glm::uvec3(0) : corners);', why: 'The first triangle that faces the light is nowhere between it and the near plane.' },
  { name: 'geometry_lacks_light_cap', techniques: 'zfail_geometry_shader', file: 'raster/glsl/volumes/volume.geom', right: 'if (light_cap) emit(corner[0].here, corner[2].here, corner[4].here);', wrong: '' },
  { name: 'geometry_dark_cap_unreversed', techniques: 'zfail_geometry_shader', file: 'raster/glsl/volumes/volume.geom', right: 'emit(corner[4].at_infinity, corner[2].at_infinity, corner[0].at_infinity)', wrong: 'emit(corner[0].at_infinity, corner[2].at_infinity, corner[4].at_infinity)' },
  { name: 'geometry_two_edges', techniques: 'zfail_geometry_shader', file: 'raster/glsl/volumes/volume.geom', right: 'for (int k = 0; k < 6; k += 2) {', wrong: 'for (int k = 0; k < 4; k += 2) {' },
  { name: 'geometry_half_sides', techniques: 'zfail_geometry_shader', file: 'raster/glsl/volumes/volume.geom', right: 'emit(corner[high].here, far, corner[high].at_infinity);', wrong: '' },
  { name: 'quads_cut_the_other_way', techniques: 'zfail_degenerate_quads', file: 'raster/glsl/volumes/degenerate_quads.vert', right: 'int[](1, 0, 2, 1, 2, 3)', wrong: 'int[](1, 0, 3, 0, 2, 3)', why: 'Either diagonal of a side is right; the judge allows both.' },
  { name: 'quads_without_fringe', techniques: 'zfail_degenerate_quads', file: 'raster/glsl/volumes/degenerate_quads.vert', right: 'edge.down != no_corner && ', wrong: 'edge.down == no_corner || ' },
  { name: 'facing_ties_face', techniques: 'zfail_geometry_shader,zfail_degenerate_quads', file: 'raster/glsl/volumes/facing.glsl', right: 'return sum > 0;', wrong: 'return sum >= 0;', why: 'The volume of a face in whose plane the light lies has no thickness: all of its faces lie in the surface, in whatever order depths round to.' },
  { name: 'facing_from_any_corner', techniques: 'zfail_geometry_shader,zfail_degenerate_quads', file: 'raster/glsl/volumes/facing.glsl', right: 'turn < 2 && (is_before', wrong: 'turn < 0 && (is_before', why: 'Another order of corners changes the last bits of a sum whose sign they do not decide.' },
].map((fault) => ({ kind: 'geometry', ...fault }));
