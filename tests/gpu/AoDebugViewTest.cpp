// The views of ao-views: each pixel is exactly what the view says it shows.
#include <functional>

#include "AoFixture.h"

namespace crevice {
namespace {

class AoDebugView : public AoTest {
protected:
    static constexpr std::uint32_t kWidth = 80, kHeight = 60;

    /// Boxes before a wall, tilted to every axis, with sky above.
    static Scene boxes() {
        Scene scene = emptyScene();
        addSquare(scene, {0, 0, 0}, {0.1f, 1, 0}, 6);
        addBox(scene, {0.6f, 0.5f, 0.2f}, {0.8f, 1, 0.7f});
        addBox(scene, {-0.7f, 0.3f, 0.6f}, {0.5f, 0.6f, 0.5f});
        return scene;
    }
    static View viewFrom(bool orthographic) {
        Camera camera = Camera::lookAt({2.5f, 2, 4}, {0, 0.3f, 0});
        camera.orthographic = orthographic;
        camera.orthoHeight = 3.5f;
        camera.near = 0.1f;
        camera.far = 60;
        return viewOf(camera, kWidth, kHeight);
    }
    Image show(const std::string& view, Options options = {}, Sets sets = {}, bool orthographic = false) {
        options.emplace("view", view);
        options.emplace("radius", "0.5");
        load("ao-views", options, std::move(sets));
        renderer_->setScene(boxes());
        return target(viewFrom(orthographic), "finalColor");
    }
    /// `expected`: colour of a pixel before it becomes bytes. A byte is the nearest one, give or take what floats
    /// round.
    static void expectEach(const Image& image, const std::function<glm::dvec3(std::uint32_t, std::uint32_t)>& expected,
                           const std::string& what) {
        for (std::uint32_t y = 0; y < image.height; ++y)
            for (std::uint32_t x = 0; x < image.width; ++x) {
                const glm::dvec3 off = glm::abs(glm::dvec3(image.at(x, y)) - expected(x, y)) * 255.0;
                ASSERT_LE(std::max({off.x, off.y, off.z}), 0.502) << what << " at " << x << ',' << y;
            }
    }
    static glm::dvec3 grey(const Image& map, std::uint32_t x, std::uint32_t y) {
        return glm::dvec3(double(map.at(x, y).x));
    }
};

TEST_F(AoDebugView, RawAndDenoisedAreTheMaps) {
    for (const std::string ao : {"gtao", "vbao", "off"}) {
        for (const std::string resolution : {"full", "half"}) {
            const std::string what = ao + ' ' + resolution;
            const Options options{{"ao", ao}, {"resolution", resolution}};
            const Image raw = show("raw", options);
            const Image map = target(viewFrom(false), "cc_ssaoMap");
            const std::uint32_t texel = resolution == "half" ? 2 : 1;
            ASSERT_EQ(map.width, kWidth / texel) << what;
            expectEach(
                raw, [&](auto x, auto y) { return grey(map, x / texel, y / texel); }, what + " raw");
            const Image denoised = show("denoised", options);
            const Image blurred = target(viewFrom(false), "cc_ssaoBlurMap");
            expectEach(
                denoised, [&](auto x, auto y) { return grey(blurred, x, y); }, what);
            EXPECT_EQ(FloatMap(denoised).min() < 0.9f, ao != "off") << what;
            // It is the map that lighting samples.
            Options lit = options;
            lit.emplace("radius", "0.5");
            load("ao-deferred", lit);
            renderer_->setScene(boxes());
            EXPECT_EQ(target(viewFrom(false), "cc_ssaoBlurMap"), blurred) << what;
        }
    }
}

TEST_F(AoDebugView, DepthAndNormalsAreThoseOfTheGbuffer) {
    for (const bool orthographic : {false, true}) {
        const Image depth = show("depth", {}, {{"DebugView.material.halfDepth", "2"}}, orthographic);
        const Image viewDepth = target(viewFrom(orthographic), "viewDepth");
        expectEach(
            depth, [&](auto x, auto y) { return glm::dvec3(2 / (2 + double(viewDepth.at(x, y).x))); }, "depth");
        EXPECT_EQ(FloatMap(depth).min(), 0) << "sky is black";
        const Image normal = show("normal", {}, {}, orthographic);
        const Image gbuffer = target(viewFrom(orthographic), "cc_gbuffer_normalMap");
        expectEach(
            normal,
            [&](auto x, auto y) {
                const glm::dvec3 n = gbuffer.at(x, y);
                return n == glm::dvec3(0) ? n : n * 0.5 + 0.5;
            },
            "normal");
    }
}

/// Weights of the neighbours along one axis by the rule of the denoiser (chunk ao-plane), in double precision: the
/// smaller one of both sides; a neighbour beyond the frame does not count.
double onPlane(const Image& depth, int x, int y, int dx, int dy, const Camera& camera) {
    const bool ortho = camera.orthographic;
    const auto isInside = [&](int px, int py) {
        return px >= 0 && py >= 0 && px < int(depth.width) && py < int(depth.height);
    };
    const auto line = [&](int px, int py) {
        const double d = isInside(px, py) ? double(depth.at(std::uint32_t(px), std::uint32_t(py)).x) : 0.0;
        return ortho ? d : 1 / std::max(d, 1e-20);
    };
    const double own = line(x, y), before = line(x - dx, y - dy), after = line(x + dx, y + dy);
    const double slope = std::abs(own - before) < std::abs(after - own) ? own - before : after - own;
    const double aspect = double(depth.width) / depth.height;
    const double seen = ortho ? double(camera.orthoHeight) * aspect : 2 * std::tan(double(camera.fovY) / 2) * aspect;
    const double tolerance = 2 * seen / depth.width;  // two pixels' worth, at depth 1 in a perspective
    const double scale = (ortho ? 1 : double(depth.at(std::uint32_t(x), std::uint32_t(y)).x)) / tolerance;
    double least = 1;
    if (isInside(x - dx, y - dy)) least = std::min(least, 1 - std::abs(before - own + slope) * scale);
    if (isInside(x + dx, y + dy)) least = std::min(least, 1 - std::abs(after - own - slope) * scale);
    return std::clamp(least, 0.0, 1.0);
}

TEST_F(AoDebugView, EdgesAreWhatTheDenoiserKeeps) {
    for (const bool orthographic : {false, true}) {
        const Image edges = show("edges", {{"guard", "0"}}, {}, orthographic);  // "beyond the frame" is its edge
        const View view = viewFrom(orthographic);
        const Image depth = target(view, "viewDepth");
        int green = 0, red = 0, white = 0;
        expectEach(
            edges,
            [&](auto x, auto y) {
                if (depth.at(x, y).x > 1e8f) return glm::dvec3(1);
                const double across = onPlane(depth, int(x), int(y), 1, 0, *view.camera);
                const double down = onPlane(depth, int(x), int(y), 0, 1, *view.camera);
                green += across < 0.1 && down > 0.9;
                red += down < 0.1 && across > 0.9;
                white += across > 0.99 && down > 0.99;
                return glm::dvec3(across, down, std::min(across, down));
            },
            orthographic ? "orthographic" : "perspective");
        EXPECT_GT(green, 50);
        EXPECT_GT(red, 20);
        EXPECT_GT(white, int(kWidth * kHeight) / 2);
    }
}

TEST_F(AoDebugView, BentNormalsAreWhatLightingTakes) {
    for (const std::string ao : {"gtao", "vbao"}) {
        for (const std::string resolution : {"full", "half"}) {
            const std::string what = ao + ' ' + resolution;
            const Image shown = show(
                "bentNormal", {{"ao", ao}, {"resolution", resolution}, {"bentNormals", "true"}, {"quality", "high"}});
            const Image bent = target(viewFrom(false), "bentNormal");
            const Image normal = target(viewFrom(false), "cc_gbuffer_normalMap");
            const Image position = target(viewFrom(false), "cc_gbuffer_positionMap");
            int turned = 0, crease = 0, kept = 0;
            expectEach(
                shown,
                [&](auto x, auto y) {
                    const glm::dvec3 b = bent.at(x, y), n = normal.at(x, y);
                    if (n == glm::dvec3(0)) return b;  // sky: nothing at all
                    EXPECT_NEAR(glm::length(b), 1, 2e-3) << what;
                    EXPECT_GT(glm::dot(b, glm::normalize(n)), 0.5) << what << " at " << x << ',' << y;
                    const glm::dvec3 p = position.at(x, y);
                    // The floor before the larger box: what is open leans away from it.
                    if (p.z > 0.6 && p.z < 0.75 && p.x > 0.4 && p.x < 0.8 && std::abs(n.y) > 0.9) {
                        ++crease;
                        turned += b.z > 0.1;
                    }
                    // The floor far from both boxes.
                    if (p.x < -1.6 && std::abs(n.y) > 0.9) kept += glm::dot(b, glm::normalize(n)) > 0.999;
                    return b * 0.5 + 0.5;
                },
                what);
            EXPECT_GT(crease, 5) << what;
            EXPECT_EQ(turned, crease) << what;
            EXPECT_GT(kept, 100) << what;
        }
    }
    // Without the option there are none.
    EXPECT_EQ(FloatMap(show("bentNormal", {{"ao", "gtao"}})).max(), 0);
}

TEST_F(AoDebugView, UnknownViewsAndLightingOptionsAreRefused) {
    EXPECT_THROW(show("heat"), Error);
    EXPECT_THROW(show("raw", {{"applyTo", "ambient"}}), Error);
}

}  // namespace
}  // namespace crevice
