#pragma once

namespace seam {

/// OpenGL's shading language, version 3.30. Everything is in the world's frame [m]; colours are linear.
extern const char* const vertex_shader;
extern const char* const depth_shader;    // into a shadow map
extern const char* const surface_shader;  // of everything that is seen

}  // namespace seam
