// The conditions that a stage's text stands in, line by line: which macros they let be defined where a call stands.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "cocos/text/SourceText.h"

namespace crevice::cocos {

class DefinedPlaces {
public:
    /// Of conditions within each other; GLSL's preprocessor takes no more.
    static constexpr std::size_t kMaxDepth = 64;

    /// A branch of a condition.
    struct Step {
        std::uint32_t id = 0, branch = 0;
        std::uint32_t condition = 0;  ///< Of the first branch: equal numbers are true together; 0 = not known.
    };
    /// The branches around a line, outermost first, include guards left out.
    using Place = std::vector<Step>;

    /// A name that is defined from the start.
    void defineBefore(std::string_view name) { seen_.emplace(name); }
    /// Follows a conditional line. False when conditions are nested too deep.
    bool follow(LineKind kind, std::string_view rest);
    /// A #define stands here. Where one is written in every branch of a condition, it is sure behind it.
    void define(std::string_view name);
    void undefine(std::string_view name);

    Place here() const;
    /// False within include guards alone.
    bool isConditional() const;
    /// True when `place` lies in another branch of a condition that is still open.
    bool excludes(const Place& place) const;
    /// True when whoever comes here came through `place`, or would have: the same condition holds here.
    bool implies(const Place& place) const;
    /// A definition stands above whatever the conditions are.
    bool isSure(std::string_view name) const;

private:
    struct Frame {
        Step step;
        std::string guarded;  ///< The name whose absence the first branch asks for.
        bool isGuard = false, hasElse = false;
        std::unordered_set<std::string> defined, common;  ///< In this branch; in all before it.
    };
    void endBranch(Frame& frame);
    std::uint32_t numberOf(LineKind kind, std::string_view condition);
    void forgetConditions(const std::string& name);

    std::vector<Frame> frames_;
    std::unordered_set<std::string> top_, seen_;
    std::unordered_map<std::string, std::uint32_t> conditions_;
    std::unordered_map<std::string, std::vector<std::string>> conditionsWith_;  ///< By the names in them.
    std::uint32_t next_ = 0;
};

}  // namespace crevice::cocos
