// What tests of whole frames share: strictness about warnings, copies of shipped effects, small scenes with lights, and
// the pixel at which a point of the world is seen.
#pragma once

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "RenderFixture.h"

namespace crevice {

inline constexpr float kHalfUnit = 1.0f / 1024;  // stores into half floats may round down by one unit of 11 bits

class FrameTest : public RenderTest {
protected:
    FrameTest() : RenderTest(LogLevel::Warning) {}

    /// A copy of a shipped effect with one text replaced by another; fails when the text is not there.
    void copyEffect(const std::string& shipped, const std::string& name, const std::string& from,
                    const std::string& to) const {
        std::string text = readText(*AssetRoots::standard().find(AssetKind::Effect, shipped));
        const std::size_t at = text.find(from);
        ASSERT_NE(at, std::string::npos) << from;
        text.replace(at, from.size(), to);
        writeEffect(name, text);
    }
    Scene shippedScene(const std::string& name) const {
        return loadScene(*AssetRoots::standard().find(AssetKind::Scene, name), {log_});
    }

    /// Nothing but one material: dielectric, dull, white; exposure 1, no light at all.
    static Scene darkScene() {
        Scene scene;
        SceneMaterial material;
        material.metallic = 0;
        scene.materials.push_back(material);
        scene.exposureEv = std::log2(1.0f / 1.2f);
        return scene;
    }
    /// A square around `centre` that faces +z.
    static void addWall(Scene& scene, float size, const glm::vec3& centre = glm::vec3(0), int material = 0) {
        const glm::mat4 world(glm::vec4(1, 0, 0, 0), glm::vec4(0, 0, 1, 0), glm::vec4(0, -1, 0, 0),
                              glm::vec4(centre, 1));
        addObject(scene, makePlane(glm::vec2(size)), world, material);
    }
    static void addFloor(Scene& scene, float size, int material = 0) {
        addObject(scene, makePlane(glm::vec2(size)), glm::mat4(1), material);
    }
    static void addBlock(Scene& scene, const glm::vec3& centre, const glm::vec3& size, int material = 0) {
        addObject(scene, makeBox(size), translated(centre), material);
    }
    static Light directional(const glm::vec3& direction, float lux) {
        Light light;
        light.direction = glm::normalize(direction);
        light.intensity = lux;
        light.castsShadow = false;
        return light;
    }
    static Light pointLight(const glm::vec3& position, float candela, float range = 0) {
        Light light;
        light.type = LightType::Point;
        light.position = position;
        light.intensity = candela;
        light.range = range;
        light.castsShadow = false;
        return light;
    }
    static Light spotLight(const glm::vec3& position, const glm::vec3& target, float candela, float inner,
                           float outer) {
        Light light = pointLight(position, candela);
        light.type = LightType::Spot;
        light.direction = glm::normalize(target - position);
        light.innerAngle = inner;
        light.outerAngle = outer;
        return light;
    }

    /// Looks along -z at the wall z = 0 from z = 5; `height` world units are seen.
    static Camera frontCamera(float height = 4) {
        Camera camera = Camera::lookAt({0, 0, 5}, {0, 0, 0});
        camera.orthographic = true;
        camera.orthoHeight = height;
        camera.near = 0.5f;
        camera.far = 20;
        return camera;
    }
    static View sized(std::uint32_t width, std::uint32_t height) { return View{.width = width, .height = height}; }

    /// What the lighting wrote, in the scene's units.
    Image radiance(const View& view) { return target(view, "cc_lighting_resultMap"); }

    /// The radiance of a wall or what stands before it, seen by frontCamera().
    Image radianceOf(const Scene& scene, const std::string& pipeline, std::uint32_t size = 8) {
        renderer_->setScene(scene);
        load(pipeline);
        return radiance(viewOf(frontCamera(), size, size));
    }

    /// Pixel coordinates (fractions, y down) of a point in the world.
    static glm::vec2 pixelOf(const View& view, const glm::vec3& world) {
        const float aspect = static_cast<float>(view.width) / static_cast<float>(view.height);
        const glm::vec4 clip = view.camera->projection(aspect) * view.camera->view * glm::vec4(world, 1);
        return (glm::vec2(clip) / clip.w * 0.5f + 0.5f) * glm::vec2(view.width, view.height);
    }
    static glm::vec4 at(const Image& image, const View& view, const glm::vec3& world) {
        const glm::vec2 pixel = pixelOf(view, world);
        if (pixel.x < 0 || pixel.y < 0 || pixel.x >= float(image.width) || pixel.y >= float(image.height)) {
            ADD_FAILURE() << "not in the picture: " << world.x << ' ' << world.y << ' ' << world.z;
            return glm::vec4(NAN);
        }
        return image.at(static_cast<std::uint32_t>(pixel.x), static_cast<std::uint32_t>(pixel.y));
    }
};

/// Largest difference of two images' bytes.
inline int largestByteDifference(const Image& a, const Image& b) {
    int largest = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
        largest = std::max(largest, std::abs(std::to_integer<int>(a.pixels[i]) - std::to_integer<int>(b.pixels[i])));
    return largest;
}

/// Largest difference of two images of one size, in units of their format's values.
inline float largestDifference(const Image& a, const Image& b) {
    EXPECT_EQ(a.width, b.width);
    EXPECT_EQ(a.height, b.height);
    float largest = 0;
    for (std::uint32_t y = 0; y < a.height; ++y) {
        for (std::uint32_t x = 0; x < a.width; ++x) {
            const glm::vec4 d = glm::abs(a.at(x, y) - b.at(x, y));
            largest = std::max({largest, d.x, d.y, d.z, d.w});
        }
    }
    return largest;
}

}  // namespace crevice
