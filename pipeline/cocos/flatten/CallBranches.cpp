// Walks through all branches at once, with the depths of brackets that they may have come to.
#include "cocos/flatten/CallBranches.h"

#include <algorithm>

namespace crevice::cocos {
namespace {

constexpr std::size_t kMaxPaths = 16;
constexpr int kWaiting = 0;  ///< The '(' is still to come.

class Walk {
public:
    Walk(const CodeLines& lines, std::size_t maxBytes) : lines_(lines), maxBytes_(maxBytes) {}

    CallBranches run(std::size_t line, std::size_t at, std::string_view name) {
        std::string text = std::string(name) + std::string(lines_.text(line).substr(at));
        std::size_t from = name.size(), shift = at - name.size();  // The name may stand elsewhere: modulo 2^n.
        for (;; ++line, text = lines_.text(line), from = shift = 0) {
            const auto origin = lines_.origin(line);
            const LineKind kind = from == 0 ? readDirective(text).kind : LineKind::Code;
            if (kind == LineKind::Code) {
                const std::size_t end = follow(text, from);
                target().texts.push_back(text.substr(0, end));
                target().origins.push_back(origin);
                if (isDone()) return join(line, end + shift);
                result_.bytes += text.size() + 1;
            } else {
                if (!take(joinContinued(lines_, line), kind, origin)) break;
                if (isDone()) return join(line, lines_.text(line).size());
            }
            if (line + 1 >= lines_.size() || result_.bytes > maxBytes_ || paths_.size() > kMaxPaths) break;
        }
        result_.branches.clear();
        return std::move(result_);
    }

private:
    struct Condition {
        std::vector<int> before, behind;
        bool hasElse = false;
    };

    bool isDone() const { return paths_.empty() && open_.empty() && phase_ == Phase::Behind; }

    BodyLines& target() {
        return phase_ == Phase::Before ? before_ : phase_ == Phase::Within ? result_.branches.back().lines : behind_;
    }

    /// Returns where the last call closes, or the end.
    std::size_t follow(std::string_view text, std::size_t from) {
        for (; from < text.size() && !paths_.empty(); ++from) {
            const char c = text[from];
            if (c == ' ' || c == '\t') continue;
            if (c == '(') isCalled_ = true;
            if (c != '(') std::erase(paths_, kWaiting);
            for (int& depth : paths_) depth += int(c == '(') - int(c == ')');
            std::erase(paths_, kWaiting);
            if (isDone()) return from + 1;
        }
        return text.size();
    }

    bool take(const std::string& text, LineKind kind, FlatSource::Origin origin) {
        if (!isConditional(kind)) return false;
        result_.bytes += text.size() + 1;
        const bool opens = kind == LineKind::If || kind == LineKind::Ifdef || kind == LineKind::Ifndef;
        if (!opens && open_.empty()) return false;
        if (opens) {
            open_.push_back({paths_, {}, false});
            if (phase_ == Phase::Before) {
                phase_ = Phase::Within;
                result_.branches.push_back({text, origin, {}});
                return true;
            }
        } else if (kind != LineKind::Endif) {
            Condition& condition = open_.back();
            condition.hasElse = condition.hasElse || kind == LineKind::Else;
            add(condition.behind, paths_);
            paths_ = condition.before;
            if (phase_ == Phase::Within && open_.size() == 1) {
                result_.branches.push_back({text, origin, {}});
                return true;
            }
        } else {
            const Condition condition = open_.back();
            open_.pop_back();
            add(paths_, condition.behind);
            if (!condition.hasElse) add(paths_, condition.before);
            if (phase_ == Phase::Within && open_.empty()) {
                phase_ = Phase::Behind;
                if (!condition.hasElse) result_.branches.push_back({"#else", origin, {}});
                return true;
            }
        }
        target().texts.push_back(text);
        target().origins.push_back(origin);
        return true;
    }

    static void add(std::vector<int>& to, const std::vector<int>& more) {
        to.insert(to.end(), more.begin(), more.end());
        std::sort(to.begin(), to.end());
        to.erase(std::unique(to.begin(), to.end()), to.end());
    }

    CallBranches join(std::size_t line, std::size_t end) {
        result_.line = line;
        result_.end = end;
        if (!isCalled_) result_.branches.clear();
        for (CallBranches::Branch& branch : result_.branches) {
            BodyLines all = before_;
            for (const BodyLines* part : {&branch.lines, &behind_}) {
                all.texts.insert(all.texts.end(), part->texts.begin(), part->texts.end());
                all.origins.insert(all.origins.end(), part->origins.begin(), part->origins.end());
            }
            branch.lines = std::move(all);
        }
        return std::move(result_);
    }

    const CodeLines& lines_;
    std::size_t maxBytes_;
    enum class Phase { Before, Within, Behind } phase_ = Phase::Before;
    CallBranches result_;
    BodyLines before_, behind_;
    std::vector<int> paths_{kWaiting};
    std::vector<Condition> open_;
    bool isCalled_ = false;
};

}  // namespace

CallBranches splitCall(const CodeLines& lines, std::size_t line, std::size_t at, std::string_view name,
                       std::size_t maxBytes) {
    return Walk(lines, maxBytes).run(line, at, name);
}

}  // namespace crevice::cocos
