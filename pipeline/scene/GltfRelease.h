// Internal to the glTF loader: gives the file's bytes back to the system as meshes are made of them, so that a big
// scene is not in memory twice.
#pragma once

#include <map>
#include <vector>

#include "scene/GltfParts.h"

namespace crevice::gltf {

struct Elements;

/// Counts for each block of the file's bytes how often primitives will still read it; at zero it is given back. What
/// anything else reads, pictures and matrices, stays.
class Release {
public:
    /// Of small files nothing is given back.
    explicit Release(File& file);
    /// `times`: how often each mesh will be read. To be called once, before the first is. Where that is
    /// so often that counting would take long, nothing is given back.
    void expect(const std::map<int, std::size_t>& times);
    /// Blocks that readings were done with so far, each as often as it was read.
    std::size_t drops() const { return drops_; }

private:
    /// Bytes that are read together, and what is not yet done with of them.
    struct ByteSpan {
        const std::byte *begin, *end;
        std::size_t stride;    ///< Of attributes; 0: others, which are read as a whole.
        std::uintptr_t block;  ///< The next one.
    };

public:
    /// One reading of a primitive; when it ends, so does the need for its bytes.
    class Reading {
    public:
        Reading(Release& release, const PrimitivePart& primitive);
        ~Reading();
        Reading(const Reading&) = delete;
        Reading& operator=(const Reading&) = delete;
        /// Attributes below that element are not read again.
        void passed(std::size_t element);

    private:
        void dropUntil(ByteSpan& span, std::uintptr_t block);

        Release& release_;
        std::vector<ByteSpan> spans_;
    };

private:
    void expectPrimitive(const PrimitivePart& primitive, std::size_t times);
    /// Each block in one of them.
    std::vector<ByteSpan> spansOf(const PrimitivePart& primitive) const;
    void addAccessor(int accessor, bool isAttribute, std::vector<ByteSpan>& spans) const;
    void addElements(const Elements& elements, std::size_t count, std::size_t size, bool isStream,
                     std::vector<ByteSpan>& spans) const;
    void pin();
    /// Takes from what may be counted; too much: nothing will be given back.
    void charge(std::size_t times, std::size_t amount);
    void count(const ByteSpan& span, std::size_t times);
    void drop(std::uintptr_t block);

    File& file_;
    bool active_ = false;
    std::vector<std::span<std::byte>> held_;         ///< The file's vectors by their addresses.
    std::map<std::uintptr_t, std::size_t> pending_;  ///< Of a block: address / its size.
    std::size_t counted_ = 0, drops_ = 0;
};

}  // namespace crevice::gltf
