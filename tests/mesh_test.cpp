#include <cmath>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "tests/temp_folder.hpp"
#include <seam/error.hpp>
#include <seam/mesh.hpp>

namespace {

using Eigen::Vector3f;

std::string refusal(const std::string& path) {
  try {
    seam::load_mesh(path);
  } catch (const seam::Error& error) {
    return error.what();
  }
  return "accepted";
}

/// A strip of two squares along x that meet at an angle, without normals.
std::string bent_strip(double degrees) {
  const double c = std::cos(degrees * M_PI / 180.0), s = std::sin(degrees * M_PI / 180.0);
  return "v -1 0 0\nv -1 1 0\nv 0 0 0\nv 0 1 0\nv " + std::to_string(c) + " 0 " +
         std::to_string(s) + "\nv " + std::to_string(c) + " 1 " + std::to_string(s) +
         "\nf 1 3 4 2\nf 3 5 6 4\n";
}

/// A triangle in COLLADA whose last corner is 2 along the file's y and 3 along its z.
std::string collada(const std::string& up_axis, const std::string& metres) {
  return R"(<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
    <asset><unit name="u" meter=")" +
         metres + R"("/><up_axis>)" + up_axis + R"(</up_axis></asset>
    <library_geometries><geometry id="g"><mesh>
      <source id="p"><float_array id="pa" count="9">0 0 0 1 0 0 0 2 3</float_array><technique_common>
        <accessor source="#pa" count="3" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
        <param name="Z" type="float"/></accessor></technique_common></source>
      <vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
      <triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles>
    </mesh></geometry></library_geometries>
    <library_visual_scenes><visual_scene id="s"><node id="n"><instance_geometry url="#g"/></node></visual_scene>
    </library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>)";
}

/// The corner that is farthest from the origin.
Vector3f far_corner(const std::string& path) {
  const seam::Mesh mesh = seam::load_mesh(path).at(0);
  Eigen::Index column = 0;
  mesh.positions.colwise().norm().maxCoeff(&column);
  return mesh.positions.col(column);
}

TEST(Mesh, OfABlockHasTwelveTrianglesAndSharpEdges) {
  const auto meshes = seam::load_mesh(SEAM_TEST_DATA "/block.obj");
  ASSERT_EQ(meshes.size(), 1U);
  const seam::Mesh& block = meshes[0];
  EXPECT_EQ(block.triangles.cols(), 12);
  EXPECT_EQ(block.positions.cols(), 24) << "four corners a face, shared by no other face";
  EXPECT_NEAR(block.positions.rowwise().maxCoeff().maxCoeff(), 0.1F, 1e-7F);
  for (const auto& normal : block.normals.colwise()) {
    EXPECT_NEAR(normal.norm(), 1.0F, 1e-6F);
    EXPECT_NEAR(normal.cwiseAbs().maxCoeff(), 1.0F, 1e-6F) << "along an axis: edges are sharp";
  }
}

TEST(Mesh, MakesNormalsWhereAFileHasThemOfLengthZero) {
  const TempFolder folder;
  const auto meshes = seam::load_mesh(folder.write(
      "zero.stl",
      "solid s\nfacet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n"
      "endfacet\nendsolid s\n"));
  ASSERT_EQ(meshes.at(0).normals.cols(), 3);
  for (const auto& normal : meshes[0].normals.colwise())
    EXPECT_LE((normal - Vector3f::UnitZ()).norm(), 1e-6F);
}

TEST(Mesh, TrianglesTurnAnticlockwiseSeenFromOutside) {
  const seam::Mesh block = seam::load_mesh(SEAM_TEST_DATA "/block.obj").at(0);
  for (const auto& triangle : block.triangles.colwise()) {
    const Vector3f a = block.positions.col(triangle[0]), b = block.positions.col(triangle[1]),
                   c = block.positions.col(triangle[2]);
    EXPECT_GT((b - a).cross(c - a).dot(block.normals.col(triangle[0])), 0.0F);
    EXPECT_GT(a.dot(block.normals.col(triangle[0])), 0.0F);
  }
}

TEST(Mesh, KeepsCreasesAbove35DegreesSharpAndSmoothsOthers) {
  const TempFolder folder;
  EXPECT_EQ(seam::load_mesh(folder.write("blunt.obj", bent_strip(30.0))).at(0).positions.cols(), 6);
  EXPECT_EQ(seam::load_mesh(folder.write("sharp.obj", bent_strip(40.0))).at(0).positions.cols(), 8);
}

TEST(Mesh, HasOneMeshPerMaterialWithItsColour) {
  const TempFolder folder;
  folder.write("m.mtl", "newmtl red\nKd 1 0 0\nnewmtl glass\nKd 0 0 1\nd 0.25\n");
  const std::string file = folder.write("m.obj",
                                        "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nusemtl "
                                        "red\nf 1 2 3\nusemtl glass\nf 1 2 4\n");
  const auto meshes = seam::load_mesh(file);
  ASSERT_EQ(meshes.size(), 2U);
  const bool red_first = meshes[0].colour.x() == 1.0F;
  EXPECT_EQ(meshes[red_first ? 0 : 1].colour, Eigen::Vector4f(1.0F, 0.0F, 0.0F, 1.0F));
  EXPECT_EQ(meshes[red_first ? 1 : 0].colour, Eigen::Vector4f(0.0F, 0.0F, 1.0F, 0.25F));
}

TEST(Mesh, LeavesOutFacesWithoutArea) {
  const TempFolder folder;
  const auto meshes = seam::load_mesh(
      folder.write("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 2 0 0\nf 1 2 3\nf 1 2 4\nf 1 1 3\n"));
  ASSERT_EQ(meshes.size(), 1U);
  EXPECT_EQ(meshes[0].triangles.cols(), 1);
}

// Whatever the file calls up becomes z.
TEST(Mesh, TurnsColladasUpAxisToZ) {
  const TempFolder folder;
  EXPECT_LE((far_corner(folder.write("z.dae", collada("Z_UP", "1"))) - Vector3f(0, 2, 3)).norm(),
            1e-6F);
  EXPECT_LE((far_corner(folder.write("y.dae", collada("Y_UP", "1"))) - Vector3f(0, -3, 2)).norm(),
            1e-6F);
}

TEST(Mesh, TakesColladasUnit) {
  const TempFolder folder;
  EXPECT_LE(
      (far_corner(folder.write("cm.DAE", collada("Z_UP", "0.01"))) - Vector3f(0, 0.02F, 0.03F))
          .norm(),
      1e-7F);
}

// Three corners as the bytes of nine little-endian floats; glTF is always Y up.
TEST(Mesh, TurnsGltfToZUp) {
  const TempFolder folder;
  const std::string file = folder.write(
      "t.gltf", R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
    "nodes": [{"mesh": 0}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 2, 3]}],
    "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 36}],
    "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAAEAAAEBA"}]})");
  EXPECT_LE((far_corner(file) - Vector3f(0, -3, 2)).norm(), 1e-6F);
}

TEST(Mesh, RefusesWhatItCannotRead) {
  const TempFolder folder;
  EXPECT_EQ(refusal("/no/such.obj"), "/no/such.obj: no such file");
  const std::string unknown = folder.write("m.xyz", "1 2 3");
  EXPECT_EQ(refusal(unknown).rfind(unknown + ": not a mesh that can be read: ", 0), 0U);
  const std::string broken = folder.write("m.dae", "<COLLADA><asset></COLLADA>");
  EXPECT_EQ(refusal(broken).rfind(broken + ": not a mesh that can be read: ", 0), 0U);
  EXPECT_EQ(refusal(broken).find('\n'), std::string::npos);
}

TEST(Mesh, RefusesWhatHoldsNoTriangle) {
  const TempFolder folder;
  const std::string line = folder.write("line.obj", "v 0 0 0\nv 1 0 0\nl 1 2\n");
  EXPECT_EQ(refusal(line).rfind(line + ": ", 0), 0U) << refusal(line);
}

TEST(Mesh, RefusesValuesThatAreNotFinite) {
  const TempFolder folder;
  const std::string file =
      folder.write("m.obj", "v nan 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2//1 3//1\n");
  EXPECT_EQ(refusal(file).rfind(file + ": ", 0), 0U) << refusal(file);
}

}  // namespace
