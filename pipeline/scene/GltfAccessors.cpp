// Reads glTF numbers from where layOut() says that they lie.
#include <algorithm>
#include <cmath>
#include <cstring>

#include <fmt/format.h>

#include "scene/GltfLayout.h"

namespace crevice::gltf {

namespace {

// glTF 2.0 specification, 3.6.2.2: f = max(c / 127, -1) and so on.
float toFloat(const unsigned char* bytes, int type, bool normalized) {
    switch (type) {
        case kFloat:
            return load<float>(bytes);
        case kByte: {
            const float c = load<std::int8_t>(bytes);
            return normalized ? std::max(c / 127.0f, -1.0f) : c;
        }
        case kUByte: {
            const float c = load<std::uint8_t>(bytes);
            return normalized ? c / 255.0f : c;
        }
        case kShort: {
            const float c = load<std::int16_t>(bytes);
            return normalized ? std::max(c / 32767.0f, -1.0f) : c;
        }
        case kUShort: {
            const float c = load<std::uint16_t>(bytes);
            return normalized ? c / 65535.0f : c;
        }
        default: {
            const double c = load<std::uint32_t>(bytes);
            return float(normalized ? c / 4294967295.0 : c);
        }
    }
}

// The first sparse element whose index is `index` or more.
std::size_t findSparse(const AccessorPart& accessor, const Layout& layout, std::size_t index) {
    std::size_t low = 0, high = layout.sparseCount;
    while (low < high) {
        const std::size_t middle = low + (high - low) / 2;
        const unsigned char* bytes = layout.sparseIndices.data + middle * layout.sparseIndices.stride;
        if (toInteger(bytes, accessor.sparse->indicesType) < index)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

// Calls visit(element, bytes) for every stored element of [first, first + count); sparse ones come last and overwrite.
template <class Visit>
void visitElements(const AccessorPart& accessor, const Layout& layout, std::size_t first, std::size_t count,
                   Visit visit) {
    if (layout.base.data)
        for (std::size_t i = first; i < first + count; ++i) visit(i, layout.base.data + i * layout.base.stride);
    if (layout.sparseCount == 0) return;
    for (std::size_t i = findSparse(accessor, layout, first); i < layout.sparseCount; ++i) {
        const std::size_t target =
            toInteger(layout.sparseIndices.data + i * layout.sparseIndices.stride, accessor.sparse->indicesType);
        if (target >= first + count) return;
        visit(target, layout.sparseValues.data + i * layout.sparseValues.stride);
    }
}

// Elements [first, first + count): sparse ones among them come last and overwrite.
Floats readRange(const File& file, int index, std::size_t first, std::size_t count) {
    const AccessorPart& accessor = file.model.accessors[std::size_t(index)];
    const Layout layout = layOutData(file, std::size_t(index));
    Floats floats;
    floats.components = accessor.components();
    const std::size_t components = std::size_t(floats.components);
    floats.values.assign(count * components, 0.0f);
    const auto keep = [&](std::size_t element, const unsigned char* bytes) {
        for (std::size_t c = 0; c < components; ++c)
            floats.values[(element - first) * components + c] =
                toFloat(bytes + layout.offsets[c], accessor.componentType, accessor.normalized);
    };
    visitElements(accessor, layout, first, count, keep);
    return floats;
}

template <class T>
void widen(const Elements& from, std::vector<std::uint32_t>& to) {
    const unsigned char* bytes = from.data;
    if (from.stride == sizeof(T)) {
        // Equal strides, known when compiling: a loop over vectors.
        for (std::size_t i = 0; i < to.size(); ++i) to[i] = load<T>(bytes + i * sizeof(T));
        return;
    }
    for (std::uint32_t& value : to) {
        value = load<T>(bytes);
        bytes += from.stride;
    }
}

// Single integers without sparse ones: most of what indices are.
void widen(const Elements& from, int type, std::vector<std::uint32_t>& to) {
    if (type == kUByte) widen<std::uint8_t>(from, to);
    if (type == kUShort) widen<std::uint16_t>(from, to);
    if (type == kUInt) widen<std::uint32_t>(from, to);
}

}  // namespace

Floats readFloats(const File& file, int index) {
    const std::size_t accessor = std::size_t(index);
    Floats floats = readRange(file, index, 0, file.model.accessors[accessor].count);
    checkFloats(file, accessor, reinterpret_cast<const unsigned char*>(floats.values.data()),
                std::size_t(floats.components) * sizeof(float));
    return floats;
}

Floats readSomeFloats(const File& file, int index, std::size_t first, std::size_t count) {
    Floats floats = readRange(file, index, first, count);
    for (std::size_t i = 0; i < floats.values.size(); ++i)
        if (!std::isfinite(floats.values[i]))
            file.fail("accessors", std::size_t(index),
                      fmt::format("element {} is not a finite number", first + i / std::size_t(floats.components)));
    return floats;
}

Floats readFirstFloats(const File& file, int index, std::size_t most) {
    return readRange(file, index, 0, std::min(most, file.model.accessors[std::size_t(index)].count));
}

FloatStream readFloatStream(const File& file, int index) {
    const AccessorPart& accessor = file.model.accessors[std::size_t(index)];
    const Layout layout = layOutData(file, std::size_t(index));
    FloatStream stream;
    stream.components = accessor.components();
    stream.count = accessor.count;
    if (accessor.componentType == kFloat && accessor.columns == 1 && layout.base.data && layout.sparseCount == 0) {
        stream.data_ = layout.base.data;
        stream.stride_ = layout.base.stride;
        checkFloats(file, std::size_t(index), stream.data_, stream.stride_);
        return stream;
    }
    stream.own_ = readFloats(file, index).values;
    stream.useOwn();
    return stream;
}

void FloatStream::useOwn() {
    data_ = reinterpret_cast<const unsigned char*>(own_.data());
    stride_ = std::size_t(components) * sizeof(float);
}

std::vector<float>& FloatStream::edit() {
    if (!own_.empty() || components == 0) return own_;
    const std::size_t bytes = std::size_t(components) * sizeof(float);
    own_.resize(count * std::size_t(components));
    for (std::size_t i = 0; i < count; ++i) std::memcpy(&own_[i * std::size_t(components)], data_ + i * stride_, bytes);
    useOwn();
    return own_;
}

std::vector<std::uint32_t> readIntegers(const File& file, int index) {
    const AccessorPart& accessor = file.model.accessors[std::size_t(index)];
    const Layout layout = layOutData(file, std::size_t(index));
    if (!isUnsigned(accessor.componentType))
        file.fail("accessors", std::size_t(index),
                  fmt::format("'componentType' {} is not an unsigned integer", accessor.componentType));
    const std::size_t components = std::size_t(accessor.components());
    std::vector<std::uint32_t> integers(accessor.count * components, 0u);
    if (layout.base.data && layout.sparseCount == 0 && components == 1) {
        widen(layout.base, accessor.componentType, integers);
        return integers;
    }
    visitElements(accessor, layout, 0, accessor.count, [&](std::size_t element, const unsigned char* bytes) {
        for (std::size_t c = 0; c < components; ++c)
            integers[element * components + c] = toInteger(bytes + layout.offsets[c], accessor.componentType);
    });
    return integers;
}

}  // namespace crevice::gltf
