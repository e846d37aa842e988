// gtao and vbao at quality=reference against scenes whose openness is known exactly: wall, corner, grooves and a bowl,
// all of the occluder on the screen, in both projections.
#include "AoHorizonFixture.h"

namespace crevice {
namespace {

constexpr double kPi = 3.14159265358979;
constexpr std::uint32_t kWidth = 160, kHeight = 120;
constexpr float kSeen = 4;  // world units that the frame is high; the radius is 1 but in the bowl

/// What a point should have, and the bin whose mean is compared.
struct Known {
    int bin = 0;
    double openness = 0;
};
using Formula = std::function<std::optional<Known>(const glm::vec3&)>;

/// Share of the hemisphere beside a wall at distance k radii: the wall's disc segment, over pi.
double cap(double k) { return k >= 1 ? 0 : (std::acos(k) - k * std::sqrt(1 - k * k)) / kPi; }

/// Two walls at k1 and k2; what both hide counts once.
double besideCorner(double k1, double k2) {
    double both = 0;
    if (k1 * k1 + k2 * k2 < 1)
        both =
            k1 * k2 + 0.5 * (std::acos(k2) - std::asin(k1) - k1 * std::sqrt(1 - k1 * k1) - k2 * std::sqrt(1 - k2 * k2));
    return 1 - (cap(k1) + cap(k2) - both / kPi);
}

/// Cosine-weighted share of a spherical cap: its axis at an angle alpha from the normal, half as wide as gamma.
double capShare(double alpha, double gamma) {
    const double c = std::cos(alpha), h = 1 / std::pow(std::sin(gamma), 2);
    if (c * c * h >= 1) return std::max(0.0, c) / h;
    const double k = std::sqrt(1 - h * c * c);
    const double inner = c * std::acos(-c * std::sqrt((h - 1) / (1 - c * c))) - k * std::sqrt(h - 1);
    return (inner / h + std::atan2(k, std::sqrt(h - 1))) / kPi;
}

/// A groove of interior angle alpha, at distance d radii from its edge.
double inGroove(double alpha, double d) {
    const double s = d * std::sin(alpha);
    return s >= 1 ? 1 : 1 - capShare(alpha, std::acos(s));
}

/// Two faces that meet in the z axis and open upwards.
Scene grooveScene(float alpha) {
    constexpr float kSize = 40;
    Scene scene = emptyScene();
    for (float side : {-1.0f, 1.0f}) {
        const glm::vec3 along(side * std::sin(alpha / 2), std::cos(alpha / 2), 0);
        const glm::vec3 normal(-side * std::cos(alpha / 2), std::sin(alpha / 2), 0);
        addSquare(scene, along * (kSize / 2), normal, kSize);
    }
    return scene;
}

constexpr float kRim = 0.70710678f;  // radius of the bowl's rim, and its depth below the middle of the sphere

/// The lowest part of a sphere of radius 1 whose middle is the origin. A whole half of it has walls at the rim that are
/// vertical: no picture from above resolves them (the last pixel's middle of 120 rows is .13 below the rim).
Scene bowlScene() {
    Scene scene = emptyScene();
    Mesh mesh = makeSphere(1, 128);  // the rim is a row of its vertices
    std::vector<std::uint32_t> lower;
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const bool above = std::any_of(mesh.indices.begin() + i, mesh.indices.begin() + i + 3,
                                       [&](std::uint32_t v) { return mesh.vertices[v].position.y > -kRim + 1e-4f; });
        if (!above) lower.insert(lower.end(), mesh.indices.begin() + i, mesh.indices.begin() + i + 3);
    }
    mesh.indices = std::move(lower);
    addObject(scene, std::move(mesh), glm::mat4(1));
    return scene;
}

struct Case {
    std::string technique;
    bool orthographic = false;
};

std::ostream& operator<<(std::ostream& out, const Case& c) {
    return out << c.technique << (c.orthographic ? " orthographic" : " perspective");
}

class AoHorizonExact : public AoHorizonTest, public testing::WithParamInterface<Case> {
protected:
    /// Means over bins of at least kEnough pixels, farther than the radius from the frame's border.
    void expectMeets(Scene scene, const glm::vec3& from, const glm::vec3& up, float seen, float radius,
                     float borderPixels, const Formula& formula) {
        constexpr int kEnough = 40;
        Options options{{"quality", "reference"}};
        // Thick things: the bitmask is then the same integral as the horizon's.
        if (GetParam().technique == "vbao") options["thickness"] = "4";
        loadSlices(GetParam().technique, radius, options);
        renderer_->setScene(std::move(scene));
        const View view = viewOf(cameraTowards(from, {0, 0, 0}, seen, GetParam().orthographic, up), kWidth, kHeight);
        const std::vector<Image> images = targets(view, {"cc_ssaoMap", "cc_gbuffer_positionMap", "viewDepth"});
        struct Mean {
            double error = 0;
            int count = 0;
        };
        std::map<int, Mean> bins;
        const auto border = static_cast<std::uint32_t>(borderPixels);
        for (std::uint32_t y = border; y < kHeight - border; ++y)
            for (std::uint32_t x = border; x < kWidth - border; ++x) {
                if (images[2].at(x, y).x > 1e8f) continue;
                const std::optional<Known> known = formula(glm::vec3(images[1].at(x, y)));
                if (!known) continue;
                bins[known->bin].error += double(images[0].at(x, y).x) - known->openness;
                ++bins[known->bin].count;
            }
        int compared = 0;
        for (const auto& [bin, mean] : bins) {
            if (mean.count < kEnough) continue;
            ++compared;
            EXPECT_NEAR(mean.error / mean.count, 0, 0.01) << "bin " << bin << " of " << mean.count << " pixels";
        }
        EXPECT_GE(compared, 3);
    }
    static constexpr float kRadiusPixels = kHeight / kSeen;
};

/// Bins of a tenth.
int tenth(double k) { return static_cast<int>(k * 10); }

TEST_P(AoHorizonExact, WallBesideFloor) {
    expectMeets(wallScene(), {1, 1, 0}, {0, 1, 0}, kSeen, 1, kRadiusPixels, [](const glm::vec3& p) {
        const double k = std::max(p.x, p.y);  // on the floor its x, on the wall its y
        return k < 0.04 ? std::nullopt : std::optional(Known{tenth(k), 1 - cap(k)});
    });
}

TEST_P(AoHorizonExact, CornerOfThreePlanes) {
    expectMeets(cornerScene(), {1, 1, 1}, {0, 1, 0}, kSeen, 1, kRadiusPixels, [](const glm::vec3& p) {
        double k[] = {p.x, p.y, p.z};
        std::sort(std::begin(k), std::end(k));
        if (k[1] < 0.06) return std::optional<Known>();
        return std::optional(Known{10 * tenth(k[1]) + std::min(tenth(k[2]), 9), besideCorner(k[1], k[2])});
    });
}

TEST_P(AoHorizonExact, GroovesOfThreeAngles) {
    for (double degrees : {60.0, 90.0, 120.0}) {
        SCOPED_TRACE(degrees);
        const double alpha = degrees * kPi / 180;
        // Its limit at the edge is sin^2 of half the angle.
        EXPECT_NEAR(inGroove(alpha, 1e-4), std::pow(std::sin(alpha / 2), 2), 1e-3);
        expectMeets(grooveScene(static_cast<float>(alpha)), {0, 1, 0}, {0, 0, -1}, kSeen, 1, kRadiusPixels,
                    [alpha](const glm::vec3& p) {
                        const double d = std::hypot(p.x, p.y);
                        return d < 0.06 ? std::nullopt : std::optional(Known{tenth(d), inGroove(alpha, d)});
                    });
    }
}

TEST_P(AoHorizonExact, SphericalBowl) {
    // Nothing is farther away than the rim is wide. What is open is the share of the sphere that is missing, the same
    // everywhere.
    constexpr double kOpen = (1 + kRim) / 2;
    expectMeets(bowlScene(), {0, 1, 0}, {0, 0, -1}, 2.2f * kRim, 2.02f * kRim, 0, [](const glm::vec3& p) {
        const double r = std::hypot(p.x, p.z);
        return r > 0.97 * kRim ? std::nullopt : std::optional(Known{tenth(r), kOpen});
    });
}

INSTANTIATE_TEST_SUITE_P(
    , AoHorizonExact, testing::Values(Case{"gtao", false}, Case{"gtao", true}, Case{"vbao", false}, Case{"vbao", true}),
    [](const auto& tested) {
        return tested.param.technique + (tested.param.orthographic ? "_orthographic" : "_perspective");
    });

}  // namespace
}  // namespace crevice
