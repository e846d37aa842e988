// The blurred cube: what its levels must hold, from integrals done another way; threads and cache change nothing.
#include "scene/EnvironmentCube.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "SceneTestTools.h"
#include "core/Files.h"
#include "scene/CubeFaces.h"

namespace crevice {
namespace {

constexpr double kPi = 3.14159265358979323846;

using Radiance = std::function<glm::dvec3(const glm::dvec3&)>;

Image panoramaOf(std::uint32_t height, const Radiance& radiance) {
    Image image(2 * height, height, Format::RGBA32F);
    for (std::uint32_t y = 0; y < height; ++y)
        for (std::uint32_t x = 0; x < 2 * height; ++x)
            *reinterpret_cast<glm::vec4*>(image.pixel(x, y)) =
                glm::vec4(glm::vec3(radiance(equirectDirection(x, y, 2 * height, height))), 1);
    return image;
}

template <class Visit>
void eachTexel(const EnvironmentCube& cube, std::size_t level, Visit visit) {
    const std::uint32_t size = cube.size >> level;
    for (std::uint32_t face = 0; face < kCubeFaces; ++face)
        for (std::uint32_t y = 0; y < size; ++y)
            for (std::uint32_t x = 0; x < size; ++x) {
                const glm::vec3 direction =
                    glm::normalize(cubeDirection(face, cubeCoordinate(float(x), size), cubeCoordinate(float(y), size)));
                visit(direction, glm::vec3(cube.levels[level][face].at(x, y)));
            }
}

TEST(EnvironmentCube, FacesFollowVulkan) {
    // Vulkan 1.3, 16.5.4 "Cube Map Face Selection": for +X, s = -z and t = -y, and so on.
    EXPECT_EQ(cubeDirection(0, 0.5f, 0.25f), glm::vec3(1, -0.25f, -0.5f));
    EXPECT_EQ(cubeDirection(1, 0.5f, 0.25f), glm::vec3(-1, -0.25f, 0.5f));
    EXPECT_EQ(cubeDirection(2, 0.5f, 0.25f), glm::vec3(0.5f, 1, 0.25f));
    EXPECT_EQ(cubeDirection(3, 0.5f, 0.25f), glm::vec3(0.5f, -1, -0.25f));
    EXPECT_EQ(cubeDirection(4, 0.5f, 0.25f), glm::vec3(0.5f, -0.25f, 1));
    EXPECT_EQ(cubeDirection(5, 0.5f, 0.25f), glm::vec3(-0.5f, -0.25f, -1));
    for (std::uint32_t face = 0; face < kCubeFaces; ++face) {
        const CubePoint point = cubePoint(3.0f * cubeDirection(face, 0.5f, -0.25f));
        EXPECT_EQ(point.face, face);
        EXPECT_FLOAT_EQ(point.s, 0.5f);
        EXPECT_FLOAT_EQ(point.t, -0.25f);
    }
}

TEST(EnvironmentCube, TheFirstLevelIsTheEnvironment) {
    const auto radiance = [](const glm::dvec3& d) { return glm::dvec3(1 + 0.5 * d.x, 1 + 0.5 * d.y, 100 + 50 * d.z); };
    const EnvironmentCube cube = filterEnvironment(panoramaOf(128, radiance));
    EXPECT_EQ(cube.size, 128u);
    EXPECT_EQ(cube.levels.size(), 5u);  // 128, 64, 32, 16, 8
    eachTexel(cube, 0, [&](const glm::vec3& direction, const glm::vec3& found) {
        const glm::dvec3 expected = radiance(direction);
        // Halves are right to 1/2048, the mean of four places and the bilinear texels to as much again.
        for (int c = 0; c < 3; ++c) ASSERT_NEAR(found[c], expected[c], expected[c] * 1e-3) << direction.x;
    });
}

/// What a level keeps of the variation of L = 1 + a·d: the mean of cos over the lobe, in double precision on a fine
/// grid.
double lobeMean(double roughness) {
    const double alpha2 = std::pow(roughness, 4);
    double sum = 0, weights = 0;
    constexpr int kSteps = 200000;
    for (int i = 0; i < kSteps; ++i) {
        const double angle = kPi / 4 * (i + 0.5) / kSteps, c = std::cos(angle), mirrored = std::cos(2 * angle);
        const double d = alpha2 / std::pow(c * c * (alpha2 - 1) + 1, 2);
        const double weight = d * c * std::sin(angle) * mirrored;
        sum += weight * mirrored;
        weights += weight;
    }
    return sum / weights;
}

TEST(EnvironmentCube, EachLevelIsTheLobeOfItsRoughnessAtEveryTexel) {
    const glm::dvec3 a(0.6, -0.5, 0.3);
    const auto radiance = [&](const glm::dvec3& d) { return glm::dvec3(1 + glm::dot(a, d)); };
    const EnvironmentCube cube = filterEnvironment(panoramaOf(128, radiance));
    const double roughnesses[] = {0, 1 - std::sqrt(0.75), 1 - std::sqrt(0.5), 0.5, 1};
    for (std::size_t level = 1; level < cube.levels.size(); ++level) {
        EXPECT_NEAR(environmentRoughness(float(level) / 4), roughnesses[level], 1e-6);
        const double kept = lobeMean(roughnesses[level]);
        double worst = 0;
        eachTexel(cube, level, [&](const glm::vec3& direction, const glm::vec3& found) {
            const double expected = 1 + kept * glm::dot(a, glm::dvec3(direction));
            worst = std::max(worst, std::abs(found.x - expected));
        });
        EXPECT_LT(worst, 0.02) << "level " << level << " of lobe " << kept;
    }
}

TEST(EnvironmentCube, AUniformEnvironmentStaysItself) {
    const EnvironmentCube cube =
        filterEnvironment(panoramaOf(16, [](const glm::dvec3&) { return glm::dvec3(0.25, 1, 1e4); }));
    for (std::size_t level = 0; level < cube.levels.size(); ++level)
        eachTexel(cube, level, [&](const glm::vec3&, const glm::vec3& found) {
            ASSERT_NEAR(found.x, 0.25, 0.25 / 2048) << level;
            ASSERT_NEAR(found.y, 1, 1.0 / 2048) << level;
            ASSERT_NEAR(found.z, 1e4, 8) << level;
        });
}

TEST(EnvironmentCube, BrighterThanAHalfIsTheLargestHalf) {
    const EnvironmentCube cube =
        filterEnvironment(panoramaOf(16, [](const glm::dvec3& d) { return glm::dvec3(d.y > 0 ? 1e8 : 1); }));
    for (std::size_t level = 0; level < cube.levels.size(); ++level)
        eachTexel(cube, level, [&](const glm::vec3&, const glm::vec3& found) { ASSERT_LE(found.x, 65504.0f); });
    EXPECT_EQ(cube.levels[0][2].at(64, 64).x, 65504.0f);
}

TEST(EnvironmentCube, ASmallBrightTexelKeepsItsLight) {
    for (const auto& [tx, ty] : {std::pair{40u, 20u}, std::pair{255u, 64u}, std::pair{9u, 3u}}) {
        Image image = panoramaOf(128, [](const glm::dvec3&) { return glm::dvec3(0); });
        *reinterpret_cast<glm::vec4*>(image.pixel(tx, ty)) = glm::vec4(1000, 1000, 1000, 1);
        const double sent = 1000 * (std::cos(kPi * ty / 128) - std::cos(kPi * (ty + 1) / 128)) * 2 * kPi / 256;
        const EnvironmentCube cube = filterEnvironment(image);
        for (const std::size_t level : {0u, 2u, 3u}) {
            const double cell = 2.0 / (cube.size >> level);
            double received = 0;
            eachTexel(cube, level, [&](const glm::vec3& d, const glm::vec3& found) {
                // Solid angle of a texel: cell² / |p|³ with p on the cube of half side 1, where the largest component
                // is 1.
                const double largest = std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)});
                received += found.x * cell * cell * std::pow(largest, 3);
            });
            EXPECT_NEAR(received / sent, 1, 0.12) << "level " << level << " texel " << tx << ',' << ty;
        }
    }
}

TEST(EnvironmentCube, LargePanoramasShrinkWithoutASeam) {
    // Wider than 4 x 512 and no multiple of it.
    const EnvironmentCube cube = filterEnvironment(
        panoramaOf(1050, [](const glm::dvec3& d) { return glm::dvec3(1 + d.x, d.y > 0 ? 1 : 0, 2); }));
    ASSERT_EQ(cube.size, 512u);
    eachTexel(cube, 0, [&](const glm::vec3& d, const glm::vec3& found) {
        ASSERT_NEAR(found.x, 1 + d.x, 4e-3) << d.x << ' ' << d.y << ' ' << d.z;
        if (std::abs(d.y) > 0.01f) {
            ASSERT_NEAR(found.y, d.y > 0 ? 1 : 0, 1e-3);
        }
        ASSERT_NEAR(found.z, 2, 1e-3);
    });
}

Image smallPanorama() {
    return panoramaOf(16, [](const glm::dvec3& d) { return glm::dvec3(1 + d.x, 3 + d.y * d.z, d.z > 0.5 ? 50 : 0.1); });
}

bool same(const EnvironmentCube& a, const EnvironmentCube& b) {
    return a.size == b.size && a.levels == b.levels && a.brdf == b.brdf;
}

TEST(EnvironmentCube, TheSameBitsWhateverTheThreads) {
    const EnvironmentCube one = filterEnvironment(smallPanorama(), 1);
    EXPECT_TRUE(same(filterEnvironment(smallPanorama(), 2), one));
    EXPECT_TRUE(same(filterEnvironment(smallPanorama(), 5), one));
}

TEST(EnvironmentCube, TheCacheIsByContentAndADamagedFileIsMadeAgain) {
    const test::TempFolder folder;
    const Image panorama = smallPanorama();
    const auto made = cachedEnvironmentCube(panorama, folder.path());
    EXPECT_TRUE(same(*made, filterEnvironment(panorama)));
    const std::filesystem::path file = folder.path() / (environmentKey(panorama) + ".cube");
    ASSERT_TRUE(std::filesystem::is_regular_file(file));
    const std::string whole = readText(file);

    // What a valid file says is believed, which shows that it is read.
    EXPECT_TRUE(same(*cachedEnvironmentCube(panorama, folder.path()), *made));
    for (std::string damaged : {whole.substr(0, whole.size() / 2), std::string("nonsense"), std::string()}) {
        writeFileAtomically(file, damaged);
        EXPECT_TRUE(same(*cachedEnvironmentCube(panorama, folder.path()), *made));
        EXPECT_EQ(readText(file), whole);
    }
    std::string flipped = whole;
    flipped[whole.size() / 2] ^= 1;
    writeFileAtomically(file, flipped);
    EXPECT_TRUE(same(*cachedEnvironmentCube(panorama, folder.path()), *made));

    Image other = panorama;
    *reinterpret_cast<float*>(other.pixel(3, 3)) += 1;
    EXPECT_NE(environmentKey(other), environmentKey(panorama));
    // A folder that cannot be made is no error.
    EXPECT_TRUE(same(*cachedEnvironmentCube(panorama, file / "below-a-file"), *made));
}

/// F0 factor and addend by a fine grid over light directions: no sampling of the lobe, no Hammersley points.
glm::dvec2 reflectanceByGrid(double nDotV, double roughness) {
    const double alpha2 = std::pow(roughness, 4);
    const glm::dvec3 v(std::sqrt(1 - nDotV * nDotV), 0, nDotV);
    constexpr int kPolar = 600, kAround = 1200;
    glm::dvec2 sum(0);
    for (int i = 0; i < kPolar; ++i) {
        const double polar = kPi / 2 * (i + 0.5) / kPolar, nDotL = std::cos(polar);
        for (int j = 0; j < kAround; ++j) {
            const double around = 2 * kPi * (j + 0.5) / kAround;
            const glm::dvec3 l(std::sin(polar) * std::cos(around), std::sin(polar) * std::sin(around), nDotL);
            const glm::dvec3 h = glm::normalize(v + l);
            const double d = alpha2 / (kPi * std::pow(h.z * h.z * (alpha2 - 1) + 1, 2));
            const double fromView = nDotL * std::sqrt(nDotV * nDotV * (1 - alpha2) + alpha2);
            const double fromLight = nDotV * std::sqrt(nDotL * nDotL * (1 - alpha2) + alpha2);
            const double share = d * 0.5 / (fromView + fromLight) * nDotL * std::sin(polar);
            const double grazing = std::pow(1 - glm::dot(v, h), 5);
            sum += glm::dvec2(1 - grazing, grazing) * share;
        }
    }
    return sum * (kPi / 2 / kPolar) * (2 * kPi / kAround);
}

TEST(EnvironmentCube, TheReflectanceTableIsTheIntegralOfTheModel) {
    const Image table = makeBrdfTable();
    for (const std::uint32_t x : {9u, 32u, 63u}) {
        for (const std::uint32_t y : {22u, 40u, 63u}) {
            const glm::dvec2 expected = reflectanceByGrid(x / 63.0, y / 63.0);
            EXPECT_NEAR(table.at(x, y).r, expected.x, 0.01) << x << ' ' << y;
            EXPECT_NEAR(table.at(x, y).g, expected.y, 0.01) << x << ' ' << y;
        }
    }
    // A polished mirror loses nothing, whatever the angle but the grazing ones.
    for (const std::uint32_t x : {20u, 40u, 63u}) EXPECT_NEAR(table.at(x, 0).r + table.at(x, 0).g, 1, 0.01);
    for (std::uint32_t y = 0; y < 64; ++y)
        for (std::uint32_t x = 0; x < 64; ++x) EXPECT_LE(table.at(x, y).r + table.at(x, y).g, 1.01f) << x << ' ' << y;
}

}  // namespace
}  // namespace crevice
