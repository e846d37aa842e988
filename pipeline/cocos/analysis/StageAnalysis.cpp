// Follows the conditions of a flattened stage from top to bottom.
#include "cocos/analysis/StageAnalysis.h"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "cocos/analysis/LiveFunctions.h"
#include "cocos/analysis/MacroAliases.h"
#include "cocos/analysis/MacroWeight.h"
#include "cocos/analysis/OutsideNames.h"
#include "cocos/flatten/HoistedMacros.h"
#include "cocos/text/Conditions.h"
#include "cocos/text/EngineMacros.h"

namespace crevice::cocos {
namespace {

constexpr std::size_t kMaxNeeds = 1'000'000;  ///< Names that branches need, of a stage.

class Analysis {
public:
    Analysis(StageText& out, std::vector<FlatDirective> directives, Problems& problems)
        : out_(out), directives_(std::move(directives)), problems_(problems) {}

    void run(std::string_view entry, const std::vector<DefineInfo>& others) {
        collectDefinitions();
        findDead(entry, others);
        out_.conditionOf.assign(out_.flat.lines.size(), 0);
        for (const FlatDirective& directive : directives_) read(directive);
        fillTo(out_.flat.lines.size());
        if (!frames_.empty())
            problems_.error(placeOf(*frames_.back().opened), "this condition has no '#endif'",
                            "close it, in the same program or chunk where you can");
        if (!problems_.hasErrors()) checkWeights();
        listDefined();
        hoist();
    }

private:
    /// One #if with its branches so far.
    struct Frame {
        std::vector<std::string> outer;             ///< Needs of the enclosing conditions.
        std::vector<std::string> earlier, current;  ///< That earlier branches were not taken; that this one is.
        std::vector<std::string> raw;               ///< The same as expressions; the last one is the present branch.
        const FlatDirective* opened = nullptr;
    };

    void collectDefinitions() {
        for (const FlatDirective& directive : directives_) {
            if (directive.kind != LineKind::Define && directive.kind != LineKind::PragmaDefine) continue;
            const std::string_view name =
                directive.macro != nullptr ? directive.macro->name : leadingName(readDirective(textOf(directive)).rest);
            if (directive.macro != nullptr && !directive.macro->dead) definitions_[name].push_back(directive.macro);
            if (directive.kind == LineKind::Define) inText_.insert(name);
            if (directive.kind == LineKind::PragmaDefine || !isHidden(directive)) visible_.insert(name);
        }
    }

    /// `# define`: Cocos' compiler does not see it, and takes the name for a macro from outside.
    bool isHidden(const FlatDirective& directive) const {
        const std::string_view text = std::string_view(out_.flat.text).substr(directive.offset);
        const std::size_t behind = std::min(text.find('#'), text.size() - 1) + 1;
        return behind < text.size() && (text[behind] == ' ' || text[behind] == '\t');
    }

    void findDead(std::string_view entry, const std::vector<DefineInfo>& others) {
        MacroBodies macros;
        for (const auto& [name, definitions] : definitions_)
            for (const MacroDefinition* macro : definitions)
                for (const auto& part : macro->body) macros[name].emplace_back(part.text);
        LiveHints hints;
        readOutsideNames(directives_, out_.flat.text, visible_, macros, hints);
        for (const DefineInfo& info : others)
            if (!visible_.contains(info.name)) addWordsOf(info, macros);
        hints.foreign = out_.stage == kFragmentBit
                            ? std::vector<std::string_view>{"gl_Position", "gl_VertexIndex", "gl_InstanceIndex"}
                            : std::vector<std::string_view>{"discard", "dFdx", "dFdy", "fwidth", "gl_FragCoord"};
        dead_ = findDeadFunctions(out_.flat.text, entry, macros, hints);
    }

    /// A name in what is left of the text, or in a macro.
    bool isNamed(std::string_view name) {
        if (words_.empty()) {
            std::size_t at = 0;
            for (const FunctionRange& function : dead_) {
                addWords(std::string_view(out_.flat.text).substr(at, function.begin - at));
                at = function.end;
            }
            addWords(std::string_view(out_.flat.text).substr(at));
            for (const auto& [defined, definitions] : definitions_)
                for (const MacroDefinition* macro : definitions)
                    for (const auto& part : macro->body) addWords(part.text);
        }
        return words_.contains(name);
    }

    void addWords(std::string_view text) {
        for (std::size_t at = 0; at < text.size();) {
            const std::string_view word = leadingName(text.substr(at));
            if (!word.empty()) words_.insert(word);
            at += std::max<std::size_t>(1, word.size());
        }
    }

    /// Directives come in the order of the text, and so do functions.
    bool isDead(const FlatDirective& directive) {
        while (nextDead_ < dead_.size() && dead_[nextDead_].lastLine < directive.line) ++nextDead_;
        return nextDead_ < dead_.size() && dead_[nextDead_].firstLine < directive.line;
    }

    /// Lines stay lines. Nothing may look at the text's directives behind this.
    void dropDead() {
        for (auto function = dead_.rbegin(); function != dead_.rend(); ++function)
            out_.flat.text.replace(function->begin, function->end - function->begin,
                                   std::string(function->lastLine - function->firstLine, '\n'));
    }

    SourceLoc placeOf(const FlatDirective& directive) const {
        const std::string_view text = textOf(directive);
        const auto begin = std::min(text.find_first_not_of(" \t"), text.size());
        return {out_.flat.files[directive.origin.file], directive.origin.line, static_cast<int>(begin) + 1,
                static_cast<int>(std::max<std::size_t>(1, text.size() - begin))};
    }

    std::string_view textOf(const FlatDirective& directive) const {
        return std::string_view(out_.flat.text).substr(directive.offset, directive.length);
    }

    void read(const FlatDirective& directive) {
        const bool dead = isDead(directive);
        if (directive.kind == LineKind::Pragma && (!dead || isNamed(directive.meta->info.name)))
            describe(*directive.meta);
        if (directive.kind == LineKind::PragmaDefine) {
            if (directive.macro->dead || directive.macro->bearsDirectives) return;
            HoistedMacro hoisted{directive.macro, directive.origin, {}};
            for (const Frame& frame : frames_)
                hoisted.raw.insert(hoisted.raw.end(), frame.raw.begin(), frame.raw.end());
            hoisted_.push_back(std::move(hoisted));
        }
        if (!isConditional(directive.kind) || dead) return;
        fillTo(directive.line);
        const Directive line = readDirective(textOf(directive));
        place_ = &directive;
        const bool opens = line.kind != LineKind::Endif && line.kind != LineKind::Else && line.kind != LineKind::Elif;
        if (!opens && frames_.empty()) {
            problems_.error(placeOf(directive), "this line belongs to no '#if'",
                            "remove it, or open a condition above");
        } else if (line.kind == LineKind::Endif) {
            frames_.pop_back();
        } else if (!opens) {
            readBranch(line);
        } else {
            open(line);
        }
        present_ = internNeeds();
    }

    void open(const Directive& line) {
        Frame frame;
        if (!frames_.empty()) frame.outer = needsOf(frames_.back());
        frame.current = evaluate(line);
        frame.raw.push_back(rawOf(line));
        frame.opened = place_;
        frames_.push_back(std::move(frame));
    }

    void readBranch(const Directive& line) {
        Frame& frame = frames_.back();
        const std::vector<std::string> turned = turnRound(frame.current);
        frame.earlier.insert(frame.earlier.end(), turned.begin(), turned.end());
        frame.raw.back() = "!(" + frame.raw.back() + ")";
        frame.current.clear();
        if (line.kind == LineKind::Else) return;
        frame.current = evaluate(line);
        frame.raw.push_back(rawOf(line));
    }

    static std::string rawOf(const Directive& line) {
        if (line.kind == LineKind::Ifdef) return fmt::format("defined({})", leadingName(line.rest));
        if (line.kind == LineKind::Ifndef) return fmt::format("!defined({})", leadingName(line.rest));
        return fmt::format("({})", line.rest);
    }

    /// What the branch needs.
    std::vector<std::string> evaluate(const Directive& line) {
        if (line.kind == LineKind::If || line.kind == LineKind::Elif) {
            const auto lookup = [this](std::string_view name, bool isValue) { return lookUp(name, isValue); };
            if (readCondition(line.rest, lookup).tooDeep)
                problems_.error({out_.flat.files[place_->origin.file], place_->origin.line},
                                "the condition nests brackets deeper than 200", "write it with fewer brackets");
            KeptNames kept = keepNames(line.rest, lookup);
            if (aliases_.exhausted())
                problems_.error({out_.flat.files[place_->origin.file], place_->origin.line},
                                fmt::format("the conditions lead to more than {} macros", MacroAliases::kMaxWords),
                                "let them name what they ask for, not macros that stand for many others");
            for (const std::string& name : kept.compared)
                if (const auto it = macroIndex_.find(name); it != macroIndex_.end())
                    inferNumber(out_.macros[it->second]);
            return std::move(kept.needs);
        }
        const std::string name(leadingName(line.rest));
        if (name.empty() || !isOutside(name, false)) return {};
        return {line.kind == LineKind::Ifndef ? "!" + name : name};
    }

    /// A name in a condition. Macros of the text stand for what they are defined as; others are asked of the outside.
    ConditionName lookUp(std::string_view name, bool isValue) {
        ConditionName result;
        result.outside = isOutside(name, isValue);
        return result.outside || !isValue ? result : aliases_.follow(name);
    }

    bool isOutside(std::string_view name, bool isValue) {
        if (name.starts_with("GL_") || name.starts_with("__") || name == "VULKAN" || visible_.contains(name))
            return false;
        mention(name, isValue);
        return true;
    }

    DefineInfo* entry(std::string_view name) {
        const auto [it, isNew] = macroIndex_.try_emplace(std::string(name), out_.macros.size());
        if (isNew) out_.macros.push_back({{}, frames_.empty() ? std::vector<std::string>{} : needsOf(frames_.back())});
        DefineInfo& info = out_.macros[it->second].info;
        info.name = name;
        return &info;
    }

    void mention(std::string_view name, bool isValue) {
        if (engineConstants().contains(name)) return;
        DefineInfo* info = entry(name);
        info->tested = info->tested || isValue;
        if (info->where.line == 0 && place_ != nullptr) {
            const auto column = textOf(*place_).find(name);
            info->where = {out_.flat.files[place_->origin.file], place_->origin.line, static_cast<int>(column) + 1,
                           static_cast<int>(name.size())};
        }
    }

    /// Descriptions of names that the text defines itself say nothing; of several the last that says something holds. A
    /// description without a tag leaves a number what its comparisons make of it.
    void describe(const StageMacro& meta) {
        const std::string& name = meta.info.name;
        if (visible_.contains(name) || engineConstants().contains(name)) return;
        const DefineInfo* known = entry(name);
        StageMacro& macro = out_.macros[macroIndex_.find(name)->second];
        if (known->described && meta.info.type == DefineType::Bool && !meta.hasDefault) return;
        const bool tested = known->tested;
        macro.info = meta.info;
        macro.info.tested = tested;
        macro.hasDefault = meta.hasDefault;
        macro.constant = meta.constant;
        if (std::exchange(macro.inferred, false)) inferNumber(macro);
    }

    std::vector<std::string> needsOf(const Frame& frame) {
        std::vector<std::string> needs;
        if (needs_ > kMaxNeeds) return needs;
        std::unordered_set<std::string_view> known;
        for (const auto* part : {&frame.outer, &frame.earlier, &frame.current})
            for (const std::string& need : *part)
                if (known.insert(need).second) needs.push_back(need);
        needs_ += needs.size();
        if (needs_ > kMaxNeeds && place_ != nullptr)
            problems_.error(placeOf(*place_), "the branches of this stage's conditions are too many to keep",
                            "an #elif needs all that stands above it not to hold: write fewer in one condition");
        return needs;
    }

    std::uint32_t internNeeds() {
        if (frames_.empty()) return 0;
        auto needs = needsOf(frames_.back());
        std::string key;
        for (const std::string& need : needs) key += need + ' ';
        const auto [it, isNew] =
            conditionIndex_.try_emplace(std::move(key), static_cast<std::uint32_t>(out_.conditions.size()));
        if (isNew && needs.empty()) return it->second = 0;
        if (isNew) out_.conditions.push_back(std::move(needs));
        return it->second;
    }

    void fillTo(std::size_t line) {
        std::fill(out_.conditionOf.begin() + static_cast<std::ptrdiff_t>(filled_),
                  out_.conditionOf.begin() + static_cast<std::ptrdiff_t>(line), present_);
        filled_ = line;
    }

    void listDefined() {
        for (const std::string_view name : inText_) out_.defined.emplace_back(name);
        for (const auto& [name, macros] : definitions_) out_.defined.emplace_back(name);
        std::sort(out_.defined.begin(), out_.defined.end());
        out_.defined.erase(std::unique(out_.defined.begin(), out_.defined.end()), out_.defined.end());
    }

    void checkWeights() {
        MacroWeights weights;
        for (const auto& [name, macros] : definitions_)
            for (const MacroDefinition* macro : macros)
                if (!macro->bearsDirectives) weights.add(*macro);
        weights.check(out_.flat, problems_);
    }

    void hoist() {
        const auto [text, lines] = hoistMacros(hoisted_, inText_);
        dropDead();
        const int count = static_cast<int>(lines.size());
        out_.flat.text.insert(0, text);
        out_.flat.lines.insert(out_.flat.lines.begin(), lines.begin(), lines.end());
        out_.conditionOf.insert(out_.conditionOf.begin(), lines.size(), 0);
        for (PragmaMark& mark : out_.marks) mark.line += count;
        std::map<int, FlatSource::Origin> calls;
        for (const auto& [line, origin] : out_.flat.calls) calls.emplace_hint(calls.end(), line + count, origin);
        out_.flat.calls = std::move(calls);
    }

    StageText& out_;
    std::vector<FlatDirective> directives_;
    Problems& problems_;
    MacroDefinitions definitions_;
    MacroAliases aliases_{definitions_, [this](std::string_view name) { return isOutside(name, true); }};
    std::unordered_set<std::string_view> inText_, visible_;
    std::unordered_map<std::string, std::size_t> macroIndex_;
    std::unordered_map<std::string, std::uint32_t> conditionIndex_;
    std::vector<Frame> frames_;
    std::vector<HoistedMacro> hoisted_;
    const FlatDirective* place_ = nullptr;
    std::vector<FunctionRange> dead_;
    std::unordered_set<std::string_view> words_;  ///< Of what is alive, once somebody asks.
    std::size_t nextDead_ = 0, needs_ = 0;
    std::size_t filled_ = 0;
    std::uint32_t present_ = 0;
};

}  // namespace

void inferNumber(StageMacro& macro) {
    if (macro.info.type != DefineType::Bool) return;
    macro.info.type = DefineType::Number;
    macro.info.range = {0, 3};
    macro.inferred = true;
}

StageText analyzeStage(ShaderStageBits stage, Flattened flattened, std::string_view entry,
                       const std::vector<DefineInfo>& others, Problems& problems) {
    StageText out;
    out.stage = stage;
    out.flat = std::move(flattened.flat);
    out.marks = std::move(flattened.marks);
    out.extensions = std::move(flattened.extensions);
    Analysis(out, std::move(flattened.directives), problems).run(entry.empty() ? "main" : entry, others);
    return out;
}

}  // namespace crevice::cocos
