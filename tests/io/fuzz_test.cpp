#include <gtest/gtest.h>

#include <functional>
#include <random>

#include "glb_builder.h"
#include "import_bytes.h"
#include "lorica/io/export.h"

namespace lorica::test {
namespace {

/// Damage of the kinds that disks, editors and ill will do.
class Damage {
 public:
  explicit Damage(std::uint64_t seed) : random_(seed) {}

  std::string once(std::string bytes) {
    if (bytes.empty()) {
      return bytes;
    }
    const std::size_t at = below(bytes.size());
    const std::size_t length = std::min(1 + below(16), bytes.size() - at);
    switch (below(7)) {
      case 0:
        bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(8)));
        break;
      case 1:
        bytes[at] = static_cast<char>(below(256));
        break;
      case 2:
        bytes.resize(at);
        break;
      case 3:
        bytes.erase(at, length);
        break;
      case 4:
        bytes.insert(at, bytes.substr(below(bytes.size()), 16));
        break;
      case 5:
        bytes.replace(at, length, std::string(length, static_cast<char>(0xFF)));
        break;
      default:
        changeNumber(bytes, at);
    }
    return bytes;
  }

  std::string some(std::string bytes) {
    for (std::size_t times = 1 + below(3); times > 0; --times) {
      bytes = once(std::move(bytes));
    }
    return bytes;
  }

  std::size_t below(std::size_t limit) { return static_cast<std::size_t>(random_() % limit); }

 private:
  /// The digits from `at` on become those of another number.
  void changeNumber(std::string& bytes, std::size_t at) {
    const std::size_t first = bytes.find_first_of("0123456789", at);
    if (first == std::string::npos) {
      return;
    }
    const std::size_t end = std::min(bytes.find_first_not_of("0123456789", first), bytes.size());
    const char* numbers[] = {
        "0", "-1", "1", "7", "255", "65536", "2147483647", "4294967296", "18446744073709551615", "1e308", "0.5"};
    bytes.replace(first, end - first, numbers[below(std::size(numbers))]);
  }

  std::mt19937_64 random_;
};

/// Reads what `damaged` makes, many times: a model or an InputError, never anything else.
void expectSurvival(const std::string& name, int times, const std::function<std::string(Damage&)>& damaged) {
  const ScratchFolder folder;
  int refused = 0;
  for (int i = 0; i < times; ++i) {
    Damage damage(static_cast<std::uint64_t>(i) + 1);
    const auto path = folder.write(name, damaged(damage));
    try {
      const io::Model model = io::importModel(path);
      ASSERT_FALSE(model.parts.empty());
      for (const io::Part& part : model.parts) {
        for (const geometry::Triangle& triangle : part.mesh.triangles) {
          ASSERT_LT(std::max({triangle[0], triangle[1], triangle[2]}), part.mesh.positions.size());
        }
        if (part.weights) {
          ASSERT_EQ(part.weights->vertices(), part.mesh.positions.size());
          for (const std::uint32_t joint : part.weights->joints) {
            ASSERT_LT(joint, model.skeleton->size());
          }
        }
      }
    } catch (const base::InputError& error) {
      ++refused;
      ASSERT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
      ASSERT_EQ(std::string(error.what()).find(path.string()), 0U) << error.what();
    } catch (const std::exception& error) {
      FAIL() << "seed " << i + 1 << ": " << error.what();
    }
  }
  EXPECT_GT(refused, times / 20) << "the damage was not felt";
  EXPECT_LT(refused, times) << "nothing was read at all";
}

/// Everything the reader knows in one file.
GlbBuilder richFile() {
  GlbBuilder file = skinnedFile();
  const int times = file.accessor(std::vector<float>{0, 1}, "SCALAR");
  const int turns = file.accessor(std::vector<float>{0, 0, 0, 1, 0.5F, 0.5F, 0.5F, 0.5F}, "VEC4");
  file.document["animations"] = Json::array({animation(2, "rotation", times, turns)});
  const int helmet = file.mesh({{"POSITION", 0}}, 1);
  file.document["nodes"][2]["children"] = {file.add("nodes", {{"mesh", helmet}, {"scale", {0.1, 0.1, 0.1}}})};
  const int indices = file.view(bytesOf(std::vector<std::uint16_t>{1, 3}));
  const int values = file.view(bytesOf(std::vector<float>{2, 0, 0, 0, 0, 3}));
  file.document["accessors"][0]["sparse"] = {{"count", 2},
                                             {"indices", {{"bufferView", indices}, {"componentType", 5123}}},
                                             {"values", {{"bufferView", values}}}};
  file.document["images"] = Json::array({{{"bufferView", 0}, {"mimeType", "image/png"}}});
  file.document["textures"] = Json::array({{{"source", 0}}});
  file.document["materials"] = Json::array({{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}});
  return file;
}

TEST(DamagedFile, GlbIsReadOrRefused) {
  const std::string good = richFile().glb();
  expectSurvival("a.glb", 4000, [&](Damage& damage) { return damage.some(good); });
}

TEST(DamagedFile, GlbWithDamagedJsonInAGoodContainerIsReadOrRefused) {
  const GlbBuilder file = richFile();
  Json document = file.document;
  document["buffers"] = Json::array({{{"byteLength", file.binary.size()}}});
  const std::string json = document.dump();
  expectSurvival("a.glb", 6000, [&](Damage& damage) { return GlbBuilder::container(damage.some(json), file.binary); });
}

TEST(DamagedFile, GlbWithDamagedBuffersIsReadOrRefused) {
  GlbBuilder file = richFile();
  const std::string binary = file.binary;
  expectSurvival("a.glb", 2000, [&](Damage& damage) {
    file.binary = damage.some(binary);
    file.binary.resize(binary.size());
    return file.glb();
  });
}

TEST(DamagedFile, GltfIsReadOrRefused) {
  const GlbBuilder file = richFile();
  Json document = file.document;
  document["buffers"] = Json::array({{{"byteLength", 3}, {"uri", "data:application/octet-stream;base64,AAAA"}}});
  const std::string json = document.dump();
  const ScratchFolder folder;
  for (int i = 0; i < 1000; ++i) {
    Damage damage(static_cast<std::uint64_t>(i) + 1);
    EXPECT_THROW(io::importModel(folder.write("a.gltf", damage.some(json))), base::InputError) << i;
  }
}

TEST(DamagedFile, ObjIsReadOrRefused) {
  const std::string good =
      "o one\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 0 0\nvn 0 0 1\nf 1/1/1 3/1/1 2/1/1\nf 1 2 4\n"
      "g two\nf -4 -1 -2\nf 2//1 3//1 \\\n4//1\n";
  expectSurvival("a.obj", 4000, [&](Damage& damage) { return damage.some(good); });
}

TEST(DamagedFile, OffIsReadOrRefused) {
  const std::string good = "OFF\n# four\n4 4 6\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
  expectSurvival("a.off", 4000, [&](Damage& damage) { return damage.some(good); });
}

std::string exported(io::SceneFormat format) {
  const std::vector<geometry::Vec3f> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const std::vector<geometry::Triangle> triangles{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  const io::SceneMesh mesh{"body", "body", points, triangles, {1, 0, 0, 1}};
  return io::sceneBytes(std::span(&mesh, 1), format);
}

TEST(DamagedFile, BinaryPlyIsReadOrRefused) {
  const std::string good = exported(io::SceneFormat::ply);
  expectSurvival("a.ply", 4000, [&](Damage& damage) { return damage.some(good); });
}

TEST(DamagedFile, TextPlyIsReadOrRefused) {
  const std::string good =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face 4\n"
      "property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n"
      "3 1 2 3\n";
  expectSurvival("a.ply", 4000, [&](Damage& damage) { return damage.some(good); });
}

TEST(DamagedFile, StlIsReadOrRefused) {
  const std::string text =
      "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n"
      "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 0 1 0\nvertex 0 0 1\nendloop\nendfacet\nendsolid a\n";
  expectSurvival("a.stl", 3000, [&](Damage& damage) { return damage.some(text); });
  std::string binary(80, 'x');
  binary += GlbBuilder::word(2);
  for (int t = 0; t < 2; ++t) {
    binary +=
        bytesOf(std::vector<float>{0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, static_cast<float>(t)}) + std::string(2, '\0');
  }
  expectSurvival("a.stl", 3000, [&](Damage& damage) { return damage.some(binary); });
}

}  // namespace
}  // namespace lorica::test
