// Which bytes primitives read, and when nobody reads them any more.
#include "scene/GltfRelease.h"

#include <algorithm>
#include <cstdint>

#include "core/Memory.h"

namespace crevice::gltf {

namespace {

constexpr std::uintptr_t kBlockBytes = 1 << 18;
constexpr std::size_t kLeastBytes = 4 << 20;      // below that it is not worth the counting
constexpr std::size_t kMostCounted = 10'000'000;  // blocks; files whose parts share their bytes may have far more

std::uintptr_t blockOf(const std::byte* at) { return reinterpret_cast<std::uintptr_t>(at) / kBlockBytes; }

}  // namespace

Release::Release(File& file) : file_(file), active_(file.bytesHeld >= kLeastBytes) {}

void Release::expect(const std::map<int, std::size_t>& times) {
    if (active_) pin();
    for (const auto& [mesh, count] : times)
        for (const PrimitivePart& primitive : file_.model.meshes[std::size_t(mesh)].primitives) {
            if (!active_) return;
            for (const Range& range : rangesOf(primitive)) active_ = active_ && this->count(range, count);
        }
}

// What is read after the first mesh, by others than meshes.
void Release::pin() {
    std::vector<Range> kept;
    for (const ImagePart& image : file_.model.images)
        if (!image.bytes.empty()) kept.push_back({image.bytes.data(), image.bytes.data() + image.bytes.size(), 0, 0});
    for (const Value& skin : listIn(file_.json, "skins"))
        if (const int matrices = intOr(skin, "inverseBindMatrices"); matrices >= 0) addAccessor(matrices, false, kept);
    for (const NodePart& node : file_.model.nodes)
        for (const auto& [name, accessor] : node.instancing) addAccessor(accessor, false, kept);
    for (const Range& range : kept) active_ = active_ && count(range, std::size_t(-1) / 2);
}

bool Release::count(const Range& range, std::size_t times) {
    for (std::uintptr_t block = blockOf(range.begin); block <= blockOf(range.end - 1); ++block) {
        if (++counted_ > kMostCounted) return false;
        std::size_t& pending = pending_[block];
        pending = std::min(pending + times, std::size_t(-1) / 2);  // pinned ones stay so
    }
    return true;
}

std::vector<Release::Range> Release::rangesOf(const PrimitivePart& primitive) const {
    std::vector<Range> ranges;
    for (const auto& [name, accessor] : primitive.attributes) addAccessor(accessor, true, ranges);
    for (const AttributeMap& target : primitive.targets)
        for (const auto& [name, accessor] : target) addAccessor(accessor, false, ranges);
    if (primitive.indices >= 0) addAccessor(primitive.indices, false, ranges);
    for (Range& range : ranges) range.block = blockOf(range.begin);
    return ranges;
}

void Release::addView(int view, std::vector<Range>& ranges) const {
    const auto& bytes = file_.model.bufferViews[std::size_t(view)].bytes;
    if (!bytes.empty()) ranges.push_back({bytes.data(), bytes.data() + bytes.size(), 0, 0});
}

void Release::addAccessor(int index, bool isAttribute, std::vector<Range>& ranges) const {
    const AccessorPart& accessor = file_.model.accessors[std::size_t(index)];
    if (accessor.sparse) {
        addView(accessor.sparse->indicesView, ranges);
        addView(accessor.sparse->valuesView, ranges);
    }
    if (accessor.bufferView < 0) return;
    const BufferViewPart& view = file_.model.bufferViews[std::size_t(accessor.bufferView)];
    const std::size_t size = componentSize(accessor.componentType) * std::size_t(accessor.components());
    if (view.bytes.empty() || size == 0) return;
    const std::size_t stride = view.byteStride ? view.byteStride : size;
    const std::byte* begin = view.bytes.data() + accessor.byteOffset;
    // checkAccessor() made sure that it ends inside the view; columns of matrices may be padded.
    const std::byte* end =
        accessor.columns > 1 ? view.bytes.data() + view.bytes.size() : begin + stride * (accessor.count - 1) + size;
    const bool isStream = isAttribute && !accessor.sparse && accessor.columns == 1;
    ranges.push_back({begin, end, isStream ? stride : 0, 0});
}

void Release::drop(std::uintptr_t block, const std::byte* within) {
    const auto pending = pending_.find(block);
    if (pending == pending_.end() || pending->second >= std::size_t(-1) / 2 || --pending->second > 0) return;
    const auto clip = [&](std::vector<std::byte>& bytes) {
        if (within < bytes.data() || within >= bytes.data() + bytes.size()) return false;
        const auto start = reinterpret_cast<std::uintptr_t>(bytes.data());
        const std::uintptr_t begin = std::max(block * kBlockBytes, start);
        const std::uintptr_t end = std::min((block + 1) * kBlockBytes, start + bytes.size());
        releasePages(std::span(bytes).subspan(begin - start, end - begin));
        return true;
    };
    if (clip(file_.content)) return;
    for (std::vector<std::byte>& bytes : file_.storage)
        if (clip(bytes)) return;
}

Release::Reading::Reading(Release& release, const PrimitivePart& primitive) : release_(release) {
    if (release.active_) ranges_ = release.rangesOf(primitive);
}

void Release::Reading::passed(std::size_t element) {
    const bool isEnd = element == std::size_t(-1);
    for (Range& range : ranges_) {
        if (!isEnd && range.stride == 0) continue;
        const std::size_t length = std::size_t(range.end - range.begin);
        const bool isWhole = isEnd || element > length / range.stride;
        // Blocks that end before the next element's first byte; at the end the last one, too.
        const std::uintptr_t until =
            isWhole ? blockOf(range.end - 1) + 1 : blockOf(range.begin + element * range.stride);
        for (; range.block < until; ++range.block) release_.drop(range.block, range.begin);
    }
}

}  // namespace crevice::gltf
