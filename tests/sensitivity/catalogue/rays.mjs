// Rays traced in float: what is shot, and what is made of the answer.
const rays = 'raster/traced/shadow_rays.cpp';
const world = 'raster/traced/embree_world.cpp';
const techniques = 'traced_epsilon,traced_offset,traced_skip';
const shot = (wrong) => ({ file: rays, right: 'ray.direction = to_light / length;', wrong });
export const faults = [
  { name: 'ray_through_the_corner_of_a_pixel', file: rays, right: 'line_of_sight(scene_.camera, x + 0.5, y + 0.5)', wrong: 'line_of_sight(scene_.camera, x, y)' },
  { name: 'ray_through_another_place_1e-3_pixels', file: rays, right: 'line_of_sight(scene_.camera, x + 0.5, y + 0.5)', wrong: 'line_of_sight(scene_.camera, x + 0.501, y + 0.5)' },
  { name: 'ray_to_a_light_1e-5_aside', ...shot('ray.direction = to_light / length; ray.direction.x += 1e-5F;') },
  { name: 'ray_not_normalised', ...shot('ray.direction = to_light;') },
  { name: 'ray_away_from_the_light', ...shot('ray.direction = to_light / -length;') },
  { name: 'ray_beyond_the_light', file: rays, right: 'ray.far = length;', wrong: '' },
  { name: 'ray_short_of_the_light', file: rays, right: 'ray.far = length;', wrong: 'ray.far = 0.999F * length;' },
  { name: 'ray_epsilon_doubled', file: rays, right: 'model.start == RayModel::Start::epsilon ? model.distance : 0', wrong: 'model.start == RayModel::Start::epsilon ? 2 * model.distance : 0' },
  { name: 'ray_epsilon_left_out', file: rays, right: 'model.start == RayModel::Start::epsilon ? model.distance : 0', wrong: '0.0F' },
  { name: 'ray_offset_to_the_other_side', file: rays, right: 'hit.point + model.distance * hit.normal', wrong: 'hit.point - model.distance * hit.normal' },
  { name: 'ray_offset_a_hundredth_off', file: rays, right: 'hit.point + model.distance * hit.normal', wrong: 'hit.point + 1.01F * model.distance * hit.normal' },
  { name: 'ray_skips_any_triangle', file: rays, right: 'recipe_.skips_own ? triangle : no_triangle', wrong: 'recipe_.skips_own ? triangle + 1 : no_triangle' },
  { name: 'ray_hit_said_lit', file: rays, right: 'if (shadow.hit[i] != no_triangle) frame_.claim.at(x, y) = Visibility::shadowed;', wrong: '' },
  { name: 'ray_sides_not_told_apart', file: rays, right: 'if (!faces_light(triangle) || !in_cone(point)) return;', wrong: 'if (!in_cone(point)) return;' },
  { name: 'ray_cone_ignored', file: rays, right: 'if (!faces_light(triangle) || !in_cone(point)) return;', wrong: 'if (!faces_light(triangle)) return;' },
  { name: 'ray_cone_a_thousandth_wider', file: rays, right: 'std::cos(light_.outer_cone)', wrong: 'std::cos(1.001 * light_.outer_cone)' },
  { name: 'ray_meets_a_triangle_less', file: world, right: 'std::copy(scene.triangles.begin(), scene.triangles.end(), triangles);', wrong: 'std::copy(scene.triangles.begin(), scene.triangles.end(), triangles); triangles[scene.triangles.size() / 2] = triangles[0];' },
  { name: 'ray_meets_vertices_1e-6_aside', file: world, right: 'std::copy(scene.positions.begin(), scene.positions.end(), vertices);', wrong: 'for (std::size_t i = 0; i < scene.positions.size(); ++i) vertices[i] = scene.positions[i] * 1.000001F;' },
].map((fault) => ({ kind: 'rays', ...fault, techniques }));
