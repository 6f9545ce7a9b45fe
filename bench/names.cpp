#include "bench/names.hpp"

#include <algorithm>

#include <seam/error.hpp>

namespace seam {

std::vector<Join> read_methods(const std::vector<std::string>& names) {
  std::vector<Join> methods;
  for (const std::string& name : names) {
    const Join method = join_from_name(name);
    if (std::find(methods.begin(), methods.end(), method) != methods.end())
      throw Error("method \"" + name + "\"", "given twice");
    methods.push_back(method);
  }
  if (names.empty()) methods.assign(all_joins.begin(), all_joins.end());
  return methods;
}

}  // namespace seam
