#include "scenes/own_folders.hpp"

namespace seam {

std::vector<std::string> with_own_folders(std::vector<std::string> folders) {
  folders.insert(folders.end(), {SEAM_SCENES, SEAM_ASSETS});
  return folders;
}

}  // namespace seam
