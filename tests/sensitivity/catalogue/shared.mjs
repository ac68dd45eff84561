// Code that techniques and judge have in common.
import { faults as lighting } from './lighting.mjs';

const tables = ['cube_of_4_bits', 'cube_of_6_bits', 'cube_truncated', 'bumps_of_5_bits', 'bumps_of_7_bits',
                'bumps_truncated', 'bumps_steeper', 'texture_normals_5_bits'];
const topology = 'scenes/mesh/topology.cpp';
const counted = 'scenes/mesh/counted_casters.cpp';
const plan = 'scenes/plan/plan.cpp';
const casters = 'scenes/plan/caster_plan.cpp';
export const faults = [
  ...lighting.filter(({ name }) => tables.includes(name)).map((fault) => ({ ...fault, name: `shared_${fault.name}` })),
  { name: 'shared_cube_of_8_texels', file: 'scenes/surface/normalisation_cube.cpp', right: 'NormalisationCube cube{size, {}};', wrong: 'size = 8; NormalisationCube cube{size, {}};'.replace('NormalisationCube cube{size, {}};', ''), as: 'skip' },
  { name: 'shared_derivatives_steeper', file: 'scenes/surface/bump_forms.cpp', right: 'glm::dvec2(-n.x, n.y) / n.z', wrong: '1.2 * glm::dvec2(-n.x, n.y) / n.z', why: 'Only where --bumps derivatives asks for it.' },
  { name: 'shared_numbers_of_4_bits', file: 'scenes/surface/bump_forms.cpp', right: 'glm::round(255.0 * (0.5 + 0.5 * p))', wrong: '17.0 * glm::round(15.0 * (0.5 + 0.5 * p))', why: 'Only where --bumps indexed asks for it.' },
  { name: 'shared_slopes_one_sided', file: 'scenes/surface/relief.cpp', right: 'scale / 2 *', wrong: 'scale *', as: 'skip' },
  { name: 'shared_extrusion_10_percent_short', techniques: 'zfail_truncated', file: 'scenes/mesh/extrusion.cpp', right: 'position + away * (distance / length)', wrong: 'position + away * (0.9 * distance / length)' },
  { name: 'shared_extrusion_distance_short', techniques: 'zfail_truncated', file: 'scenes/mesh/extrusion.cpp', right: 'return 0.5 * glm::length(upper - lower);', wrong: 'return 0.45 * glm::length(upper - lower);' },
  { name: 'shared_hole_lacks_a_triangle', file: 'scenes/mesh/holes.cpp', right: 'filled.triangles.insert(filled.triangles.end(), lids.begin(), lids.end());', wrong: 'filled.triangles.insert(filled.triangles.end(), lids.begin(), lids.end()); filled.triangles.end()[-1 - static_cast<std::ptrdiff_t>(lids.size() / 2)] = glm::uvec3(lids[0].x);' },
  { name: 'shared_holes_unfilled', file: 'scenes/mesh/holes.cpp', right: 'if (lids.empty()) return filled;', wrong: 'return filled;' },
  { name: 'shared_edges_lost', file: topology, right: 'if (edge.up < edge.down) result.push_back({edge.high, edge.low, edge.down - edge.up});', wrong: ';' },
  { name: 'shared_some_edges_lost', file: topology, right: 'if (edge.up > edge.down) result.push_back({edge.low, edge.high, edge.up - edge.down});', wrong: 'if (edge.up > edge.down && edge.low % 13 != 2) result.push_back({edge.low, edge.high, edge.up - edge.down});' },
  { name: 'shared_surplus_of_one', file: topology, right: 'edge.low, edge.high, edge.up - edge.down', wrong: 'edge.low, edge.high, 1', as: 'skip' },
  { name: 'shared_weld_coarse', file: topology, right: 'hashes.reserve(positions.size());', wrong: 'std::vector<std::uint32_t> order(positions.size()); std::iota(order.begin(), order.end(), 0U); std::sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t k) { const glm::vec3& a = positions[i]; const glm::vec3& b = positions[k]; return std::tie(a.x, a.y, a.z, i) < std::tie(b.x, b.y, b.z, k); }); std::vector<std::uint32_t> welded = order; for (std::size_t i = 0; i < order.size(); ++i) welded[order[i]] = i > 0 && glm::distance(positions[order[i]], positions[order[i - 1]]) < 1e-2F ? welded[order[i - 1]] : order[i]; return welded;' },
  { name: 'shared_weld_nothing', file: topology, right: 'positions[i] == positions[k]', wrong: 'false' },
  { name: 'shared_flips_nothing', file: counted, right: 'std::swap(casters.triangles[triangle].x, casters.triangles[triangle].y);', wrong: ';' },
  { name: 'shared_light_never_held', file: counted, right: 'return half_of_solid_angle > limit;', wrong: 'return false;' },
  { name: 'shared_light_always_held', file: counted, right: 'return half_of_solid_angle > limit;', wrong: 'return true;' },
  { name: 'shared_no_dark_cap_planned', file: plan, right: 'plan.dark_cap = volume_reaches_infinity(scene);', wrong: 'plan.dark_cap = false;' },
  { name: 'shared_no_clamp_planned', file: plan, right: 'plan.volume_meets_far = volume_meets(scene, finite_far(scene));', wrong: 'plan.volume_meets_far = false;' },
  { name: 'shared_all_casters_left_out', techniques: 'auto', file: casters, right: 'return shadows ? "" : "nothing seen lies behind, as the light looks";', wrong: 'return "nothing seen lies behind, as the light looks";' },
  { name: 'shared_near_never_met', techniques: 'auto', file: casters, right: 'plan.meets_near = all.meets_near;', wrong: 'plan.meets_near = false;' },
  { name: 'shared_infinity_never_reached', techniques: 'auto', file: casters, right: 'plan.reaches_infinity = all.reaches_infinity;', wrong: 'plan.reaches_infinity = false;' },
  { name: 'shared_all_surfaces_certain', techniques: 'auto', file: casters, right: 'std::vector<std::uint8_t> certain(scene.triangles.size(), 0);'.replace(/^.*\((.*)\);$/, '$1'), wrong: 'scene.triangles.size(), 1', as: 'skip' },
  { name: 'shared_near_short', file: 'scenes/camera.cpp', right: 'clip[3][2] = camera.near;', wrong: 'clip[3][2] = 1.01 * camera.near;' },
  { name: 'shared_half_extent', file: 'raster/passes/passes.cpp', right: 'gl.CullFace(GL_BACK);', wrong: ';', as: 'skip' },
  { name: 'shared_cone_1e-3_wide', file: 'scenes/surface/bump_forms.cpp', right: 'glm::normalize(glm::dvec3(z < 0 ? folded(p) : p, z))', wrong: 'glm::dvec3(z < 0 ? folded(p) : p, z)', why: 'Only where --bumps indexed asks for it.' },
  { name: 'shared_heights_5_bits', file: 'scenes/surface/relief.cpp', right: 'heights.at(columns.behind, y) - heights.at(columns.before, y)', wrong: 'std::round(31 * (heights.at(columns.behind, y) - heights.at(columns.before, y))) / 31' },
].filter(({ as }) => as !== 'skip').map((fault) => ({ ...fault, kind: 'shared', scope: 'shared' }));
