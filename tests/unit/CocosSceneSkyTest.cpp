// Skies of .scene files: their pictures, when they are shown and when they light, and what lights a scene without any.
#include <array>

#include "CocosSceneFixture.h"
#include "cocos/scene/SceneSky.h"
#include "core/Image.h"

namespace crevice::cocos {
namespace {

constexpr const char* kHdr = "50ff50d1-0000-4000-8000-000000f1736b";
constexpr const char* kLdr = "60ff50d1-0000-4000-8000-000000f1736b";

struct SkyFolder : SceneFolder {
    SkyFolder() {
        Image sky(4, 2, Format::RGBA8);
        for (std::uint32_t i = 0; i < 8; ++i) {
            const unsigned char texel[4] = {255, 51, static_cast<unsigned char>(i == 0 ? 102 : 0), 130};
            for (std::size_t c = 0; c < 4; ++c) sky.pixels[i * 4 + c] = std::byte{texel[c]};
        }
        writeImage(folder.path() / "project/sky.png", sky);
        writeImage(folder.path() / "project/packed.png", sky);
        write("project/sky.png.meta", R"({"importer":"image","uuid":")" + std::string(kLdr) +
                                          R"(","subMetas":{"b47c0":{"importer":"erp-texture-cube","uuid":")" + kLdr +
                                          R"(@b47c0"}}})");
        write("project/packed.png.meta", R"({"importer":"image","uuid":")" + std::string(kHdr) +
                                             R"(","subMetas":{"b47c0":{"importer":"erp-texture-cube","uuid":")" + kHdr +
                                             R"(@b47c0","userData":{"isRGBE":true}}}})");
    }
    /// A scene with one camera of these clear flags, and these fields of its sky.
    ImportedScene sky(int flags, const std::string& fields, const std::string& ambient = {}) {
        return load(withComponent(R"({ "__type__": "cc.Camera", "_clearFlags": )" + std::to_string(flags) + "}", "",
                                  R"({ "__type__": "cc.SceneGlobals", "ambient": { "__type__": "cc.AmbientInfo" )" +
                                      ambient + R"( }, "_skybox": { "__type__": "cc.SkyboxInfo", "_enabled": true, )" +
                                      fields + "} }"));
    }
    static std::string picture(const char* key, const char* uuid) {
        return std::string("\"") + key + R"(": { "__uuid__": ")" + uuid + R"(@b47c0" })";
    }
};

glm::vec3 texelOf(const Environment& sky, std::uint32_t x, std::uint32_t y) { return glm::vec3(sky.radiance.at(x, y)); }

TEST(CocosSceneSky, EightBitsAreSquared) {
    SkyFolder folder;
    const ImportedScene out =
        folder.sky(14, R"("_envLightingType": 2, "_rotationAngle": 90, )" + SkyFolder::picture("_envmapHDR", kLdr),
                   R"(, "_skyIllumHDR": 5000)");
    ASSERT_TRUE(out.scene.environment) << folder.notes;
    const Environment& sky = *out.scene.environment;
    EXPECT_EQ(sky.radiance.width, 4u);
    EXPECT_NEAR(texelOf(sky, 0, 0).x, 1, 1e-6);
    EXPECT_NEAR(texelOf(sky, 0, 0).y, 0.04, 1e-6);  // (51 / 255)²
    EXPECT_NEAR(texelOf(sky, 0, 0).z, 0.16, 1e-6);
    EXPECT_EQ(texelOf(sky, 1, 0).z, 0);
    EXPECT_FLOAT_EQ(sky.intensity, 5000);
    EXPECT_NEAR(sky.rotation, 1.5707963, 1e-6);
    EXPECT_TRUE(sky.visible);
    EXPECT_TRUE(sky.lights);
    EXPECT_FALSE(out.background);  // 14 clears no colour
}

TEST(CocosSceneSky, PackedPicturesHaveTheirExponentInAlpha) {
    SkyFolder folder;
    Image packed(4, 2, Format::RGBA8);
    const auto put = [&](std::size_t texel, const std::array<int, 4>& bytes) {
        for (std::size_t c = 0; c < 4; ++c) packed.pixels[texel * 4 + c] = std::byte(bytes[c]);
    };
    for (std::size_t i = 0; i < 8; ++i) put(i, {0, 0, 0, 128});
    put(0, {255, 51, 102, 130});
    put(1, {255, 51, 0, 128});
    put(2, {255, 51, 0, 126});
    put(3, {243, 0, 1, 201});
    writeImage(folder.folder.path() / "project/packed.png", packed);
    const ImportedScene out = folder.sky(14, R"("_envLightingType": 2, )" + SkyFolder::picture("_envmapHDR", kHdr));
    ASSERT_TRUE(out.scene.environment) << folder.notes;
    const auto expect = [&](std::uint32_t x, const glm::dvec3& radiance, double tolerance) {
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(texelOf(*out.scene.environment, x, 0)[c], radiance[c], tolerance) << x << ' ' << c;
    };
    expect(0, {1.21, 0.242, 0.484}, 1e-5);       // 1.1²; 51 and 102 are a fifth and two fifths of it
    expect(1, {1, 0.2, 0}, 1e-5);                // 1.1⁰
    expect(2, {0.8264463, 0.1652893, 0}, 1e-5);  // 1 / 1.21
    // 1000 as the engine packs it: 1.1^73 = 1051 is the first power above, 1000 / 1051 * 255 = 242.6. A step is 4.12.
    expect(3, {1000, 0, 4.12}, 2.06);
    EXPECT_NEAR(texelOf(*out.scene.environment, 3, 0).z, 4.122, 0.001);
}

TEST(CocosSceneSky, PicturesOfEightBitsAreHeldToTheLimits) {
    const TempFolder folder;
    const Log quiet(LogLevel::Error, [](LogLevel, std::string_view) {});
    const MetaAsset asset{.uuid = kLdr, .path = folder.path() / "sky.png"};
    writeImage(asset.path, Image(8, 4, Format::RGBA8));
    Limits limits;
    limits.maxImageSide = 8;
    limits.maxImagePixels = 32;
    EXPECT_EQ(readSky(asset, MetaIndex{}, quiet, limits).radiance.width, 8u);
    limits.maxImageSide = 7;
    EXPECT_TRUE(contains(errorOf([&] { readSky(asset, MetaIndex{}, quiet, limits); }), "--limit image-side="));
    limits.maxImageSide = 8;
    limits.maxImagePixels = 31;
    EXPECT_TRUE(contains(errorOf([&] { readSky(asset, MetaIndex{}, quiet, limits); }), "--limit image-pixels="));
    // As 16 bytes a pixel it may take an eighth, as .hdr and .exr may.
    limits = {};
    limits.maxImageBytes = 8 * 16 * 32;
    EXPECT_EQ(readSky(asset, MetaIndex{}, quiet, limits).radiance.width, 8u);
    limits.maxImageBytes -= 1;
    EXPECT_TRUE(
        contains(errorOf([&] { readSky(asset, MetaIndex{}, quiet, limits); }), "has 8 x 4 pixels, the limit is 31"));
    EXPECT_TRUE(contains(errorOf([&] { readSky(asset, MetaIndex{}, quiet, limits); }), "--limit image-bytes="));
    limits = {};
    limits.maxFileBytes = 8;
    const std::string tooLarge = errorOf([&] { readSky(asset, MetaIndex{}, quiet, limits); });
    EXPECT_TRUE(contains(tooLarge, "it is larger than the 8 bytes that are read")) << tooLarge;
    EXPECT_TRUE(contains(tooLarge, "--limit file-bytes=")) << tooLarge;
}

TEST(CocosSceneSky, EndingsOfPanoramasMayBeInCapitals) {
    for (const char* name : {"a.HDR", "a.Exr", "a.PNG", "a.jpg", "a.JPEG", "a.WebP"})
        EXPECT_TRUE(isPanorama(name)) << name;
    for (const char* name : {"a.gltf", "png", "a.png.meta", "a"}) EXPECT_FALSE(isPanorama(name)) << name;
}

TEST(CocosSceneSky, CamerasSayWhetherItIsShownAndTheSkyWhetherItLights) {
    SkyFolder folder;
    const std::string lit = R"("_envLightingType": 1, )" + SkyFolder::picture("_envmapHDR", kLdr);
    const std::string only = R"("_envLightingType": 0, )" + SkyFolder::picture("_envmapHDR", kLdr);
    const ImportedScene lights = folder.sky(7, lit);
    ASSERT_TRUE(lights.scene.environment);
    EXPECT_FALSE(lights.scene.environment->visible);
    EXPECT_TRUE(lights.scene.environment->lights);
    EXPECT_TRUE(litByEnvironment(lights.scene));
    const ImportedScene shown = folder.sky(14, only);
    ASSERT_TRUE(shown.scene.environment);
    EXPECT_TRUE(shown.scene.environment->visible);
    EXPECT_FALSE(shown.scene.environment->lights);
    EXPECT_FALSE(litByEnvironment(shown.scene));
    ASSERT_TRUE(shown.scene.ambient);  // it is the ambient light that lights
    EXPECT_FALSE(folder.sky(7, only).scene.environment);
    EXPECT_FALSE(folder
                     .load(withComponent(
                         R"({ "__type__": "cc.Camera", "_clearFlags": 14 })", "",
                         R"({ "_skybox": { "_enabled": false, )" + SkyFolder::picture("_envmapHDR", kLdr) + "} }"))
                     .scene.environment);
}

TEST(CocosSceneSky, EachHalfHasItsOwnPictureAndStrength) {
    SkyFolder folder;
    const std::string both = R"("_envLightingType": 2, )" + SkyFolder::picture("_envmapHDR", kHdr) + ", " +
                             SkyFolder::picture("_envmapLDR", kLdr);
    const std::string strengths = R"(, "_skyIllumHDR": 20000, "_skyIllumLDR": 0.5)";
    const ImportedScene hdr = folder.sky(14, both + R"(, "_useHDR": true)", strengths);
    ASSERT_TRUE(hdr.scene.environment);
    EXPECT_EQ(hdr.scene.environment->name, "packed.png");
    EXPECT_FLOAT_EQ(hdr.scene.environment->intensity, 20000);
    const ImportedScene ldr = folder.sky(14, both + R"(, "_useHDR": false)", strengths);
    ASSERT_TRUE(ldr.scene.environment);
    EXPECT_EQ(ldr.scene.environment->name, "sky.png");
    EXPECT_NEAR(ldr.scene.environment->intensity * exposureOf(*ldr.scene.exposureEv), 0.5, 1e-6);
}

TEST(CocosSceneSky, WhatIsLeftOutIsSaid) {
    SkyFolder folder;
    EXPECT_FALSE(folder.sky(14, R"("_envmap": { "__uuid__": ")" + std::string(kModel) + "\" }").scene.environment);
    EXPECT_TRUE(contains(folder.notes, "the sky is left out: 'm.gltf' is no sky")) << folder.notes;
    folder.notes.clear();
    folder.sky(14, SkyFolder::picture("_envmap", "70ff50d1-0000-4000-8000-000000f1736b"));
    EXPECT_TRUE(contains(folder.notes, "the sky is left out: no .meta has its uuid '70ff50d1")) << folder.notes;
    EXPECT_TRUE(contains(folder.notes, "--engine DIR"));
    folder.notes.clear();
    folder.sky(14, R"("_envmap": null)");
    EXPECT_TRUE(contains(folder.notes, "the sky is left out: it has no picture")) << folder.notes;
    folder.notes.clear();
    Image square(4, 4, Format::RGBA8);
    writeImage(folder.folder.path() / "project/sky.png", square);
    EXPECT_FALSE(folder.sky(14, SkyFolder::picture("_envmap", kLdr)).scene.environment);
    EXPECT_TRUE(contains(folder.notes, "the sky is left out: ")) << folder.notes;
    folder.notes.clear();
    const ImportedScene out = folder.sky(14, R"("_editableMaterial": { "__uuid__": ")" + std::string(kPaint) +
                                                 "\" }, " + SkyFolder::picture("_envmap", kHdr));
    EXPECT_TRUE(out.scene.environment);
    EXPECT_TRUE(contains(folder.notes, "left out: the material of the sky")) << folder.notes;
}

TEST(CocosSceneSky, AScenesAmbientLightIsTheEnginesWhereItSaysNone) {
    SceneFolder folder;
    const ImportedScene out = folder.load(withComponent(renderer(kSphere, "[]")));
    ASSERT_TRUE(out.scene.ambient);
    EXPECT_NEAR(out.scene.ambient->sky.x, 4000, 0.01);  // 0.2 of 20000 lux
    EXPECT_NEAR(out.scene.ambient->sky.z, 16000, 0.01);
    EXPECT_NEAR(out.scene.ambient->ground.y, 4000, 0.01);
    EXPECT_TRUE(contains(folder.notes, "the scene has no lights")) << folder.notes;
    // At f/16 and 1/125 s a white floor under such a sky is of middle brightness: 16000 lux x 2.6e-5.
    EXPECT_NEAR(out.scene.ambient->sky.z * exposureOf(*out.scene.exposureEv), 0.4167, 1e-3);
}

TEST(CocosSceneSky, DarknessIsAWarning) {
    SceneFolder folder;
    folder.load(withComponent(renderer(kSphere, "[]"), "",
                              R"({ "ambient": { "__type__": "cc.AmbientInfo", "_skyIllum": 0 } })"));
    EXPECT_TRUE(contains(folder.notes, "warning: nothing lights this scene")) << folder.notes;
    folder.notes.clear();
    folder.load(withComponent(R"({ "__type__": "cc.DirectionalLight" })"));
    EXPECT_FALSE(contains(folder.notes, "lights")) << folder.notes;
}

}  // namespace
}  // namespace crevice::cocos
