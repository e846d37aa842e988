// Stored floats are finite; their smallest and largest are what 'min' and 'max' say.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "scene/GltfLayout.h"

namespace crevice::gltf {

namespace {

// Throws when a number is not finite. `bytes`: floats, packed within an element.
Range findRange(const File& file, std::size_t index, const unsigned char* bytes, std::size_t stride, std::size_t count,
                std::size_t components) {
    Range range;
    std::memcpy(range.low.data(), bytes, components * sizeof(float));
    range.high = range.low;
    float bad = 0;  // 0 * infinity and 0 * NaN are NaN
    for (std::size_t i = 0; i < count; ++i, bytes += stride)
        for (std::size_t c = 0; c < components; ++c) {
            const float value = load<float>(bytes + c * sizeof(float));
            bad += 0 * value;
            range.low[c] = std::min(range.low[c], value);
            range.high[c] = std::max(range.high[c], value);
        }
    bytes -= count * stride;
    for (std::size_t i = 0; bad != 0 && i < count; ++i, bytes += stride)
        for (std::size_t c = 0; c < components; ++c)
            if (!std::isfinite(load<float>(bytes + c * sizeof(float))))
                file.fail("accessors", index, fmt::format("element {} is not a finite number", i));
    return range;
}

}  // namespace

void checkDeclared(const File& file, std::size_t index, const Range& stored) {
    const AccessorPart& accessor = file.model.accessors[index];
    if (accessor.bufferView < 0 && !accessor.sparse) return;  // any: glTF 2.0 specification, 3.6.2.5
    const Value& item = file.item("accessors", index);
    const std::size_t components = std::size_t(accessor.components());
    for (const bool upper : {false, true}) {
        const char* key = upper ? "max" : "min";
        const std::size_t count = listIn(item, key).size();
        if (count == 0) continue;
        if (count != components)
            return file.fault("accessors", index, fmt::format("'{}' has not {} numbers", key, components));
        const std::vector<float> declared = floatsIn(item, key);
        for (std::size_t c = 0; c < components; ++c) {
            const float actual = upper ? stored.high[c] : stored.low[c];
            const float tolerance = 1e-6f * std::max(std::abs(actual), std::abs(declared[c])) + 1e-9f;
            if (std::abs(actual - declared[c]) > tolerance)
                return file.fault("accessors", index,
                                  fmt::format("'{}' says {}, the data {}", key, declared[c], actual));
        }
    }
}

void checkFloats(const File& file, std::size_t index, const unsigned char* bytes, std::size_t stride) {
    const AccessorPart& accessor = file.model.accessors[index];
    const Range range = findRange(file, index, bytes, stride, accessor.count, std::size_t(accessor.components()));
    if (!accessor.normalized) checkDeclared(file, index, range);
}

}  // namespace crevice::gltf
