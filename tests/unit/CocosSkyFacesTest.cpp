// Skies of six faces: six pictures, crosses, rows and columns.
#include <array>
#include <cstring>

#include <fmt/format.h>

#include "CocosSceneFixture.h"
#include "cocos/scene/SkyFaces.h"
#include "core/Image.h"

namespace crevice::cocos {
namespace {

constexpr const char* kCube = "51ff50d1-0000-4000-8000-000000f1736b";

/// Faces are red 51 · n: n = 0 … 5 for +X, -X, +Y, -Y, +Z, -Z; green grows to the right from 0 to 255.
Image face(std::uint32_t n, std::uint32_t side = 8) {
    Image image(side, side, Format::RGBA8);
    for (std::uint32_t y = 0; y < side; ++y)
        for (std::uint32_t x = 0; x < side; ++x) {
            const unsigned char texel[4] = {static_cast<unsigned char>(51 * n),
                                            static_cast<unsigned char>(255 * x / (side - 1)), 0, 255};
            for (std::size_t c = 0; c < 4; ++c) image.pixel(x, y)[c] = std::byte{texel[c]};
        }
    return image;
}

struct FaceFolder : SceneFolder {
    Environment sky(const std::string& uuid) {
        const ImportedScene out = load(withComponent(
            R"({ "__type__": "cc.Camera", "_clearFlags": 14 })", "",
            R"({ "__type__": "cc.SceneGlobals", "ambient": { "__type__": "cc.AmbientInfo" }, "_skybox": { "__type__": "cc.SkyboxInfo", "_enabled": true, "_envmap": { "__uuid__": ")" +
                uuid + "\" } } }"));
        EXPECT_TRUE(out.scene.environment) << notes;
        return out.scene.environment.value_or(Environment{});
    }
    static glm::vec3 in(const Environment& sky, const glm::vec3& direction) {
        return sampleEquirect(sky.radiance, glm::normalize(direction));
    }
    /// The middle of each face has its red, squared as the engine does.
    static void expectFaces(const Environment& sky) {
        ASSERT_EQ(sky.radiance.width, 32u);
        ASSERT_EQ(sky.radiance.height, 16u);
        const glm::vec3 directions[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
        for (int n = 0; n < 6; ++n) EXPECT_NEAR(in(sky, directions[n]).x, n * n / 25.0, 0.01) << "face " << n;
        // Rows of faces run as graphics interfaces have them: on +Z to +X, on +X to -Z.
        EXPECT_GT(in(sky, {0.8f, 0, 1}).y, 0.6f);
        EXPECT_LT(in(sky, {-0.8f, 0, 1}).y, 0.1f);
        EXPECT_GT(in(sky, {1, 0, -0.8f}).y, 0.6f);
        EXPECT_LT(in(sky, {1, 0, 0.8f}).y, 0.1f);
    }
    void writeSix(const std::string& leftOut = "") {
        static constexpr const char* kNames[] = {"right", "left", "top", "bottom", "front", "back"};
        std::string faces;
        for (std::uint32_t n = 0; n < 6; ++n) {
            const std::string uuid = "6" + std::to_string(n) + "ff50d1-0000-4000-8000-000000f1736b", name = kNames[n];
            writeImage(folder.path() / ("project/" + name + ".png"), face(n));
            write("project/" + name + ".png.meta", meta(uuid, "image"));
            if (name != leftOut) faces += (faces.empty() ? "\"" : ",\"") + name + "\":\"" + uuid + "\"";
        }
        write("project/day.cubemap", "");
        write("project/day.cubemap.meta", R"({"importer":"texture-cube","uuid":")" + std::string(kCube) +
                                              R"(","userData":{"isRGBE":false,)" + faces + "}}");
    }
};

TEST(CocosSkyFaces, SixPicturesAreTheFacesOfACube) {
    FaceFolder folder;
    folder.writeSix();
    FaceFolder::expectFaces(folder.sky(kCube));
}

TEST(CocosSkyFaces, CrossesRowsAndColumnsAreCut) {
    struct Case {
        std::uint32_t columns, rows;
        std::array<std::array<std::uint32_t, 2>, 6> places;
    };
    // Written from the importer's drawings: (u / lfrb / d), (u / frb / d / l), and r l u d f b in a row or a column.
    const Case cases[] = {{4, 3, {{{2, 1}, {0, 1}, {1, 0}, {1, 2}, {1, 1}, {3, 1}}}},
                          {3, 4, {{{1, 1}, {1, 3}, {1, 0}, {1, 2}, {0, 1}, {2, 1}}}},
                          {6, 1, {{{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0}, {5, 0}}}},
                          {1, 6, {{{0, 0}, {0, 1}, {0, 2}, {0, 3}, {0, 4}, {0, 5}}}}};
    for (const Case& one : cases) {
        FaceFolder folder;
        Image picture(one.columns * 8, one.rows * 8, Format::RGBA8);
        for (std::uint32_t n = 0; n < 6; ++n)
            for (std::uint32_t y = 0; y < 8; ++y)
                std::memcpy(picture.pixel(one.places[n][0] * 8, one.places[n][1] * 8 + y), face(n).pixel(0, y), 32);
        writeImage(folder.folder.path() / "project/cross.png", picture);
        folder.write("project/cross.png.meta", R"({"importer":"image","uuid":")" + std::string(kCube) +
                                                   R"(","subMetas":{"b47c0":{"importer":"erp-texture-cube","uuid":")" +
                                                   kCube + R"(@b47c0"}}})");
        SCOPED_TRACE(fmt::format("{} x {}", one.columns, one.rows));
        FaceFolder::expectFaces(folder.sky(std::string(kCube) + "@b47c0"));
    }
    EXPECT_FALSE(faceLayout(0, 0));
    EXPECT_FALSE(faceLayout(8, 4));
    EXPECT_FALSE(faceLayout(13, 9));
}

TEST(CocosSkyFaces, WrongFacesAreSaid) {
    const auto notesOf = [](const std::string& leftOut, std::uint32_t side) {
        FaceFolder folder;
        folder.writeSix(leftOut);
        writeImage(folder.folder.path() / "project/top.png", Image(side, 8, Format::RGBA8));
        folder.load(withComponent(
            R"({ "__type__": "cc.Camera", "_clearFlags": 14 })", "",
            R"({ "_skybox": { "__type__": "cc.SkyboxInfo", "_enabled": true, "_envmap": { "__uuid__": ")" +
                std::string(kCube) + "\" } } }"));
        return folder.notes;
    };
    EXPECT_TRUE(contains(notesOf("front", 8), "the sky is left out: face 'front' of 'day.cubemap' is no picture"))
        << notesOf("front", 8);
    EXPECT_TRUE(contains(notesOf("", 9), "face 'top.png' of a sky has 9 x 8 pixels"));
}

}  // namespace
}  // namespace crevice::cocos
