# Doxygen reads the public headers through this, so that they may stay as plain as they are: a comment behind a member
# documents it, formulas that are indented in a comment stand in lines of their own, and <x> is no HTML.
NR == 1 && $0 == "#pragma once" {print "/** @file */"; next}
/^ *\/\/\/     [^ ]/ {
  if (!formula) {blank = $0; sub(/\/\/\/.*/, "///", blank); print blank}
  formula = 1
}
!/^ *\/\/\/     / {formula = 0}
/^ *\/\/\/ / && !formula {
  if (!/`/) gsub(/</, "\\&lt;")
  gsub(/Eqs?[.] /, "&\\ "); gsub(/[.] \\ /, ".\\ ")  # not the end of a sentence
}
/[;,{}] +\/\/ / && !/NOLINT|namespace/ {sub(/\/\/ /, "///< ")}
{print}
