// A picture of which every pixel is what a fragment shader makes of its place: for what is known of
// a driver pixel by pixel.
#pragma once

#include "raster/gl/gl.h"

#include <string>

namespace shadowproof::tests {

/// A framebuffer of one texture.
struct Picture {
    int width = 0;
    int height = 0;
    Texture texture{};
    Framebuffer framebuffer{};
};
Picture make_picture(const GlFunctions& gl, GLenum format, int width, int height);

/// Runs a fragment shader (its text from behind the line with the version) on all pixels of the
/// picture. Blending is the caller's.
void draw_pixels(const GlFunctions& gl, const Picture& picture, const std::string& fragment);

/// The red of a GLSL expression, in floats and in steps of 1/255, as OSMesa computes it behind the
/// text of a file of raster/glsl/. `z` is (0, 0, 1).
double red_steps_of(const std::string& expression, const std::string& file);

} // namespace shadowproof::tests
