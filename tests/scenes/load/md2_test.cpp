#include "scenes/error.h"
#include "scenes/load/catalog.h"
#include "scenes/load/md2/md2.h"
#include "scenes/mesh/smooth_normals.h"
#include "scenes/mesh/topology.h"
#include "tests/scenes/small_md2.h"
#include "tests/scenes/small_pcx.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <glm/geometric.hpp>
#include <limits>
#include <random>

namespace shadowproof::test {
namespace {

/// As a file in a folder of its own.
class File {
public:
    explicit File(const FileBytes& bytes) { write_bytes(path(), bytes); }
    std::filesystem::path path() const { return folder_.path() / "imp.md2"; }
    std::filesystem::path beside(const std::string& name) const { return folder_.path() / name; }

private:
    Folder folder_;
};

Scene pose_of(const Md2& model, double time) {
    SceneRequest request;
    request.time = time;
    return load_md2(File(bytes_of(model)).path(), request);
}

std::string refusal_of(const FileBytes& bytes, const SceneRequest& request = {}) {
    try {
        load_md2(File(bytes).path(), request);
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

TEST(md2, stands_y_up_and_looks_along_z_with_triangles_counter_clockwise) {
    const Scene scene = pose_of(tetrahedron(), 0);
    const std::vector<glm::vec3> expected{{0, 0, 0}, {0, 0, 10}, {10, 0, 0}, {0, 10, 0}};
    EXPECT_EQ(scene.positions, expected);
    for (const CasterReport& report : inspect_casters(scene)) {
        EXPECT_TRUE(report.closed());
        EXPECT_FALSE(report.inverted);
    }
    EXPECT_EQ(scene.name, "imp");
    EXPECT_FALSE(is_bump_lit(scene));
    EXPECT_TRUE(says(scene, "no camera in the file"));
    EXPECT_TRUE(says(scene, "no light in the file"));
    EXPECT_TRUE(says(scene, "no skin_normal.png and no skin_height.png beside the model"));
}

TEST(md2, is_posed_between_key_frames_ten_a_second_and_holds_the_first_and_the_last) {
    const auto ahead_at = [](double time) { return pose_of(tetrahedron(), time).positions[1].z; };
    EXPECT_EQ(ahead_at(-1), 10);
    EXPECT_EQ(ahead_at(0), 10);
    EXPECT_EQ(ahead_at(0.025), 15); // a quarter of the way from 10 to 30
    EXPECT_EQ(ahead_at(0.05), 20);
    EXPECT_EQ(ahead_at(0.1), 30);
    EXPECT_EQ(ahead_at(1e300), 30);
    EXPECT_EQ(ahead_at(std::numeric_limits<double>::quiet_NaN()), 30);
    EXPECT_TRUE(
        says(pose_of(tetrahedron(), 0.05), "0.5 of the way from frame 0 \"run1\" to frame 1"));
    EXPECT_TRUE(says(pose_of(tetrahedron(), 2), "frame 1 \"run2\" (2 frames, 10 a second)"));
}

TEST(md2, is_a_scene_by_its_extension_in_either_case) {
    const File file(bytes_of(tetrahedron()));
    EXPECT_EQ(load_scene(file.path().string(), {}).triangles.size(), 4U);
    std::filesystem::copy_file(file.path(), file.beside("IMP.MD2"));
    EXPECT_EQ(load_scene(file.beside("IMP.MD2").string(), {}).triangles.size(), 4U);
}

/// The PNG that the small glTF embeds.
FileBytes png() {
    const std::string uri = textured_gltf()["images"][0]["uri"];
    const std::string digits = uri.substr(uri.find(',') + 1);
    const std::string alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    FileBytes bytes;
    std::uint32_t bits = 0;
    int count = 0;
    for (const char c : digits.substr(0, digits.find('='))) {
        bits = bits << 6U | static_cast<std::uint32_t>(alphabet.find(c));
        count += 6;
        if (count < 8) continue;
        count -= 8;
        bytes.push_back(static_cast<std::uint8_t>(bits >> static_cast<unsigned>(count)));
    }
    return bytes;
}

TEST(md2, is_lit_by_the_normal_map_beside_it_and_wears_the_skin_there) {
    const File file(bytes_of(tetrahedron()));
    write_bytes(file.beside("skin_normal.png"), png());
    Scene scene = load_md2(file.path(), {});
    ASSERT_TRUE(is_bump_lit(scene));
    EXPECT_EQ(scene.materials[0].decal, no_texture);
    EXPECT_TRUE(says(scene, "wears skin_normal.png; no skin.png and no skin.pcx beside"));
    write_bytes(file.beside("skin.png"), png());
    scene = load_md2(file.path(), {});
    EXPECT_NE(scene.materials[0].decal, no_texture);
    ASSERT_EQ(scene.surfaces.size(), 12U);
    // Triangle 0 is 0, 2, 1 now, whose texels are (0, 31), (0, 0) and (63, 31).
    EXPECT_EQ(scene.surfaces[0].bump_at, glm::vec2(0.5F / 64, 31.5F / 32));
    EXPECT_EQ(scene.surfaces[1].bump_at, glm::vec2(0.5F / 64, 0.5F / 32));
    EXPECT_EQ(scene.surfaces[2].decal_at, glm::vec2(63.5F / 64, 31.5F / 32));
    for (const Surface& surface : scene.surfaces) {
        EXPECT_NEAR(glm::length(surface.normal), 1, 1e-6);
        EXPECT_NEAR(glm::dot(surface.normal, glm::vec3(surface.tangent)), 0, 1e-6);
    }
    // At the origin three right angles meet.
    EXPECT_LT(glm::distance(glm::normalize(glm::vec3(-1)), scene.surfaces[0].normal), 1e-6F);
}

TEST(md2, is_lit_by_a_height_field_where_it_has_no_normal_map) {
    const File file(bytes_of(tetrahedron()));
    write_bytes(file.beside("skin_height.png"), png());
    Scene scene = load_md2(file.path(), {});
    ASSERT_TRUE(is_bump_lit(scene));
    EXPECT_EQ(scene.materials[0].bump, Bump::height_field);
    EXPECT_EQ(scene.materials[0].bump_scale, 8);
    write_bytes(file.beside("skin_normal.png"), png());
    scene = load_md2(file.path(), {});
    EXPECT_EQ(scene.materials[0].bump, Bump::normal_map);
    EXPECT_EQ(scene.materials[0].bump_scale, 1);
    EXPECT_TRUE(says(scene, "wears skin_normal.png; no skin.png"));
}

TEST(md2, wears_the_games_own_skin_where_there_is_no_other_and_warns_of_its_light) {
    const File file(bytes_of(tetrahedron()));
    write_bytes(file.beside("skin_normal.png"), png());
    write_bytes(file.beside("skin.pcx"), small_pcx(16, 4));
    Scene scene = load_md2(file.path(), {});
    ASSERT_NE(scene.materials[0].decal, no_texture);
    EXPECT_FALSE(scene.materials[0].gloss_in_alpha);
    EXPECT_TRUE(says(scene, "wears skin_normal.png, skin.pcx; skins of the game mostly have light "
                            "painted in"));
    const Image<glm::vec4>& texels = scene.textures[scene.materials[0].decal].texels;
    ASSERT_EQ(texels.width, 16);
    const double srgb = palette_color(17)[1] / 255.0;
    EXPECT_NEAR(texels.at(1, 1).g, std::pow((srgb + 0.055) / 1.055, 2.4), 1e-6);
    write_bytes(file.beside("skin.png"), png());
    scene = load_md2(file.path(), {});
    EXPECT_TRUE(says(scene, "wears skin_normal.png, skin.png"));
    EXPECT_FALSE(says(scene, "painted in"));
}

TEST(md2, has_its_gloss_in_the_alpha_of_its_decal) {
    const File file(bytes_of(tetrahedron()));
    write_bytes(file.beside("skin_normal.png"), png());
    write_bytes(file.beside("skin_gloss.png"), png());
    Scene scene = load_md2(file.path(), {});
    EXPECT_TRUE(scene.materials[0].gloss_in_alpha);
    const Image<glm::vec4> gloss = scene.textures[scene.materials[0].bump_map].texels;
    const auto holds = [&](const Image<glm::vec4>& decal) {
        ASSERT_EQ(decal.pixels.size(), gloss.pixels.size());
        for (std::size_t i = 0; i < gloss.pixels.size(); ++i)
            EXPECT_EQ(decal.pixels[i].a, gloss.pixels[i].r);
    };
    holds(scene.textures[scene.materials[0].decal].texels);
    EXPECT_EQ(glm::vec3(scene.textures[scene.materials[0].decal].texels.pixels[0]), glm::vec3(1));
    write_bytes(file.beside("skin.png"), png());
    scene = load_md2(file.path(), {});
    EXPECT_TRUE(says(scene, "wears skin_normal.png, skin.png, skin_gloss.png"));
    holds(scene.textures[scene.materials[0].decal].texels);
    std::filesystem::remove(file.beside("skin.png"));
    write_bytes(file.beside("skin.pcx"), small_pcx(16, 5));
    try {
        load_md2(file.path(), {});
        FAIL();
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("skin_gloss.png: is of"), std::string::npos);
    }
}

TEST(md2, without_a_skin_looks_for_pictures_of_its_own_name) {
    Md2 model = tetrahedron();
    for (const char* skin : {"", "models/imp/", "..", ".pcx"}) {
        model.skin = skin;
        const File file(bytes_of(model));
        write_bytes(file.beside("imp_normal.png"), png());
        EXPECT_EQ(is_bump_lit(load_md2(file.path(), {})), std::string(skin) != "..") << skin;
    }
}

TEST(md2, with_a_damaged_picture_is_refused_by_the_pictures_name) {
    const File file(bytes_of(tetrahedron()));
    write_bytes(file.beside("skin_normal.png"), {1, 2, 3});
    try {
        load_md2(file.path(), {});
        FAIL();
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("skin_normal.png"), std::string::npos);
    }
}

/// The tetrahedron with one 32-bit number of its header set.
FileBytes with_number(std::size_t number, std::uint32_t value) {
    FileBytes bytes = bytes_of(tetrahedron());
    std::memcpy(bytes.data() + 4 * number, &value, sizeof value);
    return bytes;
}

TEST(md2, that_is_damaged_is_refused_with_the_thing_and_a_remedy) {
    struct Case {
        FileBytes bytes;
        const char* words;
    };
    Md2 far_vertex = tetrahedron();
    far_vertex.triangles[2][1] = 4;
    Md2 far_place = tetrahedron();
    far_place.triangles[3][5] = 9;
    Md2 endless = tetrahedron();
    endless.frames[0].scale.y = std::numeric_limits<float>::infinity();
    Md2 no_number = tetrahedron();
    no_number.frames[0].translation.z = std::numeric_limits<float>::quiet_NaN();
    FileBytes cut = bytes_of(tetrahedron());
    cut.pop_back();
    const Case cases[]{{{}, "0 bytes are less than a header's 68"},
                       {FileBytes(67, 'x'), "67 bytes are less"},
                       {with_number(0, 0x46546C67), "does not begin with IDP2"},
                       {with_number(1, 15), "has version 15, not 8"},
                       {with_number(2, 0), "skins of 0 by 32 texels"},
                       {with_number(3, 70000), "skins of 64 by 70000 texels"},
                       {with_number(4, 55), "frames of 55 bytes, too short for 4 vertices"},
                       {with_number(5, 0xffffffffU), "has 4294967295 skins from byte 68 on"},
                       {with_number(6, 0), "4 triangles, 0 vertices and 2 frames"},
                       {with_number(6, 0x7fffffffU), "more than 16777216 triangles or vertices"},
                       {with_number(7, 5000), "has 5000 texture coordinates from byte 132 on"},
                       {with_number(8, 5000), "has 5000 triangles from byte 148 on"},
                       {with_number(10, 0), "0 frames"},
                       {with_number(10, 3), "has 3 frames from byte 196 on, of 56 bytes each"},
                       {with_number(14, 0xfffffff0U), "frames from byte 4294967280 on"},
                       {cut, "restore the missing bytes"},
                       {bytes_of(far_vertex), "triangle 2 names vertex 4 of 4"},
                       {bytes_of(far_place), "texture coordinates 9 of 4"},
                       {bytes_of(endless), "frame 0 \"run1\" has the scale inf"},
                       {bytes_of(no_number), "the translation nan"}};
    for (const Case& each : cases) {
        const std::string refusal = refusal_of(each.bytes);
        EXPECT_NE(refusal.find(each.words), std::string::npos) << each.words << ": " << refusal;
        EXPECT_NE(refusal.find("imp.md2: "), std::string::npos) << refusal;
    }
}

TEST(md2, has_no_camera_and_no_light_to_choose) {
    SceneRequest request;
    request.camera = "main";
    EXPECT_NE(refusal_of(bytes_of(tetrahedron()), request).find("no camera \"main\""),
              std::string::npos);
    request = {};
    request.light = "0";
    EXPECT_NE(refusal_of(bytes_of(tetrahedron()), request).find("no light \"0\""),
              std::string::npos);
}

TEST(md2, whose_names_are_no_text_is_said_in_ascii) {
    Md2 model = tetrahedron();
    model.frames[0].name = "r\xff\n";
    EXPECT_TRUE(says(pose_of(model, 0), "frame 0 \"r??\""));
}

TEST(md2, that_is_mutated_loads_or_is_refused) {
    constexpr unsigned seed = 19971209;
    constexpr int mutations = 5000;
    std::mt19937 random(seed);
    const auto below = [&](std::size_t end) { return random() % end; };
    const FileBytes whole = bytes_of(tetrahedron());
    const File file(whole);
    write_bytes(file.beside("skin_normal.png"), png());
    int loaded = 0;
    for (int i = 0; i < mutations; ++i) {
        FileBytes bytes = whole;
        for (std::size_t n = 1 + below(4); n > 0; --n) {
            const std::size_t place = below(bytes.size());
            switch (below(4)) {
            case 0:
                bytes[place] = static_cast<std::uint8_t>(random());
                break;
            case 1:
                bytes[place] ^= static_cast<std::uint8_t>(1U << below(8));
                break;
            case 2:
                bytes.resize(1 + place);
                break;
            default: { // a number of the header
                const std::uint32_t nasty[]{0,           1,
                                            0x7fffffffU, 0x80000000U,
                                            0xffffffffU, static_cast<std::uint32_t>(bytes.size())};
                const std::size_t number = 4 * below(17);
                if (number + 4 <= bytes.size())
                    std::memcpy(bytes.data() + number, &nasty[below(6)], 4);
            }
            }
        }
        write_bytes(file.path(), bytes);
        SceneRequest request;
        request.time = i % 2 == 0 ? 0 : 0.05;
        try {
            const Scene scene = load_md2(file.path(), request);
            ++loaded;
            for (const glm::uvec3& triangle : scene.triangles)
                for (int k = 0; k < 3; ++k) ASSERT_LT(triangle[k], scene.positions.size());
        } catch (const Error&) { // as it should be
        } catch (...) {
            FAIL() << "seed " << seed << ", mutation " << i;
        }
    }
    EXPECT_GT(loaded, 0);
    EXPECT_LT(loaded, mutations);
}

TEST(smooth_normals, are_weighted_by_the_angle_however_a_face_is_cut) {
    // A corner of a cube: three squares, one of them cut through the corner.
    const std::vector<glm::dvec3> corners{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                          {0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
    const std::vector<glm::uvec3> triangles{{0, 2, 1}, {0, 3, 2}, {0, 1, 4}, {0, 4, 3}};
    const glm::dvec3 normal = smooth_normals(corners, triangles)[0];
    EXPECT_LT(glm::distance(normal, glm::normalize(glm::dvec3(-1, -1, -1))), 1e-15);
}

TEST(smooth_normals, where_no_triangle_has_area_are_along_z) {
    const std::vector<glm::dvec3> corners{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
    for (const glm::dvec3& normal : smooth_normals(corners, {{0, 1, 2}, {1, 1, 1}}))
        EXPECT_EQ(normal, glm::dvec3(0, 0, 1));
}

} // namespace
} // namespace shadowproof::test
