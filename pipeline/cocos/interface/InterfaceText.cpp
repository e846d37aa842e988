// Writes the numbers of declarations into the text they were read from.
#include <algorithm>

#include <fmt/format.h>

#include "cocos/interface/DeclarationFront.h"
#include "cocos/interface/Interface.h"
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

constexpr std::size_t kMaxLookedBack = 8u << 20;  ///< Bytes, for the conditions among the qualifiers of a stage.

/// Where an edit ends in the old text, and how many lines it has more than what it replaces.
struct GrownText {
    std::size_t offset = 0, lines = 0;
};

class LayoutWriter {
public:
    LayoutWriter(const StageText& stage, const StageInterface& interface, const std::vector<LayoutNumbers>& numbers)
        : text_(stage.flat.text), interface_(interface), numbers_(numbers) {}

    std::string run() {
        for (const InterfaceStatement& where : interface_.statements)
            if (where.fromPragma) pragmaPlaces_.push_back(where.begin);
        std::sort(pragmaPlaces_.begin(), pragmaPlaces_.end());
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

    const std::vector<GrownText>& grown() const { return grown_; }

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

    /// `in vec2 a, b;` becomes two statements on its line: each name has a number of its own. Conditions among the
    /// qualifiers stand in front of each.
    void splitStatement(const InterfaceStatement& where, std::size_t first, std::size_t end) {
        const DeclarationFront front = frontOf(where);
        std::string prefix = text_.substr(front.begin, where.firstName - front.begin);
        for (auto layout = where.layouts.rbegin(); layout != where.layouts.rend(); ++layout) {
            if (layout->begin >= front.begin)
                prefix.erase(layout->begin - front.begin, layout->length);
            else
                edits_.push_back(
                    {layout->begin, layout->length, newLines(layout->begin, layout->begin + layout->length)});
        }
        if (!front.conditional) std::replace(prefix.begin(), prefix.end(), '\n', ' ');
        const std::size_t directive = front.conditional ? prefix.rfind('#') : std::string::npos;
        const std::size_t numbersAt = directive == std::string::npos ? 0 : prefix.find('\n', directive) + 1;
        const bool flat = where.flat && front.words.find("flat ") == std::string::npos;
        std::string text;
        for (std::size_t at = first; at < end; ++at) {
            const InterfaceDeclaration& declaration = interface_.declarations[at];
            const auto name = std::find_if(where.declarators.begin(), where.declarators.end(), [&](const auto& d) {
                return d.starts_with(declaration.name) &&
                       (d.size() == declaration.name.size() || d.find_first_of("[ \t\n") == declaration.name.size());
            });
            std::string declarator = name == where.declarators.end() ? declaration.name : *name;
            std::replace(declarator.begin(), declarator.end(), '\n', ' ');
            if (at > first) text += (front.conditional ? "\n" : "") + front.words;
            text.append(prefix, 0, numbersAt);
            text += layoutText(numbers_[at], kept(where, declaration)) + (flat ? "flat " : "");
            text.append(prefix, numbersAt, std::string::npos).append(declarator).append("; ");
        }
        const std::string lines = newLines(front.begin, where.end);
        const auto written = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
        if (written > lines.size()) grown_.push_back({where.end, written - lines.size()});
        if (written < lines.size()) text.append(lines, written, std::string::npos);
        edits_.push_back({front.begin, where.end - front.begin, std::move(text)});
    }

    /// Where an edit crosses its begin the statement is left as it stands: a subpass input in an empty line, a layout.
    DeclarationFront frontOf(const InterfaceStatement& where) {
        DeclarationFront front = findFront(text_, where, budget_);
        const auto pragma = std::lower_bound(pragmaPlaces_.begin(), pragmaPlaces_.end(), front.begin);
        const bool crossed = (pragma != pragmaPlaces_.end() && *pragma < where.begin) ||
                             std::any_of(where.layouts.begin(), where.layouts.end(), [&](const TextEdit& layout) {
                                 return layout.begin < front.begin && layout.begin + layout.length > front.begin;
                             });
        return crossed ? DeclarationFront{where.begin, false, {}} : front;
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
    std::vector<GrownText> grown_;
    std::vector<std::size_t> pragmaPlaces_;  ///< Of subpass inputs, ascending.
    std::size_t budget_ = kMaxLookedBack;
};

/// Lines that were written behind others belong to the author's line above them.
void growLines(StageText& stage, const std::vector<GrownText>& grown) {
    if (grown.empty()) return;
    std::vector<FlatSource::Origin> lines;
    std::vector<std::uint32_t> conditions;
    std::vector<int> shift;  // per line of the old text
    std::size_t next = 0, at = 0;
    int added = 0;
    for (std::size_t line = 0; line < stage.flat.lines.size(); ++line) {
        const std::size_t end = std::min(stage.flat.text.find('\n', at), stage.flat.text.size());
        const std::uint32_t condition = line < stage.conditionOf.size() ? stage.conditionOf[line] : 0;
        std::size_t copies = 1;
        for (; next < grown.size() && grown[next].offset <= end; ++next) copies += grown[next].lines;
        lines.insert(lines.end(), copies, stage.flat.lines[line]);
        conditions.insert(conditions.end(), copies, condition);
        shift.push_back(added);
        added += static_cast<int>(copies) - 1;
        at = end + 1;
    }
    const auto shifted = [&](int line) {
        return line < 1 || static_cast<std::size_t>(line) > shift.size()
                   ? line + added
                   : line + shift[static_cast<std::size_t>(line) - 1];
    };
    stage.flat.lines = std::move(lines);
    stage.conditionOf = std::move(conditions);
    for (PragmaMark& mark : stage.marks) mark.line = shifted(mark.line);
    std::map<int, FlatSource::Origin> calls;
    for (const auto& [line, origin] : stage.flat.calls) calls.emplace_hint(calls.end(), shifted(line), origin);
    stage.flat.calls = std::move(calls);
}

}  // namespace

void writeLayouts(StageText& stage, const StageInterface& interface, const std::vector<LayoutNumbers>& numbers) {
    LayoutWriter writer(stage, interface, numbers);
    std::string text = writer.run();
    growLines(stage, writer.grown());
    stage.flat.text = std::move(text);
}

}  // namespace crevice::cocos
