// Arguments and substitution.
#include "cocos/MacroCall.h"

#include <fmt/format.h>

#include <algorithm>

namespace crevice::cocos {

bool ArgumentReader::read(std::string_view text, std::size_t& at) {
    for (; at < text.size(); ++at) {
        const char c = text[at];
        if (c == '(' && depth_++ == 0) continue;
        if (c == ')' && --depth_ == 0) {
            ++at;
            return false;
        }
        ++bytes_;
        if (c == ',' && depth_ == 1) {
            values_.emplace_back();
            whole_ = whole_ && branches_.empty();
        } else {
            values_.back().push_back(c);
        }
    }
    values_.back().push_back(' ');
    return true;
}

bool ArgumentReader::readLine(std::string_view text, LineKind kind) {
    if (!isConditional(kind)) return false;
    const bool opens = kind == LineKind::If || kind == LineKind::Ifdef || kind == LineKind::Ifndef;
    if (!opens && (branches_.empty() || branches_.back() != depth_)) return false;
    if (opens) branches_.push_back(depth_);
    if (kind == LineKind::Endif) branches_.pop_back();
    values_.back().append("\n").append(text).append("\n");
    bytes_ += text.size() + 2;
    return true;
}

std::vector<std::string> ArgumentReader::take() {
    for (std::string& value : values_) value = trimBlank(value);
    return std::move(values_);
}

bool matchArguments(const MacroDefinition& macro, std::vector<std::string>& arguments) {
    if (macro.parameters.empty() && arguments.size() == 1 && arguments[0].empty()) arguments.clear();
    return arguments.size() == macro.parameters.size();
}

void reportUnclosed(std::string_view macro, const SourceLoc& where, Problems& problems) {
    problems.error(where, fmt::format("the call of macro '{}' is not closed", macro),
                   "a ')' is missing, or it is not one in every branch: a condition between the brackets "
                   "lies within one argument");
}

void reportArguments(const MacroDefinition& macro, std::size_t given, const SourceLoc& where, Problems& problems) {
    problems.error(
        where, fmt::format("macro '{}' takes {} arguments, {} are given", macro.name, macro.parameters.size(), given),
        "give each parameter one");
}

std::string joinDirective(const SourceLines& lines, std::size_t first, std::size_t end) {
    std::string joined;
    for (std::size_t i = first; i < end; ++i) {
        std::string_view part = lines.text(i);
        if (const auto last = part.rfind('\\'); i + 1 < end || part.ends_with('\\')) part = part.substr(0, last);
        joined.append(part).push_back(' ');
    }
    return joined;
}

std::string substitute(std::string_view body, const std::vector<std::string_view>& parameters,
                       const std::vector<std::string>& arguments) {
    std::string out;
    for (std::size_t i = 0; i < body.size();) {
        if (isNamePart(body[i])) {
            std::size_t end = i + 1;
            while (end < body.size() && isNamePart(body[end])) ++end;
            const std::string_view word = body.substr(i, end - i);
            const auto it = std::find(parameters.begin(), parameters.end(), word);
            const auto index = static_cast<std::size_t>(it - parameters.begin());
            out.append(index < arguments.size() ? std::string_view(arguments[index]) : word);
            i = end;
        } else if (body.substr(i, 2) == "##") {
            while (!out.empty() && (out.back() == ' ' || out.back() == '\t')) out.pop_back();
            i = std::min(body.find_first_not_of(" \t", i + 2), body.size());
        } else {
            out.push_back(body[i++]);
        }
    }
    return out;
}

}  // namespace crevice::cocos
