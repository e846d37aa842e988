// The macros of a shader: found in its conditions, described by `#pragma define-meta`, given values before compilation.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/Error.h"

namespace crevice {

struct FlatSource;

/// Macro values as text: "1", "0", "3", "v_uv". Bools are "1" / "0".
using Defines = std::map<std::string, std::string, std::less<>>;

enum class DefineType { Bool, Number, String };

/// A macro that a shader tests or that `#pragma define-meta` declares.
struct DefineInfo {
    std::string name;
    DefineType type = DefineType::Bool;
    std::optional<std::pair<int, int>> range;  ///< Number: both ends allowed.
    std::vector<std::string> options;          ///< String: the allowed texts; the first is the default.
    std::string defaultValue = "0";
    SourceLoc where;          ///< First condition that tests it, or its define-meta.
    bool described = false;   ///< Has a define-meta: values are checked against it.
    bool tested = false;      ///< By #if or #elif as a value: must always be defined.
    bool ownDefault = false;  ///< The text has `#ifndef NAME` / `#define NAME`: defined only when given.
};

/// Macros of the given stages together, in order of first appearance.
std::vector<DefineInfo> findDefines(const std::vector<const FlatSource*>& stages, Problems& problems);

/// Checks a value against what is known of a macro; reports at `where`.
void checkDefine(const DefineInfo& info, const std::string& value, const SourceLoc& where, Problems& problems);

/// The `#define` lines for all macros: the given values, else defaults. A macro tested only by #ifdef and friends is
/// left undefined while its value is "0", so that `#ifdef NAME` means what it says.
std::string defineLines(const std::vector<DefineInfo>& infos, const Defines& values);

/// Empties the lines of define-meta pragmas, which no GLSL compiler knows; the number of lines stays.
std::string withoutDefineMeta(const FlatSource& source);

}  // namespace crevice
