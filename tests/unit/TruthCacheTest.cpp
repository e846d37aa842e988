// Maps that are kept: the same bytes without a ray, and another key for whatever rays could notice.
#include <unistd.h>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <set>
#include <utility>

#include "TruthTools.h"
#include "core/Files.h"
#include "truth/TruthCache.h"

namespace crevice::test {
namespace {

namespace fs = std::filesystem;

class TruthCache : public ::testing::Test {
protected:
    void SetUp() override {
        folder_ = fs::temp_directory_path() / ("crevice-truth-" + std::to_string(::getpid()));
        fs::create_directories(folder_);
        settings_ = {
            .terms = {{1, &hardFalloff()}, {0.5f, findFalloff("matched:cocos")}}, .samples = 16, .cache = folder_};
        scene_ = whiteScene();
        addFloor(scene_, 5);
        addWallX(scene_, 0, 5, 5);
        camera_ = Camera::lookAt({3, 4, 1}, {0.5f, 0, 0});
        camera_.near = 0.1f;
        camera_.far = 50;
    }
    void TearDown() override { fs::remove_all(folder_); }

    AmbientMap trace() const { return traceAmbient(scene_, camera_, {20, 12}, settings_); }
    std::vector<fs::path> files() const {
        std::vector<fs::path> found;
        for (const auto& entry : fs::directory_iterator(folder_)) found.push_back(entry.path());
        return found;
    }
    static void expectSame(const AmbientMap& a, const AmbientMap& b) {
        EXPECT_EQ(a.viewDepth, b.viewDepth);
        EXPECT_EQ(a.normal, b.normal);
        EXPECT_EQ(a.isCounted, b.isCounted);
        ASSERT_EQ(a.layers.size(), b.layers.size());
        for (std::size_t i = 0; i < a.layers.size(); ++i) {
            EXPECT_EQ(a.layers[i].openness, b.layers[i].openness);
            EXPECT_EQ(a.layers[i].first, b.layers[i].first);
            EXPECT_EQ(a.layers[i].second, b.layers[i].second);
            EXPECT_EQ(a.layers[i].noise, b.layers[i].noise);
        }
    }

    fs::path folder_;
    AmbientSettings settings_;
    Scene scene_;
    Camera camera_;
};

TEST_F(TruthCache, TheSecondRunTracesNothing) {
    const AmbientMap first = trace();
    EXPECT_FALSE(first.fromCache);
    ASSERT_EQ(files().size(), 1u);
    int reports = 0;
    settings_.progress = [&](float) { ++reports; };
    settings_.threads = 1;  // the calling thread reports
    const AmbientMap second = trace();
    EXPECT_TRUE(second.fromCache);
    EXPECT_EQ(reports, 0) << "the tracer ran";
    expectSame(first, second);
    const AmbientMap third = traceAmbient(RayScene(scene_), camera_, {20, 12}, settings_);
    EXPECT_TRUE(third.fromCache);
    settings_.cache.reset();
    const AmbientMap again = trace();
    EXPECT_FALSE(again.fromCache);
    EXPECT_GT(reports, 0);
    expectSame(first, again);
}

// The file decides, not the memory of the process: what is written into it comes back, if its hash is right.
TEST_F(TruthCache, DamagedFilesAreTracedAnew) {
    const AmbientMap first = trace();
    const fs::path file = files().front();
    const std::string whole = readText(file);
    std::string flipped = whole;
    flipped[whole.size() / 2] = static_cast<char>(flipped[whole.size() / 2] ^ 1);
    for (const std::string& damaged : {std::string(), whole.substr(0, 100), whole.substr(0, whole.size() - 1), flipped,
                                       whole + "x", std::string(whole.size(), 'x')}) {
        std::ofstream(file, std::ios::binary) << damaged;
        const AmbientMap again = trace();
        EXPECT_FALSE(again.fromCache);
        expectSame(first, again);
        EXPECT_EQ(readText(file), whole) << "not written anew";
        EXPECT_TRUE(trace().fromCache);
    }
    EXPECT_EQ(files().size(), 1u) << "something was left aside";
}

TEST_F(TruthCache, AFolderThatCannotBeWrittenIsNoError) {
    settings_.cache = folder_ / "absent" / "folder";
    EXPECT_FALSE(trace().fromCache);
    EXPECT_FALSE(trace().fromCache);
    EXPECT_FALSE(fs::exists(*settings_.cache));
}

TEST_F(TruthCache, AMovedTriangleIsTraced) {
    const AmbientMap first = trace();
    scene_.instances[1].world[3].x = 0.3f;
    const AmbientMap second = trace();
    EXPECT_FALSE(second.fromCache);
    EXPECT_NE(first.layers[0].openness, second.layers[0].openness);
    EXPECT_EQ(files().size(), 2u);
}

TEST_F(TruthCache, HeightfieldsAreKept) {
    const AmbientMap seen = trace();
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    const HeightfieldInput input{seen.size, camera_, seen.viewDepth, seen.normal};
    int reports = 0;
    const HeightfieldSettings settings{
        .radius = 1, .slices = 4, .threads = 1, .progress = [&](float) { ++reports; }, .cache = folder_};
    const std::vector<float> first = traceHeightfield(input, settings);
    EXPECT_EQ(files().size(), 1u);
    EXPECT_GT(std::exchange(reports, 0), 0);
    EXPECT_EQ(traceHeightfield(input, settings), first);
    EXPECT_EQ(reports, 0) << "it was traced again";
}

/// Everything that decides a map.
struct Input {
    Scene scene;
    Camera camera;
    glm::uvec2 size{20, 12};
    AmbientSettings settings;

    std::string key() const { return truthKey(scene, camera, size, settings); }
};
using Changes = std::map<std::string, std::function<void(Input&)>>;

const Falloff& steeperFalloff() {
    static const Falloff steeper = [] {
        Falloff falloff = *findFalloff("linear");
        falloff.power = 2;
        return falloff;
    }();
    return steeper;
}

/// Each changes what a ray could meet or how it counts; mesh 2 is cut out by a texture's alpha.
Changes noticedChanges() {
    return {
        {"position", [](Input& i) { i.scene.meshes[1].vertices[2].position.y += 1e-4f; }},
        {"normal",
         [](Input& i) {
             i.scene.meshes[0].vertices[0].normal = {1, 0, 0};
         }},
        {"index", [](Input& i) { std::swap(i.scene.meshes[0].indices[0], i.scene.meshes[0].indices[1]); }},
        {"transform", [](Input& i) { i.scene.instances[1].world[3].x = 0.01f; }},
        {"flipped", [](Input& i) { i.scene.instances[1].flipped = true; }},
        {"instance", [](Input& i) { i.scene.instances.push_back(i.scene.instances[0]); }},
        {"blend", [](Input& i) { i.scene.materials[0].alphaMode = AlphaMode::Blend; }},
        {"two-sided", [](Input& i) { i.scene.materials[0].doubleSided = true; }},
        {"cutoff", [](Input& i) { i.scene.materials[1].alphaCutoff = 0.4f; }},
        {"alpha", [](Input& i) { i.scene.materials[1].baseColor.a = 0.9f; }},
        {"texel", [](Input& i) { i.scene.textures[0].image.pixel(1, 0)[3] = std::byte{7}; }},
        {"wrap", [](Input& i) { i.scene.textures[0].sampler.wrapU = TextureWrap::Clamp; }},
        {"uv", [](Input& i) { i.scene.meshes[2].vertices[0].uv0.x = 0.5f; }},
        {"vertex alpha", [](Input& i) { i.scene.meshes[2].vertices[0].color.a = 0.5f; }},
        {"eye", [](Input& i) { i.camera.view[3].x += 1e-5f; }},
        {"field of view", [](Input& i) { i.camera.fovY += 1e-5f; }},
        {"parallel", [](Input& i) { i.camera.orthographic = true; }},
        {"shift", [](Input& i) { i.camera.lensShift.y = 0.1f; }},
        {"near", [](Input& i) { i.camera.near = 0.2f; }},
        {"far", [](Input& i) { i.camera.far = 60; }},
        {"size",
         [](Input& i) {
             i.size = {12, 20};
         }},
        {"radius", [](Input& i) { i.settings.terms[0].radius = 1.01f; }},
        {"falloff", [](Input& i) { i.settings.terms[0].falloff = findFalloff("linear"); }},
        {"changed falloff", [](Input& i) { i.settings.terms[0].falloff = &steeperFalloff(); }},
        {"directions", [](Input& i) { i.settings.terms[0].falloff = findFalloff("matched:songjihu"); }},
        {"terms", [](Input& i) { i.settings.terms.pop_back(); }},
        {"samples", [](Input& i) { i.settings.samples = 32; }},
        {"seed", [](Input& i) { i.settings.seed = 2; }},
    };
}

Changes unnoticedChanges() {
    return {
        {"names", [](Input& i) { i.scene.name = i.scene.meshes[0].name = i.scene.materials[0].name = "other"; }},
        {"colour",
         [](Input& i) {
             i.scene.materials[0].baseColor = {1, 0, 0, 0.5f};
         }},
        {"lights", [](Input& i) { i.scene.lights.emplace_back(); }},
        {"threads", [](Input& i) { i.settings.threads = 7; }},
        {"uv of opaque", [](Input& i) { i.scene.meshes[0].vertices[0].uv0.x = 0.5f; }},
        {"unused", [](Input& i) { i.scene.materials.emplace_back(); }},
    };
}

class TruthKey : public TruthCache {
protected:
    /// The fixture's scene, and a square that a texture cuts out.
    Input input() {
        SceneTexture texture;
        texture.image = Image(2, 1, Format::RGBA8);
        scene_.textures.push_back(texture);
        SceneMaterial mask;
        mask.alphaMode = AlphaMode::Mask;
        mask.baseColorMap.texture = 0;
        scene_.materials.push_back(mask);
        addQuad(scene_, {-1, 1, 1}, {1, 1, 1}, {1, 1, -1}, {-1, 1, -1}, 1);
        return {scene_, camera_, {20, 12}, settings_};
    }
};

TEST_F(TruthKey, IsAnotherForWhatRaysNotice) {
    const Input plain = input();
    std::map<std::string, std::string> names = {{plain.key(), "nothing"}};
    for (const auto& [name, change] : noticedChanges()) {
        Input changed = plain;
        change(changed);
        const auto [known, isNew] = names.emplace(changed.key(), name);
        EXPECT_TRUE(isNew) << "'" << name << "' has the key of '" << known->second << "'";
    }
}

TEST_F(TruthKey, IsTheSameForWhatRaysCannotNotice) {
    const Input plain = input();
    for (const auto& [name, change] : unnoticedChanges()) {
        Input changed = plain;
        change(changed);
        EXPECT_EQ(changed.key(), plain.key()) << name;
    }
}

TEST_F(TruthKey, OfAHeightfieldIsAnotherForEachInputAndSetting) {
    const AmbientMap seen = trace();
    std::vector<float> moved = seen.viewDepth;
    moved[7] *= 1.001f;
    std::vector<std::uint8_t> mask(moved.size(), 1);
    mask[3] = 0;
    std::vector<glm::vec3> tilted = seen.normal;
    tilted[9] = {0, 0, 1};
    using Change = std::function<void(HeightfieldInput&, HeightfieldSettings&)>;
    const std::map<std::string, Change> changes = {
        {"nothing", [](HeightfieldInput&, HeightfieldSettings&) {}},
        {"depth", [&](HeightfieldInput& i, HeightfieldSettings&) { i.viewDepth = moved; }},
        {"normal", [&](HeightfieldInput& i, HeightfieldSettings&) { i.normal = tilted; }},
        {"mask", [&](HeightfieldInput& i, HeightfieldSettings&) { i.isCounted = mask; }},
        {"camera", [](HeightfieldInput& i, HeightfieldSettings&) { i.camera.fovY = 1; }},
        {"radius", [](HeightfieldInput&, HeightfieldSettings& s) { s.radius = 2; }},
        {"thickness", [](HeightfieldInput&, HeightfieldSettings& s) { s.thickness = 1; }},
        {"steps", [](HeightfieldInput&, HeightfieldSettings& s) { s.steps = 7; }},
        {"slices", [](HeightfieldInput&, HeightfieldSettings& s) { s.slices = 7; }},
        {"seed", [](HeightfieldInput&, HeightfieldSettings& s) { s.seed = 7; }},
    };
    std::set<std::string> keys;
    for (const auto& [name, change] : changes) {
        HeightfieldInput input{seen.size, camera_, seen.viewDepth, seen.normal};
        HeightfieldSettings settings{.radius = 1, .slices = 4};
        change(input, settings);
        EXPECT_TRUE(keys.insert(heightfieldKey(input, settings)).second) << name;
    }
}

}  // namespace
}  // namespace crevice::test
