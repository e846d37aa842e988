// The files Cocos' editor writes (.rpp, .mtl, .scene, .prefab): a list of objects that name each other by place.
#pragma once

#include <filesystem>
#include <initializer_list>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/Document.h"

namespace crevice::cocos {

/// A reference to an asset as written; empty = null.
struct AssetRef {
    std::string uuid;  ///< Normal form (Uuid.h), or the text as written when it is none.
    std::string expectedType{};
    SourceLoc where{};
    explicit operator bool() const { return !uuid.empty(); }
};

/// True for { "__uuid__": … }.
bool isAssetRef(const Value& value);
AssetRef readAssetRef(const Value& value);

/// `__type__` of an object, "" without one.
std::string typeOf(const Value& object);

/// Either form of a file: the list in which { "__id__": n } names element n, or one object that stands alone.
class ObjectGraph {
public:
    /// Throws Error when the file cannot be read, is no JSON, or is neither of the two forms.
    static ObjectGraph read(const std::filesystem::path& path, const DocumentLimits& limits = {});
    static ObjectGraph parse(std::string_view text, const std::string& file, const DocumentLimits& limits = {});

    const Value& root() const { return *objects_.front(); }
    std::size_t size() const { return objects_.size(); }
    /// The object that a value stands for: itself when it is written in place, the one that its `__id__` names else.
    /// Null for null, and after an error in `problems` (no such object, not an object). `what` names the value.
    const Value* resolve(const Value& value, const std::string& what, Problems& problems) const;
    /// Every object of a list of references; null ones are left out.
    std::vector<const Value*> resolveList(const Value* list, const std::string& what, Problems& problems) const;

private:
    std::unique_ptr<Value> document_;  // objects_ point into it, also after a move
    std::vector<const Value*> objects_;
};

/// Reads plain fields of one object; missing ones and null keep the default, wrong types are errors.
class FieldReader {
public:
    FieldReader(const Value& object, Problems& problems) : object_(object), problems_(problems) {}
    double number(std::string_view key, double otherwise) const;  ///< One that a float holds; others are errors.
    std::int64_t integer(std::string_view key, std::int64_t otherwise) const;
    bool boolean(std::string_view key, bool otherwise) const;
    std::string text(std::string_view key, std::string otherwise = {}) const;
    /// A list, or null when it is missing or null.
    const Value* list(std::string_view key) const;
    AssetRef asset(std::string_view key) const;
    const Value* find(std::string_view key) const;
    /// The first of several names that the object has (fields were renamed between versions), else the first.
    std::string_view firstOf(std::initializer_list<std::string_view> keys) const;

private:
    const Value* typed(std::string_view key, bool (Value::*is)() const, const char* wanted) const;
    const Value& object_;
    Problems& problems_;
};

}  // namespace crevice::cocos
