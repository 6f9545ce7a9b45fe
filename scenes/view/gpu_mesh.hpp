#pragma once

#include <seam/mesh.hpp>

namespace seam {

/// A mesh in the memory of what draws; needs a current context from first to last.
class GpuMesh {
 public:
  explicit GpuMesh(const Mesh& mesh);
  GpuMesh(const GpuMesh&) = delete;
  GpuMesh& operator=(const GpuMesh&) = delete;
  ~GpuMesh();

  void draw() const;

 private:
  unsigned array_ = 0, vertices_ = 0, indices_ = 0;
  int count_ = 0;
};

}  // namespace seam
