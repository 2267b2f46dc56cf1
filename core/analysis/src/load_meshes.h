#pragma once

/// \file
/// Meshes of a study, from files or made by the program, each read once.

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>

#include "lorica/analysis/hashed_model.h"
#include "lorica/human/clip.h"
#include "lorica/human/skinning.h"
#include "lorica/io/import.h"
#include "lorica/manikin/human.h"
#include "lorica/study/study.h"

namespace lorica::analysis {

/// Parts of one structure, chosen and merged.
struct MergedMesh {
  geometry::TriangleMesh mesh;
  std::optional<human::SkinWeights> weights;  ///< present when every merged part has them
  std::size_t unskinnedParts = 0;             ///< left out because others of the model are skinned
};

/// \param keep says which parts, by name
MergedMesh mergeParts(const io::Model& model, const std::function<bool(const std::string&)>& keep, bool skinnedOnly);

/// Reads files and makes built-in meshes on demand; remembers both.
class MeshLibrary {
 public:
  explicit MeshLibrary(std::filesystem::path studyFile) : studyFile_(std::move(studyFile)) {}

  /// \throw base::InputError
  const io::Model& file(const study::InputFile& input);
  /// The same for a file that is new to the study: `input` gets its hash. \throw base::InputError
  const io::Model& newFile(study::InputFile& input);
  /// \throw base::InputError when there can be no such person, base::Cancelled
  const manikin::Human& human(const human::Person& person, base::Threads threads, const base::Progress& progress);
  /// Checks that every part the source names is in the model. \throw base::InputError
  static void checkParts(const study::MeshSource& source, const io::Model& model, const std::string& file);
  base::Issues takeIssues() { return std::exchange(issues_, {}); }

 private:
  std::string keyOf(const study::InputFile& input) const;
  const io::Model& keep(const study::InputFile& input, HashedModel read);

  std::filesystem::path studyFile_;
  std::map<std::string, HashedModel> models_;  ///< without a hash where the study had one
  std::unique_ptr<manikin::Human> human_;
  base::Issues issues_;
};

/// True when the source's selection holds the part: empty selections hold all.
bool selects(const study::MeshSource& source, const std::string& part);

/// Whether `name` fits `pattern`, where '*' stands for any run of characters.
bool fits(std::string_view name, std::string_view pattern);

}  // namespace lorica::analysis
