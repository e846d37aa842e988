// How much a scene may ask for before it is refused: one list of limits, for code, `--limit` and the documents.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace crevice {

/// Memory stays bounded because everything a scene can make grow has its line here. (Documents of pipelines and effects
/// have fixed limits: DocumentLimits, IncludeLimits.)
struct Limits {
    std::size_t maxFileBytes = std::size_t(2) << 30;
    std::size_t maxDocumentValues = 8'000'000;
    int maxDocumentDepth = 200;
    std::size_t maxVertices = 100'000'000;
    std::size_t maxInstances = 1'000'000;
    int maxNodeDepth = 256;
    std::uint32_t maxImageSide = 16384;
    std::size_t maxImagePixels = std::size_t(1) << 28;
    std::size_t maxImageBytes = std::size_t(4) << 30;
};

/// One limit as people see it.
struct LimitInfo {
    const char* name;
    const char* unit;
    const char* help;
};

/// Calls `visit(field, LimitInfo)` for each limit: the one list.
template <class AnyLimits, class Visit>
void visitLimits(AnyLimits& limits, Visit visit) {
    visit(limits.maxFileBytes, LimitInfo{"file-bytes", "bytes", "Each file, and all buffers of a scene together"});
    visit(limits.maxDocumentValues, LimitInfo{"document-values", "values", "Values in the JSON of a scene"});
    visit(limits.maxDocumentDepth, LimitInfo{"document-depth", "levels", "Nesting of the JSON of a scene"});
    visit(limits.maxVertices,
          LimitInfo{"vertices", "vertices", "Over all meshes of a scene; indices: six times as many"});
    visit(limits.maxInstances, LimitInfo{"instances", "instances", "Meshes that a scene shows"});
    visit(limits.maxNodeDepth, LimitInfo{"node-depth", "levels", "Nesting of a glTF's nodes"});
    visit(limits.maxImageSide, LimitInfo{"image-side", "pixels", "Width and height of a picture that is read"});
    visit(limits.maxImagePixels, LimitInfo{"image-pixels", "pixels", "Each picture that is read"});
    visit(limits.maxImageBytes, LimitInfo{"image-bytes", "bytes", "All decoded pictures of a scene together"});
}

/// Sets one limit from "NAME=VALUE". VALUE is a whole number from 1, with K, M or G behind it for thousands, millions
/// and milliards (bytes: KiB, MiB, GiB). Throws Error: no such limit, no such number, more than the limit's type holds.
void setLimit(Limits& limits, std::string_view text);

/// A value as setLimit() reads it, as short as it is exact: "64M".
std::string limitText(std::size_t value, std::string_view unit);

/// The end of a message about a limit: "raise it with --limit vertices=N if you trust the file".
std::string raiseLimit(std::string_view name);

}  // namespace crevice
