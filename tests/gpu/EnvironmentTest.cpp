// Light from all around in finished frames: white furnace, mirrored directions, rotation, background, range.
#include "EnvironmentFixture.h"

namespace crevice {
namespace {

TEST_F(EnvironmentFrames, AWhiteSurfaceInAFurnaceCannotBeSeen) {
    Scene scene = whiteSpheres();
    scene.environment = uniform(glm::vec3(0.5f, 0.25f, 0.75f));
    const View view = viewOf(frontCamera(2), 160, 64);
    for (const char* pipeline : {"deferred", "forward"}) {
        load(pipeline);
        renderer_->setScene(scene);
        const Image image = radiance(view);
        float covered = 0;
        for (std::uint32_t y = 0; y < image.height; ++y) {
            for (std::uint32_t x = 0; x < image.width; ++x) {
                // Spheres and background alike, at every angle and roughness: 1/255 of the radiance.
                const glm::vec4 found = image.at(x, y);
                ASSERT_NEAR(found.r, 0.5f, 0.5f / 255) << pipeline << ' ' << x << ',' << y;
                ASSERT_NEAR(found.g, 0.25f, 0.25f / 255) << pipeline << ' ' << x << ',' << y;
                ASSERT_NEAR(found.b, 0.75f, 0.75f / 255) << pipeline << ' ' << x << ',' << y;
            }
        }
        // That the spheres are there at all: without the background they are what is covered.
        Scene hidden = scene;
        hidden.environment->visible = false;
        renderer_->setScene(hidden);
        const Image alone = radiance(view);
        for (std::uint32_t y = 0; y < alone.height; ++y)
            for (std::uint32_t x = 0; x < alone.width; ++x) covered += alone.at(x, y).a;
        EXPECT_NEAR(covered / (160 * 64), 0.636, 0.03) << pipeline;  // 10 pi 0.45² of 5 x 2
    }
}

TEST_F(EnvironmentFrames, ColouredSurfacesStayWithinTheirReflectance) {
    // A surface may not send back more than it receives; a metal at least what one reflection leaves it.
    Scene scene = whiteSpheres();
    for (SceneMaterial& material : scene.materials) material.baseColor = {0.8f, 0.5f, 0.2f, 1};
    scene.environment = uniform(glm::vec3(1));
    scene.environment->visible = false;
    load("deferred");
    renderer_->setScene(scene);
    const View view = viewOf(frontCamera(2), 160, 64);
    const Image image = radiance(view), table = makeBrdfTable();
    for (int i = 0; i < 10; ++i) {
        const glm::vec4 found = at(image, view, {float(i % 5) - 2, i < 5 ? 0.5f : -0.5f, 0.45f});
        const glm::vec3 base(0.8f, 0.5f, 0.2f);
        const glm::vec4 once = table.at(63, static_cast<std::uint32_t>(std::lround(0.25 * (i % 5) * 63)));
        for (int c = 0; c < 3; ++c) {
            // Seen straight Fresnel adds nothing to a metal; light between its facets is coloured again.
            const float least = i < 5 ? base[c] * once.r + once.g : base[c];
            const float most = i < 5 ? base[c] : 0.04f + 0.96f * base[c];
            EXPECT_GE(found[c], least - 0.01f) << i;
            EXPECT_LE(found[c], most + 0.01f) << i;
        }
    }
}

TEST_F(EnvironmentFrames, AMirrorShowsTheRightSides) {
    Scene scene = mirrorSphere();
    scene.environment = axes();
    load("deferred");
    const View view = viewOf(frontCamera(2.2f), 96, 96);
    // Where the sphere's normal lies between the viewer (+z) and a side, that side is mirrored.
    const float s = std::sqrt(0.5f);
    const std::pair<glm::vec3, glm::vec3> places[] = {{{s, 0, s}, {1, 0, 0}},
                                                      {{-s, 0, s}, {-1, 0, 0}},
                                                      {{0, s, s}, {0, 1, 0}},
                                                      {{0, -s, s}, {0, -1, 0}},
                                                      {{0, 0, 1}, {0, 0, 1}}};
    const auto expectColors = [&](const std::function<glm::vec3(const glm::vec3&)>& shown) {
        renderer_->setScene(scene);
        const Image image = radiance(view);
        for (const auto& [place, direction] : places) {
            const glm::vec3 found(at(image, view, place)), expected = axisColor(shown(direction));
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(found[c], expected[c], 0.03f) << direction.x << direction.y << direction.z;
        }
    };
    expectColors([](const glm::vec3& d) { return d; });
    // A quarter turn about +y brings what was at +z to +x, and what was at -x to +z.
    scene.environment->rotation = 1.57079633f;
    expectColors([](const glm::vec3& d) { return glm::vec3(-d.z, d.y, d.x); });
}

TEST_F(EnvironmentFrames, TheBackgroundIsTheEnvironmentBlurredOrHidden) {
    Scene scene = mirrorSphere();
    scene.environment = axes();
    scene.sky = {.enabled = true, .zenith = glm::vec3(7), .horizon = glm::vec3(7), .nadir = glm::vec3(7)};
    Camera camera = Camera::lookAt({0, 0, -10}, {0, 0, -20});  // the sphere is behind it
    camera.near = 0.1f;
    camera.far = 50;
    camera.fovY = 2.2f;  // 126°: the sides are in the frame as well
    const View view = viewOf(camera, 96, 64);
    load("deferred");
    const auto shown = [&](const glm::vec3& direction) {
        return glm::vec3(at(radiance(view), view, camera.position() + direction));
    };
    renderer_->setScene(scene);
    EXPECT_EQ(shown({0, 0, -1}), glm::vec3(1, 1, 0));
    EXPECT_EQ(shown({1.4f, 0, -1}), glm::vec3(1, 0, 0));
    EXPECT_EQ(shown({-1.4f, 0, -1}), glm::vec3(0, 1, 1));
    EXPECT_EQ(shown({0, 1.4f, -1}), glm::vec3(0, 1, 0));
    scene.environment->intensity = 4;
    renderer_->setScene(scene);
    EXPECT_EQ(shown({0, 0, -1}), glm::vec3(4, 4, 0));
    // Blurred, all six sides mix: blue and the others are in it.
    scene.environment->blur = 1;
    renderer_->setScene(scene);
    const glm::vec3 blurred = shown({0, 0, -1});
    EXPECT_LT(blurred.r, 3.9f);
    EXPECT_GT(blurred.b, 0.1f);
    // Hidden, the scene's own sky is there.
    scene.environment->visible = false;
    renderer_->setScene(scene);
    EXPECT_EQ(shown({0, 0, -1}), glm::vec3(7));
}

TEST_F(EnvironmentFrames, GreatRadianceStaysFinite) {
    Scene scene = mirrorSphere();
    scene.environment = uniform(glm::vec3(1e4f));
    load("deferred");
    renderer_->setScene(scene);
    const View view = viewOf(frontCamera(2.2f), 32, 32);
    EXPECT_NEAR(radiance(view).at(16, 16).g, 1e4f, 1e4f / 255);
    scene.environment->intensity = 1e6f;
    renderer_->setScene(scene);
    const Image image = radiance(view);
    for (std::uint32_t y = 0; y < image.height; ++y)
        for (std::uint32_t x = 0; x < image.width; ++x) ASSERT_TRUE(std::isfinite(image.at(x, y).g));
}

TEST_F(EnvironmentFrames, WithoutOneNothingOfItIsCompiled) {
    load("deferred");
    const auto readsCube = [&] {
        for (const StageProgram& stage : renderer_->pipeline().program().stages())
            for (const DrawProgram& draw : stage.draws)
                for (const ShaderResource& resource : draw.variant->info.resources)
                    if (resource.name == "cc_environment") return true;
        return false;
    };
    Scene scene = mirrorSphere();
    const View view = viewOf(frontCamera(2.2f), 16, 16);
    renderer_->setScene(scene);
    EXPECT_FALSE(readsCube());
    const Image dark = radiance(view);
    EXPECT_EQ(dark.at(8, 8), glm::vec4(0, 0, 0, 1));
    scene.environment = uniform(glm::vec3(1));
    renderer_->setScene(scene);
    EXPECT_TRUE(readsCube());
    EXPECT_NEAR(radiance(view).at(8, 8).r, 1, 1.0 / 255);
    // And back: the slots have let go of it.
    scene.environment.reset();
    renderer_->setScene(scene);
    EXPECT_FALSE(readsCube());
    EXPECT_EQ(radiance(view), dark);
}

TEST_F(EnvironmentFrames, AmbientLightGivesWay) {
    Scene scene = whiteSpheres();
    scene.ambient = Ambient{glm::vec3(9), glm::vec3(9)};
    scene.environment = uniform(glm::vec3(0.5f));
    load("deferred");
    renderer_->setScene(scene);
    const View view = viewOf(frontCamera(2), 160, 64);
    EXPECT_NEAR(at(radiance(view), view, {0, -0.5f, 0.45f}).r, 0.5f, 0.5f / 255);
}

}  // namespace
}  // namespace crevice
