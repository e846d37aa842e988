// What the properties of glTF 2.0 and of the extensions that are read may hold: one table per kind of object.
#pragma once

#include <limits>
#include <span>

namespace crevice::gltf {

enum class Shape { Any, Flag, Integer, Number, Text, Index, Object, Numbers, Indices, Objects, IndexMap, IndexMaps };

struct Rule {
    const char* key = "";
    Shape shape = Shape::Number;
    bool required = false;
    double min = -std::numeric_limits<double>::infinity(), max = std::numeric_limits<double>::infinity();
    bool aboveMin = false;            ///< `min` itself is not allowed.
    std::size_t least = 0, most = 0;  ///< Items of a list; most 0 = any number.
    const char* list = nullptr;       ///< Index …: into which list of the document.
    std::span<const Rule> rules{};    ///< Object …: what it may hold.
    bool harmless = false;            ///< A breach changes no picture: a fault.
    std::span<const int> oneOf{};     ///< Integer: which ones there are, unless it is empty.
    const char* words = nullptr;      ///< Text: " A B C ", other words are faults (readers may know more).
};

/// What the document itself may hold.
std::span<const Rule> documentRules();

}  // namespace crevice::gltf
