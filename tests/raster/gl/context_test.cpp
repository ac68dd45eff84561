#include "raster/gl/context.h"
#include "raster/gl/gl.h"
#include "scenes/error.h"

#include <gtest/gtest.h>

#include <utility>

namespace shadowproof::tests {
namespace {

TEST(Context, osmesa_draws_with_llvmpipe_and_says_what_it_is) {
    const Gpu gpu(GlPlatform::osmesa);
    EXPECT_NE(gpu.driver().renderer.find("llvmpipe"), std::string::npos);
    EXPECT_NE(gpu.driver().version.find("4.5"), std::string::npos);
    EXPECT_EQ(gpu.driver().subpixel_bits, 8);
    EXPECT_EQ(gpu.driver().depth_bits, 24);
    EXPECT_EQ(gpu.driver().stencil_bits, 8);
}

TEST(Context, an_extension_is_there_when_its_name_is_listed) {
    const Gpu gpu(GlPlatform::osmesa);
    EXPECT_TRUE(gpu.has_extension("GL_ARB_depth_clamp"));
    EXPECT_FALSE(gpu.has_extension("GL_EXT_depth_bounds_test"));
    EXPECT_FALSE(gpu.has_extension("GL_ARB_depth"));
}

TEST(Context, a_moved_gpu_keeps_its_functions_in_place) {
    Gpu first(GlPlatform::osmesa);
    const GlFunctions* const functions = &first.gl();
    const Gpu second = std::move(first);
    EXPECT_EQ(&second.gl(), functions);
}

TEST(Context, a_handle_deletes_its_name_once_and_only_as_the_last_owner) {
    Gpu gpu(GlPlatform::osmesa);
    Buffer first = make_buffer(gpu.gl());
    const GLuint name = first.name();
    Buffer second = std::move(first);
    EXPECT_EQ(second.name(), name);
    second = make_buffer(gpu.gl());
    EXPECT_NE(second.name(), 0U);
    EXPECT_NO_THROW(check(gpu.gl(), "moving handles"));
}

TEST(Context, a_failed_call_is_named_with_its_pass_and_leaves_no_error_behind) {
    Gpu gpu(GlPlatform::osmesa);
    gpu.gl().Enable(GL_TEXTURE_2D_ARRAY);
    gpu.gl().DepthFunc(GL_TRIANGLES);
    try {
        check(gpu.gl(), "the wrong pass");
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("the wrong pass failed with GL_INVALID_ENUM"),
                  std::string::npos)
            << error.what();
    }
    EXPECT_NO_THROW(check(gpu.gl(), "the next pass"));
}

} // namespace
} // namespace shadowproof::tests
