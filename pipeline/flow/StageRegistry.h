// Stage classes by name: factory, priority, help. An object that is passed, never a global.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/Error.h"

namespace crevice {

class RenderStage;

struct StageInfo {
    /// Cocos' order of stages; places an `insert` without before/after. Data-only stages have none.
    std::optional<int> priority;
    std::string help;
};

struct StageClass {
    std::string name;
    StageInfo info;
    std::string origin;  ///< "builtin" or the path of the plugin.
    std::function<std::unique_ptr<RenderStage>()> make;
};

class StageRegistry {
public:
    /// Registers a class. Throws Error naming both origins when the name is taken.
    template <class Stage>
    void add(std::string name, StageInfo info) {
        addClass({std::move(name), std::move(info), origin_, [] { return std::make_unique<Stage>(); }});
    }
    void addClass(StageClass stageClass);

    const StageClass* find(std::string_view name) const;
    /// Throws Error with near names when there is no such class.
    const StageClass& get(std::string_view name, const SourceLoc& where) const;
    /// Sorted by name.
    const std::vector<StageClass>& classes() const { return classes_; }
    std::optional<int> priorityOf(std::string_view name) const;

    /// Classes added from now on come from here: set by the plugin loader.
    void setOrigin(std::string origin) { origin_ = std::move(origin); }

private:
    std::vector<StageClass> classes_;
    std::string origin_ = "builtin";
};

}  // namespace crevice
