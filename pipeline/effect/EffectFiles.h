// Which file an effect's name means, and who reads it.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/Document.h"
#include "core/Files.h"
#include "effect/EffectFrontEnd.h"

namespace crevice {

using FrontEnds = std::vector<std::unique_ptr<EffectFrontEnd>>;

/// A file and who reads it; null = the library itself does.
struct FoundEffect {
    std::filesystem::path path;
    EffectFrontEnd* reader = nullptr;
};

/// A name below effects/, or a path that ends with .effect: relative to the document that asks, else to the current
/// folder. Front ends come first, in their order; by the end of a path they are asked only for what our own effects do
/// not have. Throws Error at `where`: no such effect (with near names), a path outside of the asset folders.
FoundEffect findEffect(const AssetRoots& roots, const FrontEnds& frontEnds, const std::string& effect,
                       const SourceLoc& where);

/// Full names of all effects: the front ends' and our own, sorted, each once.
std::vector<std::string> effectNames(const AssetRoots& roots, const FrontEnds& frontEnds);

}  // namespace crevice
