// Which bytes primitives read, and when nobody reads them any more.
#include "scene/GltfRelease.h"

#include <algorithm>
#include <cstdint>

#include "core/Memory.h"
#include "scene/GltfLayout.h"

namespace crevice::gltf {

namespace {

constexpr std::uintptr_t kBlockBytes = 1 << 18;
constexpr std::size_t kLeastBytes = 4 << 20;  // below that it is not worth the counting
// Blocks and accessors over all readings, so drops as well; files whose parts share their bytes may have far more.
constexpr std::size_t kMostCounted = 10'000'000;
constexpr std::size_t kPinned = std::size_t(-1) / 2;

std::uintptr_t addressOf(const std::byte* at) { return reinterpret_cast<std::uintptr_t>(at); }
std::uintptr_t blockOf(const std::byte* at) { return addressOf(at) / kBlockBytes; }

// Accessors that spansOf() looks at.
std::size_t accessorsOf(const PrimitivePart& primitive) {
    std::size_t count = 1 + primitive.attributes.size() + primitive.targets.size();
    for (const AttributeMap& target : primitive.targets) count += target.size();
    return count;
}

}  // namespace

Release::Release(File& file) : file_(file), active_(file.bytesHeld >= kLeastBytes) {
    if (!active_) return;
    held_.emplace_back(file.content);
    for (std::vector<std::byte>& bytes : file.storage) held_.emplace_back(bytes);
    std::erase_if(held_, [](const std::span<std::byte>& bytes) { return bytes.empty(); });
    std::ranges::sort(held_, {}, [](const std::span<std::byte>& bytes) { return addressOf(bytes.data()); });
}

void Release::expect(const std::map<int, std::size_t>& times) {
    if (active_) pin();
    for (const auto& [mesh, count] : times)
        for (const PrimitivePart& primitive : file_.model.meshes[std::size_t(mesh)].primitives)
            if (count > 0) expectPrimitive(primitive, count);
}

void Release::expectPrimitive(const PrimitivePart& primitive, std::size_t times) {
    charge(times, accessorsOf(primitive));
    if (!active_) return;
    for (const ByteSpan& span : spansOf(primitive)) {
        charge(times, blockOf(span.end - 1) + 1 - span.block);
        if (!active_) return;
        count(span, times);
    }
}

// What is read after the first mesh, by others than meshes.
void Release::pin() {
    std::vector<ByteSpan> kept;
    for (const ImagePart& image : file_.model.images)
        if (!image.bytes.empty()) kept.push_back({image.bytes.data(), image.bytes.data() + image.bytes.size(), 0, 0});
    for (const Value& skin : listIn(file_.json, "skins"))
        if (const int matrices = intOr(skin, "inverseBindMatrices"); matrices >= 0) addAccessor(matrices, false, kept);
    for (const NodePart& node : file_.model.nodes)
        for (const auto& [name, accessor] : node.instancing) addAccessor(accessor, false, kept);
    for (ByteSpan& span : kept) {
        span.block = blockOf(span.begin);
        charge(1, blockOf(span.end - 1) + 1 - span.block);
        if (!active_) return;
        count(span, kPinned);
    }
}

void Release::charge(std::size_t times, std::size_t amount) {
    active_ = active_ && amount <= (kMostCounted - counted_) / times;
    if (active_) counted_ += times * amount;
}

void Release::count(const ByteSpan& span, std::size_t times) {
    for (std::uintptr_t block = span.block; block <= blockOf(span.end - 1); ++block) {
        std::size_t& pending = pending_[block];
        pending = std::min(pending + times, kPinned);  // pinned ones stay so
    }
}

// A block where one span ends and the next begins is the first one's: it drops its last block at the end of the
// reading. Spans that share more are one; where they are interleaved, the first is the last to leave a block.
std::vector<Release::ByteSpan> Release::spansOf(const PrimitivePart& primitive) const {
    std::vector<ByteSpan> spans, distinct;
    for (const auto& [name, accessor] : primitive.attributes) addAccessor(accessor, true, spans);
    for (const AttributeMap& target : primitive.targets)
        for (const auto& [name, accessor] : target) addAccessor(accessor, false, spans);
    if (primitive.indices >= 0) addAccessor(primitive.indices, false, spans);
    std::ranges::sort(spans, {}, [](const ByteSpan& span) { return addressOf(span.begin); });
    for (ByteSpan& span : spans) {
        span.block = blockOf(span.begin);
        const std::uintptr_t last = blockOf(span.end - 1);
        const std::uintptr_t covered = distinct.empty() ? 0 : blockOf(distinct.back().end - 1);
        if (distinct.empty() || span.block > covered) {
            distinct.push_back(span);
        } else if (span.block == covered) {
            span.block = covered + 1;
            if (last > covered) distinct.push_back(span);
        } else {
            ByteSpan& before = distinct.back();
            if (before.stride != span.stride) before.stride = 0;
            if (addressOf(span.end) > addressOf(before.end)) before.end = span.end;
        }
    }
    return distinct;
}

void Release::addElements(const Elements& elements, std::size_t count, std::size_t size, bool isStream,
                          std::vector<ByteSpan>& spans) const {
    if (!elements.data) return;
    const auto* begin = reinterpret_cast<const std::byte*>(elements.data);
    spans.push_back({begin, begin + elements.stride * (count - 1) + size, isStream ? elements.stride : 0, 0});
}

void Release::addAccessor(int index, bool isAttribute, std::vector<ByteSpan>& spans) const {
    const AccessorPart& accessor = file_.model.accessors[std::size_t(index)];
    if (!isKnown(accessor)) return;
    const Layout layout = layOut(file_, std::size_t(index));
    const bool isStream = isAttribute && !accessor.sparse && accessor.columns == 1;
    addElements(layout.base, accessor.count, layout.elementBytes, isStream, spans);
    if (!accessor.sparse) return;
    addElements(layout.sparseIndices, layout.sparseCount, componentSize(accessor.sparse->indicesType), false, spans);
    addElements(layout.sparseValues, layout.sparseCount, layout.elementBytes, false, spans);
}

void Release::drop(std::uintptr_t block) {
    ++drops_;
    const auto pending = pending_.find(block);
    if (pending == pending_.end() || pending->second >= kPinned || --pending->second > 0) return;
    const std::uintptr_t begin = block * kBlockBytes, end = begin + kBlockBytes;
    auto bytes = std::ranges::partition_point(
        held_, [&](const std::span<std::byte>& held) { return addressOf(held.data()) + held.size() <= begin; });
    for (; bytes != held_.end() && addressOf(bytes->data()) < end; ++bytes) {
        const std::uintptr_t start = addressOf(bytes->data());
        const std::uintptr_t from = std::max(begin, start), to = std::min(end, start + bytes->size());
        releasePages(bytes->subspan(from - start, to - from));
    }
}

Release::Reading::Reading(Release& release, const PrimitivePart& primitive) : release_(release) {
    if (release.active_) spans_ = release.spansOf(primitive);
}

Release::Reading::~Reading() {
    for (ByteSpan& span : spans_) dropUntil(span, blockOf(span.end - 1) + 1);
}

// Blocks that end before the next element's first byte, but never the last: another span may begin in it.
void Release::Reading::passed(std::size_t element) {
    for (ByteSpan& span : spans_) {
        if (span.stride == 0) continue;
        const std::size_t most = (addressOf(span.end) - addressOf(span.begin) - 1) / span.stride;
        dropUntil(span, blockOf(span.begin + std::min(element, most) * span.stride));
    }
}

void Release::Reading::dropUntil(ByteSpan& span, std::uintptr_t block) {
    for (; span.block < block; ++span.block) release_.drop(span.block);
}

}  // namespace crevice::gltf
