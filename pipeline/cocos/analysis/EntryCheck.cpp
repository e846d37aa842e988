// Looks for the entry's name as a word; what stands in front of it and a bracket behind it make it a function.
#include "cocos/analysis/EntryCheck.h"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "cocos/text/SourceText.h"
#include "core/Text.h"

namespace crevice::cocos {
namespace {

constexpr std::array<std::string_view, 12> kOtherTypes = {"void", "bool",  "int",   "uint", "float", "vec2",
                                                          "vec3", "ivec4", "uvec4", "mat4", "mat3",  "mat2"};

bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\n'; }

/// What stands in front of each "NAME(", and whether the name occurs at all.
struct Occurrences {
    std::vector<std::string_view> types;
    bool any = false;
};

Occurrences findFunction(std::string_view text, std::string_view name) {
    Occurrences found;
    for (std::size_t at = text.find(name); at != std::string_view::npos; at = text.find(name, at + name.size())) {
        std::size_t end = at + name.size();
        if ((at > 0 && isNamePart(text[at - 1])) || (end < text.size() && isNamePart(text[end]))) continue;
        found.any = true;
        while (end < text.size() && isBlank(text[end])) ++end;
        const std::string_view type = nameBefore(text, at);
        if (end < text.size() && text[end] == '(' && !type.empty()) found.types.push_back(type);
    }
    return found;
}

/// Names in front of "(" that follow a name: functions, for the help.
std::vector<std::string> functionsOf(std::string_view text) {
    std::vector<std::string> names;
    for (std::size_t at = text.find('('); at != std::string_view::npos; at = text.find('(', at + 1)) {
        const std::string_view name = nameBefore(text, at);
        if (name.empty() || !isNameStart(name.front())) continue;
        const std::string_view type = nameBefore(text, static_cast<std::size_t>(name.data() - text.data()));
        if (type.empty() || type == "return" || type == "else" || type == "define") continue;
        names.emplace_back(name);
    }
    return names;
}

}  // namespace

void checkEntry(std::string_view text, const ProgramReference& program, ShaderStageBits stage, const SourceLoc& where,
                Problems& problems) {
    const Occurrences found = findFunction(text, program.entry);
    if (!found.any && text.find("##") == std::string_view::npos) {
        const auto near = nearestNames(program.entry, functionsOf(text), 1);
        problems.error(where, fmt::format("program '{}' has no function '{}'", program.program, program.entry),
                       near.empty() ? "a pass names its programs as 'program:function'"
                                    : fmt::format("did you mean '{}'?", near.front()));
        return;
    }
    const auto isOther = [](std::string_view type) {
        return std::find(kOtherTypes.begin(), kOtherTypes.end(), type) != kOtherTypes.end();
    };
    const bool wrong = !found.types.empty() && std::all_of(found.types.begin(), found.types.end(), isOther);
    if (stage == kComputeBit || !wrong) return;
    problems.error(where,
                   fmt::format("function '{}' returns {}, not the vec4 that the stage results in", program.entry,
                               found.types.front()),
                   stage == kVertexBit
                       ? "an entry of 'vert' returns the position: vec4"
                       : "an entry of 'frag' returns the colour: vec4; or write main() and leave the entry out");
}

}  // namespace crevice::cocos
