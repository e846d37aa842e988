// What stands in front of the names of an interface declaration, with conditions around some of its words.
#pragma once

#include <string>
#include <string_view>

#include "cocos/interface/Interface.h"

namespace crevice::cocos {

struct DeclarationFront {
    std::size_t begin = 0;     ///< Where the statement begins: at its first word, or at the #if around its first words.
    bool conditional = false;  ///< Conditions stand between `begin` and the first name, all of them closed there.
    std::string
        words;  ///< Qualifiers in front of the condition in one of whose branches the statement begins: "flat ".
};

/// Of a statement with several names. What is not understood begins at its first word and has no conditions. At most
/// `budget` bytes are looked at, which become fewer.
DeclarationFront findFront(std::string_view text, const InterfaceStatement& where, std::size_t& budget);

}  // namespace crevice::cocos
