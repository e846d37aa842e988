// How an occlusion map meets light from all around: each part by the formula of docs/ao/light.md.
#include "AoLightingFixture.h"
#include "scene/EnvironmentCube.h"

namespace crevice {
namespace {

class EnvironmentAo : public AoLightingOptions {
protected:
    /// A white dielectric that faces the viewer, under radiance 1 from everywhere.
    Scene litPlane(float metallic, float roughness) {
        Scene scene = facingPlane(glm::vec3(1), metallic, roughness);
        scene.ambient.reset();
        Image image(16, 8, Format::RGBA32F);
        for (std::size_t i = 0; i < 16 * 8; ++i) reinterpret_cast<glm::vec4*>(image.pixels.data())[i] = glm::vec4(1);
        scene.environment = makeEnvironment(std::move(image), "white", Log(LogLevel::Error));
        return scene;
    }
    /// Share that is reflected once, seen straight: the table's last column.
    static double mirroredShare(double f0, float roughness) {
        static const Image table = makeBrdfTable();
        const glm::vec4 found = table.at(63, static_cast<std::uint32_t>(std::lround(roughness * 63)));
        return f0 * found.r + found.g;
    }
    double center(const Scene& scene, const Options& options) {
        return double(lit(scene, options).at(kWidth / 2, kHeight / 2).g);
    }
};

// Rows of the table at whole texels: 21 / 63 and 63 / 63.
constexpr float kSmooth = 1.0f / 3;

TEST_F(EnvironmentAo, DiffuseLightIsScaledAndReflectionsFollowTheirFormula) {
    const double a = 0.4;
    setOpenness(40);
    for (const float roughness : {kSmooth, 1.0f}) {
        const Scene plane = litPlane(0, roughness);
        const double mirrored = mirroredShare(0.04, roughness), scattered = 1 - mirrored;
        const double byLagarde = std::clamp(std::pow(1 + a, std::exp2(-16 * roughness - 1)) - 1 + a, 0.0, 1.0);
        const double byCone = std::min(1.0, (1 - std::sqrt(1 - a)) / (1 - std::exp2(-3.32193 * roughness * roughness)));
        EXPECT_NEAR(center(plane, {{"specularOcclusion", "off"}}), scattered * a + mirrored, 1e-3) << roughness;
        EXPECT_NEAR(center(plane, {{"specularOcclusion", "lagarde"}}), scattered * a + mirrored * byLagarde, 1e-3);
        EXPECT_NEAR(center(plane, {{"specularOcclusion", "cone"}}), scattered * a + mirrored * byCone, 1e-3);
        // White light bounces to and fro: the cubic of Jimenez et al. 2016 at albedo 1.
        const double bounced = ((1.708 * a - 4.1534) * a + 3.4455) * a;
        EXPECT_NEAR(center(plane, {{"specularOcclusion", "off"}, {"multiBounce", "true"}}),
                    scattered * bounced + mirrored, 1e-3);
    }
}

TEST_F(EnvironmentAo, AnOpenSurfaceIsUntouchedAndEmissionStays) {
    setOpenness(100);
    EXPECT_NEAR(center(litPlane(0, 1), {}), 1, 1.0 / 255);
    EXPECT_NEAR(center(litPlane(1, kSmooth), {{"specularOcclusion", "cone"}}), 1, 1.0 / 255);
    setOpenness(0);
    Scene glowing = litPlane(0, 1);
    glowing.materials[0].emissive = glm::vec3(0.25f);
    EXPECT_NEAR(center(glowing, {{"specularOcclusion", "cone"}}), 0.25, 1e-3);
}

TEST_F(EnvironmentAo, BentNormalsTurnTheDiffuseLookUp) {
    // Bright above, dark below. Even columns have the bent normal (0.6, 0.8, 0), odd ones that of the plane, +z.
    Scene plane = litPlane(0, 1);
    Image image(64, 32, Format::RGBA32F);
    for (std::uint32_t y = 0; y < 32; ++y)
        for (std::uint32_t x = 0; x < 64; ++x)
            *reinterpret_cast<glm::vec4*>(image.pixel(x, y)) = glm::vec4(glm::vec3(y < 16 ? 2 : 0), 1);
    plane.environment = makeEnvironment(std::move(image), "half", Log(LogLevel::Error));
    setOpenness(100);
    setBentNormal(true);
    const Image image2 = lit(plane, {{"specularOcclusion", "off"}});
    const double difference = image2.at(20, 20).g - image2.at(21, 20).g;
    const double scattered = 1 - mirroredShare(0.04, 1);
    // Order 2 of a half space of radiance 2 is 1 + 3/2 y · 2/3 = 1 + y: worked by hand from equation 8.
    EXPECT_NEAR(difference, scattered * 0.8, 5e-3);
}

}  // namespace
}  // namespace crevice
