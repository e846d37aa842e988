// Internal to the scene importer: what an instance of a prefab changes in its nodes and components, adds and removes.
#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "cocos/assets/ObjectGraph.h"

namespace crevice::cocos {

/// A cc.PrefabInstance. What it changes is named by a target: the fileIds of the instances on the way into prefabs
/// inside of the prefab, each with a '\n' behind it, and the fileId of the node or component.
class PrefabOverrides {
public:
    PrefabOverrides() = default;
    /// `graph`: of the file that holds the instance; it must outlive this, as what is mounted lies in it.
    PrefabOverrides(const ObjectGraph& graph, const Value& instance, Problems& problems);

    /// Writes the changes of that node or component into `object`. Paths may lead through objects and into lists
    /// ("_materials", "0"), one step behind their end at most.
    void apply(const std::string& target, Value& object);
    bool has(const std::string& target) const { return changes_.find(target) != changes_.end(); }
    /// True for a component that the instance takes away.
    bool removes(const std::string& target) const { return removed_.contains(target); }
    /// Nodes that the instance hangs below that node, and components that it adds to it.
    const std::vector<const Value*>& children(const std::string& target);
    const std::vector<const Value*>& components(const std::string& target);
    /// Whether anything but the fields of `target` itself is changed behind `prefix`.
    bool reachesBeside(const std::string& prefix, const std::string& target) const;
    /// How many changes were not applied: to what is not there, or with a value that cannot be copied.
    std::size_t left() const;

private:
    struct Change {
        std::vector<std::string> path{};
        Value value{};
        bool used = false;
    };
    struct Mounted {
        std::vector<const Value*> objects{};
        bool used = false;
    };
    using MountedMap = std::map<std::string, Mounted>;
    void readChanges(const ObjectGraph& graph, const Value* list, Problems& problems);
    static const std::vector<const Value*>& take(MountedMap& map, const std::string& target);

    std::multimap<std::string, Change> changes_;
    MountedMap children_, components_;
    std::set<std::string> removed_;
    std::size_t unread_ = 0;
};

/// An instance that the walk is inside of.
struct PrefabScope {
    PrefabOverrides* changes = nullptr;
    const ObjectGraph* graph = nullptr;  ///< Of the file that holds the instance.
    std::string prefix{};                ///< Of targets here: the instances between it and here.
};
/// Innermost first: what outer instances say comes later and counts.
using PrefabScopes = std::vector<PrefabScope>;

/// Inside of an instance with this fileId, which lies inside of `outer`.
PrefabScopes enterInstance(const PrefabScopes& outer, PrefabOverrides& own, const ObjectGraph& graph,
                           const std::string& instanceId);

/// The object, or `copy` filled with it and all changes of these scopes.
const Value& withChanges(const PrefabScopes& scopes, const std::string& fileId, const Value& object, Value& copy);
bool isRemoved(const PrefabScopes& scopes, const std::string& fileId);

/// The fileId in the object's prefab information ("_prefab" of a node, "__prefab" of a component); empty without one.
std::string prefabIdOf(const ObjectGraph& graph, const Value& object, const char* key, Problems& problems);

}  // namespace crevice::cocos
