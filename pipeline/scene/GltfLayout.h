// Internal to the glTF loader: where the elements of an accessor lie in memory, checked.
#pragma once

#include <array>
#include <cstring>

#include "scene/GltfParts.h"

namespace crevice::gltf {

/// Elements in memory, already checked; null = all zero, or missing.
struct Elements {
    const unsigned char* data = nullptr;
    std::size_t stride = 0;
    bool missing = false;  ///< The buffer has no data.
};

struct Layout {
    Elements base;
    Elements sparseIndices, sparseValues;
    std::size_t sparseCount = 0;
    std::size_t componentBytes = 0;
    std::size_t elementBytes = 0;
    std::array<std::size_t, 16> offsets{};  ///< Of each component in an element.
};

/// Where an accessor's elements lie. Throws Error: a type that glTF 2.0 does not have, a range beyond its view, sparse
/// indices that are not below the count or do not increase.
Layout layOut(const File& file, std::size_t accessor);
/// The same for those who read it. Throws Error as well when there are no bytes, or more elements than may be.
Layout layOutData(const File& file, std::size_t accessor);
/// Throws Error when an accessor's sparse indices do not increase or are not below its count.
void checkSparse(const File& file, std::size_t accessor, const Elements& indices);
/// Its type and component type are those of glTF 2.0: others are left to those who want to read them.
bool isKnown(const AccessorPart& accessor);
bool isUnsigned(int componentType);

template <class T>
T load(const unsigned char* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof value);
    return value;
}

/// Of an unsigned type.
inline std::uint32_t toInteger(const unsigned char* bytes, int type) {
    switch (type) {
        case kUByte:
            return load<std::uint8_t>(bytes);
        case kUShort:
            return load<std::uint16_t>(bytes);
        default:
            return load<std::uint32_t>(bytes);
    }
}

}  // namespace crevice::gltf
