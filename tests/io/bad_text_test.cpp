#include <gtest/gtest.h>

#include "import_bytes.h"

namespace lorica::test {
namespace {

const std::string corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

TEST(BadFile, MustExistBeAFileAndBeKnown) {
  EXPECT_THROW(io::importModel("/nonexistent/body.glb"), base::InputError);
  EXPECT_THROW(io::importModel(ScratchFolder().path()), base::InputError);
  expectRefused("", "a.glb", "is empty");
  expectRefused("hello", "a.txt", "known format");
}

TEST(BadObj, LineIsNamed) {
  expectRefused(corners + "f 1 2 4\n", "a.obj", "line 4: the face uses vertex 4, but only 3");
  expectRefused(corners + "f 1 2 -4\n", "a.obj", "line 4");
  expectRefused(corners + "f 1 2 0\n", "a.obj", "line 4");
  expectRefused(corners + "f 1 2\n", "a.obj", "line 4: a face needs three corners");
  expectRefused(corners + "f 1 2 3x\n", "a.obj", "not '3x'");
  expectRefused(corners + "f 1/1 2/a 3\n", "a.obj", "not '2/a'");
  expectRefused("v 0 0\n" + corners, "a.obj", "line 1: the z of a vertex was expected, not ''");
  expectRefused("v 0 0 1,5\n" + corners, "a.obj", "not '1,5'");
  expectRefused("v 0 0 nan\n" + corners, "a.obj", "line 1");
  expectRefused("v 0 0 1e999\n" + corners, "a.obj", "line 1");
  expectRefused(corners + "w 1 2 3\n", "a.obj", "'w' is no OBJ statement");
  expectRefused(corners, "a.obj", "no triangles");
  expectRefused("v 0 0 1e300\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "a.obj", "further away");
}

TEST(BadStl, CutOrGarbledFilesAreRefused) {
  expectRefused("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nendloop\n", "a.stl",
                "line 6: 'vertex' was expected, not 'endloop'");
  expectRefused("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n", "a.stl", "the file ends where 'vertex'");
  expectRefused("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 x\n", "a.stl", "line 4");
  expectRefused("solid a\nendsolid\n", "a.stl", "no triangles");
  std::string binary(84 + 50, '\0');
  binary[80] = 2;
  expectRefused(binary, "a.stl", "states 2 triangles, which take 184 bytes, but has 134");
  expectRefused("xyz", "a.stl", "too short");
  binary[80] = 1;
  binary.replace(84 + 12, 4, "\xFF\xFF\xFF\xFF");
  expectRefused(binary, "a.stl", "triangle 0: a coordinate is not a finite number");
}

const std::string plyHead =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n";

TEST(BadPly, LineOrElementIsNamed) {
  expectRefused(plyHead + "0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", "a.ply", "uses vertex 3, but there are 3 vertices");
  expectRefused(plyHead + "0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n", "a.ply", "line 13: -1 is no vertex index");
  expectRefused(plyHead + "0 0 0\n1 0 0\n0 1 0\n3 0 1 1.5\n", "a.ply", "1.5 is no vertex index");
  expectRefused(plyHead + "0 0 0\n1 0 0\n0 1 0\n-3 0 1 2\n", "a.ply", "no count");
  expectRefused(plyHead + "0 0 0\n1 0 0\n0 1\n", "a.ply", "the file ends before");
  expectRefused(plyHead + "0 0 0\n1 0 q\n0 1\n", "a.ply", "line 11: a number was expected, not 'q'");
  expectRefused(plyHead + "0 0 0\n1 0 nan\n0 1 0\n3 0 1 2\n", "a.ply", "finite x, y and z");
  expectRefused("ply\nformat ascii 1.0\nelement vertex 9999999999\n", "a.ply", "line 3");
  expectRefused("ply\nformat ascii 1.0\nelement vertex 3\nend_header\n", "a.ply", "has no properties");
  expectRefused("ply\nformat ascii 1.0\nproperty float x\n", "a.ply", "before the first element");
  expectRefused("ply\nformat ascii 1.0\nelement vertex 3\nproperty floaty x\n", "a.ply", "not 'floaty'");
  expectRefused("ply\nformat binary_middle_endian 1.0\n", "a.ply", "line 2");
  expectRefused("ply\nelement vertex 0\nproperty float x\nend_header\n", "a.ply", "format line is missing");
  expectRefused("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n1\n", "a.ply", "x, y and z");
  expectRefused("ply\nformat ascii 1.0\n", "a.ply", "the file ends where end_header");
  expectRefused(
      "ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\nproperty float x\nproperty float y\n"
      "property float z\nend_header\n" +
          std::string(24, '\0'),
      "a.ply", "vertex 2: the file ends before");
}

TEST(BadOff, LineIsNamed) {
  expectRefused("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", "a.off", "line 6: the face uses vertex 3");
  expectRefused("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1\n", "a.off", "line 6");
  expectRefused("OFF\n3 1 0\n0 0 0\n1 0 0\n", "a.off", "the file ends where one of 3 vertices");
  expectRefused("OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "a.off", "the file ends where one of 2 faces");
  expectRefused("OFF\n-3 1 0\n", "a.off", "line 2");
  expectRefused("OFF BINARY\n", "a.off", "binary OFF");
  expectRefused("4OFF\n1 1 1\n", "a.off", "dimensions");
  expectRefused("OFF\n3000000000 1 0\n0 0 0\n", "a.off", "the file ends");
}

}  // namespace
}  // namespace lorica::test
