// A type of glslang's is qualifiers, then "N-element array of", then a name, a "vector of" or a "matrix of".
#include "effect/GlslTypeText.h"

#include <algorithm>
#include <regex>
#include <vector>

namespace crevice {
namespace {

std::string vectorName(const std::string& scalar, const std::string& count) {
    const std::string prefix = scalar == "float" ? "" : scalar.substr(0, 1);  // ivec, uvec, bvec, dvec
    return prefix + "vec" + count;
}

std::string matrixName(const std::string& scalar, const std::string& columns, const std::string& rows) {
    return (scalar == "double" ? "dmat" : "mat") + columns + (columns == rows ? "" : "x" + rows);
}

/// Empty when it is no type.
std::string plainType(std::string words) {
    static const std::regex kLayout(R"(layout\([^)]*\))");
    static const std::regex kQualifier(
        R"((^|\s)(global|temp|const|in|out|inout|uniform|buffer|shared|readonly|writeonly|coherent|volatile|restrict|)"
        R"(flat|smooth|noperspective|centroid|invariant|highp|mediump|lowp)(?=\s))");
    static const std::regex kArray(R"(^\s*(?:(?:unsized|runtime-sized)(?: \d+-element)?|(\d+)-element) array of)");
    static const std::regex kVector(R"(^\s*(\d)-component vector of (float|double|int|uint|bool)\s*$)");
    static const std::regex kMatrix(R"(^\s*(\d)X(\d) matrix of (float|double)\s*$)");
    static const std::regex kName(R"(^\s*(\w+)\s*$)");
    words = std::regex_replace(words, kLayout, " ");
    for (std::string before; before != words;) {
        before = words;
        words = std::regex_replace(words, kQualifier, " ");
    }
    std::smatch found;
    std::string suffix;
    while (std::regex_search(words, found, kArray)) {
        suffix += "[" + found[1].str() + "]";
        words = found.suffix();
        words = std::regex_replace(words, kQualifier, " ");
    }
    if (std::regex_match(words, found, kVector)) return vectorName(found[2], found[1]) + suffix;
    if (std::regex_match(words, found, kMatrix)) return matrixName(found[3], found[1], found[2]) + suffix;
    if (std::regex_match(words, found, kName)) return found[1].str() + suffix;
    return {};
}

/// Types without a name: their members follow in braces, as many as there are. Empty when it is none.
std::string membersType(const std::string& words) {
    const auto brace = words.find('{');
    if (brace == std::string::npos) return {};
    const std::string head = words.substr(0, brace);
    const bool array = head.find("array of") != std::string::npos;
    if (head.ends_with("structure")) return array ? "an array of structs" : "a struct";
    if (head.ends_with("block")) return array ? "an array of blocks" : "a block";
    return {};
}

std::vector<std::string> quotedTexts(const std::string& message) {
    std::vector<std::string> quoted;
    for (std::size_t open = message.find('\''); open != std::string::npos;) {
        const std::size_t close = message.find('\'', open + 1);
        if (close == std::string::npos) break;
        quoted.push_back(message.substr(open + 1, close - open - 1));
        open = message.find('\'', close + 1);
    }
    return quoted;
}

bool isScalar(const std::string& type) {
    return type == "bool" || type == "int" || type == "uint" || type == "float" || type == "double";
}

bool hasComponents(const std::string& type) {
    static const std::regex kComponents(R"([iubd]?vec\d|d?mat\d(x\d)?)");
    return std::regex_match(type, kComponents);
}

}  // namespace

std::string plainGlslTypes(const std::string& message) {
    std::string plain;
    std::size_t at = 0;
    for (std::size_t open; (open = message.find('\'', at)) != std::string::npos;) {
        const std::size_t close = message.find('\'', open + 1);
        const std::string quoted = message.substr(open + 1, close == std::string::npos ? close : close - open - 1);
        if (const std::string type = membersType(quoted); !type.empty()) {
            plain += message.substr(at, open - at) + type;
            at = close == std::string::npos ? message.size() : close + 1;  // glslang cuts long messages off
            continue;
        }
        if (close == std::string::npos) break;
        const std::string type = plainType(quoted);
        plain += message.substr(at, open - at) + "'" + (type.empty() ? quoted : type) + "'";
        at = close + 1;
    }
    return plain + message.substr(at);
}

std::string conversionAdvice(const std::string& message) {
    for (const char* members : {"a struct", "a block", "an array of structs", "an array of blocks"})
        if (message.find(std::string("from ") + members) != std::string::npos ||
            message.find(std::string("to ") + members) != std::string::npos)
            return "structs and blocks convert to nothing and from nothing: take the member you mean: s.x";
    const std::vector<std::string> types = quotedTexts(message);
    if (std::any_of(types.begin(), types.end(), [](const std::string& type) { return type.ends_with(']'); }))
        return "arrays convert to nothing and from nothing: take the element you mean: a[0]";
    if (std::any_of(types.begin(), types.end(), hasComponents))
        return "build the type by its name, or take the components you mean: vec4(v, 1.0), v.rgb";
    // GLSL 4.50, 4.1.10 "Implicit Conversions".
    if (types.size() >= 2 && std::all_of(types.begin(), types.end(), isScalar))
        return "GLSL turns int into uint, uint into float and float into double, never back: write the conversion";
    return "give a value of the type that is wanted";
}

}  // namespace crevice
