// Arguments and substitution.
#include "cocos/text/MacroCall.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace crevice::cocos {

BodyLines splitLines(std::string_view text, FlatSource::Origin origin) {
    BodyLines lines;
    for (std::size_t at = 0; at <= text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        lines.texts.emplace_back(text.substr(at, end - at));
        lines.origins.push_back(origin);
        at = end + 1;
    }
    return lines;
}

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

CallArguments::State ArgumentReader::readLine(std::string_view text, LineKind kind) {
    using State = CallArguments::State;
    const bool opens = kind == LineKind::If || kind == LineKind::Ifdef || kind == LineKind::Ifndef;
    if (!isConditional(kind) || (!opens && branches_.empty())) return State::Cut;
    if (!opens && branches_.back() != depth_) return State::Crossing;
    if (opens) branches_.push_back(depth_);
    if (kind == LineKind::Endif) branches_.pop_back();
    values_.back().append("\n").append(text).append("\n");
    bytes_ += text.size() + 2;
    return State::Found;
}

std::string joinContinued(const CodeLines& lines, std::size_t& line) {
    std::string joined(lines.text(line));
    while (joined.ends_with('\\') && line + 1 < lines.size()) {
        joined.back() = ' ';
        joined.append(lines.text(++line));
    }
    return joined;
}

CallArguments readArguments(const CodeLines& lines, std::size_t line, std::size_t at, std::size_t maxBytes) {
    using State = CallArguments::State;
    CallArguments result;
    ArgumentReader reader;
    const auto end = [&](State state) {
        result.state = state;
        result.bytes = reader.bytes();
        return std::move(result);
    };
    for (; line < lines.size(); ++line, at = 0) {
        const std::string_view text = withoutSplice(lines.text(line));
        if (const LineKind kind = at == 0 ? readDirective(lines.text(line)).kind : LineKind::Code;
            kind != LineKind::Code) {
            const bool opens = kind == LineKind::If || kind == LineKind::Ifdef || kind == LineKind::Ifndef;
            if (!reader.isOpen()) return end(opens ? State::Crossing : State::None);
            const std::string whole = joinContinued(lines, line);
            if (const State state = reader.readLine(whole, kind); state != State::Found) return end(state);
            continue;
        }
        if (!reader.isOpen()) {
            at = std::min(text.find_first_not_of(" \t", at), text.size());
            if (at == text.size()) continue;
            if (text[at] != '(') return end(State::None);
        }
        if (!reader.read(text, at)) {
            if (!reader.isWhole()) return end(State::Crossing);
            result.values = reader.take();
            result.line = line;
            result.end = at;
            return end(State::Found);
        }
        if (reader.bytes() > maxBytes) break;
    }
    if (!reader.isOpen()) return end(State::None);
    return end(lines.isBody() && reader.bytes() <= maxBytes ? State::Cut : State::Unclosed);
}

std::vector<std::string> ArgumentReader::take() {
    for (std::string& value : values_) value = trimBlank(value);
    return std::move(values_);
}

bool matchArguments(const MacroDefinition& macro, std::vector<std::string>& arguments) {
    if (macro.parameters.empty() && arguments.size() == 1 && arguments[0].empty()) arguments.clear();
    return arguments.size() == macro.parameters.size();
}

bool pastesLines(const MacroDefinition& macro, const CallArguments& arguments) {
    const auto isPasted = [](const auto& part) { return part.text.find("##") != std::string_view::npos; };
    return std::any_of(arguments.values.begin(), arguments.values.end(),
                       [](const std::string& value) { return value.find('\n') != std::string::npos; }) &&
           std::any_of(macro.body.begin(), macro.body.end(), isPasted);
}

void reportUnclosed(std::string_view macro, std::size_t limit, const SourceLoc& where, Problems& problems) {
    const std::string within = limit > 0 ? fmt::format(" within {} KB", limit >> 10) : std::string();
    problems.error(where, fmt::format("the call of macro '{}' is not closed{}", macro, within),
                   "add the ')' that is missing");
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

std::string joinPasted(const MacroDefinition& macro, std::size_t& line) {
    std::string joined(macro.body[line].text);
    for (; line + 1 < macro.body.size(); ++line) {
        const std::string_view next = trimBlank(macro.body[line + 1].text);
        if (!trimBlank(joined).ends_with("##") && !next.starts_with("##")) break;
        if (readDirective(next).kind != LineKind::Code) break;
        joined.append(" ").append(next);
    }
    return joined;
}

std::string substitute(std::string_view body, const std::vector<std::string_view>& parameters,
                       const std::vector<std::string>& arguments) {
    std::string out;
    bool pasting = false;
    const auto beginOfName = [&] {
        std::size_t begin = out.size();
        while (begin > 0 && isNamePart(out[begin - 1])) --begin;
        return begin;
    };
    for (std::size_t i = 0; i < body.size();) {
        if (isNamePart(body[i])) {
            std::size_t end = i + 1;
            while (end < body.size() && isNamePart(body[end])) ++end;
            const std::string_view word = body.substr(i, end - i);
            const auto it = std::find(parameters.begin(), parameters.end(), word);
            const auto index = static_cast<std::size_t>(it - parameters.begin());
            std::string_view value = index < arguments.size() ? std::string_view(arguments[index]) : word;
            if (std::exchange(pasting, false) && value.starts_with(kFinal)) value.remove_prefix(1);
            out.append(value);
            i = end;
        } else if (body.substr(i, 2) == "##") {
            while (!out.empty() && (out.back() == ' ' || out.back() == '\t')) out.pop_back();
            if (const std::size_t begin = beginOfName(); begin > 0 && out[begin - 1] == kFinal) out.erase(begin - 1, 1);
            i = std::min(body.find_first_not_of(" \t", i + 2), body.size());
            pasting = true;  // What comes of it is a name of its own.
        } else {
            out.push_back(body[i++]);
            pasting = false;
        }
    }
    return out;
}

}  // namespace crevice::cocos
