// Direct light on one plane against the formulas of glTF, deferred and forward; emission, ambient light and fog.
#include "FrameFixture.h"
#include "LightingReference.h"

namespace crevice {
namespace {

/// Results are half floats: 11 significant bits. Vulkan lets the store round down (lavapipe does): one unit, 2^-10.
constexpr double kHalfError = 1.0 / 1024;
/// The reference's tolerance: the store, and unit vectors, whose inverse square root has 12 bits on lavapipe (2^-11.4).
constexpr double kShadingError = kHalfError + 1.0 / 1024;

struct Paint {
    glm::vec3 color;
    float metallic, roughness;
};
/// All exact in half floats, so that the G-buffer loses nothing.
constexpr Paint kPaints[] = {
    {{1, 1, 1}, 0, 1}, {{0.5f, 0.25f, 0.75f}, 0, 0.5f}, {{0.875f, 0.5f, 0.25f}, 0.75f, 0.375f}};

class Lighting : public FrameTest {
protected:
    static Scene wall() {
        Scene scene = darkScene();
        addWall(scene, 20);
        return scene;
    }
    static void paint(Scene& scene, const Paint& paint) {
        scene.materials[0].baseColor = glm::vec4(paint.color, 1);
        scene.materials[0].metallic = paint.metallic;
        scene.materials[0].roughness = paint.roughness;
    }

    /// The wall's radiance in both pipelines and all paints against the reference, pixel by pixel.
    void expectReference(Scene scene, const Camera& camera) {
        const View view = viewOf(camera, 12, 8);
        for (const char* pipeline : {"deferred", "forward"}) {
            load(pipeline);
            for (const Paint& color : kPaints) {
                paint(scene, color);
                renderer_->setScene(scene);
                expectPixels(radiance(view), view, scene, pipeline);
            }
        }
    }
    void expectPixels(const Image& image, const View& view, const Scene& scene, const std::string& what) {
        double brightest = 0;
        for (std::uint32_t y = 0; y < image.height; ++y) {
            for (std::uint32_t x = 0; x < image.width; ++x) {
                const ReferencePoint point = pointAt(view, scene.materials[0], x, y);
                const glm::dvec3 expected = referenceRadiance(point, scene);
                const glm::dvec4 actual(image.at(x, y));
                for (int c = 0; c < 3; ++c) {
                    brightest = std::max(brightest, expected[c]);
                    EXPECT_NEAR(actual[c], expected[c], expected[c] * kShadingError + 2e-5)
                        << what << ' ' << x << ',' << y << " channel " << c;
                }
                EXPECT_EQ(actual.w, 1.0);
            }
        }
        EXPECT_GT(brightest, 0.01) << what;
    }
    /// Where the view ray of a pixel meets the wall z = 0.
    static ReferencePoint pointAt(const View& view, const SceneMaterial& material, std::uint32_t x, std::uint32_t y) {
        const Camera& camera = *view.camera;
        const double aspect = double(view.width) / view.height;
        const glm::dvec2 ndc((x + 0.5) / view.width * 2 - 1, 1 - (y + 0.5) / view.height * 2);
        const glm::dmat4 toWorld = glm::inverse(glm::dmat4(camera.view));
        const double half = camera.orthographic ? 0.5 * camera.orthoHeight : std::tan(0.5 * camera.fovY);
        const glm::dvec3 offset(ndc.x * half * aspect, ndc.y * half, 0);
        const glm::dvec3 start = toWorld * glm::dvec4(camera.orthographic ? offset : glm::dvec3(0), 1);
        const glm::dvec3 ray =
            glm::dmat3(toWorld) *
            glm::normalize(glm::dvec3(camera.orthographic ? glm::dvec3(0) : offset) + glm::dvec3(0, 0, -1));
        ReferencePoint point;
        point.position = start + ray * (-start.z / ray.z);
        point.toViewer = -ray;
        point.baseColor = glm::dvec3(material.baseColor);
        point.metallic = material.metallic;
        point.roughness = material.roughness;
        return point;
    }
    static Camera slantedCamera() {
        Camera camera = Camera::lookAt({1.5f, 2, 4}, {0, 0, 0});
        camera.fovY = 0.6f;
        camera.near = 0.5f;
        camera.far = 20;
        return camera;
    }
};

TEST_F(Lighting, AWhiteWallThatFacesTheLightAndTheViewer) {
    Scene scene = wall();
    scene.lights = {directional({0, 0, -1}, 3)};
    renderer_->setScene(scene);
    load("deferred");
    const Image image = radiance(viewOf(frontCamera(), 4, 4));
    // Head-on F = 0.04; roughness 1: D = 1/pi, V = 1/4. The diffuse part gets what is not mirrored.
    const double expected = (0.96 + 0.04 / 4) / kReferencePi * 3;
    EXPECT_NEAR(image.at(1, 2).x, expected, expected * kHalfError);
}

TEST_F(Lighting, DirectionalLight) {
    Scene scene = wall();
    scene.lights = {directional({0.5f, -0.75f, -1}, 2.5f)};
    scene.lights[0].color = {1, 0.5f, 0.25f};
    expectReference(scene, slantedCamera());
}

TEST_F(Lighting, PointLightByInverseSquareAndRangeWindow) {
    Scene scene = wall();
    scene.lights = {pointLight({0.5f, 0.25f, 0.75f}, 4)};
    expectReference(scene, slantedCamera());
    scene.lights[0].range = 1.5f;
    expectReference(scene, frontCamera());
    // Beyond the range there is nothing at all.
    renderer_->setScene(scene);
    const Image image = radiance(viewOf(frontCamera(), 12, 8));
    EXPECT_EQ(image.at(0, 7).x, 0);
    EXPECT_GT(image.at(7, 3).x, 0.1f);
}

TEST_F(Lighting, SpotLightWithASoftCone) {
    Scene scene = wall();
    scene.lights = {spotLight({-0.5f, 0.5f, 2}, {0, 0, 0}, 10, 0.2f, 0.5f)};
    expectReference(scene, frontCamera());
    EXPECT_EQ(radiance(viewOf(frontCamera(), 12, 8)).at(11, 7).x, 0);
}

TEST_F(Lighting, TwentyFivePunctualAndThreeDirectionalLightsAllCount) {
    Scene scene = wall();
    for (int i = 0; i < 25; ++i) {
        const glm::vec3 position(float(i % 5) - 2, float(i / 5) - 2, 0.5f + 0.0625f * float(i));
        scene.lights.push_back(i % 2 ? spotLight(position, {0, 0, 0}, 0.5f, 0.1f, 1.2f) : pointLight(position, 0.25f));
        scene.lights.back().color = {0.25f * float(i % 4), 1, 0.125f * float(i % 7)};
    }
    for (const glm::vec3 direction : {glm::vec3(0, 0, -1), glm::vec3(1, 0, -1), glm::vec3(0, 1, -2)}) {
        scene.lights.push_back(directional(direction, 0.25f));
    }
    expectReference(scene, slantedCamera());
}

TEST_F(Lighting, EmissionIsAddedAndAmbientFollowsTheNormal) {
    for (const char* pipeline : {"deferred", "forward"}) {
        load(pipeline);
        Scene scene = wall();
        scene.lights = {directional({0, 0, -1}, 1)};
        renderer_->setScene(scene);
        const View view = viewOf(frontCamera(), 4, 4);
        const glm::vec4 lit = radiance(view).at(1, 1);
        scene.materials[0].emissive = {2, 0.5f, 0};
        renderer_->setScene(scene);
        const glm::vec4 glowing = radiance(view).at(1, 1);
        EXPECT_NEAR(glowing.x, lit.x + 2, 2 * kHalfError) << pipeline;
        EXPECT_NEAR(glowing.y, lit.y + 0.5f, kHalfError) << pipeline;
        EXPECT_EQ(glowing.z, lit.z) << pipeline;
        // A black dielectric keeps the reflection of 4 %; a vertical wall sees half sky, half ground.
        scene.lights.clear();
        scene.materials[0].emissive = {0, 0, 0};
        scene.ambient = Ambient{{1, 0, 2}, {0, 1, 2}};
        renderer_->setScene(scene);
        const glm::vec4 ambient = radiance(view).at(1, 1);
        EXPECT_EQ(ambient.x, ambient.y) << pipeline;
        EXPECT_NEAR(ambient.z, 4 * ambient.x, 4 * kHalfError) << pipeline;
        EXPECT_GT(ambient.x, 0.5f) << pipeline;
        EXPECT_LT(ambient.x, 0.55f) << pipeline;
    }
}

TEST_F(Lighting, FloorsSeeTheSkyAndCeilingsTheGround) {
    for (const float facing : {1.0f, -1.0f}) {
        Scene scene = darkScene();
        addObject(scene, makePlane(glm::vec2(20)),
                  glm::rotate(glm::mat4(1), facing > 0 ? 0.0f : 3.14159265f, {1, 0, 0}));
        scene.ambient = Ambient{{1, 0, 0}, {0, 1, 0}};
        Camera camera = Camera::lookAt({0, 5 * facing, 0}, {0, 0, 0}, {0, 0, -1});
        camera.near = 1;
        camera.far = 10;
        renderer_->setScene(scene);
        for (const char* pipeline : {"deferred", "forward"}) {
            load(pipeline);
            const glm::vec4 color = radiance(viewOf(camera, 4, 4)).at(1, 1);
            EXPECT_GT(facing > 0 ? color.x : color.y, 0.95f) << pipeline << facing;
            EXPECT_LT(facing > 0 ? color.y : color.x, 0.001f) << pipeline << facing;
        }
    }
}

TEST_F(Lighting, ForwardAndDeferredShowTheSamePicture) {
    for (const char* name : {"crease", "default"}) {
        renderer_->setScene(shippedScene(name));
        load("deferred", {{"fxaa", "false"}});
        const Image deferred = renderer_->render(sized(160, 90));
        load("forward");
        const Image forward = renderer_->render(sized(160, 90));
        EXPECT_LE(largestDifference(deferred, forward), 2.01f / 255) << name;
    }
}

class LightingFog : public Lighting {
protected:
    static double transmittance(const Fog& fog, double distance) {
        switch (fog.type) {
            case FogType::Linear:
                return std::clamp((double(fog.end) - distance) / (double(fog.end) - double(fog.start)), 0.0, 1.0);
            case FogType::Exp:
                return std::exp(-double(fog.density) * distance);
            case FogType::Exp2:
                return std::exp(-std::pow(double(fog.density) * distance, 2));
            case FogType::Layered:  // of Cocos' effects only
            case FogType::None:
                break;
        }
        return 1;
    }
};

TEST_F(LightingFog, EveryKindByTheLengthOfTheViewRay) {
    Scene scene = wall();
    scene.materials[0].emissive = {1, 1, 1};
    scene.materials[0].baseColor = {0, 0, 0, 1};
    for (const char* pipeline : {"deferred", "forward"}) {
        load(pipeline);
        for (const FogType type : {FogType::None, FogType::Linear, FogType::Exp, FogType::Exp2}) {
            scene.fog = {.type = type, .color = {0.25f, 0.5f, 3}, .start = 2, .end = 9, .density = 0.15f};
            renderer_->setScene(scene);
            for (const Camera& camera : {frontCamera(), slantedCamera()}) {
                const View view = viewOf(camera, 6, 4);
                const Image image = radiance(view);
                const glm::dvec3 eye(camera.position());
                for (std::uint32_t x = 0; x < 6; ++x) {
                    const glm::dvec3 position = pointAt(view, scene.materials[0], x, 1).position;
                    const double ray = camera.orthographic ? 5 : glm::length(position - eye);
                    const double share = transmittance(scene.fog, ray);
                    for (int c = 0; c < 3; ++c) {
                        const double expected = share + (1 - share) * double(scene.fog.color[c]);
                        EXPECT_NEAR(image.at(x, 1)[c], expected, expected * kHalfError) << pipeline << int(type);
                    }
                }
            }
        }
    }
}

TEST_F(LightingFog, FogLiesOverOcclusion) {
    Scene scene = shippedScene("crease");
    scene.fog = {.type = FogType::Linear, .color = {0.25f, 0.5f, 0.75f}, .start = 0, .end = 0.001f};
    renderer_->setScene(scene);
    load("ssao-deferred", {}, {{.path = "SsaoStage.material.radius", .value = "0.75"}});
    View view = sized(64, 36);
    view.keep = {"cc_ssaoBlurMap", "cc_lighting_resultMap", "viewDepth"};
    renderer_->render(view);
    const Image occlusion = renderer_->target("cc_ssaoBlurMap");
    const Image lit = renderer_->target("cc_lighting_resultMap");
    const Image depth = renderer_->target("viewDepth");
    float darkest = 1;
    for (std::uint32_t y = 0; y < 36; ++y) {
        for (std::uint32_t x = 0; x < 64; ++x) {
            if (depth.at(x, y).x > 1e8f) continue;
            darkest = std::min(darkest, occlusion.at(x, y).x);
            EXPECT_EQ(lit.at(x, y), glm::vec4(0.25f, 0.5f, 0.75f, 1)) << x << ',' << y;
        }
    }
    EXPECT_LT(darkest, 0.7f);
}

}  // namespace
}  // namespace crevice
