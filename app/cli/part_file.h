#pragma once

/// \file
/// The counts of one part of a run, as a file between `run --part` and `merge`. It holds what the run would shoot and
/// from where (the provenance of its plan), so that parts of different runs are told apart.

#include <nlohmann/json.hpp>

#include "commands.h"
#include "lorica/analysis/loaded_study.h"

namespace lorica::cli {

inline constexpr auto partFileName = "part.json";

/// \param result of the part, not cancelled
std::string partText(const RunArguments& arguments, const analysis::LoadedStudy& study,
                     const analysis::RunResult& result);

/// What a run of the study shoots, without a shot: equal texts are the same run.
std::string planText(const analysis::LoadedStudy& study, analysis::RunResult planned);

/// A part that was read back. Nothing in it is trusted.
class PartFile {
 public:
  /// \throw base::InputError when the folder has none, or one that is damaged
  explicit PartFile(const std::filesystem::path& folder);

  const std::string& file() const { return file_; }
  const analysis::RunPart& part() const { return part_; }
  /// Of the command that made it, --out, --threads and --quiet aside.
  const RunArguments& arguments() const { return arguments_; }
  /// \throw base::InputError when the part is not one of the run whose planText() is given
  /// \param whose what the user knows that run by
  void requireSameRun(const std::string& planText, const std::string& whose) const;
  std::string planText() const { return plan_.dump(); }
  /// The planned run with the part's counts. \throw base::InputError when the counts cannot be those of the run
  analysis::RunResult counted(const analysis::LoadedStudy& study, analysis::RunResult planned) const;

 private:
  using Json = nlohmann::ordered_json;

  [[noreturn]] void fail(const std::string& place, const std::string& text) const;
  const Json& member(const Json& json, const char* key, const std::string& place) const;
  std::uint64_t whole(const Json& json, const char* key, const std::string& place) const;
  std::vector<std::uint64_t> numbers(const Json& json, const std::string& place) const;
  void readArguments(const Json& json);

  std::string file_;
  analysis::RunPart part_;
  RunArguments arguments_;
  Json plan_;
  Json counts_;
};

}  // namespace lorica::cli
