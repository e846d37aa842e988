// Follows `__id__` with every step checked: files are edited by hand and merged by machines.
#include "cocos/assets/ObjectGraph.h"

#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "cocos/files/Uuid.h"
#include "core/Files.h"

namespace crevice::cocos {
namespace {

constexpr int kMaxSteps = 16;

Error notAGraph(const Value& value) {
    return Error(value.where(), fmt::format("this is no file of Cocos' editor: it must hold objects with '__type__'"),
                 "a list of objects, or one object");
}

}  // namespace

bool isAssetRef(const Value& value) {
    const Value* uuid = value.isObject() ? value.find("__uuid__") : nullptr;
    return uuid && uuid->isString();
}

AssetRef readAssetRef(const Value& value) {
    if (!isAssetRef(value)) return {};
    const Value& uuid = *value.find("__uuid__");
    AssetRef ref{.uuid = normalizeUuid(uuid.string()).value_or(uuid.string()), .where = uuid.where()};
    const Value* type = value.find("__expectedType__");
    if (type && type->isString()) ref.expectedType = type->string();
    return ref;
}

std::string typeOf(const Value& object) {
    const Value* type = object.isObject() ? object.find("__type__") : nullptr;
    return type && type->isString() ? type->string() : std::string();
}

ObjectGraph ObjectGraph::read(const std::filesystem::path& path, const DocumentLimits& limits) {
    return parse(readText(path, limits.maxBytes), path.string(), limits);
}

ObjectGraph ObjectGraph::parse(std::string_view text, const std::string& file, const DocumentLimits& limits) {
    ObjectGraph graph;
    graph.document_ = std::make_unique<Value>(parseJson(text, file, limits));
    const Value& document = *graph.document_;
    if (document.isArray()) {
        for (const Value& object : document.items()) graph.objects_.push_back(&object);
    } else {
        graph.objects_.push_back(&document);
    }
    if (graph.objects_.empty() || typeOf(graph.root()).empty()) throw notAGraph(document);
    return graph;
}

const Value* ObjectGraph::resolve(const Value& value, const std::string& what, Problems& problems) const {
    const Value* at = &value;
    for (int step = 0; step < kMaxSteps; ++step) {
        if (at->isNull()) return nullptr;
        if (!at->isObject()) {
            problems.error(at->where(), fmt::format("{} must be an object, not {}", what, at->typeName()),
                           R"(write { "__id__": N }, N counted from 0 in this file's list)");
            return nullptr;
        }
        const Value* id = at->find("__id__");
        if (!id) return at;
        const bool inRange =
            id->isInteger() && id->integer() >= 0 && static_cast<std::uint64_t>(id->integer()) < objects_.size();
        if (!inRange) {
            problems.error(id->where(),
                           fmt::format("{} is object {}, but this file has {}", what,
                                       id->isString() ? "'" + id->string() + "'" : id->toJson(-1), objects_.size()),
                           fmt::format("objects count from 0 to {}", objects_.size() - 1));
            return nullptr;
        }
        at = objects_[static_cast<std::size_t>(id->integer())];
    }
    problems.error(value.where(), fmt::format("{} is named in a circle: its '__id__' never ends at an object", what),
                   "let '__id__' name an object with '__type__'");
    return nullptr;
}

std::vector<const Value*> ObjectGraph::resolveList(const Value* list, const std::string& what,
                                                   Problems& problems) const {
    std::vector<const Value*> objects;
    if (!list) return objects;
    for (std::size_t i = 0; i < list->items().size(); ++i) {
        const Value* object = resolve(list->items()[i], fmt::format("item {} of {}", i, what), problems);
        if (object) objects.push_back(object);
    }
    return objects;
}

const Value* FieldReader::find(std::string_view key) const {
    const Value* value = object_.isObject() ? object_.find(key) : nullptr;
    return value && !value->isNull() ? value : nullptr;
}

const Value* FieldReader::typed(std::string_view key, bool (Value::*is)() const, const char* wanted) const {
    const Value* value = find(key);
    if (!value || (value->*is)()) return value;
    problems_.error(value->where(), fmt::format("'{}' must be {}, not {}", key, wanted, value->typeName()),
                    "save the file again in Cocos Creator, or correct it by hand");
    return nullptr;
}

double FieldReader::number(std::string_view key, double otherwise) const {
    const Value* value = typed(key, &Value::isNumber, "a number");
    if (!value) return otherwise;
    if (fitsFloat(value->number())) return value->number();
    problems_.error(value->where(), fmt::format("'{}' is {}, more than a float holds", key, value->toJson(-1)),
                    "write a number that can be computed with");
    return otherwise;
}

std::int64_t FieldReader::integer(std::string_view key, std::int64_t otherwise) const {
    const Value* value = typed(key, &Value::isNumber, "a whole number");
    if (!value) return otherwise;
    if (value->isInteger()) return value->integer();
    const double written = value->number();
    if (written == std::floor(written) && std::abs(written) < 1e15) return static_cast<std::int64_t>(written);
    problems_.error(value->where(), fmt::format("'{}' must be a whole number", key), "remove the fraction");
    return otherwise;
}

bool FieldReader::boolean(std::string_view key, bool otherwise) const {
    const Value* value = typed(key, &Value::isBool, "true or false");
    return value ? value->boolean() : otherwise;
}

std::string FieldReader::text(std::string_view key, std::string otherwise) const {
    const Value* value = typed(key, &Value::isString, "a string");
    return value ? value->string() : std::move(otherwise);
}

const Value* FieldReader::list(std::string_view key) const { return typed(key, &Value::isArray, "a list"); }

AssetRef FieldReader::asset(std::string_view key) const {
    const Value* value = find(key);
    if (!value) return {};
    if (isAssetRef(*value)) return readAssetRef(*value);
    problems_.error(value->where(), fmt::format("'{}' must be an asset or null, not {}", key, value->typeName()),
                    R"(write { "__uuid__": "…" })");
    return {};
}

std::string_view FieldReader::firstOf(std::initializer_list<std::string_view> keys) const {
    for (const std::string_view key : keys) {
        if (find(key)) return key;
    }
    return *keys.begin();
}

}  // namespace crevice::cocos
