// Scenes of spheres under environments that the test makes itself.
#pragma once

#include "FrameFixture.h"
#include "scene/EnvironmentCube.h"

namespace crevice {

class EnvironmentFrames : public FrameTest {
protected:
    /// `radiance(direction)` for every texel of a panorama.
    template <class Radiance>
    static Environment environmentOf(std::uint32_t height, Radiance radiance) {
        Image image(2 * height, height, Format::RGBA32F);
        for (std::uint32_t y = 0; y < height; ++y)
            for (std::uint32_t x = 0; x < 2 * height; ++x)
                *reinterpret_cast<glm::vec4*>(image.pixel(x, y)) =
                    glm::vec4(radiance(glm::vec3(equirectDirection(x, y, 2 * height, height))), 1);
        Environment environment = makeEnvironment(std::move(image), "test", Log(LogLevel::Error));
        environment.cube = cachedEnvironmentCube(environment.radiance, std::nullopt);
        return environment;
    }
    static Environment uniform(const glm::vec3& radiance) {
        return environmentOf(8, [&](const glm::vec3&) { return radiance; });
    }
    /// +X red, -X cyan, +Y green, -Y magenta, +Z blue, -Z yellow: whichever axis is nearest.
    static glm::vec3 axisColor(const glm::vec3& d) {
        const glm::vec3 a = glm::abs(d);
        if (a.x >= a.y && a.x >= a.z) return d.x > 0 ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 1);
        if (a.y >= a.z) return d.y > 0 ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 1);
        return d.z > 0 ? glm::vec3(0, 0, 1) : glm::vec3(1, 1, 0);
    }
    static Environment axes() { return environmentOf(128, axisColor); }

    /// White metals (upper row) and white dielectrics of roughness 0, 1/4 … 1, seen along -z; colours are factors.
    static Scene whiteSpheres() {
        Scene scene = darkScene();
        scene.materials.clear();
        for (int i = 0; i < 10; ++i) {
            SceneMaterial material;
            material.metallic = i < 5 ? 1 : 0;
            material.roughness = 0.25f * float(i % 5);
            scene.materials.push_back(material);
            addObject(scene, makeSphere(0.45f, 48),
                      glm::translate(glm::mat4(1), {float(i % 5) - 2, i < 5 ? 0.5f : -0.5f, 0}), i);
        }
        return scene;
    }
    /// One polished white metal sphere at the origin.
    static Scene mirrorSphere() {
        Scene scene = darkScene();
        scene.materials[0].metallic = 1;
        scene.materials[0].roughness = 0;
        addObject(scene, makeSphere(1, 128), glm::mat4(1));
        return scene;
    }
};

}  // namespace crevice
