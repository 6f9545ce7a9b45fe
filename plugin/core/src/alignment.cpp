#include <seam/alignment.hpp>

namespace seam {

const char SEAM_EIGEN_BUILD = 0;

}  // namespace seam
