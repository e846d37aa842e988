// Keeps stage classes sorted by name and refuses duplicates with both origins.
#include "flow/StageRegistry.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/Text.h"
#include "flow/RenderStage.h"

namespace crevice {

void StageRegistry::addClass(StageClass stageClass) {
    if (const StageClass* first = find(stageClass.name)) {
        throw Error(fmt::format("stage class '{}' of {} is already registered by {}", stageClass.name,
                                stageClass.origin, first->origin),
                    "rename one of the two classes, or load only one of the plugins");
    }
    const auto place = std::lower_bound(classes_.begin(), classes_.end(), stageClass.name,
                                        [](const StageClass& a, const std::string& name) { return a.name < name; });
    classes_.insert(place, std::move(stageClass));
}

const StageClass* StageRegistry::find(std::string_view name) const {
    const auto found =
        std::find_if(classes_.begin(), classes_.end(), [&](const StageClass& c) { return c.name == name; });
    return found == classes_.end() ? nullptr : &*found;
}

const StageClass& StageRegistry::get(std::string_view name, const SourceLoc& where) const {
    if (const StageClass* stageClass = find(name)) return *stageClass;
    std::vector<std::string> names;
    for (const StageClass& c : classes_) names.push_back(c.name);
    throw Error(where, fmt::format("no stage class is registered under '{}'", name),
                didYouMean(name, names, "classes") + "; a class of a plugin needs --plugin FILE.so");
}

std::optional<int> StageRegistry::priorityOf(std::string_view name) const {
    const StageClass* stageClass = find(name);
    return stageClass ? stageClass->info.priority : std::nullopt;
}

}  // namespace crevice
