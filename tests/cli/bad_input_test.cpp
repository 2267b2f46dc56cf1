#include <nlohmann/json.hpp>

#include "program.h"

namespace lorica::test {
namespace {

class BadInput : public Program {
 protected:
  BadInput() {
    write("s.lorica.json", run("template sample").out);
    run("export s.lorica.json --pose rest --format glb --out body.glb");
    glb_ = read("body.glb");
    fs::remove(folder_ / "s.lorica.json");
    fs::remove(folder_ / "body.glb");
  }

  /// Imports a damaged body: it must be refused, and leave nothing.
  void refused(const std::string& bytes, std::initializer_list<std::string> words) const {
    write("bad.glb", bytes);
    expectOneClearLine(run("import bad.glb --out made.lorica.json"), words);
    EXPECT_EQ(files(), 1U) << "only the bad file itself";
  }
  nlohmann::json header() const {
    const std::size_t length = word(12);
    return nlohmann::json::parse(glb_.substr(20, length));
  }
  /// The GLB with another JSON chunk.
  std::string withHeader(const nlohmann::json& json) const {
    std::string text = json.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const std::string binary = glb_.substr(20 + word(12));
    std::string bytes = glb_.substr(0, 8);
    append(bytes, 12 + 8 + text.size() + binary.size());
    append(bytes, text.size());
    return bytes + "JSON" + text + binary;
  }
  std::uint32_t word(std::size_t at) const {
    std::uint32_t value = 0;
    for (std::size_t i = 4; i-- > 0;) {
      value = value << 8 | static_cast<unsigned char>(glb_[at + i]);
    }
    return value;
  }
  static void append(std::string& bytes, std::size_t value) {
    for (int i = 0; i < 4; ++i) {
      bytes.push_back(static_cast<char>(value >> (8 * i) & 0xFF));
    }
  }

  std::string glb_;
};

TEST_F(BadInput, MissingFile) {
  expectOneClearLine(run("import nowhere.glb --out made.lorica.json"), {"nowhere.glb", "no such file"});
  EXPECT_EQ(files(), 0U);
}

TEST_F(BadInput, TruncatedGlb) {
  refused(glb_.substr(0, glb_.size() / 2), {"bad.glb"});
}

TEST_F(BadInput, WrongChunkLength) {
  std::string bytes = glb_;
  bytes[15] = 0x7F;
  refused(bytes, {"bad.glb", "chunk"});
}

TEST_F(BadInput, IndexBeyondTheVertices) {
  auto json = header();
  for (auto& accessor : json["accessors"]) {
    if (accessor["type"] == "VEC3") {
      accessor["count"] = 3;
    }
  }
  refused(withHeader(json), {"bad.glb", "accessor"});
}

TEST_F(BadInput, ViewBeyondItsBuffer) {
  auto json = header();
  json["bufferViews"][0]["byteLength"] = 4000000000U;
  refused(withHeader(json), {"bad.glb"});
}

TEST_F(BadInput, NanPosition) {
  std::string bytes = glb_;
  const auto json = header();
  const std::size_t accessor = json["meshes"][0]["primitives"][0]["attributes"]["POSITION"];
  const std::size_t view = json["accessors"][accessor]["bufferView"];
  const std::size_t offset = 20 + word(12) + 8 + json["bufferViews"][view].value("byteOffset", std::size_t{0});
  bytes.replace(offset + 12, 4, std::string("\x00\x00\xC0\x7F", 4));
  refused(bytes, {"bad.glb", "accessor"});
}

TEST_F(BadInput, CyclicNodes) {
  auto json = header();
  json["nodes"][0]["children"] = {1};
  json["nodes"][1]["children"] = {0};
  refused(withHeader(json), {"bad.glb", "node"});
}

TEST_F(BadInput, EmptyMesh) {
  write("bad.off", "OFF\n0 0 0\n");
  expectOneClearLine(run("import bad.off --out made.lorica.json"), {"bad.off"});
  EXPECT_EQ(files(), 1U);
}

class BadStudy : public Program {
 protected:
  BadStudy() : sample_(run("template sample").out) {}
  void refused(const std::string& text, std::initializer_list<std::string> words) const {
    write("bad.lorica.json", text);
    expectOneClearLine(run("run bad.lorica.json --out out"), words);
    EXPECT_EQ(files(), 1U) << "only the bad file itself";
  }
  nlohmann::ordered_json json() const { return nlohmann::ordered_json::parse(sample_); }

  std::string sample_;
};

TEST_F(BadStudy, SyntaxErrorsNameLineAndColumn) {
  refused("{\n  \"lorica_study\": 1,\n  \"name\" \"x\"\n}", {"bad.lorica.json", "3"});
}

TEST_F(BadStudy, MissingInput) {
  auto study = json();
  study["organs"][0].erase("builtin");
  study["organs"][0]["file"] = "gone.glb";
  study["organs"][0]["sha256"] = std::string(64, 'a');
  refused(study.dump(), {"gone.glb", "no such file"});
}

TEST_F(BadStudy, WrongHash) {
  write("other.off", "OFF\n");
  auto study = json();
  study["organs"][0].erase("builtin");
  study["organs"][0]["file"] = "other.off";
  study["organs"][0]["sha256"] = std::string(64, 'a');
  write("bad.lorica.json", study.dump());
  expectOneClearLine(run("run bad.lorica.json --out out"), {"other.off", "changed"});
  EXPECT_FALSE(exists("out"));
}

TEST_F(BadStudy, UnknownStructure) {
  auto study = json();
  study["organs"][0]["builtin"] = "human/gills";
  refused(study.dump(), {"/organs/0", "gills"});
}

TEST_F(BadStudy, LatticeTooFineToHold) {
  auto study = json();
  study["organs"][0]["lattice"] = {{"layout", "uniform"}, {"cells", 1000}};
  refused(study.dump(), {"/organs/0/lattice", "control points"});
}

TEST_F(BadStudy, ClipWithoutATime) {
  write("bad.lorica.json", sample_);
  expectOneClearLine(run("run bad.lorica.json --out out --pose squat"), {"squat@"});
}

TEST_F(BadStudy, NegativeCount) {
  auto study = json();
  study["trials"] = -5;
  refused(study.dump(), {"/trials"});
}

TEST_F(BadStudy, NewerVersion) {
  auto study = json();
  study["lorica_study"] = 7;
  refused(study.dump(), {"7", "version"});
}

TEST_F(BadStudy, UnknownPoseOfARunAndTimeBeyondAClip) {
  write("bad.lorica.json", sample_);
  expectOneClearLine(run("run bad.lorica.json --out out --pose handstand"), {"handstand"});
  expectOneClearLine(run("run bad.lorica.json --out out --pose toe_touch@99"), {"99", "beyond"});
  EXPECT_FALSE(exists("out"));
}

}  // namespace
}  // namespace lorica::test
