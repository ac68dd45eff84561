// What a technique sets in OpenGL.
const file = 'raster/volumes/counted_light.cpp';
const shadows = 'raster/volumes/stencil.cpp';
const passes = 'raster/passes/passes.cpp';
const steps = 'return test == Counting::Test::depth_pass ? Steps{+1, -1} : Steps{-1, +1};';
const wrap = 'return step > 0 ? GL_INCR_WRAP : GL_DECR_WRAP;';
const countedDepth = 'gl.DepthFunc(recipe.depth_model.reversed() ? GL_GREATER : GL_LESS);';
const clamp = 'set_enabled(gl, GL_DEPTH_CLAMP, depth_model.clamp);';
const surfaceDepth = 'gl.DepthFunc(reversed ? GL_GREATER : GL_LESS);';
const cull = 'set_enabled(gl, GL_CULL_FACE, !run.double_sided);';
const tested = 'gl.StencilFunc(stencil ? GL_EQUAL : GL_ALWAYS, 0, ~0U);';
const mask = 'gl.StencilMask((1U << static_cast<unsigned>(recipe.counting.bits)) - 1);';
const clearDepth = 'gl.ClearNamedFramebufferfi(framebuffer, GL_DEPTH_STENCIL, 0, reversed ? 0.0F : 1.0F, stencil);';
const clearColor = 'gl.ClearNamedFramebufferfv(framebuffer, GL_COLOR, 0, background.data());';
const bumps = 'bump_tangent_space,bump_three_pass,bump_three_pass+zpass';
const clearStencil = 'gl.ClearNamedFramebufferiv(target.surface.name(), GL_STENCIL, 0, &value);';
const lightDepth = 'gl.DepthFunc(GL_EQUAL);';
export const faults = [
  { name: 'steps_exchanged', file, right: steps, wrong: 'return test == Counting::Test::depth_pass ? Steps{-1, +1} : Steps{+1, -1};' },
  { name: 'back_steps_both_up', file, right: steps, wrong: 'return test == Counting::Test::depth_pass ? Steps{+1, +1} : Steps{+1, +1};' },
  { name: 'saturates_for_wraps', file, right: wrap, wrong: 'return step > 0 ? GL_INCR : GL_DECR;' },
  { name: 'decrement_saturates', file, right: wrap, wrong: 'return step > 0 ? GL_INCR_WRAP : GL_DECR;' },
  { name: 'inverts_for_wraps', file, right: wrap, wrong: 'return GL_INVERT;' },
  { name: 'fronts_not_counted', file, right: 'set(GL_FRONT, steps.front);', wrong: 'set(GL_FRONT, 0 * steps.front); gl.StencilOpSeparate(GL_FRONT, GL_KEEP, GL_KEEP, GL_KEEP);' },
  { name: 'backs_not_counted', file, right: 'set(GL_BACK, steps.back);', wrong: 'gl.StencilOpSeparate(GL_BACK, GL_KEEP, GL_KEEP, GL_KEEP);' },
  { name: 'counted_depth_or_equal', file, right: countedDepth, wrong: 'gl.DepthFunc(recipe.depth_model.reversed() ? GL_GEQUAL : GL_LEQUAL);' },
  { name: 'counted_depth_exchanged', file, right: countedDepth, wrong: 'gl.DepthFunc(recipe.depth_model.reversed() ? GL_LESS : GL_GREATER);' },
  { name: 'counted_depth_always', file, right: countedDepth, wrong: 'gl.DepthFunc(GL_ALWAYS);' },
  { name: 'volumes_write_depth', file, right: 'gl.DepthMask(GL_FALSE);', wrong: 'gl.DepthMask(GL_TRUE);' },
  { name: 'volumes_culled', file, right: 'gl.Disable(GL_CULL_FACE);', wrong: 'gl.Enable(GL_CULL_FACE);' },
  { name: 'stencil_of_7_bits', file, right: mask, wrong: 'gl.StencilMask(0x7f);' },
  { name: 'stencil_of_2_bits', file, right: mask, wrong: 'gl.StencilMask(3);' },
  { name: 'stencil_never_writes_bit_0', file, right: mask, wrong: 'gl.StencilMask(0xfe);' },
  { name: 'counts_where_zero', file, right: 'gl.StencilFunc(GL_ALWAYS, 0, ~0U);', wrong: 'gl.StencilFunc(GL_EQUAL, 0, ~0U);' },
  { name: 'fail_counts_as_pass', file, right: 'gl.StencilOpSeparate(face, GL_KEEP, counted, GL_KEEP);', wrong: 'gl.StencilOpSeparate(face, GL_KEEP, GL_KEEP, counted);' },
  { name: 'fail_counts_all', file, right: 'gl.StencilOpSeparate(face, GL_KEEP, counted, GL_KEEP);', wrong: 'gl.StencilOpSeparate(face, GL_KEEP, counted, counted);' },
  { name: 'pass_counts_as_fail', file, right: 'gl.StencilOpSeparate(face, GL_KEEP, GL_KEEP, counted);', wrong: 'gl.StencilOpSeparate(face, GL_KEEP, counted, GL_KEEP);' },
  { name: 'near_not_hidden_under_clamp', file, right: 'if (clamp) visible.near = static_cast<float>(camera.near);', wrong: 'static_cast<void>(clamp);', why: 'No bundled scene has a surface before the near plane where depths are clamped.' },
  { name: 'far_not_hidden', file, right: 'if (clamp || !recipe.depth_model.finite()) visible.far = static_cast<float>(camera.far);', wrong: ';' },
  { name: 'far_hidden_early', file, right: 'if (clamp || !recipe.depth_model.finite()) visible.far = static_cast<float>(camera.far);', wrong: 'visible.far = static_cast<float>(0.999 * camera.far);' },
  { name: 'flipped_sides_not_flipped', file, right: 'set_steps(gl_, kind, part->caster.test, {.front = steps.back, .back = steps.front});', wrong: ';' },
  { name: 'occluders_count_down', techniques: 'zp_plus', file, right: 'gl_.StencilOp(GL_KEEP, GL_KEEP, operation(+1, kind));', wrong: 'gl_.StencilOp(GL_KEEP, GL_KEEP, operation(-1, kind));' },
  { name: 'eye_count_one_more', techniques: 'zpass_eye_count', file, right: 'start_ = static_cast<std::int64_t>(volumes_around_eye(parts_.front()->scene));', wrong: 'start_ = static_cast<std::int64_t>(1 + volumes_around_eye(parts_.front()->scene));' },
  { name: 'eye_count_left_out', techniques: 'zpass_eye_count', file, right: 'start_ = static_cast<std::int64_t>(volumes_around_eye(parts_.front()->scene));', wrong: ';' },
  { name: 'no_ledge', techniques: 'zpass_capped', file: passes, right: 'gl.DepthRange(depth_model.front, 1);', wrong: 'gl.DepthRange(0, 1);' },
  { name: 'sum_depth_or_equal', techniques: 'zfail_float', file, right: 'const GLenum others = recipe_.depth_model.reversed() ? GL_LEQUAL : GL_GEQUAL;'.replace(/^.*= (.*);$/, '$1'), wrong: 'recipe_.depth_model.reversed() ? GL_LESS : GL_GREATER' },
  { name: 'stencil_of_the_light_before', techniques: bumps, file: passes, right: clearStencil, wrong: ';' },
  { name: 'another_light_starts_from_1', techniques: bumps, file: passes, right: clearStencil, wrong: 'const GLint one = value + 1; gl.ClearNamedFramebufferiv(target.surface.name(), GL_STENCIL, 0, &one);' },
  { name: 'claim_of_the_light_before', techniques: bumps, file: shadows, right: 'take_unlit(gl, target, claims);', wrong: ';' },
  { name: 'claims_not_kept', techniques: bumps, file: shadows, right: 'keep_claim(gl, target, claims, light);', wrong: ';' },

  { name: 'clip_control_minus_one', file: passes, right: 'gl.ClipControl(GL_LOWER_LEFT, reversed ? GL_ZERO_TO_ONE : GL_NEGATIVE_ONE_TO_ONE);', wrong: 'gl.ClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);' },
  { name: 'clip_control_upper_left', file: passes, right: 'gl.ClipControl(GL_LOWER_LEFT, reversed ? GL_ZERO_TO_ONE : GL_NEGATIVE_ONE_TO_ONE);', wrong: 'gl.ClipControl(GL_UPPER_LEFT, reversed ? GL_ZERO_TO_ONE : GL_NEGATIVE_ONE_TO_ONE);' },
  { name: 'never_clamps', file: passes, right: clamp, wrong: 'set_enabled(gl, GL_DEPTH_CLAMP, false);' },
  { name: 'always_clamps', file: passes, right: clamp, wrong: 'set_enabled(gl, GL_DEPTH_CLAMP, true);' },
  { name: 'fronts_run_clockwise', file: passes, right: 'gl.FrontFace(GL_CCW);', wrong: 'gl.FrontFace(GL_CW);' },
  { name: 'culls_fronts', file: passes, right: 'gl.CullFace(GL_BACK);', wrong: 'gl.CullFace(GL_FRONT);' },
  { name: 'no_depth_test', file: passes, right: 'gl.Enable(GL_DEPTH_TEST);', wrong: 'gl.Disable(GL_DEPTH_TEST);' },
  { name: 'surface_depth_or_equal', file: passes, right: surfaceDepth, wrong: 'gl.DepthFunc(reversed ? GL_GEQUAL : GL_LEQUAL);', why: 'No two surfaces of a bundled scene tie.' },
  { name: 'surface_depth_always', file: passes, right: surfaceDepth, wrong: 'gl.DepthFunc(GL_ALWAYS);' },
  { name: 'never_culls', file: passes, right: cull, wrong: 'set_enabled(gl, GL_CULL_FACE, false);' },
  { name: 'always_culls', file: passes, right: cull, wrong: 'set_enabled(gl, GL_CULL_FACE, true);' },
  { name: 'clears_to_red', file: passes, right: clearColor, wrong: 'const GLfloat red[4] = {1, 0, 0, 0}; gl.ClearNamedFramebufferfv(framebuffer, GL_COLOR, 0, red);' },
  { name: 'clears_to_shadowed', file: passes, right: clearColor, wrong: 'const GLfloat gray[4] = {64 / 255.0F, 0, 0, 0}; gl.ClearNamedFramebufferfv(framebuffer, GL_COLOR, 0, gray);' },
  { name: 'clears_to_triangle_0', file: passes, right: 'gl.ClearNamedFramebufferuiv(framebuffer, GL_COLOR, 1, nothing.data());', wrong: 'const GLuint zero[4] = {0, 0, 0, 0}; gl.ClearNamedFramebufferuiv(framebuffer, GL_COLOR, 1, zero);' },
  { name: 'clears_depth_short_of_far', file: passes, right: clearDepth, wrong: 'gl.ClearNamedFramebufferfi(framebuffer, GL_DEPTH_STENCIL, 0, reversed ? 0.01F : 0.99F, stencil);' },
  { name: 'clears_stencil_to_1', file: passes, right: clearDepth, wrong: 'gl.ClearNamedFramebufferfi(framebuffer, GL_DEPTH_STENCIL, 0, reversed ? 0.0F : 1.0F, stencil + 1);' },
  { name: 'runs_from_triangle_0', file: passes, right: 'gl.ProgramUniform1ui(surface.of(run).name(), 7, run.first_triangle);', wrong: 'gl.ProgramUniform1ui(surface.of(run).name(), 7, 0);' },
  { name: 'light_depth_or_nearer', file: passes, right: lightDepth, wrong: 'gl.DepthFunc(GL_LEQUAL);', why: 'As light_depth_always.' },
  { name: 'light_depth_always', file: passes, right: lightDepth, wrong: 'gl.DepthFunc(GL_ALWAYS);', why: 'Only the triangle that is seen speaks, whatever the depth test lets through.' },
  { name: 'light_ignores_stencil', file: passes, right: tested, wrong: 'gl.StencilFunc(GL_ALWAYS, 0, ~0U);' },
  { name: 'light_asks_4_bits', file: passes, right: tested, wrong: 'gl.StencilFunc(stencil ? GL_EQUAL : GL_ALWAYS, 0, 0xf);' },
  { name: 'light_asks_for_1', file: passes, right: tested, wrong: 'gl.StencilFunc(stencil ? GL_EQUAL : GL_ALWAYS, 1, ~0U);' },
  { name: 'light_where_shadowed', file: passes, right: tested, wrong: 'gl.StencilFunc(stencil ? GL_NOTEQUAL : GL_ALWAYS, 0, ~0U);' },
  { name: 'unreceiving_left_dark', file: passes, right: 'draw(geometry.receivers, geometry.lit_sides.count - geometry.receivers);', wrong: ';', why: 'Every bundled mesh receives.' },
  { name: 'all_receive', file: passes, right: 'geometry.receivers = static_cast<std::uint32_t>(sides.receivers);', wrong: 'geometry.receivers = static_cast<std::uint32_t>(sides.triangles.size());', why: 'Every bundled mesh receives.' },
  { name: 'none_receives', file: passes, right: 'geometry.receivers = static_cast<std::uint32_t>(sides.receivers);', wrong: 'geometry.receivers = 0;' },
  { name: 'depth_of_24_bits', file: 'raster/gl/target.cpp', right: 'floating ? GL_DEPTH32F_STENCIL8 : GL_DEPTH24_STENCIL8', wrong: 'GL_DEPTH24_STENCIL8' },
  { name: 'depth_in_floats', file: 'raster/gl/target.cpp', right: 'floating ? GL_DEPTH32F_STENCIL8 : GL_DEPTH24_STENCIL8', wrong: 'GL_DEPTH32F_STENCIL8' },
  { name: 'upside_down', file: 'raster/gl/target.cpp', right: '(height - 1 - y) * stride', wrong: 'y * stride' },
  { name: 'depth_read_as_half', file: 'raster/gl/target.cpp', right: 'frame.depth = read_picture<float>(gl, target, GL_DEPTH_COMPONENT, GL_FLOAT);', wrong: 'frame.depth = Image<float>(target.width, target.height, 0.5F);' },
  { name: 'counter_read_in_4_bits', file: 'raster/gl/target.cpp', right: 'gl.BindFramebuffer(GL_FRAMEBUFFER, 0);\n    check(gl, "reading back");', wrong: 'gl.BindFramebuffer(GL_FRAMEBUFFER, 0); for (auto& c : frame.counted->counter.pixels) c &= 0xf;' },
  { name: 'occluders_unclamped', techniques: 'zp_plus', file: 'raster/volumes/near_plane.cpp', right: 'gl.Enable(GL_DEPTH_CLAMP);', wrong: ';', why: 'The shadows lie at depth zero.' },
  { name: 'occluders_unclipped', techniques: 'zp_plus', file: 'raster/volumes/near_plane.cpp', right: 'gl.Enable(GL_CLIP_DISTANCE0);', wrong: ';', why: 'The driver clips by a distance that a shader writes even where that is not enabled; occluders_never_clipped is caught.' },
  { name: 'occluders_never_clipped', techniques: 'zp_plus', file: 'raster/glsl/volumes/from_light.vert', right: 'gl_ClipDistance[0] = projected.z;', wrong: 'gl_ClipDistance[0] = 1;' },
  { name: 'occluders_depth_tested', techniques: 'zp_plus', file: 'raster/volumes/near_plane.cpp', right: 'gl.Disable(GL_DEPTH_TEST);', wrong: ';', why: 'Where there are occluders, all that is seen lies beyond twice the near plane, and so behind them: they are drawn in the middle of the range.' },
  { name: 'near_caps_behind_ledge', techniques: 'zpass_capped', file: 'raster/volumes/near_plane.cpp', right: 'gl.DepthRange(0, 0);', wrong: 'gl.DepthRange(1, 1);' },
].map((fault) => ({ kind: 'state', ...fault }));
