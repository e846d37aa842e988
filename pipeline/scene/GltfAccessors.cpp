// Checked access to glTF numbers: nothing is read before its whole range is known to lie inside its buffer.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include <fmt/format.h>

#include "scene/GltfParts.h"

namespace crevice::gltf {

std::size_t componentSize(int type) {
    switch (type) {
        case kByte:
        case kUByte:
            return 1;
        case kShort:
        case kUShort:
            return 2;
        case kUInt:
        case kFloat:
            return 4;
        default:
            return 0;
    }
}

namespace {

/// Elements in memory, already checked; null = all zero, or missing.
struct Elements {
    const unsigned char* data = nullptr;
    std::size_t stride = 0;
    bool missing = false;  ///< The buffer has no data.
};

// The range [offset, offset + (count - 1) * stride + size) of a buffer view, checked without overflow.
Elements checkRange(const File& file, std::size_t accessor, std::string_view what, int viewIndex, std::size_t offset,
                    std::size_t count, std::size_t size, bool packed) {
    const BufferViewPart& view = file.model.bufferViews[std::size_t(viewIndex)];
    const std::size_t stride = packed || view.byteStride == 0 ? size : view.byteStride;
    if (stride < size)
        file.fail(
            "bufferViews", std::size_t(viewIndex),
            fmt::format("'byteStride' {} is less than an element of accessors[{}], {} bytes", stride, accessor, size));
    const std::size_t length = view.byteLength;
    if (offset > length || size > length - offset || (count - 1) > (length - offset - size) / stride)
        file.fail(
            "accessors", accessor,
            fmt::format(
                "{} of {} elements of {} bytes, {} apart, from byte {} reaches beyond bufferViews[{}] of {} bytes",
                what, count, size, stride, offset, viewIndex, length));
    if (view.bytes.empty()) return {nullptr, stride, true};
    return {reinterpret_cast<const unsigned char*>(view.bytes.data()) + offset, stride};
}

template <class T>
T load(const unsigned char* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof value);
    return value;
}

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

std::uint32_t toInteger(const unsigned char* bytes, int type) {
    switch (type) {
        case kUByte:
            return load<std::uint8_t>(bytes);
        case kUShort:
            return load<std::uint16_t>(bytes);
        default:
            return load<std::uint32_t>(bytes);
    }
}

bool isUnsigned(int type) { return type == kUByte || type == kUShort || type == kUInt; }

struct Layout {
    Elements base;
    Elements sparseIndices, sparseValues;
    std::size_t sparseCount = 0;
    std::size_t componentBytes = 0;
    std::size_t elementBytes = 0;
    std::array<std::size_t, 16> offsets{};  ///< Of each component in an element.
};

// Columns of matrices begin at multiples of 4 bytes: glTF 2.0 specification, 3.6.2.4.
void layOutElement(const AccessorPart& accessor, Layout& layout) {
    const std::size_t rows = std::size_t(accessor.rows), bytes = layout.componentBytes;
    const std::size_t column = accessor.columns > 1 ? (rows * bytes + 3) / 4 * 4 : rows * bytes;
    for (std::size_t i = 0; i < std::size_t(accessor.components()); ++i)
        layout.offsets[i] = i / rows * column + i % rows * bytes;
    layout.elementBytes = column * std::size_t(accessor.columns);
}

void checkSparse(const File& file, std::size_t index, const AccessorPart& accessor, Layout& layout) {
    const SparsePart& sparse = *accessor.sparse;
    const std::size_t indexBytes = componentSize(sparse.indicesType);
    if (sparse.count > accessor.count)
        file.fail("accessors", index,
                  fmt::format("'sparse.count' is {}, allowed are 1 … {}", sparse.count, accessor.count));
    if (!isUnsigned(sparse.indicesType))
        file.fail("accessors", index,
                  fmt::format("'sparse.indices.componentType' {} is not an unsigned integer", sparse.indicesType));
    layout.sparseCount = sparse.count;
    layout.sparseIndices = checkRange(file, index, "'sparse.indices'", sparse.indicesView, sparse.indicesOffset,
                                      layout.sparseCount, indexBytes, true);
    layout.sparseValues = checkRange(file, index, "'sparse.values'", sparse.valuesView, sparse.valuesOffset,
                                     layout.sparseCount, layout.elementBytes, true);
    if (layout.sparseIndices.missing || layout.sparseValues.missing) return;
    std::uint32_t before = 0;
    for (std::size_t i = 0; i < layout.sparseCount; ++i) {
        const std::uint32_t target = toInteger(layout.sparseIndices.data + i * indexBytes, sparse.indicesType);
        if (target >= accessor.count)
            file.fail("accessors", index,
                      fmt::format("sparse index {} at {} is not below 'count' {}", target, i, accessor.count));
        if (i > 0 && target <= before)
            file.fail("accessors", index, fmt::format("sparse index {} at {} is not above the one before", target, i));
        before = target;
    }
}

// Unknown types are left to those who want to read them.
bool isKnown(const AccessorPart& accessor) { return accessor.rows > 0 && componentSize(accessor.componentType) > 0; }

Layout layOut(const File& file, std::size_t index) {
    const AccessorPart& accessor = file.model.accessors[index];
    if (componentSize(accessor.componentType) == 0)
        file.fail("accessors", index, fmt::format("'componentType' {} is not one of glTF 2.0", accessor.componentType));
    if (!isKnown(accessor)) file.fail("accessors", index, "'type' is not one of glTF 2.0");
    Layout layout;
    layout.componentBytes = componentSize(accessor.componentType);
    layOutElement(accessor, layout);
    if (accessor.bufferView >= 0)
        layout.base = checkRange(file, index, "the range", accessor.bufferView, accessor.byteOffset, accessor.count,
                                 layout.elementBytes, false);
    if (accessor.sparse) checkSparse(file, index, accessor, layout);
    return layout;
}

// Calls visit(element, component, bytes) for every stored component of the first `most` elements; sparse ones come last
// and overwrite.
template <class Visit>
void visitComponents(const AccessorPart& accessor, const Layout& layout, Visit visit,
                     std::size_t most = std::size_t(-1)) {
    const int components = accessor.components();
    const auto visitElement = [&](std::size_t element, const unsigned char* bytes) {
        for (int c = 0; c < components; ++c) visit(element, c, bytes + layout.offsets[std::size_t(c)]);
    };
    if (layout.base.data)
        for (std::size_t i = 0; i < std::min(most, accessor.count); ++i)
            visitElement(i, layout.base.data + i * layout.base.stride);
    for (std::size_t i = 0; i < layout.sparseCount; ++i) {
        const std::uint32_t target =
            toInteger(layout.sparseIndices.data + i * layout.sparseIndices.stride, accessor.sparse->indicesType);
        if (target < most) visitElement(target, layout.sparseValues.data + i * layout.sparseValues.stride);
    }
}

Layout layOutData(const File& file, std::size_t index) {
    const std::size_t limit = 6 * file.options.limits.maxVertices;
    if (file.model.accessors[index].count > limit)
        file.fail("accessors", index,
                  fmt::format("'count' {} is beyond the limit of {}", file.model.accessors[index].count, limit),
                  raiseLimit("vertices"));
    const Layout layout = layOut(file, index);
    if (layout.base.missing || layout.sparseIndices.missing || layout.sparseValues.missing)
        file.fail("accessors", index, "its buffer has no data", "a buffer needs an 'uri' or a binary chunk");
    return layout;
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

/// The smallest and largest number of each component.
struct Range {
    std::array<float, 16> low{}, high{};
};

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

// Declared bounds are the smallest and largest values stored: nothing that is drawn depends on them.
void checkRangeDeclared(const File& file, std::size_t index, const Range& range, std::size_t components) {
    const Value& item = file.item("accessors", index);
    if (file.model.accessors[index].normalized) return;
    for (const bool upper : {false, true}) {
        const std::vector<float> declared = floatsIn(item, upper ? "max" : "min");
        if (declared.empty()) continue;
        if (declared.size() != components)
            return file.fault("accessors", index, fmt::format("'min' or 'max' has not {} numbers", components));
        for (std::size_t c = 0; c < components; ++c) {
            const float actual = upper ? range.high[c] : range.low[c];
            const float tolerance = 1e-6f * std::max(std::abs(actual), std::abs(declared[c])) + 1e-9f;
            if (std::abs(actual - declared[c]) > tolerance)
                return file.fault("accessors", index,
                                  fmt::format("'{}' says {}, the data {}", upper ? "max" : "min", declared[c], actual));
        }
    }
}

void checkValues(const File& file, std::size_t index, const unsigned char* bytes, std::size_t stride) {
    const AccessorPart& accessor = file.model.accessors[index];
    const std::size_t components = std::size_t(accessor.components());
    checkRangeDeclared(file, index, findRange(file, index, bytes, stride, accessor.count, components), components);
}

void checkSparseStart(const File& file, std::size_t index, const Layout& layout) {
    const SparsePart& sparse = *file.model.accessors[index].sparse;
    const auto check = [&](const char* what, int view, std::size_t offset, std::size_t size) {
        const std::size_t at = file.model.bufferViews[std::size_t(view)].byteOffset + offset;
        if (at % size || offset % size)
            file.fault("accessors", index,
                       fmt::format("'{}' begin at byte {}, not at a multiple of {}", what, at, size));
    };
    check("sparse.indices", sparse.indicesView, sparse.indicesOffset, componentSize(sparse.indicesType));
    check("sparse.values", sparse.valuesView, sparse.valuesOffset, layout.componentBytes);
}

}  // namespace

void checkAccessor(const File& file, std::size_t index) {
    const AccessorPart& accessor = file.model.accessors[index];
    if (!isKnown(accessor)) {
        const bool type = componentSize(accessor.componentType) == 0;
        return file.fault("accessors", index,
                          type ? fmt::format("'componentType' {} is unknown", accessor.componentType)
                               : std::string("'type' is unknown"));
    }
    const Layout layout = layOut(file, index);
    if (accessor.normalized && (accessor.componentType == kFloat || accessor.componentType == kUInt))
        file.fault("accessors", index, "floats and 32-bit integers cannot be 'normalized'");
    const std::size_t view =
        accessor.bufferView >= 0 ? file.model.bufferViews[std::size_t(accessor.bufferView)].byteOffset : 0;
    if (accessor.byteOffset % layout.componentBytes || (view + accessor.byteOffset) % layout.componentBytes)
        file.fault("accessors", index,
                   fmt::format("it begins at byte {}, not at a multiple of {}", view + accessor.byteOffset,
                               layout.componentBytes));
    if (accessor.columns > 1 && (view + accessor.byteOffset) % 4)
        file.fault("accessors", index, "its columns do not begin at multiples of 4 bytes");
    if (accessor.sparse) checkSparseStart(file, index, layout);
    if (accessor.bufferView < 0 && accessor.byteOffset > 0)
        file.fault("accessors", index, "'byteOffset' needs a 'bufferView'");
}

Floats readFloats(const File& file, int index) {
    const AccessorPart& accessor = file.model.accessors[std::size_t(index)];
    const Layout layout = layOutData(file, std::size_t(index));
    Floats floats;
    floats.components = accessor.components();
    const std::size_t components = std::size_t(floats.components);
    floats.values.assign(accessor.count * components, 0.0f);
    visitComponents(accessor, layout, [&](std::size_t element, int component, const unsigned char* bytes) {
        floats.values[element * components + std::size_t(component)] =
            toFloat(bytes, accessor.componentType, accessor.normalized);
    });
    checkValues(file, std::size_t(index), reinterpret_cast<const unsigned char*>(floats.values.data()),
                components * sizeof(float));
    return floats;
}

bool hasData(const File& file, int index) {
    const AccessorPart& accessor = file.model.accessors[std::size_t(index)];
    if (!isKnown(accessor) || accessor.count > 6 * file.options.limits.maxVertices) return false;
    if (accessor.bufferView < 0 && !accessor.sparse) return false;
    const auto isMissing = [&](int view) { return file.model.bufferViews[std::size_t(view)].bytes.empty(); };
    if (accessor.bufferView >= 0 && isMissing(accessor.bufferView)) return false;
    return !accessor.sparse || !(isMissing(accessor.sparse->indicesView) || isMissing(accessor.sparse->valuesView));
}

Floats readFirstFloats(const File& file, int index, std::size_t most) {
    const AccessorPart& accessor = file.model.accessors[std::size_t(index)];
    const Layout layout = layOutData(file, std::size_t(index));
    Floats floats;
    floats.components = accessor.components();
    const std::size_t components = std::size_t(floats.components);
    floats.values.assign(std::min(most, accessor.count) * components, 0.0f);
    const auto keep = [&](std::size_t element, int component, const unsigned char* bytes) {
        floats.values[element * components + std::size_t(component)] =
            toFloat(bytes, accessor.componentType, accessor.normalized);
    };
    visitComponents(accessor, layout, keep, most);
    return floats;
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
        checkValues(file, std::size_t(index), stream.data_, stream.stride_);
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
    visitComponents(accessor, layout, [&](std::size_t element, int component, const unsigned char* bytes) {
        integers[element * components + std::size_t(component)] = toInteger(bytes, accessor.componentType);
    });
    return integers;
}

}  // namespace crevice::gltf
