#include "raster/volumes/volume_measure.h"

#include <algorithm>
#include <cmath>

namespace shadowproof {

void measure_volumes(const GlFunctions& gl, const Target& target, const DepthModel& depth_model,
                     std::span<const VolumePass* const> passes,
                     const std::function<void()>& draw_volumes, Frame& frame) {
    const bool reversed = depth_model.reversed();
    for (const VolumePass* pass : passes) set_worth(gl, *pass, 1, 1);
    begin_adding(gl, target);
    gl.DepthFunc(reversed ? GL_GEQUAL : GL_LEQUAL);
    draw_volumes();
    end_adding(gl);
    frame.counted->volumes = converted<std::uint8_t>(read_sum(gl, target), [](float faces) {
        return static_cast<std::uint8_t>(std::min(faces, 255.0F));
    });

    const Query query = make_query(gl, GL_SAMPLES_PASSED);
    gl.BindFramebuffer(GL_FRAMEBUFFER, target.adding.name());
    gl.ColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    gl.DepthFunc(GL_ALWAYS);
    gl.BeginQuery(GL_SAMPLES_PASSED, query.name());
    draw_volumes();
    gl.EndQuery(GL_SAMPLES_PASSED);
    GLuint64 fragments = 0;
    gl.GetQueryObjectui64v(query.name(), GL_QUERY_RESULT, &fragments);
    frame.counted->volume_fragments = fragments;
    check(gl, "measuring the volumes");
}

} // namespace shadowproof
