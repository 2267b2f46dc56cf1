#include <gtest/gtest.h>

#include <algorithm>

#include "full_study.h"
#include "lorica/base/files.h"
#include "temporary_folder.h"

namespace lorica::study {
namespace {

TEST(Sha256, GivesThePublishedDigests) {
  // FIPS 180-4, examples of the standard.
  EXPECT_EQ(sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(sha256(std::string(1000000, 'a')), "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

class Inputs : public ::testing::Test {
 protected:
  std::filesystem::path put(const std::string& name, std::string_view bytes) const {
    base::writeFileAtomically(folder_.path() / name, bytes);
    return folder_.path() / name;
  }
  std::filesystem::path studyFile() const { return folder_.path() / "s.lorica.json"; }
  std::string pathOf(const std::string& name) const { return (folder_.path() / name).string(); }

  /// A study with the human and one organ for each file.
  static Study studyOf(const std::vector<std::string>& files) {
    Study study;
    for (const std::string& file : files) {
      InputFile input;
      input.path = file;
      if (&file == &files.front()) {
        study.human.from = input;
      } else {
        study.organs.emplace_back();
        study.organs.back().mesh.from = input;
      }
    }
    return study;
  }

  test::TemporaryFolder folder_;
};

TEST_F(Inputs, AreListedOnceInTheOrderOfTheStudy) {
  std::vector<std::string> paths;
  for (const InputFile& input : inputFiles(parseStudy(fullStudy, "s"))) {
    paths.push_back(input.path);
  }
  EXPECT_EQ(paths,
            (std::vector<std::string>{"body.glb", "organs/liver.stl", "vest/front.glb", "shots.csv", "blast.csv"}));
  EXPECT_EQ(inputFiles(studyOf({"a.stl", "b.stl", "a.stl"})).size(), 2U);
}

TEST_F(Inputs, AreRelativeToTheStudy) {
  InputFile input;
  input.path = "../meshes/./heart.stl";
  EXPECT_EQ(resolve(input, "/somewhere/studies/s.lorica.json"), "/somewhere/meshes/heart.stl");
  EXPECT_EQ(resolve(input, "s.lorica.json"),
            (std::filesystem::current_path() / "../meshes/heart.stl").lexically_normal());
  input.path = "/models/heart.stl";
  EXPECT_EQ(resolve(input, "/somewhere/s.lorica.json"), "/models/heart.stl");
}

TEST_F(Inputs, AreTheSameFilesForAStudyRebasedToAnotherFolder) {
  const Study study = studyOf({"body.glb", "../meshes/./heart.stl", "/models/liver.stl", "organs/sub/lung.stl"});
  const std::filesystem::path from = "/data/studies/a.lorica.json";
  for (const std::filesystem::path to :
       {"/data/studies/deep/er/b.lorica.json", "/data/b.lorica.json", "/b.lorica.json", "/data/meshes/b.lorica.json",
        "/data/studies/../other/b.lorica.json", "relative/b.lorica.json"}) {
    const Study moved = rebased(study, from, to);
    const std::vector<InputFile> before = inputFiles(study);
    const std::vector<InputFile> after = inputFiles(moved);
    ASSERT_EQ(after.size(), before.size());
    for (std::size_t i = 0; i < before.size(); ++i) {
      EXPECT_EQ(resolve(after[i], to), resolve(before[i], from)) << to;
      EXPECT_EQ(std::filesystem::path(after[i].path).is_absolute(), before[i].path.starts_with('/')) << after[i].path;
    }
    EXPECT_NE(after[0].path, before[0].path);
    EXPECT_EQ(after[2].path, before[2].path);
  }
  EXPECT_EQ(inputFiles(rebased(study, from, "/data/b.lorica.json"))[0].path, "studies/body.glb");
  EXPECT_EQ(inputFiles(rebased(study, from, "/data/meshes/b.lorica.json"))[1].path, "heart.stl");
}

TEST_F(Inputs, StayAsTheyAreWrittenWhenTheStudyStaysInItsFolder) {
  const Study study = studyOf({"body.glb", "../meshes/./heart.stl", "./liver.stl"});
  EXPECT_EQ(rebased(study, "/data/studies/a.lorica.json", "/data/studies/b.lorica.json"), study);
  EXPECT_EQ(rebased(study, "/data/studies/a.lorica.json", "/data/x/../studies/b.lorica.json"), study);
}

TEST_F(Inputs, PassWhenTheyAreAsTheyWere) {
  put("a.stl", "abc");
  put("b.stl", "def");
  const Study study = studyOf({"a.stl", "b.stl"});
  EXPECT_TRUE(checkInputs(study, studyFile()).empty()) << "a study written by hand has no hashes";
  const Study hashed = withCurrentHashes(study, studyFile());
  EXPECT_EQ(std::get<InputFile>(hashed.human.from).sha256, sha256("abc"));
  EXPECT_TRUE(checkInputs(hashed, studyFile()).empty());
}

TEST_F(Inputs, ThatChangedAreErrorsThatSayWhatToDoUntilTheyAreTaken) {
  put("a.stl", "abc");
  const Study study = withCurrentHashes(studyOf({"a.stl", "a.stl"}), studyFile());
  put("a.stl", "");
  const base::Issues issues = checkInputs(study, studyFile());
  ASSERT_EQ(issues.size(), 1U);
  EXPECT_EQ(issues[0].line(), pathOf("a.stl") +
                                  ": error: has changed since the study was made (expected ba7816bf8f01, found "
                                  "e3b0c44298fc); run `lorica-cli check --accept-inputs` to take the new one");
  EXPECT_TRUE(checkInputs(withCurrentHashes(study, studyFile()), studyFile()).empty());
}

TEST_F(Inputs, ThatAreMissingOrNoFilesAreErrorsOncePerFile) {
  std::filesystem::create_directory(folder_.path() / "b.stl");
  const base::Issues issues = checkInputs(studyOf({"a.stl", "b.stl", "a.stl"}), studyFile());
  ASSERT_EQ(issues.size(), 2U);
  EXPECT_EQ(issues[0].line(),
            pathOf("a.stl") + ": error: there is no such file; put it back or correct the path in the study");
  EXPECT_EQ(issues[1].severity, base::Severity::error);
  EXPECT_EQ(issues[1].file, pathOf("b.stl"));
  EXPECT_THROW(withCurrentHashes(studyOf({"a.stl"}), studyFile()), base::InputError);
}

TEST_F(Inputs, ThatNeverEndAreRefused) {
  EXPECT_THROW(sha256OfInput("/dev/zero"), base::InputError);
}

TEST_F(Inputs, OfGltfCoverTheirBufferFilesInOrder) {
  const std::string gltf = R"({"buffers": [{"uri": "sub/two%20words.bin"}, {"uri": "data:;base64,AAAA"},
                               {"byteLength": 4}, {"uri": "b.bin"}]})";
  put("sub/two words.bin", "first");
  put("b.bin", "second");
  EXPECT_EQ(sha256OfInput(put("a.gltf", gltf)), sha256(gltf + "firstsecond"));
  EXPECT_EQ(sha256OfInput(put("a.GLTF", gltf)), sha256(gltf + "firstsecond"));
  EXPECT_EQ(sha256OfInput(put("a.glb", gltf)), sha256(gltf));

  const Study study = withCurrentHashes(studyOf({"a.gltf"}), studyFile());
  put("b.bin", "other");
  EXPECT_EQ(checkInputs(study, studyFile()).size(), 1U);
  std::filesystem::remove(folder_.path() / "b.bin");
  const base::Issues issues = checkInputs(study, studyFile());
  ASSERT_EQ(issues.size(), 1U);
  EXPECT_EQ(issues[0].line(), pathOf("b.bin") + ": error: there is no such file; put it back, a.gltf needs it");
}

TEST_F(Inputs, OfSeriesCoverTheirFilesInOrder) {
  const std::string series = R"(<VTKFile type="Collection"><Collection><DataSet timestep="0" file="sub/a.vti"/>
                                <DataSet timestep="1" file="b.vti"/></Collection></VTKFile>)";
  put("sub/a.vti", "first");
  put("b.vti", "second");
  EXPECT_EQ(sha256OfInput(put("s.pvd", series)), sha256(series + "firstsecond"));
  std::filesystem::remove(folder_.path() / "b.vti");
  EXPECT_THROW(sha256OfInput(folder_.path() / "s.pvd"), base::InputError);
}

TEST_F(Inputs, OfGltfThatAreDamagedAreErrorsNotCrashes) {
  for (const char* text : {"", "{", "[]", "null"}) {
    EXPECT_THROW(sha256OfInput(put("a.gltf", text)), base::InputError) << text;
  }
  for (const char* text : {"{}", R"({"buffers": 3})", R"({"buffers": [null, 3, {"uri": 5}, {}]})"}) {
    EXPECT_EQ(sha256OfInput(put("a.gltf", text)), sha256(text));
  }
  EXPECT_THROW(sha256OfInput(put("a.gltf", std::string(1000000, '['))), base::InputError);
}

}  // namespace
}  // namespace lorica::study
