#include "compare/output/write_file.h"
#include "compare/report/report_pictures.h"
#include "tests/compare/handmade_report.h"

#include <gtest/gtest.h>
#include <png.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

namespace shadowproof {
namespace {

/// sRGB to CIE XYZ-derived luminance, relative to white (WCAG 2.1, relative luminance).
double luminance(const Rgb& color) {
    const auto linear = [](std::uint8_t byte) {
        const double value = byte / 255.0;
        return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
    };
    return 0.2126 * linear(color[0]) + 0.7152 * linear(color[1]) + 0.0722 * linear(color[2]);
}

TEST(ReportPictures, differing_pixels_alone_have_a_cause_s_colour) {
    const SceneResult scene = handmade_scene("x", Cause::unexplained, Verdict::unexplained);
    const PalettePicture picture = cause_picture(scene.cells[0]);
    EXPECT_EQ(picture.at(2, 1), cause_colors[static_cast<std::size_t>(Cause::near_plane)]);
    EXPECT_EQ(picture.at(1, 2), cause_colors[static_cast<std::size_t>(Cause::edge)]);
    EXPECT_EQ(picture.at(3, 2), cause_colors[static_cast<std::size_t>(Cause::unexplained)]);
    EXPECT_EQ(picture.at(0, 0), dimmed(Visibility::background));
    EXPECT_EQ(picture.at(1, 0), dimmed(Visibility::lit));
    EXPECT_EQ(picture.at(3, 1), dimmed(Visibility::shadowed));
}

TEST(ReportPictures, the_difference_tells_false_light_from_false_shadow) {
    const SceneResult scene = handmade_scene("x", Cause::edge, Verdict::agrees);
    const PalettePicture picture = difference_picture(scene.truth, scene.cells[0]);
    const auto color = [](Contradiction c) {
        return all_contradictions[static_cast<std::size_t>(c)].color;
    };
    EXPECT_EQ(picture.at(2, 1), color(Contradiction::falsely_lit));
    EXPECT_EQ(picture.at(1, 2), color(Contradiction::falsely_shadowed));
}

TEST(ReportPictures, the_difference_marks_nothing_where_colours_alone_differ) {
    SceneResult scene = handmade_scene("x", Cause::edge, Verdict::agrees);
    scene.cells[0].comparison.cause.at(1, 0) = static_cast<std::uint8_t>(Cause::shading);
    EXPECT_EQ(difference_picture(scene.truth, scene.cells[0]).at(1, 0), dimmed(Visibility::lit));
    EXPECT_EQ(cause_picture(scene.cells[0]).at(1, 0),
              cause_colors[static_cast<std::size_t>(Cause::shading)]);
}

TEST(ReportPictures, every_mark_stands_out_from_the_dimmed_claim) {
    std::vector<Rgb> marks(cause_colors.begin(), cause_colors.end());
    for (const ContradictionWords& words : all_contradictions) marks.push_back(words.color);
    for (const Visibility claim : {Visibility::lit, Visibility::shadowed, Visibility::background})
        for (const Rgb& mark : marks) {
            const Rgb base = dimmed(claim);
            int furthest = 0;
            for (std::size_t k = 0; k < 3; ++k)
                furthest = std::max(furthest, std::abs(mark[k] - base[k]));
            EXPECT_GE(furthest, 80);
        }
    EXPECT_LT(luminance(dimmed(Visibility::background)), luminance(dimmed(Visibility::shadowed)));
    EXPECT_LT(luminance(dimmed(Visibility::shadowed)), luminance(dimmed(Visibility::lit)));
}

TEST(ReportPictures, a_png_reads_back_as_it_was) {
    const SceneResult scene = handmade_scene("x", Cause::edge, Verdict::agrees);
    const std::filesystem::path file = std::filesystem::temp_directory_path() /
                                       ("shadowproof-" + std::to_string(getpid()) + ".png");
    write_file(file, to_png(scene.truth.visibility));
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    ASSERT_TRUE(png_image_begin_read_from_file(&image, file.c_str())) << image.message;
    EXPECT_EQ(image.format, unsigned{PNG_FORMAT_GRAY});
    std::vector<std::uint8_t> bytes(12);
    ASSERT_EQ(PNG_IMAGE_SIZE(image), bytes.size());
    ASSERT_TRUE(png_image_finish_read(&image, nullptr, bytes.data(), 0, nullptr)) << image.message;
    for (std::size_t i = 0; i < bytes.size(); ++i)
        EXPECT_EQ(bytes[i], static_cast<std::uint8_t>(scene.truth.visibility.pixels[i]));
    std::filesystem::remove(file);
}

TEST(ReportPictures, a_png_of_any_number_of_colours_and_any_width_reads_back_as_it_was) {
    for (const std::size_t colors : {1U, 2U, 3U, 4U, 5U, 16U, 17U, 256U})
        for (const int width : {1, 2, 3, 7, 8, 9, 300}) {
            PalettePicture picture{Image<std::uint8_t>(width, 2), std::vector<Rgb>(256)};
            for (std::size_t i = 0; i < 256; ++i) // each has its own
                picture.palette[i] = {static_cast<std::uint8_t>(i),
                                      static_cast<std::uint8_t>(7 * i),
                                      static_cast<std::uint8_t>(255 - i)};
            std::vector<std::uint8_t>& indices = picture.indices.pixels;
            for (std::size_t i = 0; i < indices.size(); ++i) // the last of the palette first
                indices[i] = static_cast<std::uint8_t>(255 - i % colors);
            const std::string bytes = to_png(picture);
            png_image image{};
            image.version = PNG_IMAGE_VERSION;
            ASSERT_TRUE(png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()));
            ASSERT_EQ(image.width, static_cast<unsigned>(width));
            image.format = PNG_FORMAT_RGB;
            std::vector<Rgb> read(indices.size());
            ASSERT_TRUE(png_image_finish_read(&image, nullptr, read.data(), 0, nullptr));
            ASSERT_EQ(image.warning_or_error, 0U) << image.message;
            for (std::size_t i = 0; i < read.size(); ++i)
                ASSERT_EQ(read[i], picture.palette[indices[i]])
                    << colors << " " << width << " " << i;
        }
}

TEST(ReportPictures, a_scene_s_name_never_leaves_the_folder) {
    SceneResult scene;
    scene.name = "../../etc/pass wd";
    EXPECT_EQ(truth_path(scene), "______etc_pass_wd/truth.png");
    scene.name = "";
    EXPECT_EQ(truth_path(scene), "scene/truth.png");
}

} // namespace
} // namespace shadowproof
