// Values of Cocos' own types (cc.Color, cc.Vec3, cc.Mat4, references) as numbers, words and assets.
#pragma once

#include <string>
#include <vector>

#include "cocos/assets/ObjectGraph.h"
#include "core/Document.h"

namespace crevice::cocos {

struct TypedValue {
    enum class Kind { Null, Bool, Number, Text, Numbers, Asset, List, Other };
    Kind kind = Kind::Null;
    Value plain{};                    ///< Bool, Number, Text; Numbers as a list. Colours are divided by 255.
    AssetRef asset{};                 ///< Asset.
    std::vector<TypedValue> items{};  ///< List.
    std::string type{};               ///< `__type__` of what was read; of Other, too.
    SourceLoc where{};
};

/// cc.Color, cc.Vec2/3/4, cc.Quat, cc.Mat3/4, cc.Size, cc.Rect, assets, plain values and lists of these. A component
/// that is missing is 0 (1 for the alpha of a colour and on the diagonal of a matrix). Objects of other types: Other.
/// Wrong components are errors.
TypedValue readTyped(const Value& value, Problems& problems);

}  // namespace crevice::cocos
