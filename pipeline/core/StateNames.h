// The words of Cocos' files for fixed-function states. A word's place in its list is Cocos' number of it and, but for
// primitives and polygon modes, the value of our enum.
#pragma once

#include <array>
#include <string>

namespace crevice {

inline constexpr std::array kCompareNames = {"never",   "less",      "equal",         "less_equal",
                                             "greater", "not_equal", "greater_equal", "always"};
inline constexpr std::array kStencilNames = {"zero", "keep",   "replace",   "incr",
                                             "decr", "invert", "incr_wrap", "decr_wrap"};
inline constexpr std::array kCullNames = {"none", "front", "back"};
inline constexpr std::array kPolygonNames = {"fill", "point", "line"};
inline constexpr std::array kBlendFactorNames = {"zero",
                                                 "one",
                                                 "src_alpha",
                                                 "dst_alpha",
                                                 "one_minus_src_alpha",
                                                 "one_minus_dst_alpha",
                                                 "src_color",
                                                 "dst_color",
                                                 "one_minus_src_color",
                                                 "one_minus_dst_color",
                                                 "src_alpha_saturate",
                                                 "constant_color",
                                                 "one_minus_constant_color",
                                                 "constant_alpha",
                                                 "one_minus_constant_alpha"};
inline constexpr std::array kBlendOpNames = {"add", "sub", "rev_sub", "min", "max"};
inline constexpr std::array kTopologyNames = {"point_list",
                                              "line_list",
                                              "line_strip",
                                              "line_loop",
                                              "line_list_adjacency",
                                              "line_strip_adjacency",
                                              "iso_line_list",
                                              "triangle_list",
                                              "triangle_strip",
                                              "triangle_fan",
                                              "triangle_list_adjacency",
                                              "triangle_strip_adjacency",
                                              "triangle_patch_adjacency",
                                              "quad_patch_list"};

/// The word of a colour mask with red 1, green 2, blue 4, alpha 8: "rgb" of 7; nothing of 0.
inline std::string colorMaskWord(int mask) {
    std::string word;
    for (int i = 0; i < 4; ++i)
        if ((mask >> i & 1) != 0) word += "rgba"[i];
    return word;
}

}  // namespace crevice
