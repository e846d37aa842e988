// Checked access to glTF numbers: nothing is read before its whole range is known to lie inside its buffer.
#include <cstring>

#include <fmt/format.h>

#include "scene/GltfParts.h"

namespace crevice::gltf {

namespace {

// Bytes of one component, 0 for types that glTF 2.0 does not have.
std::size_t componentSize(int type) {
    switch (type) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return 1;
        case TINYGLTF_COMPONENT_TYPE_SHORT:
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return 2;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        case TINYGLTF_COMPONENT_TYPE_FLOAT:
            return 4;
        default:
            return 0;
    }
}

int componentCount(int type) {
    switch (type) {
        case TINYGLTF_TYPE_SCALAR:
            return 1;
        case TINYGLTF_TYPE_VEC2:
            return 2;
        case TINYGLTF_TYPE_VEC3:
            return 3;
        case TINYGLTF_TYPE_VEC4:
        case TINYGLTF_TYPE_MAT2:
            return 4;
        case TINYGLTF_TYPE_MAT3:
            return 9;
        case TINYGLTF_TYPE_MAT4:
            return 16;
        default:
            return 0;
    }
}

/// Elements in memory, already checked; null = all zero.
struct Elements {
    const unsigned char* data = nullptr;
    std::size_t stride = 0;
};

// The range [offset, offset + (count - 1) * stride + size) of a buffer view, checked without overflow.
Elements checkRange(const File& file, std::size_t accessor, std::string_view what, int view, std::size_t offset,
                    std::size_t count, std::size_t size, bool packed) {
    const auto& model = file.model;
    if (view < 0 || std::size_t(view) >= model.bufferViews.size())
        file.fail("accessors", accessor,
                  fmt::format("{} names bufferViews[{}], the file has {}", what, view, model.bufferViews.size()));
    const tinygltf::BufferView& bufferView = model.bufferViews[view];
    if (bufferView.buffer < 0 || std::size_t(bufferView.buffer) >= model.buffers.size())
        file.fail("bufferViews", view,
                  fmt::format("'buffer' is {}, the file has {} buffers", bufferView.buffer, model.buffers.size()));
    const auto& bytes = model.buffers[bufferView.buffer].data;
    if (bufferView.byteOffset > bytes.size() || bufferView.byteLength > bytes.size() - bufferView.byteOffset)
        file.fail("bufferViews", view,
                  fmt::format("'byteOffset' {} and 'byteLength' {} reach beyond buffers[{}] of {} bytes",
                              bufferView.byteOffset, bufferView.byteLength, bufferView.buffer, bytes.size()));
    const std::size_t stride = packed || bufferView.byteStride == 0 ? size : bufferView.byteStride;
    if (stride < size)
        file.fail(
            "bufferViews", view,
            fmt::format("'byteStride' {} is less than an element of accessors[{}], {} bytes", stride, accessor, size));
    const std::size_t length = bufferView.byteLength;
    if (offset > length || size > length - offset || (count - 1) > (length - offset - size) / stride)
        file.fail(
            "accessors", accessor,
            fmt::format(
                "{} of {} elements of {} bytes, {} apart, from byte {} reaches beyond bufferViews[{}] of {} bytes",
                what, count, size, stride, offset, view, length));
    return {bytes.data() + bufferView.byteOffset + offset, stride};
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
        case TINYGLTF_COMPONENT_TYPE_FLOAT:
            return load<float>(bytes);
        case TINYGLTF_COMPONENT_TYPE_BYTE: {
            const float c = load<std::int8_t>(bytes);
            return normalized ? std::max(c / 127.0f, -1.0f) : c;
        }
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE: {
            const float c = load<std::uint8_t>(bytes);
            return normalized ? c / 255.0f : c;
        }
        case TINYGLTF_COMPONENT_TYPE_SHORT: {
            const float c = load<std::int16_t>(bytes);
            return normalized ? std::max(c / 32767.0f, -1.0f) : c;
        }
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT: {
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
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return load<std::uint8_t>(bytes);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return load<std::uint16_t>(bytes);
        default:
            return load<std::uint32_t>(bytes);
    }
}

bool isUnsigned(int type) {
    return type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE || type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
           type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
}

struct Layout {
    Elements base;
    Elements sparseIndices, sparseValues;
    std::size_t sparseCount = 0;
    int components = 0;
    std::size_t componentBytes = 0;
};

void checkSparse(const File& file, std::size_t index, const tinygltf::Accessor& accessor, Layout& layout) {
    const auto& sparse = accessor.sparse;
    const std::size_t indexBytes = componentSize(sparse.indices.componentType);
    if (sparse.count < 1 || std::size_t(sparse.count) > accessor.count)
        file.fail("accessors", index,
                  fmt::format("'sparse.count' is {}, allowed are 1 … {}", sparse.count, accessor.count));
    if (!isUnsigned(sparse.indices.componentType))
        file.fail(
            "accessors", index,
            fmt::format("'sparse.indices.componentType' {} is not an unsigned integer", sparse.indices.componentType));
    if (sparse.indices.byteOffset < 0 || sparse.values.byteOffset < 0)
        file.fail("accessors", index, "a 'byteOffset' of 'sparse' is negative");
    layout.sparseCount = sparse.count;
    layout.sparseIndices = checkRange(file, index, "'sparse.indices'", sparse.indices.bufferView,
                                      sparse.indices.byteOffset, layout.sparseCount, indexBytes, true);
    layout.sparseValues = checkRange(file, index, "'sparse.values'", sparse.values.bufferView, sparse.values.byteOffset,
                                     layout.sparseCount, layout.componentBytes * layout.components, true);
    for (std::size_t i = 0; i < layout.sparseCount; ++i) {
        const std::uint32_t target =
            toInteger(layout.sparseIndices.data + i * indexBytes, sparse.indices.componentType);
        if (target >= accessor.count)
            file.fail("accessors", index,
                      fmt::format("sparse index {} at {} is not below 'count' {}", target, i, accessor.count));
    }
}

Layout layOut(const File& file, std::size_t index) {
    const tinygltf::Accessor& accessor = file.model.accessors[index];
    Layout layout;
    layout.components = componentCount(accessor.type);
    layout.componentBytes = componentSize(accessor.componentType);
    if (layout.components == 0 || layout.componentBytes == 0)
        file.fail("accessors", index, fmt::format("'componentType' {} is not one of glTF 2.0", accessor.componentType));
    if (accessor.count < 1) file.fail("accessors", index, "'count' is 0");
    if (accessor.count > 6 * file.options.limits.maxVertices)
        file.fail(
            "accessors", index,
            fmt::format("'count' {} is beyond the limit of {}", accessor.count, 6 * file.options.limits.maxVertices));
    // Columns of small-component matrices are padded to 4 bytes; nothing that is drawn uses them.
    if (accessor.type >= TINYGLTF_TYPE_MAT2 && accessor.type <= TINYGLTF_TYPE_MAT4 && layout.componentBytes != 4)
        return layout;
    if (accessor.bufferView >= 0)
        layout.base = checkRange(file, index, "the range", accessor.bufferView, accessor.byteOffset, accessor.count,
                                 layout.componentBytes * layout.components, false);
    if (accessor.sparse.isSparse) checkSparse(file, index, accessor, layout);
    return layout;
}

// Calls visit(element, component, bytes) for every stored component; sparse ones come last and overwrite.
template <class Visit>
void visitComponents(const tinygltf::Accessor& accessor, const Layout& layout, Visit visit) {
    const auto visitElement = [&](std::size_t element, const unsigned char* bytes) {
        for (int c = 0; c < layout.components; ++c) visit(element, c, bytes + c * layout.componentBytes);
    };
    if (layout.base.data)
        for (std::size_t i = 0; i < accessor.count; ++i) visitElement(i, layout.base.data + i * layout.base.stride);
    for (std::size_t i = 0; i < layout.sparseCount; ++i) {
        const int indexType = accessor.sparse.indices.componentType;
        const std::uint32_t target = toInteger(layout.sparseIndices.data + i * layout.sparseIndices.stride, indexType);
        visitElement(target, layout.sparseValues.data + i * layout.sparseValues.stride);
    }
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
    if (type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE) widen<std::uint8_t>(from, to);
    if (type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT) widen<std::uint16_t>(from, to);
    if (type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT) widen<std::uint32_t>(from, to);
}

}  // namespace

void checkAccessor(const File& file, std::size_t index) { layOut(file, index); }

Floats readFloats(const File& file, int index) {
    const tinygltf::Accessor& accessor = file.model.accessors[index];
    const Layout layout = layOut(file, index);
    Floats floats;
    floats.components = layout.components;
    floats.values.assign(accessor.count * layout.components, 0.0f);
    visitComponents(accessor, layout, [&](std::size_t element, int component, const unsigned char* bytes) {
        floats.values[element * layout.components + component] =
            toFloat(bytes, accessor.componentType, accessor.normalized);
    });
    return floats;
}

FloatStream readFloatStream(const File& file, int index) {
    const tinygltf::Accessor& accessor = file.model.accessors[index];
    const Layout layout = layOut(file, index);
    FloatStream stream;
    stream.components = layout.components;
    stream.count = accessor.count;
    if (accessor.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT && layout.base.data && layout.sparseCount == 0) {
        stream.data_ = layout.base.data;
        stream.stride_ = layout.base.stride;
        return stream;
    }
    stream.converted_ = readFloats(file, index).values;
    stream.data_ = reinterpret_cast<const unsigned char*>(stream.converted_.data());
    stream.stride_ = layout.components * sizeof(float);
    return stream;
}

std::vector<std::uint32_t> readIntegers(const File& file, int index) {
    const tinygltf::Accessor& accessor = file.model.accessors[index];
    const Layout layout = layOut(file, index);
    if (!isUnsigned(accessor.componentType))
        file.fail("accessors", index,
                  fmt::format("'componentType' {} is not an unsigned integer", accessor.componentType));
    std::vector<std::uint32_t> integers(accessor.count * layout.components, 0u);
    if (layout.base.data && layout.sparseCount == 0 && layout.components == 1) {
        widen(layout.base, accessor.componentType, integers);
        return integers;
    }
    visitComponents(accessor, layout, [&](std::size_t element, int component, const unsigned char* bytes) {
        integers[element * layout.components + component] = toInteger(bytes, accessor.componentType);
    });
    return integers;
}

}  // namespace crevice::gltf
