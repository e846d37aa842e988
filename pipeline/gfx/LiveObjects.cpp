// Names and text of the object counters.
#include "gfx/LiveObjects.h"

#include <fmt/format.h>

namespace crevice {

const char* objectKindName(ObjectKind kind) {
    static constexpr std::array<const char*, kObjectKindCount> kNames = {
        "images",           "image views", "buffers",          "samplers",        "pipelines",
        "pipeline layouts", "set layouts", "descriptor pools", "descriptor sets", "command pools",
        "fences",           "query pools", "allocations",      "memory blocks"};
    return kNames[static_cast<std::size_t>(kind)];
}

std::string LiveObjects::text() const {
    std::string text;
    for (std::size_t i = 0; i < kObjectKindCount; ++i) {
        if (counts[i] != 0) text += fmt::format("{} {}, ", objectKindName(static_cast<ObjectKind>(i)), counts[i]);
    }
    return text + fmt::format("memory {} bytes", memoryBytes);
}

}  // namespace crevice
