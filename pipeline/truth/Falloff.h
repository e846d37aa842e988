// Falloffs: how much a surface at a distance occludes. Those that techniques amount to are data in one table, so that
// each technique can be measured by its own definition as well as by the hard one. docs/reference.md lists them.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace crevice {

/// How directions weigh around the normal n. Every law is a density over the hemisphere, the same all around n.
enum class DirectionLaw : std::uint8_t {
    Cosine,   ///< (n·ω)/π: what a diffuse surface receives
    Uniform,  ///< 1/2π
    Box       ///< That of a uniform point in [-1,1]² × [0,1], averaged around n: kernels that normalise random boxes
};

/// Openness = (1 - min(1, base + strength · E[ρ(t/R)])^occlusionPower)^power, E over the directions of the law, t the
/// distance of the first surface.
struct Falloff {
    const char* name = "hard";           ///< As --falloff takes it.
    float (*weight)(float x) = nullptr;  ///< ρ(x), x = t/R, for 0 ≤ x < reach; nullptr: 1 there.
    float reach = 1;                     ///< In radii; ρ is 0 from there on.
    DirectionLaw directions = DirectionLaw::Cosine;
    float base = 0, strength = 1, occlusionPower = 1, power = 1;
    const char* formula = "1";  ///< ρ as documentation writes it.
    const char* doc = "";       ///< What it stands for.
    const char* source = "";    ///< Where the formula comes from.

    bool isHard() const { return weight == nullptr; }
    /// ρ(x); 0 for infinity.
    float at(float x) const { return !(x < reach) ? 0.0f : weight ? weight(x) : 1.0f; }
    /// From E[ρ].
    double openness(double meanWeight) const;
};

/// hard, linear, quadratic, then the matched ones ("matched:gtao"). The table lives as long as the program.
std::span<const Falloff> allFalloffs();
/// Null when there is none of that name.
const Falloff* findFalloff(std::string_view name);
const Falloff& hardFalloff();
std::vector<std::string> falloffNames();

}  // namespace crevice
