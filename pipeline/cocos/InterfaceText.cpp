// Writes the numbers of declarations into the text they were read from.
#include <algorithm>

#include <fmt/format.h>

#include "cocos/Interface.h"
#include "core/Text.h"

namespace crevice::cocos {
namespace {

std::string layoutText(const LayoutNumbers& numbers, const std::string& kept) {
    std::string text;
    const auto add = [&](const char* key, int value) {
        if (value >= 0) text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", key, value);
    };
    add("input_attachment_index", numbers.attachment);
    add("set", numbers.set);
    add("binding", numbers.binding);
    add("location", numbers.location);
    if (!kept.empty()) text += (text.empty() ? "" : ", ") + kept;
    return text.empty() ? "" : "layout(" + text + ") ";
}

class LayoutWriter {
public:
    LayoutWriter(const StageText& stage, const StageInterface& interface, const std::vector<LayoutNumbers>& numbers)
        : text_(stage.flat.text), interface_(interface), numbers_(numbers) {}

    std::string run() {
        for (std::size_t at = 0; at < interface_.declarations.size();) {
            std::size_t end = at;
            while (end < interface_.declarations.size() &&
                   interface_.declarations[end].statement == interface_.declarations[at].statement)
                ++end;
            writeStatement(interface_.statements[interface_.declarations[at].statement], at, end);
            at = end;
        }
        return apply();
    }

private:
    std::string newLines(std::size_t begin, std::size_t end) const {
        const auto first = text_.begin() + static_cast<std::ptrdiff_t>(begin);
        const auto last = text_.begin() + static_cast<std::ptrdiff_t>(end);
        return std::string(static_cast<std::size_t>(std::count(first, last, '\n')), '\n');
    }

    std::string kept(const InterfaceStatement& where, const InterfaceDeclaration& declaration) const {
        std::string all;
        for (const TextEdit& layout : where.layouts)
            if (!layout.text.empty()) all += (all.empty() ? "" : ", ") + layout.text;
        if (declaration.kind == InterfaceKind::Image && !declaration.formatMark.empty() && all.empty())
            all = lowerCase(declaration.formatMark);
        return all;
    }

    void writeStatement(const InterfaceStatement& where, std::size_t first, std::size_t end) {
        const InterfaceDeclaration& declaration = interface_.declarations[first];
        if (where.fromPragma) {
            edits_.push_back({where.begin, 0,
                              fmt::format("{}{} {} {};", layoutText(numbers_[first], ""),
                                          declaration.kind == InterfaceKind::Output ? "out" : "uniform",
                                          declaration.type, declaration.name)});
        } else if (where.declarators.size() > 1) {
            splitStatement(where, first, end);
        } else {
            for (const TextEdit& layout : where.layouts)
                edits_.push_back({layout.begin, layout.length, newLines(layout.begin, layout.begin + layout.length)});
            edits_.push_back({where.storage, 0,
                              layoutText(numbers_[first], kept(where, declaration)) + (where.flat ? "flat " : "")});
        }
    }

    /// `in vec2 a, b;` becomes two statements on its line: each name has a number of its own.
    void splitStatement(const InterfaceStatement& where, std::size_t first, std::size_t end) {
        std::string prefix = text_.substr(where.begin, where.firstName - where.begin);
        for (auto layout = where.layouts.rbegin(); layout != where.layouts.rend(); ++layout)
            prefix.erase(layout->begin - where.begin, layout->length);
        std::replace(prefix.begin(), prefix.end(), '\n', ' ');
        std::string text;
        for (std::size_t at = first; at < end; ++at) {
            const InterfaceDeclaration& declaration = interface_.declarations[at];
            const auto name = std::find_if(where.declarators.begin(), where.declarators.end(), [&](const auto& d) {
                return d.starts_with(declaration.name) &&
                       (d.size() == declaration.name.size() || d.find_first_of("[ \t\n") == declaration.name.size());
            });
            text += layoutText(numbers_[at], kept(where, declaration)) + (where.flat ? "flat " : "") + prefix +
                    (name == where.declarators.end() ? declaration.name : *name) + "; ";
        }
        std::replace(text.begin(), text.end(), '\n', ' ');
        edits_.push_back({where.begin, where.end - where.begin, text + newLines(where.begin, where.end)});
    }

    std::string apply() {
        std::stable_sort(edits_.begin(), edits_.end(), [](const auto& a, const auto& b) { return a.begin < b.begin; });
        std::string out;
        out.reserve(text_.size() + edits_.size() * 40);
        std::size_t at = 0;
        for (const TextEdit& edit : edits_) {
            out.append(text_, at, edit.begin - at);
            out += edit.text;
            at = edit.begin + edit.length;
        }
        return out.append(text_, at, std::string::npos);
    }

    const std::string& text_;
    const StageInterface& interface_;
    const std::vector<LayoutNumbers>& numbers_;
    std::vector<TextEdit> edits_;
};

}  // namespace

std::string writeLayouts(const StageText& stage, const StageInterface& interface,
                         const std::vector<LayoutNumbers>& numbers) {
    return LayoutWriter(stage, interface, numbers).run();
}

}  // namespace crevice::cocos
