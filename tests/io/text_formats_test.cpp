#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>

#include "import_bytes.h"
#include "lorica/geometry/measures.h"
#include "lorica/geometry/mesh_audit.h"

namespace lorica::test {
namespace {

using base::Severity;
using geometry::Triangle;
using io::Model;

const io::ImportOptions asWritten{base::LengthUnit::metre, io::UpAxis::y};

/// The tetrahedron 0, x, y, z.
void expectTetrahedron(const Model& model) {
  ASSERT_EQ(model.parts.size(), 1U);
  EXPECT_EQ(model.parts[0].mesh.positions.size(), 4U);
  EXPECT_EQ(model.parts[0].mesh.triangles.size(), 4U);
  EXPECT_TRUE(geometry::audit(model.parts[0].mesh).closed());
  EXPECT_NEAR(geometry::signedVolume(model.parts[0].mesh), 1.0 / 6.0, 1e-12);
  EXPECT_EQ(issuesAbout(model, Severity::note, "inside out"), 0U);
}

template <class T>
void append(std::string& bytes, T value, bool bigEndian = false) {
  std::array<char, sizeof(T)> raw{};
  std::memcpy(raw.data(), &value, sizeof(T));
  if (bigEndian) {
    std::reverse(raw.begin(), raw.end());
  }
  bytes.append(raw.data(), raw.size());
}

TEST(Obj, CornersMayBeWrittenInAllFourFormsAndCountedBackwards) {
  expectTetrahedron(
      importBytes("# a comment\n"
                  "v 0 0 0\nv 1 0 0 0.5 0.5 0.5\nv 0 +1.0e0 0\nv 0 0 10e-1\n"
                  "vt 0 0\nvn 0 0 1\n"
                  "f 1 3 2 # trailing\nf 1/1 2/1 4/1\nf 1//1 4//1 3//1\nf -3/-1/-1 -2/-1/-1 -1/-1/-1\n",
                  "a.obj", asWritten));
}

TEST(Obj, CarriageReturnsAndJoinedLinesAreUnderstood) {
  expectTetrahedron(
      importBytes("v 0 0 0\r\nv 1 0 0\r\nv 0 1 \\\r\n 0\r\nv 0 0 1\r\n"
                  "f 1 3 2\r\nf 1 2 \\\r\n4\r\nf 1 4 3\r\nf 2 3 4",
                  "a.obj", asWritten));
}

TEST(Obj, PolygonsAreCutAroundTheirFirstCorner) {
  const Model model = importBytes("v 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 2 0\nv 0 1 0\nf 1 2 3 4 5\n", "a.obj", asWritten);
  EXPECT_EQ(model.parts[0].mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}}));
  EXPECT_NEAR(geometry::area(model.parts[0].mesh), 3.0, 1e-12);
}

TEST(Obj, ObjectsAndGroupsBecomeParts) {
  const Model model = importBytes(
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
      "f 1 2 3\no left lung\nf 1 2 4\ng heart\nusemtl red\nf 2 3 4\n"
      "o left lung\nf 1 3 4\no empty\n",
      "a.obj", asWritten);
  ASSERT_EQ(model.parts.size(), 3U);
  EXPECT_EQ(model.parts[0].name, "part_0");
  EXPECT_EQ(model.parts[1].name, "left lung");
  EXPECT_EQ(model.parts[1].mesh.triangles.size(), 2U);
  EXPECT_EQ(model.parts[2].name, "heart");
  EXPECT_EQ(model.parts[2].mesh.positions.size(), 3U) << "only its own vertices";
}

TEST(Obj, PointsAndLinesAreNoted) {
  const Model model = importBytes("v 0 0 0\nv 1 0 0\nv 0 1 0\nl 1 2\np 1\nf 1 2 3\n", "a.obj", asWritten);
  EXPECT_EQ(issuesAbout(model, Severity::note, "2 statements"), 1U);
}

std::string asciiStl(bool capitals) {
  const char* points[] = {"0 0 0", "1 0 0", "0 1 0", "0 0 1"};
  const int faces[][3] = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  std::string text = "solid a body\n";
  for (const auto& face : faces) {
    text += "  facet normal nan 0 0\n    outer loop\n";
    for (const int corner : face) {
      text += std::string("      vertex ") + points[corner] + "\n";
    }
    text += "    endloop\n  endfacet\n";
  }
  text += "endsolid a body\n";
  if (capitals) {
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::toupper(c); });
  }
  return text;
}

std::string binaryStl(const std::string& head) {
  const float points[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const int faces[][3] = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  std::string bytes = head;
  bytes.resize(80, ' ');
  append(bytes, std::uint32_t{4});
  for (const auto& face : faces) {
    bytes.append(12, '\0');
    for (const int corner : face) {
      for (const float coordinate : points[corner]) {
        append(bytes, coordinate);
      }
    }
    bytes.append(2, '\0');
  }
  return bytes;
}

TEST(Stl, TextAndBinaryAreToldApartByContent) {
  expectTetrahedron(importBytes(asciiStl(false), "a.stl", asWritten));
  expectTetrahedron(importBytes(asciiStl(true), "a.STL", asWritten));
  expectTetrahedron(importBytes(binaryStl("exported"), "a.stl", asWritten));
  expectTetrahedron(importBytes(binaryStl("solid, or so it says"), "a.stl", asWritten));
  expectTetrahedron(importBytes(binaryStl("no ending"), "a", asWritten));
}

TEST(Stl, SolidsBecomeParts) {
  const Model model = importBytes(asciiStl(false) + asciiStl(false), "a.stl", asWritten);
  ASSERT_EQ(model.parts.size(), 2U);
  EXPECT_EQ(model.parts[0].name, "a body");
  EXPECT_EQ(model.parts[1].name, "a body_2");
}

TEST(Ply, TextWithPropertiesInAnyOrder) {
  expectTetrahedron(
      importBytes("ply\nformat ascii 1.0\ncomment by hand\nobj_info none\n"
                  "element vertex 4\nproperty uchar red\nproperty double z\nproperty float x\n"
                  "property list uchar int extra\nproperty float y\nproperty float quality\n"
                  "element face 4\nproperty uchar flag\nproperty list uchar int vertex_index\n"
                  "element edge 1\nproperty int a\nend_header\n"
                  "255 0 0 0 0 nan\n255 0 1 0 0 1\n255 0 0 2 8 9 1 1\n255 1 0 1 5 0 1\n"
                  "0 3 0 2 1\n0 3 0 1 3\n0 3 0 3 2\n0 3 1 2 3\n7\n",
                  "a.ply", asWritten));
}

std::string binaryPly(bool bigEndian) {
  std::string bytes = std::string("ply\r\nformat ") + (bigEndian ? "binary_big_endian" : "binary_little_endian") +
                      " 1.0\r\nelement vertex 4\r\nproperty double x\r\nproperty short flag\r\nproperty float y\r\n"
                      "property float z\r\nelement face 2\r\nproperty list ushort uint vertex_indices\r\n"
                      "property uchar red\r\nelement tristrips 1\r\nproperty list int int vertex_indices\r\n"
                      "end_header\r\n";
  const float points[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (const auto& p : points) {
    append(bytes, static_cast<double>(p[0]), bigEndian);
    append(bytes, std::int16_t{-3}, bigEndian);
    append(bytes, p[1], bigEndian);
    append(bytes, p[2], bigEndian);
  }
  for (const auto& face : {std::array{0U, 2U, 1U}, std::array{0U, 1U, 3U}}) {
    append(bytes, std::uint16_t{3}, bigEndian);
    for (const unsigned corner : face) {
      append(bytes, std::uint32_t{corner}, bigEndian);
    }
    append(bytes, std::uint8_t{200});
  }
  // Two strips: 0 3 2, and 1 2 3.
  append(bytes, std::int32_t{7}, bigEndian);
  for (const int corner : {0, 3, 2, -1, 1, 2, 3}) {
    append(bytes, std::int32_t{corner}, bigEndian);
  }
  return bytes;
}

TEST(Ply, BinaryInBothByteOrdersWithStrips) {
  expectTetrahedron(importBytes(binaryPly(false), "a.ply", asWritten));
  expectTetrahedron(importBytes(binaryPly(true), "a.ply", asWritten));
}

TEST(Off, CountsMayStandInTheHeaderLineOrBelow) {
  const std::string body =
      "0 0 0\n# between\n1 0 0\n0 1 0\n\n0 0 1 # last\n3 0 2 1\n3 0 1 3 255 0 0\n3 0 3 2\n3 1 2 3\n";
  expectTetrahedron(importBytes("OFF 4 4 6\n" + body, "a.off", asWritten));
  expectTetrahedron(importBytes("# comment\nOFF\n# more\n4 4 0\n" + body, "a.off", asWritten));
}

TEST(Off, ColoursAndNormalsOfVerticesArePassedOver) {
  expectTetrahedron(
      importBytes("COFF\n4 4 6\n0 0 0 255 0 0 255\n1 0 0 255 0 0 255\n0 1 0 255 0 0 255\n"
                  "0 0 1 255 0 0 255\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n",
                  "a.off", asWritten));
  expectTetrahedron(
      importBytes("NOFF\n4 4 6\n0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 0 1\n0 0 1 0 0 1\n"
                  "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n",
                  "a.off", asWritten));
}

TEST(Off, PolygonsAreCutAroundTheirFirstCorner) {
  const Model model = importBytes("OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n", "a.off", asWritten);
  EXPECT_EQ(model.parts[0].mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
}

}  // namespace
}  // namespace lorica::test
