// One table says which components each of Cocos' types has.
#include "cocos/assets/TypedValue.h"

#include <cmath>

#include <fmt/format.h>

namespace crevice::cocos {
namespace {

constexpr int kMaxDepth = 16;

struct NumberType {
    const char* name;
    std::vector<const char*> components;
    double scale = 1;
    std::vector<double> missing{};  ///< Empty = zeros.
};

const std::vector<NumberType>& numberTypes() {
    static const std::vector<NumberType> kTypes = {
        {"cc.Color", {"r", "g", "b", "a"}, 1.0 / 255, {0, 0, 0, 255}},
        {"cc.Vec2", {"x", "y"}},
        {"cc.Vec3", {"x", "y", "z"}},
        {"cc.Vec4", {"x", "y", "z", "w"}},
        {"cc.Quat", {"x", "y", "z", "w"}, 1, {0, 0, 0, 1}},
        {"cc.Size", {"width", "height"}},
        {"cc.Rect", {"x", "y", "width", "height"}},
        {"cc.Mat3", {"m00", "m01", "m02", "m03", "m04", "m05", "m06", "m07", "m08"}, 1, {1, 0, 0, 0, 1, 0, 0, 0, 1}},
        {"cc.Mat4",
         {"m00", "m01", "m02", "m03", "m04", "m05", "m06", "m07", "m08", "m09", "m10", "m11", "m12", "m13", "m14",
          "m15"},
         1,
         {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}},
    };
    return kTypes;
}

Value readNumbers(const Value& object, const NumberType& type, Problems& problems) {
    Value list = Value::makeArray(object.where());
    for (std::size_t i = 0; i < type.components.size(); ++i) {
        const Value* written = object.find(type.components[i]);
        double number = type.missing.empty() ? 0 : type.missing[i];
        if (written && !written->isNull()) {
            if (!written->isNumber() || !std::isfinite(written->number())) {
                problems.error(written->where(),
                               fmt::format("'{}' of a {} must be a number, not {}", type.components[i], type.name,
                                           written->typeName()),
                               "write a number");
            } else if (!fitsFloat(written->number())) {
                problems.error(written->where(),
                               fmt::format("'{}' of a {} is {}, more than a float holds", type.components[i], type.name,
                                           written->toJson(-1)),
                               "write a number that a shader can compute with");
            } else {
                number = written->number();
            }
        }
        list.items().push_back(Value::makeNumber(number * type.scale, written ? written->where() : object.where()));
    }
    return list;
}

TypedValue readObject(const Value& value, Problems& problems) {
    TypedValue typed{.type = typeOf(value), .where = value.where()};
    if (isAssetRef(value)) {
        typed.kind = TypedValue::Kind::Asset;
        typed.asset = readAssetRef(value);
        return typed;
    }
    typed.kind = TypedValue::Kind::Other;
    for (const NumberType& type : numberTypes()) {
        if (typed.type != type.name) continue;
        typed.kind = TypedValue::Kind::Numbers;
        typed.plain = readNumbers(value, type, problems);
    }
    return typed;
}

TypedValue readAt(const Value& value, Problems& problems, int depth) {
    using Kind = TypedValue::Kind;
    TypedValue typed{.plain = value, .where = value.where()};
    switch (value.type()) {
        case Value::Type::Null:
            return typed;
        case Value::Type::Bool:
            typed.kind = Kind::Bool;
            return typed;
        case Value::Type::Number:
            typed.kind = Kind::Number;
            return typed;
        case Value::Type::String:
            typed.kind = Kind::Text;
            return typed;
        case Value::Type::Object:
            return readObject(value, problems);
        case Value::Type::Array:
            break;
    }
    typed.kind = Kind::List;
    typed.plain = {};
    if (depth > kMaxDepth) {
        problems.error(value.where(), fmt::format("a list nested deeper than {} levels", kMaxDepth), "flatten it");
        return typed;
    }
    for (const Value& item : value.items()) typed.items.push_back(readAt(item, problems, depth + 1));
    return typed;
}

}  // namespace

TypedValue readTyped(const Value& value, Problems& problems) { return readAt(value, problems, 0); }

}  // namespace crevice::cocos
