#include "scenes/view/gpu_mesh.hpp"

#include <epoxy/gl.h>

namespace seam {

GpuMesh::GpuMesh(const Mesh& mesh) : count_(static_cast<int>(mesh.triangles.size())) {
  Eigen::MatrixXf vertices(6, mesh.positions.cols());
  vertices << mesh.positions, mesh.normals;
  glGenVertexArrays(1, &array_);
  glGenBuffers(1, &vertices_);
  glGenBuffers(1, &indices_);
  glBindVertexArray(array_);
  glBindBuffer(GL_ARRAY_BUFFER, vertices_);
  glBufferData(GL_ARRAY_BUFFER, vertices.size() * static_cast<GLsizeiptr>(sizeof(float)),
               vertices.data(), GL_STATIC_DRAW);
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_);
  glBufferData(GL_ELEMENT_ARRAY_BUFFER, count_ * static_cast<GLsizeiptr>(sizeof(int)),
               mesh.triangles.data(), GL_STATIC_DRAW);
  for (const unsigned i : {0U, 1U}) {
    const auto offset = static_cast<std::size_t>(3 * i) * sizeof(float);
    glEnableVertexAttribArray(i);
    glVertexAttribPointer(i, 3, GL_FLOAT, GL_FALSE, 6 * sizeof(float),
                          reinterpret_cast<const void*>(offset));
  }
}

GpuMesh::~GpuMesh() {
  glDeleteVertexArrays(1, &array_);
  glDeleteBuffers(1, &vertices_);
  glDeleteBuffers(1, &indices_);
}

void GpuMesh::draw() const {
  glBindVertexArray(array_);
  glDrawElements(GL_TRIANGLES, count_, GL_UNSIGNED_INT, nullptr);
}

}  // namespace seam
