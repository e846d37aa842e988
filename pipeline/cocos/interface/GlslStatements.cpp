// One walk that counts braces and parentheses and restores the counts where a condition changes its branch.
#include "cocos/interface/GlslStatements.h"

namespace crevice::cocos {
namespace {

bool isStorage(std::string_view word) { return word == "in" || word == "out" || word == "uniform" || word == "buffer"; }

class StatementWalk {
public:
    explicit StatementWalk(const std::vector<GlslToken>& tokens) : tokens_(tokens) {}

    std::vector<GlslStatement> run() {
        begin(0);
        while (at_ < tokens_.size()) {
            const GlslToken& token = tokens_[at_];
            if (token.directive) {
                const bool between = at_ == present_.begin;
                takeDirective();
                if (between) begin(at_);
            } else if (token.text == "{") {
                takeBrace();
            } else if (token.text == ";" && depth_.paren == 0) {
                endStatement();
            } else if (token.text == "}") {  // one more than was opened: a branch closed it elsewhere
                begin(++at_);
            } else {
                takeWord(token);
            }
        }
        return std::move(found_);
    }

private:
    struct Depth {
        int brace = 0, paren = 0;
    };

    void begin(std::size_t at) {
        present_ = {};
        present_.begin = at;
        hasStorage_ = hasValue_ = false;
        depth_.paren = 0;
    }

    void takeWord(const GlslToken& token) {
        if (token.text == "(") ++depth_.paren;
        if (token.text == ")" && depth_.paren > 0) --depth_.paren;
        if (depth_.paren == 0 && token.text == "=") hasValue_ = true;
        if (depth_.paren == 0 && !hasStorage_ && present_.brace == 0 && isStorage(token.text)) {
            hasStorage_ = true;
            present_.storage = at_;
            present_.conditional = !branches_.empty();
        }
        ++at_;
    }

    void takeBrace() {
        const bool isStruct = tokens_[present_.begin].text == "struct";
        const bool body = present_.brace == 0 && !hasValue_ && (hasStorage_ || isStruct);
        if (body) present_.brace = at_;
        const std::size_t branch = skipBraces();
        if (body && branch != 0) {  // another branch begins it anew, and only the last one goes on behind them
            present_.close = present_.end = branch;
            if (!hasStorage_) present_.storage = branch;
            found_.push_back(present_);
            begin(at_);
        } else if (body) {
            present_.close = at_ - 1;
        } else if (!hasValue_) {
            begin(at_);  // a function's body ends its statement
        }
    }

    void endStatement() {
        present_.end = at_;
        if (!hasStorage_) present_.storage = at_;
        if (hasStorage_ || present_.brace != 0) found_.push_back(present_);
        begin(++at_);
    }

    /// From a `{` to behind the `}` that closes it, or to the branch that begins outside of it: then that line's token.
    std::size_t skipBraces() {
        std::size_t branch = 0;
        do {
            const GlslToken& token = tokens_[at_];
            branch = token.directive ? at_ : 0;
            if (token.directive) {
                takeDirective();
                continue;
            }
            if (token.text == "{") ++depth_.brace;
            if (token.text == "}") --depth_.brace;
            ++at_;
        } while (depth_.brace > 0 && at_ < tokens_.size());
        depth_.brace = 0;
        return branch;
    }

    void takeDirective() {
        const std::size_t end = directiveEnd(tokens_, at_);
        const std::string_view word = at_ + 1 < end ? tokens_[at_ + 1].text : std::string_view();
        if (word == "if" || word == "ifdef" || word == "ifndef") {
            branches_.push_back(depth_);
        } else if ((word == "else" || word == "elif") && !branches_.empty()) {
            depth_ = branches_.back();
        } else if (word == "endif" && !branches_.empty()) {
            branches_.pop_back();
        }
        at_ = end;
    }

    const std::vector<GlslToken>& tokens_;
    std::size_t at_ = 0;
    Depth depth_;
    std::vector<Depth> branches_;  ///< Depths at the #if of each enclosing condition.
    GlslStatement present_;
    bool hasStorage_ = false, hasValue_ = false;
    std::vector<GlslStatement> found_;
};

}  // namespace

std::vector<GlslStatement> findInterfaceStatements(const std::vector<GlslToken>& tokens) {
    return StatementWalk(tokens).run();
}

}  // namespace crevice::cocos
