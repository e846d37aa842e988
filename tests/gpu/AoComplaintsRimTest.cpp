// Rims: what is dark or bright beside things and behind them, and should not be.
#include "AoComplaintsFixture.h"
#include "truth/HeightfieldReference.h"
#include "truth/PictureMetrics.h"

namespace crevice {
namespace {

constexpr float kFovY = 0.7f;

class AoPillar : public AoTest {
protected:
    /// By how much the floor is brighter behind a pillar than before it, as far away. The truth is 0.
    double brighterBehind(const std::string& ao, const std::string& resolution, Options more = {}) {
        Scene scene = emptyScene();
        addSquare(scene, {0, 0, 0}, {0, 1, 0}, 40);
        addBox(scene, {0, 0.3f, 0}, {0.4f, 0.6f, 0.4f});
        Camera camera = Camera::lookAt({0, 6, 3.5f}, {0, 0, 0});
        camera.fovY = 0.5f;
        camera.near = 0.1f;
        camera.far = 100;
        const View view = viewOf(camera, 192, 192);
        more.merge(Options{{"ao", ao}, {"resolution", resolution}, {"radius", "0.8"}});
        load("ao-views", more, {{"cc_ssaoBlurMap.format", "R32F"}});
        renderer_->setScene(std::move(scene));
        const FloatMap openness = map(view, "cc_ssaoBlurMap"), depth = map(view, "viewDepth");
        const auto strip = [&](float nearZ, float farZ) {
            return meanWhere(view, depth, openness, [&](const glm::vec3& p) {
                return std::abs(p.y) < 0.01f && std::abs(p.x) < 0.15f && p.z > nearZ && p.z < farZ;
            });
        };
        // The pillar hides up to .35 behind its back face.
        const double before = strip(0.62f, 0.72f), behind = strip(-0.72f, -0.62f);
        EXPECT_LT(before, 0.97) << "the pillar occludes the floor";
        return behind - before;
    }
};

TEST_F(AoPillar, TheBitmaskDarkensTheFloorBehindItAsBeforeIt) {
    for (const char* resolution : {"full", "half"}) {
        const double byDefault = brighterBehind("vbao", resolution);
        const double asDeep = brighterBehind("vbao", resolution, {{"thickness", "0.5"}});
        const double horizon = brighterBehind("gtao", resolution);
        RecordProperty(resolution,
                       std::to_string(byDefault) + ' ' + std::to_string(asDeep) + ' ' + std::to_string(horizon));
        // The pillar is half a radius deep.
        EXPECT_NEAR(asDeep, 0, 0.03) << resolution;
        EXPECT_NEAR(byDefault, 0, 0.03) << resolution;
        // What everybody complains of: horizons take the pillar for a wall without end.
        EXPECT_LT(horizon, byDefault) << resolution;
        EXPECT_LT(horizon, -0.03) << resolution << ": more than the mask may have";
    }
}

/// Things that float before a far wall (left) and the sky (right): a ball before a box, farther than the radius; two
/// boxes through each other, whose creases end at silhouettes; a bar before a board, nearer than the radius.
Scene silhouettes() {
    Scene scene = emptyScene();
    addSquare(scene, {-15, 0, -12}, {0, 0, 1}, 30);
    addObject(scene, makeSphere(0.35f, 64), translated({-0.9f, -0.5f, 1}));
    addBox(scene, {-1.1f, -0.5f, -0.8f}, {1.1f, 1.2f, 0.3f});
    addBox(scene, {0.9f, 0.5f, 0}, {0.3f, 1.2f, 0.3f});
    addBox(scene, {0.9f, 0.5f, 0.1f}, {1.2f, 0.3f, 0.4f});
    addBox(scene, {0.7f, -0.7f, -0.2f}, {1.2f, 0.8f, 0.1f});
    addBox(scene, {0.8f, -0.6f, 0.15f}, {0.12f, 1.2f, 0.12f});
    return scene;
}

/// 1 where a surface is seen within 4 pixels of a depth edge.
std::vector<std::uint8_t> nearEdges(const std::vector<std::uint8_t>& edges, const FloatMap& depth) {
    std::vector<std::uint8_t> near(edges.size());
    for (int y = 0; y < int(depth.height); ++y)
        for (int x = 0; x < int(depth.width); ++x) {
            const auto at = [&](int px, int py) { return std::size_t(py) * depth.width + std::size_t(px); };
            if (edges[at(x, y)] == 0) continue;
            for (int v = std::max(y - 4, 0); v <= std::min(y + 4, int(depth.height) - 1); ++v)
                for (int u = std::max(x - 4, 0); u <= std::min(x + 4, int(depth.width) - 1); ++u)
                    near[at(u, v)] = depth.values[at(u, v)] < 1e8f;
        }
    return near;
}

std::vector<glm::vec3> normalsOf(const Image& gbuffer) {
    std::vector<glm::vec3> normals;
    for (std::uint32_t y = 0; y < gbuffer.height; ++y)
        for (std::uint32_t x = 0; x < gbuffer.width; ++x) {
            const glm::vec3 n = gbuffer.at(x, y);
            normals.push_back(glm::dot(n, n) > 0 ? glm::normalize(n) : n);
        }
    return normals;
}

class AoRims : public AoComplaints {};

TEST_P(AoRims, SilhouettesHaveNoRims) {
    Camera camera = Camera::lookAt({1.2f, 0.6f, 5}, {0, -0.1f, 0});
    camera.fovY = kFovY;
    camera.near = 0.1f;
    camera.far = 100;
    constexpr std::uint32_t kWidth = 160, kHeight = 120;
    const View view = viewOf(camera, kWidth, kHeight);
    loadMaps(0.5f);
    renderer_->setScene(silhouettes());
    const FloatMap openness = open(view), depth = map(view, "viewDepth");
    const glm::uvec2 size(kWidth, kHeight);
    const std::vector<std::uint8_t> counted = nearEdges(findDepthEdges(size, depth.values, camera), depth);
    const std::vector<glm::vec3> normal = normalsOf(target(view, "cc_gbuffer_normalMap"));
    const std::vector<float> known =
        traceHeightfield({size, camera, depth.values, normal, counted}, {.radius = 0.5f, .slices = 16});
    const MapMetrics m = measureMap(openness.values, known, counted);
    RecordProperty("rmse", std::to_string(m.rmse) + " bias " + std::to_string(m.bias));
    EXPECT_GT(m.count, 2000u);
    EXPECT_GT(m.white, 0.09) << "a map without occlusion fails";
    EXPECT_LE(m.rmse, 0.08);
}

INSTANTIATE_TEST_SUITE_P(All, AoRims, testing::ValuesIn(everyAoCase()), nameOfAoCase);

}  // namespace
}  // namespace crevice
