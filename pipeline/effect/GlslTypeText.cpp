// A type of glslang's is qualifiers, then "N-element array of", then a name, a "vector of" or a "matrix of".
#include "effect/GlslTypeText.h"

#include <regex>

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
    static const std::regex kArray(R"(^\s*(\d+)-element array of)");
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

}  // namespace

std::string plainGlslTypes(const std::string& message) {
    std::string plain;
    std::size_t at = 0;
    for (std::size_t open; (open = message.find('\'', at)) != std::string::npos;) {
        const std::size_t close = message.find('\'', open + 1);
        if (close == std::string::npos) break;
        const std::string quoted = message.substr(open + 1, close - open - 1);
        const std::string type = plainType(quoted);
        plain += message.substr(at, open - at) + "'" + (type.empty() ? quoted : type) + "'";
        at = close + 1;
    }
    return plain + message.substr(at);
}

}  // namespace crevice
