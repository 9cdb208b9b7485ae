#pragma once
// The words that begin lines of OBJ.   [Wavefront, Advanced Visualizer, appendix B1]

#include <algorithm>
#include <array>
#include <string_view>

namespace subdivd::proto::text {

// What is read, or may be left out because the refined mesh has its own.
inline constexpr std::array<std::string_view, 11> kReadObjWords = {"v", "vt", "vn", "f",      "l",     "o",
                                                                   "t", "fo", "g",  "usemtl", "mtllib"};
// Smoothing groups, and files that tell how things look.
inline constexpr std::array<std::string_view, 6> kObjGroupWords = {"s",      "mg",         "usemap",
                                                                   "maplib", "shadow_obj", "trace_obj"};
// What is rendered in other ways, and lines of free-form curves and surfaces.
inline constexpr std::array<std::string_view, 29> kOtherObjWords = {
    "p",     "vp",    "bevel", "c_interp", "d_interp", "lod",  "cstype", "deg", "bmat", "step",
    "curv",  "curv2", "surf",  "parm",     "trim",     "hole", "scrv",   "sp",  "end",  "con",
    "ctech", "stech", "call",  "csh",      "bsp",      "bzp",  "cdc",    "cdp", "res"};

template <std::size_t n>
constexpr bool is_among(std::string_view word, const std::array<std::string_view, n>& words) {
  return std::ranges::find(words, word) != words.end();
}

constexpr bool is_obj_word(std::string_view word) {
  return is_among(word, kReadObjWords) || is_among(word, kObjGroupWords) || is_among(word, kOtherObjWords);
}

}  // namespace subdivd::proto::text
