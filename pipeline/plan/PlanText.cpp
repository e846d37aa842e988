// A frame plan as people read it: the table of `crevice plan` and the Graphviz drawing.
#include <algorithm>
#include <array>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "core/Text.h"
#include "plan/FramePlan.h"
#include "plan/TargetSize.h"

namespace crevice {
namespace {

constexpr std::size_t kColumns = 4;
using Row = std::array<std::vector<std::string>, kColumns>;  ///< Per cell the words that stay on one line.

/// Widest lines of the cells, in characters; a longer word makes its column wider.
constexpr std::array<std::size_t, kColumns> kWrapAt{24, 34, 38, 60};

/// Characters of UTF-8 text: bytes that do not continue one.
std::size_t textWidth(const std::string& text) {
    return static_cast<std::size_t>(
        std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }));
}

std::string padded(const std::string& text, std::size_t width) {
    const std::size_t used = textWidth(text);
    return used < width ? text + std::string(width - used, ' ') : text;
}

std::vector<std::string> wrapped(const std::vector<std::string>& words, std::size_t width) {
    std::vector<std::string> lines;
    for (const std::string& word : words) {
        if (!lines.empty() && textWidth(lines.back()) + 1 + textWidth(word) <= width) {
            lines.back() += " " + word;
        } else {
            lines.push_back(word);
        }
    }
    return lines.empty() ? std::vector<std::string>{"–"} : lines;
}

/// Puts a comma after every word but the last.
std::vector<std::string> listed(std::vector<std::string> words) {
    for (std::size_t i = 0; i + 1 < words.size(); ++i) words[i] += ",";
    return words;
}

std::string levelName(const std::string& target, std::uint32_t mip, bool shown) {
    return shown ? fmt::format("{}@{}", target, mip) : target;
}

std::string writeName(const PlannedWrite& planned) {
    std::string name = levelName(planned.write.target, planned.write.mip, planned.write.mip > 0);
    if (planned.write.kind == WriteKind::Storage) name += " S";
    if (planned.write.kind == WriteKind::DepthTest) return name + " T";
    if (planned.write.kind != WriteKind::Storage) name += planned.clears ? " C" : " L";
    return name;
}

std::string readName(const TargetRead& read, const BindingMap* bindings) {
    std::string name = levelName(read.target, read.mip, read.mip > 0 || read.oneMip);
    if (bindings) {
        const auto found = bindings->find(read.target);
        if (found != bindings->end()) name += fmt::format(" {}", found->second.binding);
    }
    return read.storage ? name + " S" : name;
}

/// "a, b color→sampled; c undefined→color": equal changes together, in the order of their first.
std::vector<std::string> transitionWords(const std::vector<Transition>& transitions) {
    std::vector<std::string> words;
    std::vector<bool> done(transitions.size(), false);
    for (std::size_t i = 0; i < transitions.size(); ++i) {
        if (done[i]) continue;
        if (!words.empty()) words.back() += ";";
        std::vector<std::string> names;
        for (std::size_t j = i; j < transitions.size(); ++j) {
            if (transitions[j].from != transitions[i].from || transitions[j].to != transitions[i].to) continue;
            names.push_back(levelName(transitions[j].target, transitions[j].mip, transitions[j].mip != kAllMips));
            done[j] = true;
        }
        for (const std::string& name : listed(names)) words.push_back(name);
        words.push_back(fmt::format("{}→{}", stateName(transitions[i].from), stateName(transitions[i].to)));
    }
    return words;
}

std::vector<std::string> readWords(const std::vector<TargetRead>& reads, const BindingMap* bindings) {
    std::vector<std::string> names;
    for (const TargetRead& read : reads) {
        std::string name = readName(read, bindings);
        if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(std::move(name));
    }
    return listed(names);
}

std::vector<Row> tableRows(const FramePlan& plan, const BindingMap* bindings) {
    std::vector<Row> rows;
    for (const PlannedStage& stage : plan.stages) {
        std::vector<std::string> writes;
        for (const PlannedWrite& write : stage.writes) writes.push_back(writeName(write));
        rows.push_back({std::vector<std::string>{plan.uses[stage.use].stage}, listed(writes),
                        readWords(stage.reads, bindings), transitionWords(stage.before)});
    }
    rows.push_back({std::vector<std::string>{"(readback)"}, {}, {plan.output}, transitionWords(plan.atEnd)});
    return rows;
}

/// Numbered rows under the titles; the last row is the readback and has no number.
std::string layOut(const std::vector<Row>& rows) {
    const std::array<std::string, kColumns> titles{"stage", "writes", "reads", "transitions before"};
    std::vector<std::array<std::vector<std::string>, kColumns>> cells;
    std::array<std::size_t, kColumns> widths{};
    for (std::size_t column = 0; column < kColumns; ++column) widths[column] = textWidth(titles[column]);
    for (const Row& row : rows) {
        auto& lines = cells.emplace_back();
        for (std::size_t column = 0; column < kColumns; ++column) {
            lines[column] = wrapped(row[column], kWrapAt[column]);
            for (const std::string& line : lines[column]) widths[column] = std::max(widths[column], textWidth(line));
        }
    }
    const auto lineOf = [&](const std::string& number, const auto& cellText) {
        std::string line = fmt::format("{:>2} ", number);
        for (std::size_t column = 0; column < kColumns; ++column)
            line += padded(cellText(column), widths[column]) + "  ";
        line.erase(line.find_last_not_of(' ') + 1);
        return line + "\n";
    };
    std::string text = lineOf("#", [&](std::size_t column) { return titles[column]; });
    for (std::size_t row = 0; row < cells.size(); ++row) {
        std::size_t height = 0;
        for (const auto& lines : cells[row]) height = std::max(height, lines.size());
        for (std::size_t i = 0; i < height; ++i) {
            const bool numbered = i == 0 && row + 1 < cells.size();
            text += lineOf(numbered ? std::to_string(row + 1) : "", [&](std::size_t column) {
                const auto& lines = cells[row][column];
                return i < lines.size() ? lines[i] : std::string();
            });
        }
    }
    return text;
}

std::string legend(const FramePlan& plan) {
    bool clears = false, loads = false, tests = false, storage = false;
    for (const PlannedStage& stage : plan.stages) {
        for (const TargetRead& read : stage.reads) storage |= read.storage;
        for (const PlannedWrite& planned : stage.writes) {
            const WriteKind kind = planned.write.kind;
            storage |= kind == WriteKind::Storage;
            tests |= kind == WriteKind::DepthTest;
            if (kind == WriteKind::Color || kind == WriteKind::DepthWrite) (planned.clears ? clears : loads) = true;
        }
    }
    std::vector<std::string> parts;
    if (clears) parts.emplace_back("C = first write this frame, clears.");
    if (loads) parts.emplace_back("L = keeps what is there.");
    if (tests) parts.emplace_back("T = only tested against.");
    if (storage) parts.emplace_back("S = storage image.");
    return join(parts, "  ");
}

/// "GbufferStage, AoMain 44 px; AoDenoise1 2 px": what each stage draws of the guard, fixed sizes left out.
std::string guardWords(const FramePlan& plan, const PipelineDesc& desc, std::uint32_t guard) {
    std::string text;
    std::optional<std::uint32_t> last;
    for (const PlannedStage& stage : plan.stages) {
        const bool hasGuard = std::any_of(stage.writes.begin(), stage.writes.end(), [&](const PlannedWrite& planned) {
            const TargetDesc* target = desc.findTarget(planned.write.target);
            return target && !target->size;
        });
        if (!hasGuard) continue;
        const std::uint32_t pixels = std::min(guard, stage.beyond);
        if (last) text += pixels == *last ? ", " : fmt::format(" {} px; ", *last);
        text += plan.uses[stage.use].stage;
        last = pixels;
    }
    return last ? text + fmt::format(" {} px", *last) : text;
}

std::string quoted(const std::string& text) {
    std::string result = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') result += '\\';
        result += c;
    }
    return result + "\"";
}

}  // namespace

std::string planTable(const FramePlan& plan, const PipelineDesc& desc, std::uint32_t width, std::uint32_t height,
                      const BindingMap* bindings) {
    std::uint64_t bytes = 0;
    const std::uint32_t guard = guardPixels(desc.guard, height);
    for (const TargetDesc& target : desc.targets) bytes += targetBytes(target, width + 2 * guard, height + 2 * guard);
    std::vector<std::string> unused, holding, disabled;
    for (const TargetLife& life : plan.lives) {
        if (life.firstUse < 0) {
            unused.push_back(life.target);
        } else if (life.neverWritten) {
            holding.push_back(life.target);
        }
    }
    for (const StageUse& use : plan.uses) {
        if (!use.enabled) disabled.push_back(use.stage);
    }
    std::string text = layOut(tableRows(plan, bindings));
    text +=
        fmt::format(" {}  Memory {}×{}: {:.1f} MiB.  Unused: {}\n", legend(plan), width + 2 * guard, height + 2 * guard,
                    static_cast<double>(bytes) / (1 << 20), unused.empty() ? "–" : join(unused));
    if (guard > 0)
        text += fmt::format(
            " Guard: {} pixels on each side ({} % of the height); pictures are cropped to {}×{}\n"
            " Drawn of the guard: {}\n",
            guard, desc.guard, width, height, guardWords(plan, desc, guard));
    if (!holding.empty()) text += fmt::format(" Never written, holding the clear value: {}\n", join(holding));
    if (!disabled.empty()) text += fmt::format(" Disabled: {}\n", join(disabled));
    return text;
}

std::string planDot(const FramePlan& plan) {
    std::string text = "digraph plan {\n  rankdir=LR;\n  node [fontname=\"sans-serif\"];\n";
    for (const TargetLife& life : plan.lives) {
        const char* style = life.target == plan.output ? ", peripheries=2" : life.neverWritten ? ", style=dotted" : "";
        text += fmt::format("  {} [label={}, shape=ellipse{}];\n", quoted("target " + life.target), quoted(life.target),
                            style);
    }
    for (const StageUse& use : plan.uses) {
        if (use.enabled) continue;
        text += fmt::format("  {} [label={}, shape=box, style=dashed, color=gray, fontcolor=gray];\n",
                            quoted("stage " + use.stage), quoted(use.stage));
    }
    for (std::size_t i = 0; i < plan.stages.size(); ++i) {
        const std::string& name = plan.uses[plan.stages[i].use].stage;
        const std::string node = quoted("stage " + name);
        text += fmt::format("  {} [label={}, shape=box];\n", node, quoted(fmt::format("{} {}", i + 1, name)));
        std::set<std::string> read;
        for (const TargetRead& wire : plan.stages[i].reads) {
            if (!read.insert(wire.target).second) continue;
            text += fmt::format("  {} -> {};\n", quoted("target " + wire.target), node);
        }
        for (const PlannedWrite& planned : plan.stages[i].writes) {
            const std::string target = quoted("target " + planned.write.target);
            if (planned.write.kind == WriteKind::DepthTest) {
                text += fmt::format("  {} -> {} [label=\"test\", style=dashed];\n", target, node);
            } else {
                text += fmt::format("  {} -> {}{};\n", node, target, planned.clears ? " [label=\"clear\"]" : "");
            }
        }
    }
    return text + "}\n";
}

}  // namespace crevice
