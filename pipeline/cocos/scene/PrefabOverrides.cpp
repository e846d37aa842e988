// Values are copied: the prefab's own file stays as it is for its other instances.
#include "cocos/scene/PrefabOverrides.h"

#include <algorithm>
#include <charconv>

namespace crevice::cocos {
namespace {

constexpr std::size_t kMaxPath = 8;
constexpr std::int64_t kMaxLength = 4096;

std::vector<std::string> wordsOf(const Value* list) {
    std::vector<std::string> words;
    if (!list) return words;
    for (const Value& item : list->items()) {
        if (item.isString()) words.push_back(item.string());
        if (item.isInteger()) words.push_back(std::to_string(item.integer()));
    }
    return words.size() == list->items().size() ? words : std::vector<std::string>{};
}

/// "" for what cannot be read.
std::string targetOf(const ObjectGraph& graph, const Value* written, Problems& problems) {
    const Value* info = written ? graph.resolve(*written, "'targetInfo'", problems) : nullptr;
    const Value* ids = info ? info->find("localID") : nullptr;
    std::string target;
    for (const std::string& id : wordsOf(ids && ids->isArray() ? ids : nullptr)) {
        if (!target.empty()) target += '\n';
        target += id;
    }
    return target;
}

/// The value behind one step of a path, made where a list is one too short; null where there is none.
Value* step(Value& object, const std::string& word) {
    if (object.isObject()) {
        if (!object.find(word)) object.set(word, Value());
        return object.find(word);
    }
    std::size_t index = 0;
    const auto [end, failed] = std::from_chars(word.data(), word.data() + word.size(), index);
    if (!object.isArray() || failed != std::errc{} || end != word.data() + word.size()) return nullptr;
    if (index == object.items().size()) object.items().push_back(Value());
    return index < object.items().size() ? &object.items()[index] : nullptr;
}

bool setLength(Value& list, const Value& length) {
    if (!length.isInteger() || length.integer() < 0 || length.integer() > kMaxLength) return false;
    list.items().resize(std::size_t(length.integer()));
    return true;
}

bool write(Value& object, const std::vector<std::string>& path, const Value& value) {
    Value* at = &object;
    for (const std::string& word : path) {
        if (at->isArray() && word == "length" && &word == &path.back()) return setLength(*at, value);
        at = step(*at, word);
        if (!at) return false;
    }
    *at = value;
    return true;
}

bool hasReferences(const Value& value) {
    if (value.isArray()) return std::any_of(value.items().begin(), value.items().end(), hasReferences);
    if (!value.isObject()) return false;
    return value.find("__id__") || std::any_of(value.members().begin(), value.members().end(),
                                               [](const Member& member) { return hasReferences(member.value); });
}

/// Objects of the instance's file are copied where they lead to no others; null for those that do.
const Value* copyable(const ObjectGraph& graph, const Value* value, Problems& problems) {
    if (value && value->isObject() && value->find("__id__")) value = graph.resolve(*value, "'value'", problems);
    return value && !hasReferences(*value) ? value : nullptr;
}

}  // namespace

PrefabOverrides::PrefabOverrides(const ObjectGraph& graph, const Value& instance, Problems& problems) {
    const FieldReader fields(instance, problems);
    readChanges(graph, fields.list("propertyOverrides"), problems);
    const auto readMounted = [&](const char* key, const char* objects, MountedMap& map) {
        for (const Value* info : graph.resolveList(fields.list(key), key, problems)) {
            const FieldReader mounted(*info, problems);
            Mounted& entry = map[targetOf(graph, mounted.find("targetInfo"), problems)];
            for (const Value* object : graph.resolveList(mounted.list(objects), objects, problems))
                entry.objects.push_back(object);
        }
    };
    readMounted("mountedChildren", "nodes", children_);
    readMounted("mountedComponents", "components", components_);
    if (const Value* removed = fields.list("removedComponents"))
        for (const Value& target : removed->items()) removed_.insert(targetOf(graph, &target, problems));
}

void PrefabOverrides::readChanges(const ObjectGraph& graph, const Value* list, Problems& problems) {
    for (const Value* written : graph.resolveList(list, "'propertyOverrides'", problems)) {
        const FieldReader fields(*written, problems);
        const std::string target = targetOf(graph, fields.find("targetInfo"), problems);
        std::vector<std::string> path = wordsOf(fields.list("propertyPath"));
        if (path == std::vector<std::string>{"_euler"}) continue;  // the editor's; _lrot says the same
        const Value* value = copyable(graph, written->find("value"), problems);
        if (target.empty() || path.empty() || path.size() > kMaxPath || !value) {
            ++unread_;
            continue;
        }
        // A name changes nothing in the picture, wherever it is.
        const bool named = path == std::vector<std::string>{"_name"};
        changes_.emplace(target, Change{std::move(path), *value, named});
    }
}

void PrefabOverrides::apply(const std::string& target, Value& object) {
    const auto [begin, end] = changes_.equal_range(target);
    for (auto it = begin; it != end; ++it)
        it->second.used = write(object, it->second.path, it->second.value) || it->second.used;
}

const std::vector<const Value*>& PrefabOverrides::take(MountedMap& map, const std::string& target) {
    static const std::vector<const Value*> kNone;
    const auto found = map.find(target);
    if (found == map.end()) return kNone;
    found->second.used = true;
    return found->second.objects;
}

const std::vector<const Value*>& PrefabOverrides::children(const std::string& target) {
    return take(children_, target);
}

const std::vector<const Value*>& PrefabOverrides::components(const std::string& target) {
    return take(components_, target);
}

bool PrefabOverrides::reachesBeside(const std::string& prefix, const std::string& target) const {
    const auto inside = [&](const auto& entry) { return entry.first.starts_with(prefix); };
    const auto beside = [&](const auto& entry) { return inside(entry) && entry.first != target; };
    return std::any_of(changes_.begin(), changes_.end(), beside) ||
           std::any_of(children_.begin(), children_.end(), inside) ||
           std::any_of(components_.begin(), components_.end(), inside) ||
           std::any_of(removed_.begin(), removed_.end(),
                       [&](const std::string& removed) { return removed.starts_with(prefix); });
}

std::size_t PrefabOverrides::left() const {
    std::size_t count = unread_;
    for (const auto& [target, change] : changes_) count += !change.used;
    for (const MountedMap* map : {&children_, &components_})
        for (const auto& [target, mounted] : *map) count += mounted.used ? 0 : mounted.objects.size();
    return count;
}

PrefabScopes enterInstance(const PrefabScopes& outer, PrefabOverrides& own, const ObjectGraph& graph,
                           const std::string& instanceId) {
    PrefabScopes scopes = {{&own, &graph, {}}};
    for (const PrefabScope& scope : outer)
        scopes.push_back({scope.changes, scope.graph, scope.prefix + instanceId + '\n'});
    return scopes;
}

const Value& withChanges(const PrefabScopes& scopes, const std::string& fileId, const Value& object, Value& copy) {
    bool changed = false;
    for (const PrefabScope& scope : scopes) {
        const std::string target = scope.prefix + fileId;
        if (fileId.empty() || !scope.changes->has(target)) continue;
        if (!changed) copy = object;
        changed = true;
        scope.changes->apply(target, copy);
    }
    return changed ? copy : object;
}

bool isRemoved(const PrefabScopes& scopes, const std::string& fileId) {
    return !fileId.empty() && std::any_of(scopes.begin(), scopes.end(), [&](const PrefabScope& scope) {
        return scope.changes->removes(scope.prefix + fileId);
    });
}

std::string prefabIdOf(const ObjectGraph& graph, const Value& object, const char* key, Problems& problems) {
    const Value* ref = object.find(key);
    const Value* info = ref && !ref->isNull() ? graph.resolve(*ref, "its prefab", problems) : nullptr;
    return info ? FieldReader(*info, problems).text("fileId") : std::string();
}

}  // namespace crevice::cocos
