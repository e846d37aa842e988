// Runs go from left to right, in one of two alphabets.
#include "effect/PropertyTarget.h"

namespace crevice {

std::string uniformOf(const EffectProperty& property) {
    return property.target.empty() ? property.name : property.target.substr(0, property.target.find('.'));
}

std::string swizzleOf(const EffectProperty& property) {
    const auto dot = property.target.find('.');
    return dot == std::string::npos ? std::string() : property.target.substr(dot + 1);
}

int firstComponent(const std::string& swizzle) {
    for (const std::string all : {"xyzw", "rgba"})
        if (const auto at = all.find(swizzle); at != std::string::npos) return static_cast<int>(at);
    return -1;
}

}  // namespace crevice
