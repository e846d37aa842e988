// Internal to the glTF loader: gives the file's bytes back to the system as meshes are made of them, so that a big
// scene is not in memory twice.
#pragma once

#include <map>
#include <vector>

#include "scene/GltfParts.h"

namespace crevice::gltf {

/// Counts for each block of the file's bytes how often primitives will still read it; at zero it is given back. What
/// anything else reads, pictures and matrices, stays.
class Release {
public:
    /// Of small files nothing is given back.
    explicit Release(File& file);
    /// `times`: how often each mesh will be read. To be called once, before the first is.
    void expect(const std::map<int, std::size_t>& times);

private:
    /// Bytes that are read together, and what is not yet done with of them.
    struct Range {
        const std::byte *begin, *end;
        std::size_t stride;    ///< Of attributes; 0: others, which are read as a whole.
        std::uintptr_t block;  ///< The next one.
    };

public:
    /// One reading of a primitive; when it ends, so does the need for its bytes.
    class Reading {
    public:
        Reading(Release& release, const PrimitivePart& primitive);
        ~Reading() { passed(std::size_t(-1)); }
        Reading(const Reading&) = delete;
        Reading& operator=(const Reading&) = delete;
        /// Attributes below that element are not read again.
        void passed(std::size_t element);

    private:
        Release& release_;
        std::vector<Range> ranges_;
    };

private:
    std::vector<Range> rangesOf(const PrimitivePart& primitive) const;
    void addView(int view, std::vector<Range>& ranges) const;
    void addAccessor(int accessor, bool isAttribute, std::vector<Range>& ranges) const;
    void pin();
    /// False: too many blocks to count.
    bool count(const Range& range, std::size_t times);
    void drop(std::uintptr_t block, const std::byte* within);

    File& file_;
    bool active_ = false;
    std::map<std::uintptr_t, std::size_t> pending_;  ///< Of a block: address / its size.
    std::size_t counted_ = 0;
};

}  // namespace crevice::gltf
