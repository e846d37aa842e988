// Falloffs: each is what its kernel's distances make of it, and a wall darkens as much as the technique tends to.
#include <set>

#include "TruthTools.h"
#include "core/Files.h"
#include "truth/Sampling.h"

namespace crevice::test {
namespace {

float rho(const char* name, double x) {
    const Falloff* falloff = findFalloff(name);
    EXPECT_NE(falloff, nullptr) << name;
    return falloff ? falloff->at(float(x)) : -1;
}

TEST(TruthFalloff, TheTableIsWhole) {
    std::set<std::string> names;
    for (const Falloff& falloff : allFalloffs()) {
        const std::string name = falloff.name;
        EXPECT_TRUE(names.insert(name).second) << name;
        EXPECT_EQ(findFalloff(name), &falloff);
        EXPECT_FALSE(std::string(falloff.doc).empty()) << name;
        EXPECT_FALSE(std::string(falloff.source).empty()) << name;
        EXPECT_FALSE(std::string(falloff.formula).empty()) << name;
        float last = 1;
        for (int i = 0; i < 400; ++i) {
            const float x = falloff.reach * float(i) / 400, value = falloff.at(x);
            EXPECT_LE(value, last + 1e-6f) << name << " at " << x;
            EXPECT_GE(value, -1e-6f) << name << " at " << x;
            last = value;
        }
        EXPECT_EQ(falloff.at(0), 1.0f) << name;
        EXPECT_EQ(falloff.at(falloff.reach), 0.0f) << name;
        EXPECT_EQ(falloff.at(INFINITY), 0.0f) << name;
    }
    for (const char* technique : {"crytek", "cocos", "learnopengl", "songjihu", "urp", "hbao", "gtao", "vbao"})
        EXPECT_EQ(names.count(std::string("matched:") + technique), 1u) << technique;
    EXPECT_EQ(findFalloff("soft"), nullptr);
    EXPECT_TRUE(hardFalloff().isHard());
}

TEST(TruthFalloff, TheDocumentNamesThemAll) {
    const std::string text = readText(CREVICE_TEST_SOURCE_DIR "/docs/reference.md");
    for (const Falloff& falloff : allFalloffs()) {
        std::string name = falloff.name;
        if (name.starts_with("matched:")) name.erase(0, std::string("matched:").size());
        EXPECT_NE(text.find("`" + name + "`"), std::string::npos) << name;
    }
}

/// Share of a kernel's distances r(u, v), u and v even in [0, 1), that exceed x.
template <class Distance>
double shareBeyond(double x, Distance&& distance) {
    constexpr int kSteps = 1500;
    int beyond = 0;
    for (int i = 0; i < kSteps; ++i)
        for (int k = 0; k < kSteps; ++k) beyond += distance((i + 0.5) / kSteps, (k + 0.5) / kSteps) > x;
    return double(beyond) / (double(kSteps) * kSteps);
}

TEST(TruthFalloff, KernelsDistancesMakeTheirFalloffs) {
    for (const double x : {0.005, 0.05, 0.1, 0.2, 0.35, 0.5, 0.8, 0.97}) {
        EXPECT_NEAR(rho("matched:learnopengl", x),
                    shareBeyond(x, [](double u, double v) { return v * (0.1 + 0.9 * u * u); }), 1e-3);
        EXPECT_NEAR(rho("matched:cocos", x), shareBeyond(x, [](double u, double) { return 0.1 + 0.9 * u * u; }), 1e-3);
        EXPECT_NEAR(rho("matched:songjihu", x), shareBeyond(x, [](double u, double) { return 0.01 + 0.99 * u * u; }),
                    1e-3);
        EXPECT_NEAR(rho("matched:cosine", x), shareBeyond(x, [](double, double) { return 1.0; }), 1e-3);
        EXPECT_NEAR(rho("matched:cosine-uniform", x), shareBeyond(x, [](double u, double) { return u; }), 1e-3);
        EXPECT_NEAR(rho("matched:cosine-sqrt", x), shareBeyond(x, [](double u, double) { return std::sqrt(u); }), 1e-3);
        EXPECT_NEAR(rho("matched:crytek", x), shareBeyond(x, [](double u, double) { return std::cbrt(u); }), 1e-3);
    }
    EXPECT_NEAR(rho("matched:learnopengl", 0.1), 0.584, 5e-4);
    EXPECT_NEAR(rho("matched:learnopengl", 0.2), 0.3576, 5e-4);
    EXPECT_NEAR(rho("matched:learnopengl", 0.3), 0.2349, 5e-4);
    EXPECT_NEAR(rho("matched:learnopengl", 0.5), 0.097, 5e-4);
    EXPECT_NEAR(rho("matched:cocos", 0.1), 1, 1e-6);
    EXPECT_NEAR(rho("matched:cocos", 0.325), 0.5, 1e-6);
    EXPECT_NEAR(rho("matched:songjihu", 0.01 + 0.99 / 4), 0.5, 1e-6);
    EXPECT_NEAR(rho("matched:hbao", 0.5), 0.75, 1e-6);
    EXPECT_EQ(rho("matched:xegtao", 0.56), 1.0f);  // (1 - .615) 1.457 = .561
    EXPECT_NEAR(rho("matched:xegtao", 1), 0.457 / (0.615 * 1.457), 1e-6);
    EXPECT_NEAR(rho("matched:urp", 0.25), 0.4, 1e-6);  // as 1/x
    for (const char* name : {"matched:gtao", "matched:vbao"}) EXPECT_TRUE(findFalloff(name)->isHard());
}

// Mean direction and spread of each law, by points that are even in the box itself.
TEST(TruthFalloff, DirectionLaws) {
    constexpr int kCount = 1 << 15;
    const auto moments = [&](DirectionLaw law) {
        glm::dvec3 sum(0), squares(0);
        for (std::uint32_t i = 0; i < kCount; ++i) {
            const glm::dvec3 d = sampleDirection(law, scrambledSobol(i, 5));
            EXPECT_NEAR(glm::length(d), 1, 1e-6);
            sum += d / double(kCount);
            squares += d * d / double(kCount);
        }
        EXPECT_NEAR(sum.x, 0, 1e-3);
        EXPECT_NEAR(sum.y, 0, 1e-3);
        EXPECT_NEAR(squares.x, squares.y, 1e-3);
        return glm::dvec2(sum.z, squares.z);
    };
    glm::dvec2 box(0);
    constexpr int kSteps = 80;
    for (int i = 0; i < kSteps; ++i) {
        for (int j = 0; j < kSteps; ++j) {
            for (int k = 0; k < kSteps; ++k) {
                const glm::dvec3 p(2 * (i + 0.5) / kSteps - 1, 2 * (j + 0.5) / kSteps - 1, (k + 0.5) / kSteps);
                const double z = p.z / glm::length(p);
                box += glm::dvec2(z, z * z) / std::pow(double(kSteps), 3);
            }
        }
    }
    EXPECT_NEAR(moments(DirectionLaw::Cosine).x, 2.0 / 3, 5e-4);
    EXPECT_NEAR(moments(DirectionLaw::Cosine).y, 0.5, 5e-4);
    EXPECT_NEAR(moments(DirectionLaw::Uniform).x, 0.5, 5e-4);
    EXPECT_NEAR(moments(DirectionLaw::Uniform).y, 1.0 / 3, 5e-4);
    EXPECT_NEAR(moments(DirectionLaw::Box).x, box.x, 5e-4);
    EXPECT_NEAR(moments(DirectionLaw::Box).y, box.y, 5e-4);
}

TEST(TruthFalloff, OpennessOfTheMean) {
    EXPECT_EQ(hardFalloff().openness(0.25), 0.75);
    EXPECT_EQ(findFalloff("matched:crytek-article")->openness(0), 0.5);
    EXPECT_NEAR(findFalloff("matched:crytek-article")->openness(0.5), 0.25, 1e-12);
    EXPECT_NEAR(findFalloff("matched:xegtao")->openness(0.5), std::pow(0.5, double(2.2f)), 1e-9);
    EXPECT_EQ(findFalloff("matched:urp")->openness(1), 0.0);  // clamped
    EXPECT_NEAR(findFalloff("matched:urp")->openness(0.02), 1 - std::pow(0.3, 0.6), 1e-6);
}

Scene wall() {
    Scene scene = whiteScene();
    addFloor(scene, 5);
    addWallX(scene, 0, 5, 5);
    return scene;
}

/// 1 - E[ρ(k/s)] over the directions of a box, s the sine towards a wall: the box turned to the wall, or to every side.
double boxLimit(const Falloff& falloff, double k, bool turned) {
    constexpr int kSteps = 40, kTurns = 120;
    double sum = 0;
    for (int i = 0; i < kSteps; ++i) {
        for (int j = 0; j < kSteps; ++j) {
            for (int l = 0; l < kSteps; ++l) {
                const glm::dvec3 p(2 * (i + 0.5) / kSteps - 1, 2 * (j + 0.5) / kSteps - 1, (l + 0.5) / kSteps);
                const double length = glm::length(p), across = std::hypot(p.x, p.y) / length;
                if (!turned) {
                    if (p.x > 0) sum += double(falloff.at(float(k * length / p.x)));
                    continue;
                }
                for (int turn = 0; turn < kTurns / 2; ++turn) {  // the other half of the turn looks away from the wall
                    const double sine = across * std::cos(glm::pi<double>() * ((turn + 0.5) / (kTurns / 2) - 0.5));
                    sum += double(falloff.at(float(k / sine))) / kTurns;
                }
            }
        }
    }
    return 1 - sum / std::pow(double(kSteps), 3);
}

// What the kernels tend to with infinitely many samples, at a distance k·R from an infinite wall. The limits as
// published are those of a box that is turned to the wall; kernels turn it at random.
TEST(TruthFalloff, LimitsAtAWall) {
    struct Limits {
        double k, hard, learnOpenGl, cocos, boxSqrt;
    };
    constexpr Limits kLimits[] = {{0.05, .532, .731, .585, .539},
                                  {0.1, .564, .834, .696, .578},
                                  {0.3, .688, .960, .875, .734},
                                  {0.5, .804, .991, .953, .874}};
    Falloff boxSqrt = *findFalloff("quadratic");
    boxSqrt.directions = DirectionLaw::Box;
    const Falloff* falloffs[] = {findFalloff("matched:learnopengl"), findFalloff("matched:cocos"), &boxSqrt};
    const Scene scene = wall();
    const RayScene rays(scene);
    AmbientSettings settings{.terms = {{1, &hardFalloff()}}, .samples = 1 << 14};
    for (const Falloff* falloff : falloffs) settings.terms.push_back({1, falloff});
    for (const Limits& limits : kLimits) {
        const auto point = pointAt({float(limits.k), 0, 0}, {0, 1, 0});
        const std::vector<Openness> traced = traceOpenness(rays, point, settings, 3);
        EXPECT_NEAR(traced[0].mean(), limits.hard, 1.5e-3) << limits.k;
        const double published[] = {limits.learnOpenGl, limits.cocos, limits.boxSqrt};
        for (std::size_t i = 0; i < 3; ++i) {
            EXPECT_NEAR(boxLimit(*falloffs[i], limits.k, false), published[i], 1.5e-3) << limits.k << " " << i;
            EXPECT_NEAR(traced[i + 1].mean(), boxLimit(*falloffs[i], limits.k, true), 1.5e-3) << limits.k << " " << i;
            EXPECT_NEAR(traced[i + 1].mean(), published[i], 0.015) << limits.k << " " << i;
        }
    }
}

// Any falloff over cosine directions at a wall: 1 - 2/π ∫ ρ(k/x) √(1 - x²) dx, x the sine towards the wall.
TEST(TruthFalloff, AnyCosineFalloffAtAWall) {
    const Scene scene = wall();
    const RayScene rays(scene);
    for (const Falloff& falloff : allFalloffs()) {
        if (falloff.directions != DirectionLaw::Cosine) continue;
        for (const double k : {0.1, 0.45, 1.2}) {
            double mean = 0;
            constexpr int kSteps = 20000;
            for (int i = 0; i < kSteps; ++i) {
                const double x = (i + 0.5) / kSteps;
                mean += 2 / glm::pi<double>() * double(falloff.at(float(k / x))) * std::sqrt(1 - x * x) / kSteps;
            }
            const AmbientSettings settings{.terms = {{1, &falloff}}, .samples = 1 << 14};
            const auto point = pointAt({float(k), 0, 0}, {0, 1, 0});
            EXPECT_NEAR(traceOpenness(rays, point, settings, 4).front().mean(), falloff.openness(mean), 2e-3)
                << falloff.name << " at " << k;
        }
    }
}

// Rays are shared: a map of a run with several terms is, to the bit, that of a run of its own.
TEST(TruthFalloff, OneRunGivesWhatManyGive) {
    const Scene scene = wall();
    const RayScene rays(scene);
    Camera camera = Camera::lookAt({0.5f, 10, 0}, {0.5f, 0, 0}, {0, 0, -1});
    camera.orthographic = true;
    camera.orthoHeight = 2;
    camera.near = 0.1f;
    camera.far = 50;
    AmbientSettings all{.terms = {}, .samples = 32};
    for (const float radius : {0.5f, 1.0f})
        for (const Falloff& falloff : allFalloffs()) all.terms.push_back({radius, &falloff});
    const AmbientMap together = traceAmbient(rays, camera, {16, 8}, all);
    ASSERT_EQ(together.layers.size(), 2 * allFalloffs().size());
    for (std::size_t i = 0; i < all.terms.size(); ++i) {
        AmbientSettings one = all;
        one.terms = {all.terms[i]};
        const AmbientMap alone = traceAmbient(rays, camera, {16, 8}, one);
        EXPECT_EQ(alone.layers[0].first, together.layers[i].first) << all.terms[i].falloff->name;
        EXPECT_EQ(alone.layers[0].second, together.layers[i].second) << all.terms[i].falloff->name;
        EXPECT_EQ(together.layers[i].term.radius, all.terms[i].radius);
        EXPECT_EQ(together.layers[i].term.falloff, all.terms[i].falloff);
    }
    EXPECT_NE(together.layers[0].openness, together.layers[allFalloffs().size()].openness) << "the radius does nothing";
}

}  // namespace
}  // namespace crevice::test
