// A kernel whose points lie at random distances r of distribution F amounts, before thick occluders, to the falloff
// 1 - F(t/R): a point is inside the solid when its distance is beyond the surface's.
#include "truth/Falloff.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace crevice {
namespace {

float linear(float x) { return 1 - x; }
float quadratic(float x) { return 1 - x * x; }
float cubic(float x) { return 1 - x * x * x; }

/// r = low + (1 - low) u², u uniform: 1 - F = 1 - √((x - low) / (1 - low)).
float squaredLadder(float x, float low) { return x <= low ? 1 : 1 - std::sqrt((x - low) / (1 - low)); }
float cocos(float x) { return squaredLadder(x, 0.1f); }
float songjihu(float x) { return squaredLadder(x, 0.01f); }

/// r = v (.1 + .9 u²), u and v uniform: 1 - F = ∫ max(0, 1 - x / (.1 + .9 u²)) du, from u₀ on where that is above 0.
float learnOpenGl(float x) {
    const float start = x <= 0.1f ? 0 : std::sqrt((x - 0.1f) / 0.9f);
    return (1 - start) - x / 0.3f * (std::atan(3.0f) - std::atan(3 * start));  // √(.1 · .9) = .3, √(.9 / .1) = 3
}

constexpr float kXeReach = 1.457f, kXeFade = 0.615f;
float xeGtao(float x) { return std::min(1.0f, (kXeReach - x) / (kXeFade * kXeReach)); }

constexpr float kUrpNearest = 0.1f, kUrpIntensity = 3;
float urp(float x) { return kUrpNearest / std::max(x, kUrpNearest); }

constexpr const char* kLearnOpenGl = "LearnOpenGL, SSAO (after J. Chapman): r = U·lerp(.1, 1, (i/64)²)";
constexpr const char* kCocosKernel = "Cocos Creator 3.3 SSAO article: r = lerp(.1, 1, (i/64)²)";
constexpr const char* kCrytek = "M. Mittring: Finding Next Gen - CryEngine 2, 2007";
constexpr const char* kCosineKernel = "1 - F(x) of the distances r of a cosine-weighted kernel";

constexpr auto kCosine = DirectionLaw::Cosine, kUniform = DirectionLaw::Uniform, kBox = DirectionLaw::Box;

constexpr std::array kFalloffs = {
    Falloff{.doc = "What is nearer than R occludes; techniques are ranked by it",
            .source = "Ambient occlusion with a limit of distance; the reference of XeGTAO"},
    Falloff{.name = "linear", .weight = linear, .formula = "1 - x", .doc = "Fades evenly", .source = "Obscurance"},
    Falloff{.name = "quadratic",
            .weight = quadratic,
            .formula = "1 - x²",
            .doc = "Fades late",
            .source = "Weight of HBAO and ASSAO"},
    Falloff{.name = "matched:cosine", .doc = "Kernel of cosine directions, r = R", .source = kCosineKernel},
    Falloff{.name = "matched:cosine-uniform",
            .weight = linear,
            .formula = "1 - x",
            .doc = "Kernel of cosine directions, r = R·ξ",
            .source = kCosineKernel},
    Falloff{.name = "matched:cosine-sqrt",
            .weight = quadratic,
            .formula = "1 - x²",
            .doc = "Kernel of cosine directions, r = R·√ξ",
            .source = kCosineKernel},
    Falloff{.name = "matched:crytek",
            .weight = cubic,
            .directions = kUniform,
            .formula = "1 - x³",
            .doc = "Points of the half of a ball that is above the surface",
            .source = kCrytek},
    Falloff{.name = "matched:crytek-article",
            .weight = cubic,
            .directions = kUniform,
            .base = 0.5f,
            .strength = 0.5f,
            .formula = "1 - x³",
            .doc = "Points of a whole ball: half of them lie below a flat surface",
            .source = kCrytek},
    Falloff{.name = "matched:cocos",
            .weight = cocos,
            .directions = kBox,
            .formula = "1 below .1, then 1 - √((x - .1)/.9)",
            .doc = "Kernel of the article",
            .source = kCocosKernel},
    Falloff{.name = "matched:learnopengl",
            .weight = learnOpenGl,
            .directions = kBox,
            .formula = "(1 - u) - x/.3 (atan 3 - atan 3u), u = √(max(0, x - .1)/.9)",
            .doc = "Kernel of the article",
            .source = kLearnOpenGl},
    Falloff{.name = "matched:songjihu",
            .weight = songjihu,
            .directions = kBox,
            .formula = "1 below .01, then 1 - √((x - .01)/.99)",
            .doc = "Kernel of the article, its depth test put right; without its weight against the view axis",
            .source = "songjihu, SSAO in Unity: r = lerp(.01, 1, (i/N)²)"},
    Falloff{.name = "matched:urp",
            .weight = urp,
            .strength = 0.5f * kUrpIntensity / kUrpNearest,
            .occlusionPower = 0.6f,
            .formula = "min(1, .1/x)",
            .doc = "Obscurance (n·d)/|d| with intensity 3 and contrast .6; approximate: its points lie behind the "
                   "samples, not along them",
            .source = "M. McGuire et al.: The Alchemy Screen-Space Ambient Obscurance Algorithm, 2011; constants of "
                      "Unity's URP"},
    Falloff{.name = "matched:hbao",
            .weight = quadratic,
            .directions = kUniform,
            .formula = "1 - x²",
            .doc = "Horizons weighted by solid angle, without their bias",
            .source = "L. Bavoil, M. Sainz: Screen Space Ambient Occlusion, 2008"},
    Falloff{.name = "matched:gtao",
            .doc = "Samples beyond R are ignored",
            .source = "J. Jimenez et al.: Practical Realtime Strategies for Accurate Indirect Occlusion, 2016"},
    Falloff{.name = "matched:vbao",
            .doc = "Cosine-correct bits, hard at R",
            .source = "O. Therrien et al.: Screen Space Indirect Lighting with Visibility Bitmask, 2023"},
    Falloff{.name = "matched:xegtao",
            .weight = xeGtao,
            .reach = kXeReach,
            .power = 2.2f,
            .formula = "min(1, (1.457 - x)/(.615·1.457)) up to 1.457",
            .doc = "As shipped: radius times 1.457, fading over its last .615, power 2.2",
            .source = "Intel XeGTAO, default settings"},
};

}  // namespace

double Falloff::openness(double meanWeight) const {
    double occlusion = std::min(1.0, double(base) + double(strength) * meanWeight);
    if (occlusionPower != 1) occlusion = std::pow(occlusion, double(occlusionPower));
    return power == 1 ? 1 - occlusion : std::pow(1 - occlusion, double(power));
}

std::span<const Falloff> allFalloffs() { return kFalloffs; }

const Falloff* findFalloff(std::string_view name) {
    const auto found =
        std::find_if(kFalloffs.begin(), kFalloffs.end(), [&](const Falloff& f) { return f.name == name; });
    return found == kFalloffs.end() ? nullptr : &*found;
}

const Falloff& hardFalloff() { return kFalloffs.front(); }

std::vector<std::string> falloffNames() {
    std::vector<std::string> names;
    for (const Falloff& falloff : kFalloffs) names.emplace_back(falloff.name);
    return names;
}

}  // namespace crevice
