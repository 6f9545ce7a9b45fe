#pragma once

namespace seam {

/// The last of the guards against mixed precisions (see precision.hpp), for libraries that come by ways which neither
/// compiler nor linker see.
/// @throws Error  Bullet's libraries of the other precision are loaded, too
void require_one_precision();

}  // namespace seam
