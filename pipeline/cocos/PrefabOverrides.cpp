// Values are copied: the prefab's own file stays as it is for its other instances.
#include "cocos/PrefabOverrides.h"

#include <algorithm>
#include <charconv>

namespace crevice::cocos {
namespace {

constexpr std::size_t kMaxPath = 8;

std::vector<std::string> wordsOf(const Value* list) {
    std::vector<std::string> words;
    if (!list) return words;
    for (const Value& item : list->items()) {
        if (item.isString()) words.push_back(item.string());
        if (item.isInteger()) words.push_back(std::to_string(item.integer()));
    }
    return words.size() == list->items().size() ? words : std::vector<std::string>{};
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

bool isReference(const Value& value) { return value.isObject() && value.find("__id__"); }

}  // namespace

PrefabOverrides::PrefabOverrides(const ObjectGraph& graph, const Value& instance, Problems& problems) {
    const Value* list = FieldReader(instance, problems).list("propertyOverrides");
    for (const Value* written : graph.resolveList(list, "'propertyOverrides'", problems)) {
        const FieldReader fields(*written, problems);
        const Value* target = fields.find("targetInfo");
        const Value* info = target ? graph.resolve(*target, "'targetInfo'", problems) : nullptr;
        const Value* ids = info ? info->find("localID") : nullptr;
        const std::vector<std::string> id = wordsOf(ids && ids->isArray() ? ids : nullptr);
        std::vector<std::string> path = wordsOf(fields.list("propertyPath"));
        const Value* value = written->find("value");
        if (path == std::vector<std::string>{"_name"} || path == std::vector<std::string>{"_euler"}) continue;
        if (id.size() != 1 || path.empty() || path.size() > kMaxPath || !value || isReference(*value)) {
            ++deeper_;
            continue;
        }
        changes_.emplace(id.front(), Change{std::move(path), *value});
    }
}

void PrefabOverrides::apply(std::string_view fileId, Value& object) {
    const auto [begin, end] = changes_.equal_range(fileId);
    for (auto it = begin; it != end; ++it) {
        Change& change = it->second;
        Value* at = &object;
        for (const std::string& word : change.path) at = at ? step(*at, word) : nullptr;
        if (at) *at = change.value;
        change.used = change.used || at;
    }
}

std::size_t PrefabOverrides::left() const {
    const auto unused = [](const auto& change) { return !change.second.used; };
    return deeper_ + std::size_t(std::count_if(changes_.begin(), changes_.end(), unused));
}

std::string prefabIdOf(const ObjectGraph& graph, const Value& object, const char* key, Problems& problems) {
    const Value* ref = object.find(key);
    const Value* info = ref && !ref->isNull() ? graph.resolve(*ref, "its prefab", problems) : nullptr;
    return info ? FieldReader(*info, problems).text("fileId") : std::string();
}

}  // namespace crevice::cocos
