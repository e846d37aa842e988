// Materials as they are drawn: occlusion maps, cut-outs, two-sidedness, mirrored instances, and blending.
#include "FrameFixture.h"

namespace crevice {
namespace {

class MaterialDraw : public FrameTest {
protected:
    /// A 1 x 1 texture.
    static int addTexel(Scene& scene, const glm::u8vec4& texel, bool srgb = false) {
        SceneTexture texture;
        texture.image = Image(1, 1, srgb ? Format::RGBA8_SRGB : Format::RGBA8);
        for (int c = 0; c < 4; ++c) texture.image.pixels[std::size_t(c)] = static_cast<std::byte>(texel[c]);
        texture.srgb = srgb;
        scene.textures.push_back(texture);
        return static_cast<int>(scene.textures.size()) - 1;
    }
    static SceneMaterial glowing(const glm::vec3& radiance, float alpha, AlphaMode mode) {
        SceneMaterial material;
        material.baseColor = {0, 0, 0, alpha};
        material.metallic = 1;  // black metal reflects nothing: only the emission is seen
        material.emissive = radiance;
        material.alphaMode = mode;
        return material;
    }
};

TEST_F(MaterialDraw, OcclusionMapsDarkenAmbientLightOnly) {
    for (const char* pipeline : {"deferred", "forward"}) {
        Scene scene = darkScene();
        addWall(scene, 20);
        scene.lights = {directional({0, 0, -1}, 1)};
        const float direct = radianceOf(scene, pipeline).at(3, 3).x;
        scene.materials[0].occlusionMap.texture = addTexel(scene, {128, 0, 0, 255});
        EXPECT_EQ(radianceOf(scene, pipeline).at(3, 3).x, direct) << pipeline;

        scene.lights.clear();
        scene.ambient = Ambient{glm::vec3(1), glm::vec3(1)};
        for (const float strength : {1.0f, 0.5f, 0.0f}) {
            scene.materials[0].occlusionStrength = 0;
            const float open = radianceOf(scene, pipeline).at(3, 3).x;
            scene.materials[0].occlusionStrength = strength;
            const float share = 1 + strength * (128.0f / 255 - 1);
            // Roughness 1: reflections are occluded as much as the diffuse part.
            EXPECT_NEAR(radianceOf(scene, pipeline).at(3, 3).x, open * share, 3 * kHalfUnit * open) << pipeline;
        }
    }
}

TEST_F(MaterialDraw, TexturesMultiplyTheFactors) {
    for (const char* pipeline : {"deferred", "forward"}) {
        Scene scene = darkScene();
        addWall(scene, 20);
        scene.materials[0].emissive = {1, 2, 4};
        scene.materials[0].emissiveMap.texture = addTexel(scene, {255, 188, 0, 255}, true);
        const glm::vec4 color = radianceOf(scene, pipeline).at(3, 3);
        const float linear188 = std::pow((188.0f / 255 + 0.055f) / 1.055f, 2.4f);
        EXPECT_NEAR(color.x, 1, 2 * kHalfUnit) << pipeline;
        EXPECT_NEAR(color.y, 2 * linear188, 0.002f) << pipeline;
        EXPECT_EQ(color.z, 0) << pipeline;
    }
}

TEST_F(MaterialDraw, CutOutsKeepOrDropWholeFragments) {
    for (const char* pipeline : {"deferred", "forward"}) {
        for (const float alpha : {0.4f, 0.6f}) {
            Scene scene = darkScene();
            scene.materials[0] = glowing({1, 1, 1}, alpha, AlphaMode::Mask);
            scene.materials[0].alphaCutoff = 0.5f;
            addWall(scene, 20);
            const bool kept = alpha > 0.5f;
            EXPECT_EQ(radianceOf(scene, pipeline).at(3, 3), glm::vec4(kept ? 1.0f : 0.0f)) << pipeline << alpha;
        }
        // An opaque material ignores alpha.
        Scene scene = darkScene();
        scene.materials[0] = glowing({1, 1, 1}, 0.25f, AlphaMode::Opaque);
        addWall(scene, 20);
        EXPECT_EQ(radianceOf(scene, pipeline).at(3, 3), glm::vec4(1)) << pipeline;
    }
}

TEST_F(MaterialDraw, BackFacesAreHiddenOrLitWithTheReversedNormal) {
    // Slanted: a normal that is merely bent towards the viewer would be lit differently.
    const glm::mat4 slant = glm::rotate(glm::mat4(1), 0.6f, glm::vec3(0, 1, 0));
    const glm::mat4 away(glm::vec4(-1, 0, 0, 0), glm::vec4(0, 0, -1, 0), glm::vec4(0, -1, 0, 0), glm::vec4(0, 0, 0, 1));
    for (const char* pipeline : {"deferred", "forward"}) {
        Scene front = darkScene();
        addWall(front, 20);
        front.instances[0].world = slant * front.instances[0].world;
        front.lights = {directional({0.5f, 0, -1}, 2)};
        const Image expected = radianceOf(front, pipeline);
        EXPECT_GT(expected.at(3, 3).x, 0.1f);

        Scene back = darkScene();
        addObject(back, makePlane(glm::vec2(20)), slant * away);
        back.lights = front.lights;
        EXPECT_EQ(radianceOf(back, pipeline).at(3, 3), glm::vec4(0)) << pipeline;
        back.materials[0].doubleSided = true;
        EXPECT_LE(largestDifference(radianceOf(back, pipeline), expected), 2 * kHalfUnit) << pipeline;
    }
}

TEST_F(MaterialDraw, MirroredInstancesShowTheirOutside) {
    for (const char* pipeline : {"deferred", "forward"}) {
        std::vector<Image> images;
        for (const float mirror : {1.0f, -1.0f}) {
            Scene scene = darkScene();
            const glm::mat4 world =
                glm::scale(glm::rotate(glm::mat4(1), 0.5f, glm::vec3(0, 1, 0)), glm::vec3(mirror, 1, 1));
            addObject(scene, makeBox({1.5f, 1, 2}), world);
            scene.lights = {directional({-0.5f, -1, -1}, 2), pointLight({1, 1, 2}, 3)};
            images.push_back(radianceOf(scene, pipeline, 32));
        }
        // A box is its own mirror image; only the triangles' diagonals differ.
        EXPECT_LE(largestDifference(images[0], images[1]), 0.003f) << pipeline;
        EXPECT_GT(images[0].at(16, 16).x, 0.1f);
    }
}

TEST_F(MaterialDraw, OneBlendedQuadOverOpaque) {
    for (const char* pipeline : {"deferred", "forward"}) {
        Scene scene = darkScene();
        scene.materials = {glowing({0.5f, 2, 0}, 1, AlphaMode::Opaque), glowing({4, 1, 1}, 0.25f, AlphaMode::Blend)};
        addWall(scene, 20, {0, 0, 0}, 0);
        addWall(scene, 2, {0, 0, 1}, 1);
        const Image image = radianceOf(scene, pipeline);
        const glm::vec4 inside = image.at(3, 3);
        for (int c = 0; c < 3; ++c) {
            const float expected = 0.25f * scene.materials[1].emissive[c] + 0.75f * scene.materials[0].emissive[c];
            EXPECT_NEAR(inside[c], expected, 2 * kHalfUnit * expected) << pipeline;
        }
        EXPECT_NEAR(inside.w, 1, kHalfUnit) << pipeline;
        EXPECT_EQ(image.at(0, 0), glm::vec4(0.5f, 2, 0, 1)) << pipeline;
        // Behind the opaque wall it is hidden.
        scene.instances[1].world[3].z = -1;
        EXPECT_EQ(radianceOf(scene, pipeline).at(3, 3), glm::vec4(0.5f, 2, 0, 1)) << pipeline;
    }
}

TEST_F(MaterialDraw, BlendedOverNothingLeavesItsAlpha) {
    Scene scene = darkScene();
    scene.materials[0] = glowing({2, 2, 2}, 0.25f, AlphaMode::Blend);
    addWall(scene, 20);
    const glm::vec4 color = radianceOf(scene, "deferred").at(3, 3);
    EXPECT_NEAR(color.x, 0.5f, 2 * kHalfUnit);
    EXPECT_NEAR(color.w, 0.25f, kHalfUnit);
}

TEST_F(MaterialDraw, BlendedObjectsAreDrawnBackToFront) {
    for (const char* pipeline : {"deferred", "forward"}) {
        for (const bool nearFirst : {false, true}) {
            Scene scene = darkScene();
            scene.materials = {glowing({1, 0, 0}, 0.5f, AlphaMode::Blend), glowing({0, 1, 0}, 0.5f, AlphaMode::Blend)};
            addWall(scene, 4, {0, 0, nearFirst ? 1.0f : 0.0f}, nearFirst ? 0 : 1);
            addWall(scene, 4, {0, 0, nearFirst ? 0.0f : 1.0f}, nearFirst ? 1 : 0);
            const glm::vec4 color = radianceOf(scene, pipeline).at(3, 3);
            EXPECT_NEAR(color.x, 0.5f, kHalfUnit) << pipeline << nearFirst;   // the near red one
            EXPECT_NEAR(color.y, 0.25f, kHalfUnit) << pipeline << nearFirst;  // the far green one, half covered
        }
    }
}

}  // namespace
}  // namespace crevice
