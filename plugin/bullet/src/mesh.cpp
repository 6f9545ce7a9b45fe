#include <algorithm>
#include <cctype>
#include <filesystem>

#include <Eigen/Geometry>
#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <seam/error.hpp>
#include <seam/mesh.hpp>

namespace seam {
namespace {

constexpr unsigned steps = aiProcess_Triangulate | aiProcess_FindDegenerates |
                           aiProcess_SortByPType | aiProcess_GenSmoothNormals |
                           aiProcess_JoinIdenticalVertices | aiProcess_PreTransformVertices;

const aiScene* import(Assimp::Importer& importer, const std::string& path) {
  importer.SetPropertyFloat(AI_CONFIG_PP_GSN_MAX_SMOOTHING_ANGLE, 35.0F);
  importer.SetPropertyBool(AI_CONFIG_PP_FD_REMOVE, true);
  importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE,
                              aiPrimitiveType_POINT | aiPrimitiveType_LINE);
  std::error_code status;
  if (!std::filesystem::is_regular_file(path, status)) throw Error(path, "no such file");
  const aiScene* scene = importer.ReadFile(path, steps);
  if (scene && !(scene->mFlags & AI_SCENE_FLAGS_INCOMPLETE)) return scene;
  throw Error(path, std::string("not a mesh that can be read: ") + importer.GetErrorString());
}

/// assimp hands these formats over with Y up, whatever up-axis the file names.
bool comes_with_y_up(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending == ".dae" || ending == ".gltf" || ending == ".glb";
}

Eigen::Matrix3Xf columns(const aiVector3D* vectors, unsigned count, bool y_up) {
  Eigen::Matrix3Xf result(3, count);
  for (unsigned i = 0; i < count; ++i) {
    const aiVector3D& v = vectors[i];
    result.col(i) = y_up ? Eigen::Vector3f(v.x, -v.z, v.y) : Eigen::Vector3f(v.x, v.y, v.z);
  }
  return result;
}

/// Normals that a file gives as zero come out of assimp as NaN: there those of the faces around take their place.
void repair_normals(Mesh& mesh) {
  Eigen::Matrix3Xf around = Eigen::Matrix3Xf::Zero(3, mesh.positions.cols());
  for (const auto& corner : mesh.triangles.colwise()) {
    const Eigen::Vector3f a = mesh.positions.col(corner(0));
    const Eigen::Vector3f face =
        (mesh.positions.col(corner(1)) - a).cross(mesh.positions.col(corner(2)) - a);
    for (const int i : corner) around.col(i) += face;
  }
  for (Eigen::Index i = 0; i < mesh.normals.cols(); ++i)
    if (!(mesh.normals.col(i).norm() > 0.5F))
      mesh.normals.col(i) = around.col(i).stableNormalized();
}

Eigen::Vector4f colour_of(const aiMaterial& material) {
  aiColor4D colour(0.8F, 0.8F, 0.8F, 1.0F);
  material.Get(AI_MATKEY_COLOR_DIFFUSE, colour);
  float opacity = 1.0F;
  if (material.Get(AI_MATKEY_OPACITY, opacity) == AI_SUCCESS) colour.a = opacity;
  return {colour.r, colour.g, colour.b, colour.a};
}

Mesh convert(const aiMesh& mesh, const aiMaterial& material, bool y_up) {
  Mesh result;
  result.positions = columns(mesh.mVertices, mesh.mNumVertices, y_up);
  result.normals = columns(mesh.mNormals, mesh.mNumVertices, y_up).colwise().normalized();
  result.triangles.resize(3, mesh.mNumFaces);
  for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
    const unsigned* corner = mesh.mFaces[i].mIndices;
    result.triangles.col(i) =
        Eigen::Matrix<unsigned, 3, 1>(corner[0], corner[1], corner[2]).cast<int>();
  }
  repair_normals(result);
  result.colour = colour_of(material);
  return result;
}

}  // namespace

std::vector<Mesh> load_mesh(const std::string& path) {
  Assimp::Importer importer;
  const aiScene& scene = *import(importer, path);
  const bool y_up = comes_with_y_up(path);
  std::vector<Mesh> meshes;
  for (unsigned i = 0; i < scene.mNumMeshes; ++i) {
    const aiMesh& mesh = *scene.mMeshes[i];
    if (mesh.mNumFaces == 0) continue;
    meshes.push_back(convert(mesh, *scene.mMaterials[mesh.mMaterialIndex], y_up));
    if (!meshes.back().positions.allFinite() || !meshes.back().normals.allFinite()) {
      throw Error(path, "mesh " + std::to_string(i) + " holds a value that is not finite");
    }
  }
  if (meshes.empty()) throw Error(path, "holds no triangle");
  return meshes;
}

}  // namespace seam
