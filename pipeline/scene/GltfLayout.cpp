// Checks where accessors lie: nothing is read before its whole range is known to lie inside its buffer.
#include "scene/GltfLayout.h"

#include <algorithm>

#include <fmt/format.h>

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

bool isUnsigned(int type) { return type == kUByte || type == kUShort || type == kUInt; }

bool isKnown(const AccessorPart& accessor) { return accessor.rows > 0 && componentSize(accessor.componentType) > 0; }

namespace {

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

// Columns of matrices begin at multiples of 4 bytes: glTF 2.0 specification, 3.6.2.4.
void layOutElement(const AccessorPart& accessor, Layout& layout) {
    const std::size_t rows = std::size_t(accessor.rows), bytes = layout.componentBytes;
    const std::size_t column = accessor.columns > 1 ? (rows * bytes + 3) / 4 * 4 : rows * bytes;
    for (std::size_t i = 0; i < std::size_t(accessor.components()); ++i)
        layout.offsets[i] = i / rows * column + i % rows * bytes;
    layout.elementBytes = column * std::size_t(accessor.columns);
}

void layOutSparse(const File& file, std::size_t index, const AccessorPart& accessor, Layout& layout) {
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
    if (!layout.sparseIndices.missing && !layout.sparseValues.missing) checkSparse(file, index, layout.sparseIndices);
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
    if (accessor.sparse) layOutSparse(file, index, accessor, layout);
    return layout;
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

bool hasData(const File& file, int index) {
    const AccessorPart& accessor = file.model.accessors[std::size_t(index)];
    if (!isKnown(accessor) || accessor.count > 6 * file.options.limits.maxVertices) return false;
    if (accessor.bufferView < 0 && !accessor.sparse) return false;
    const auto isMissing = [&](int view) { return file.model.bufferViews[std::size_t(view)].bytes.empty(); };
    if (accessor.bufferView >= 0 && isMissing(accessor.bufferView)) return false;
    return !accessor.sparse || !(isMissing(accessor.sparse->indicesView) || isMissing(accessor.sparse->valuesView));
}

}  // namespace crevice::gltf
