// Both forms against formulas written a second time, on the processor, from the article and from
// docs/stages/SsaoStage.md. They are fed with the G-buffer that the device drew, so that only the ambient occlusion is
// compared.
#include "AoFixture.h"
#include "stages/SsaoKernel.h"

namespace crevice {
namespace {

constexpr std::uint32_t kWidth = 96, kHeight = 64;
constexpr std::uint32_t kSeed = 5;

float smoothstep01(float x) {
    const float t = std::clamp(x, 0.0f, 1.0f);
    return t * t * (3 - 2 * t);
}

/// What both formulas are computed from.
struct Frame {
    glm::mat4 view{1}, projection{1};
    float near = 0, far = 0;
    Image position, normal, depth, noise;
    std::vector<glm::vec4> kernel;
};

/// Pixel at texture coordinates, the nearest one, clamped to the image.
glm::vec4 fetch(const Image& image, const glm::vec2& uv) {
    const glm::vec2 size(static_cast<float>(image.width), static_cast<float>(image.height));
    const glm::ivec2 texel = glm::clamp(glm::ivec2(glm::floor(uv * size)), glm::ivec2(0), glm::ivec2(size) - 1);
    return image.at(static_cast<std::uint32_t>(texel.x), static_cast<std::uint32_t>(texel.y));
}

/// The article's shader for one pixel, radius 1.
float articleOpenness(const Frame& frame, const glm::vec2& uv, const glm::vec2& random) {
    const auto depthOf = [&](const glm::vec3& world) { return -(frame.view * glm::vec4(world, 1)).z / frame.far; };
    const auto unit = [](const glm::vec3& v) {
        return glm::dot(v, v) > 0 ? v / std::sqrt(glm::dot(v, v)) : glm::vec3(1, 0, 0);
    };
    const glm::vec3 position(fetch(frame.position, uv));
    const glm::vec3 normal(fetch(frame.normal, uv));
    const glm::vec3 randomVector(random * 2.0f - 1.0f, 0);
    const glm::vec3 tangent = unit(randomVector - normal * glm::dot(randomVector, normal));
    const glm::mat3 frameOfTangent(tangent, glm::cross(normal, tangent), normal);
    const glm::mat4 viewProjection = frame.projection * frame.view;
    const float depth = depthOf(position);
    float occlusion = 0;
    for (const glm::vec4& k : frame.kernel) {
        const glm::vec3 sample = position + frameOfTangent * glm::vec3(k);
        const glm::vec4 clip = viewProjection * glm::vec4(sample, 1);
        if (clip.w <= 0) continue;
        const float stored = depthOf(glm::vec3(fetch(frame.position, glm::vec2(clip) / clip.w * 0.5f + 0.5f)));
        const float range = smoothstep01(1.0f / std::max(std::abs(depth - stored), 1e-9f));
        occlusion += (stored <= depthOf(sample) ? 1.0f : 0.0f) * range;
    }
    return 1 - occlusion / static_cast<float>(frame.kernel.size());
}

/// The article's hash with the processor's sine.
float articleRandom(const glm::vec2& uv) {
    const float v = std::sin(glm::dot(uv, glm::vec2(12.9898f, 78.233f))) * 43758.5453f;
    return v - std::floor(v);
}

/// The default form for one pixel, as docs/stages/SsaoStage.md puts it: plainly, in view space, in doubles. A
/// perspective camera.
double defaultOpenness(const Frame& frame, std::uint32_t x, std::uint32_t y, double radius) {
    const glm::dvec2 size(frame.depth.width, frame.depth.height);
    const glm::dmat4 projection(frame.projection);
    const glm::dvec2 pixel(x + 0.5, y + 0.5);
    const double depth = frame.depth.at(x, y).x;
    if (depth > 1e8) return 1;
    const auto positionAt = [&](const glm::dvec2& at, double z) {
        const glm::dvec2 ndc = at / size * 2.0 - 1.0;
        // clip.xy = scale * xy + shift * -z: an off-centre lens.
        return glm::dvec3((ndc.x + projection[2][0]) * z / projection[0][0],
                          (ndc.y + projection[2][1]) * z / projection[1][1], -z);
    };
    const glm::dvec3 position = positionAt(pixel, depth);
    const glm::dvec3 normal = glm::normalize(glm::dmat3(frame.view) * glm::dvec3(frame.normal.at(x, y)));
    const double pixelsPerUnit = 0.5 * size.y * std::abs(projection[1][1]) / depth;
    const double range = std::min({radius, 0.5 * size.y / pixelsPerUnit, 0.9 * (depth - frame.near)});

    // A basis about the normal (Duff et al. 2017, in coordinates whose z counts away from the viewer), turned by the
    // noise.
    const glm::dvec3 n(normal.x, normal.y, normal.z);
    const double sign = n.z >= 0 ? 1 : -1;
    const double a = -1 / (sign + n.z), b = n.x * n.y * a;
    const glm::dvec3 u(1 + sign * n.x * n.x * a, sign * b, -sign * n.x), v(b, sign + n.y * n.y * a, -n.y);
    const auto fraction = [](double value) { return value - std::floor(value); };
    const double turn = 6.283185307179586 * fraction(52.9829189 * fraction(0.06711056 * x + 0.00583715 * y));
    const glm::dvec3 tangent = u * std::cos(turn) + v * std::sin(turn);
    const glm::dvec3 bitangent = v * std::cos(turn) - u * std::sin(turn);

    // How much nearer a texel may be than its sample without a doubt: half a pixel along the plane on each axis, the
    // error of the stored normal over the radius, and of the depth.
    const double planeDistance = -glm::dot(normal, position);
    const double perPixel =
        std::abs(normal.x / (0.5 * size.x * projection[0][0])) + std::abs(normal.y / (0.5 * size.y * projection[1][1]));
    const double slackInverse = 0.5 * perPixel / planeDistance;
    const double slackRelative = range / 2048 / planeDistance + 2e-5;

    double occlusion = 0;
    int tested = 0;
    for (const glm::vec4& k : frame.kernel) {
        const glm::dvec3 sample =
            position + range * (double(k.x) * tangent + double(k.y) * bitangent + double(k.z) * normal);
        const double sampleDepth = -sample.z;
        const glm::dvec2 ndc = glm::dvec2(sample.x * projection[0][0], sample.y * projection[1][1]) / sampleDepth -
                               glm::dvec2(projection[2]);
        const glm::dvec2 texel = glm::floor((ndc * 0.5 + 0.5) * size);
        if (texel.x < 0 || texel.y < 0 || texel.x >= size.x || texel.y >= size.y) continue;
        ++tested;
        const double stored =
            frame.depth.at(static_cast<std::uint32_t>(texel.x), static_cast<std::uint32_t>(texel.y)).x;
        if (1 / stored <= (1 + slackRelative) / sampleDepth + slackInverse) continue;
        occlusion += std::clamp((range - (depth - stored)) / (0.5 * range), 0.0, 1.0);
    }
    const double fade = std::clamp((radius * pixelsPerUnit - 1) / 2, 0.0, 1.0);
    return std::clamp(1 - fade * occlusion / std::max(tested, 1), 0.0, 1.0);
}

class AoFormula : public AoTest {
protected:
    void SetUp() override {
        AoTest::SetUp();
        scene_ = cornerScene(30);
        addBox(scene_, {1.1f, 0.55f, 0.7f}, {0.9f, 1.1f, 0.8f});
        const glm::mat4 turned =
            glm::rotate(translated({2.2f, 0.4f, 1.9f}), 0.7f, glm::normalize(glm::vec3(0.3f, 1, 0.2f)));
        addObject(scene_, makeSphere(0.5f, 32), turned);
        camera_ = Camera::lookAt({5.5f, 4.2f, 4.4f}, {0.9f, 0.5f, 0.8f});
        camera_.fovY = glm::radians(40.0f);
        camera_.lensShift = {0.35f, -0.25f};
        camera_.near = 0.5f;
        camera_.far = 50;
    }
    /// Renders a form with radius 1; fills `frame` with what it was made from.
    FloatMap render(const std::string& form, Frame& frame) {
        Sets sets = {{"SsaoStage.params.seed", std::to_string(kSeed)}, {"SsaoStage.material.radius", "1"}};
        if (form == "default") sets.push_back({"SsaoStage.material.power", "1"});
        writeFragment("article-noise", R"(  float random(vec2 uv) {
    return fract(sin(dot(uv, vec2(12.9898, 78.233))) * 43758.5453);
  })",
                      "    result = vec4(random(v_uv + vec2(0.0, 1.0)), random(v_uv + vec2(1.0, 0.0)), 0.0, 1.0);",
                      "vec4");
        loadDocument(
            R"({ "extends": "ao-only", "targets": { "noise": { "format": "RGBA32F" }, "cc_ssaoMap": { "override": true, "format": "R32F" } },
          "edits": [ { "insert": { "stage": "FullscreenStage", "name": "Noise", "effect": "article-noise", "writes": ["noise"] },
                       "before": "SsaoStage" } ] })",
            sets, {{"form", form}});
        renderer_->setScene(scene_);
        View view = viewOf(camera_, kWidth, kHeight);
        view.keep = {"cc_ssaoMap", "cc_gbuffer_positionMap", "cc_gbuffer_normalMap", "viewDepth", "noise"};
        renderer_->render(view);
        frame.view = camera_.view;
        frame.projection = camera_.projection(float(kWidth) / float(kHeight));
        frame.near = camera_.near;
        frame.far = camera_.far;
        frame.position = renderer_->target("cc_gbuffer_positionMap");
        frame.normal = renderer_->target("cc_gbuffer_normalMap");
        frame.depth = renderer_->target("viewDepth");
        frame.noise = renderer_->target("noise");
        frame.kernel.resize(64);
        makeSsaoKernel(form == "article" ? SsaoKernelKind::Article : SsaoKernelKind::Stratified, kSeed, frame.kernel);
        return FloatMap(renderer_->target("cc_ssaoMap"));
    }
    Scene scene_;
    Camera camera_;
};

struct Agreement {
    double mean = 0;        ///< Of the second map minus that of the first.
    double equalShare = 0;  ///< Of pixels within one step of a byte.
};

template <class Openness>
Agreement compare(const FloatMap& map, Openness openness) {
    Agreement agreement;
    for (std::uint32_t y = 0; y < kHeight; ++y) {
        for (std::uint32_t x = 0; x < kWidth; ++x) {
            const double difference = openness(x, y) - map.at(x, y);
            agreement.mean += difference / (kWidth * kHeight);
            agreement.equalShare += (std::abs(difference) <= kByteStep) / double(kWidth * kHeight);
        }
    }
    return agreement;
}

glm::vec2 uvOf(std::uint32_t x, std::uint32_t y) {
    return {(static_cast<float>(x) + 0.5f) / kWidth, (static_cast<float>(y) + 0.5f) / kHeight};
}

TEST_F(AoFormula, ArticleToTheLetter) {
    Frame frame;
    const FloatMap map = render("article", frame);
    ASSERT_LT(map.mean(), 0.95);
    // The random numbers are the device's: the hash keeps just the digits of the sine in which devices differ.
    const Agreement exact = compare(map, [&](std::uint32_t x, std::uint32_t y) {
        return articleOpenness(frame, uvOf(x, y), glm::vec2(frame.noise.at(x, y)));
    });
    EXPECT_GE(exact.equalShare, 0.99);
    EXPECT_LE(std::abs(exact.mean), kByteStep);
    // With the processor's own sine single pixels differ, the whole does not.
    const Agreement own = compare(map, [&](std::uint32_t x, std::uint32_t y) {
        const glm::vec2 uv = uvOf(x, y);
        return articleOpenness(frame, uv, {articleRandom(uv + glm::vec2(0, 1)), articleRandom(uv + glm::vec2(1, 0))});
    });
    EXPECT_LE(std::abs(own.mean), kByteStep);
    RecordProperty("share_with_own_sine", std::to_string(own.equalShare));
    RecordProperty("share", std::to_string(exact.equalShare));
}

TEST_F(AoFormula, DefaultAsDocumented) {
    Frame frame;
    const FloatMap map = render("default", frame);
    ASSERT_LT(map.mean(), 0.98);
    const Agreement agreement =
        compare(map, [&](std::uint32_t x, std::uint32_t y) { return defaultOpenness(frame, x, y, 1.0); });
    EXPECT_LE(std::abs(agreement.mean), kByteStep);
    EXPECT_GE(agreement.equalShare, 0.99);
    RecordProperty("share", std::to_string(agreement.equalShare));
}

}  // namespace
}  // namespace crevice
