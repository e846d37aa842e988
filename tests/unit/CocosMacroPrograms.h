// Small random programs full of macros, as text in Cocos' dialect and as what a C preprocessor understands.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace crevice::cocos {

/// The macros that come from outside, one bit each: a variant is a number of these bits.
constexpr std::array<const char*, 3> kSwitches = {"USE_A", "USE_B", "USE_C"};
constexpr unsigned kVariantCount = 8;

class MacroProgram {
public:
    /// Equal seeds give equal programs of about `size` lines. `crossing`: conditions between a call's brackets may hold
    /// commas and brackets of the call.
    MacroProgram(std::uint32_t seed, int size, bool crossing);

    /// In Cocos' dialect: preprocessor lines stand in the bodies of macros.
    std::string source() const;
    /// With the conditions of the bodies decided, which C does not know.
    std::string plain(unsigned variant) const;

    /// The program is made of lines and conditions that may be left out.
    std::size_t itemCount() const { return items_.size(); }
    MacroProgram without(std::size_t item) const;

    /// All names that programs define.
    static std::vector<std::string> names();

private:
    std::uint32_t next(std::uint32_t below);
    bool chance(std::uint32_t percent) { return next(100) < percent; }

    void addItems(int count, int depth);
    void addDefine();
    void addCondition(int depth);
    void addStatement();
    std::string condition();
    std::string body(std::size_t name, int arity);
    std::string value(int arity, int depth, bool breaks);
    std::string call(std::size_t name, int arity, int depth, bool breaks);
    std::string branches(int arity, int depth);

    std::uint32_t state_;
    bool crossing_;
    struct Item {
        std::size_t begin = 0, end = 0;
    };
    std::vector<Item> items_;
    std::string text_;                ///< Conditions of bodies as kIf, switch, kElse, …, kEnd.
    std::array<bool, 16> written_{};  ///< Has been defined: another #define needs an #undef.
};

}  // namespace crevice::cocos
