// Internal to the scene importer: what an instance of a prefab changes in its nodes and components.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "cocos/ObjectGraph.h"

namespace crevice::cocos {

/// The propertyOverrides of a cc.PrefabInstance, by the fileId of the node or component that they change.
class PrefabOverrides {
public:
    PrefabOverrides() = default;
    /// `graph`: of the scene that holds the instance.
    PrefabOverrides(const ObjectGraph& graph, const Value& instance, Problems& problems);

    /// Writes the changes of that node or component into `object`. Paths may lead through objects and into lists
    /// ("_materials", "0"), one step behind their end at most.
    void apply(std::string_view fileId, Value& object);
    bool has(std::string_view fileId) const { return !fileId.empty() && changes_.find(fileId) != changes_.end(); }
    /// How many changes were not applied: to what lies in prefabs inside of the prefab, or is not there.
    std::size_t left() const;

private:
    struct Change {
        std::vector<std::string> path{};
        Value value{};
        bool used = false;
    };
    std::multimap<std::string, Change, std::less<>> changes_;
    std::size_t deeper_ = 0;
};

/// The fileId in the object's prefab information ("_prefab" of a node, "__prefab" of a component); empty without one.
std::string prefabIdOf(const ObjectGraph& graph, const Value& object, const char* key, Problems& problems);

}  // namespace crevice::cocos
