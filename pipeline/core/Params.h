// One list of fields per parameter set: it drives reading, range and unknown-key checks, --set, JSON Schema and docs.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "core/Document.h"

namespace crevice {

/// What is known of a field besides its type. Ranges are inclusive and hold per component.
struct FieldInfo {
    double min = -std::numeric_limits<double>::infinity();
    double max = std::numeric_limits<double>::infinity();
    const char* unit = "";
    const char* help = "";
};

/// Walks the fields of a parameter set. A set lists its fields once, in a function that takes a visitor.
class ParamVisitor {
public:
    virtual ~ParamVisitor() = default;
    virtual void field(const char* key, bool& value, const FieldInfo& info) = 0;
    virtual void field(const char* key, std::int32_t& value, const FieldInfo& info) = 0;
    virtual void field(const char* key, std::uint32_t& value, const FieldInfo& info) = 0;
    virtual void field(const char* key, float& value, const FieldInfo& info) = 0;
    virtual void field(const char* key, glm::vec2& value, const FieldInfo& info) = 0;
    virtual void field(const char* key, glm::vec3& value, const FieldInfo& info) = 0;
    virtual void field(const char* key, glm::vec4& value, const FieldInfo& info) = 0;
    virtual void field(const char* key, std::string& value, const FieldInfo& info) = 0;
    /// One of `names`; `value` is the index.
    virtual void choice(const char* key, int& value, std::span<const char* const> names, const FieldInfo& info) = 0;
};

/// Reads fields from an object. Wrong types, values out of range and (in finish) unknown keys go to `problems`.
/// `what` names the set in messages: "params of stage 'SsaoStage'".
class ParamReader final : public ParamVisitor {
public:
    ParamReader(const Value& object, std::string what, Problems& problems);
    void field(const char* key, bool& value, const FieldInfo& info) override;
    void field(const char* key, std::int32_t& value, const FieldInfo& info) override;
    void field(const char* key, std::uint32_t& value, const FieldInfo& info) override;
    void field(const char* key, float& value, const FieldInfo& info) override;
    void field(const char* key, glm::vec2& value, const FieldInfo& info) override;
    void field(const char* key, glm::vec3& value, const FieldInfo& info) override;
    void field(const char* key, glm::vec4& value, const FieldInfo& info) override;
    void field(const char* key, std::string& value, const FieldInfo& info) override;
    void choice(const char* key, int& value, std::span<const char* const> names, const FieldInfo& info) override;

    /// Names a key that is read elsewhere, so that finish() knows it. Returns its value or null.
    const Value* take(const char* key);
    /// Reports every key that no field named, with near names.
    void finish();

private:
    const Value* lookUp(const char* key);
    template <class Number>
    void readNumber(const char* key, Number& value, const FieldInfo& info);
    template <int N, class Vec>
    void readVector(const char* key, Vec& value, const FieldInfo& info);

    const Value& object_;
    std::string what_;
    Problems& problems_;
    std::vector<std::string> known_;
};

/// A field as documentation shows it.
struct ParamRow {
    std::string key;
    std::string type;          ///< "bool", "int", "uint", "float", "vec2"…, "string", "a | b | c"
    std::string defaultValue;  ///< JSON text of the value the visitor saw
    std::string range;         ///< "0 … 1", "≥ 0", "" when unlimited
    std::string unit;
    std::string help;
    Value schema;  ///< JSON Schema of the field
};

/// Collects the fields of a set with their present values as defaults: for `crevice stages`, docs and the schema.
class ParamTable final : public ParamVisitor {
public:
    void field(const char* key, bool& value, const FieldInfo& info) override;
    void field(const char* key, std::int32_t& value, const FieldInfo& info) override;
    void field(const char* key, std::uint32_t& value, const FieldInfo& info) override;
    void field(const char* key, float& value, const FieldInfo& info) override;
    void field(const char* key, glm::vec2& value, const FieldInfo& info) override;
    void field(const char* key, glm::vec3& value, const FieldInfo& info) override;
    void field(const char* key, glm::vec4& value, const FieldInfo& info) override;
    void field(const char* key, std::string& value, const FieldInfo& info) override;
    void choice(const char* key, int& value, std::span<const char* const> names, const FieldInfo& info) override;

    const std::vector<ParamRow>& rows() const { return rows_; }
    /// `{ "type": "object", "additionalProperties": false, "properties": { … } }`
    Value schema() const;

private:
    std::vector<ParamRow> rows_;
};

}  // namespace crevice
