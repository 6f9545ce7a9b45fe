#pragma once

#include <array>

#include <seam/join.hpp>

namespace seam {

/// How a method's curves look in every picture; the colours are told apart by the colour-blind, too.
struct MethodStyle {
  const char* colour;       // #rrggbb
  std::array<int, 2> dash;  // drawn, left out; 0, 0: a whole line
};

constexpr MethodStyle style_of(Join method) {
  switch (method) {
    case Join::dmp2a:
      return {"#0072b2", {0, 0}};
    case Join::dmp3:
      return {"#009e73", {8, 5}};
    case Join::dmp2j:
      return {"#cc79a7", {3, 3}};
    default:
      return {"#d55e00", {0, 0}};
  }
}

}  // namespace seam
