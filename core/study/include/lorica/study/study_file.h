#pragma once

/// \file
/// The study's file: JSON, versioned, described by resources/schema/study.schema.json. Defaults are
/// omitted but for those that decide the numbers: models, trials, seed, shots, samplers and lattice cells.

#include <filesystem>
#include <string>
#include <string_view>

#include "lorica/base/issue.h"
#include "lorica/study/study.h"

namespace lorica::study {

/// Version written by this program. Older ones are upgraded by reading, newer ones refused.
inline constexpr int studyVersion = 1;

/// \param file how errors name the text
/// \throw base::InputError with line and column (syntax) or JSON pointer (content) and what was expected there
Study parseStudy(std::string_view json, const std::string& file);

/// Canonical text: equal studies have equal text, and parseStudy(studyText(s)) == s for every s that parseStudy gives.
/// Of a lattice only the settings its layout uses are written; sizes that are no double of millimetres / 1000 (those
/// of a file always are) move to the nearest one.
/// \throw base::InputError when a name or path is not UTF-8
/// \pre all numbers are finite
std::string studyText(const Study& study);

/// Reads and parses. \throw base::InputError
Study loadStudy(const std::filesystem::path& path);

/// Saves atomically. \throw base::InputError
void saveStudy(const Study& study, const std::filesystem::path& path);

/// All the study's input files, each path once, in the order of the study.
std::vector<InputFile> inputFiles(const Study& study);

/// Checks that every input file exists and has its hash. An empty hash passes (a study written by hand).
/// \return one issue of severity error per missing, unreadable or changed file, naming it and saying what to do
base::Issues checkInputs(const Study& study, const std::filesystem::path& studyFile);

/// The study with every input's hash as its file is now.
/// \throw base::InputError when a file is missing or cannot be read
Study withCurrentHashes(const Study& study, const std::filesystem::path& studyFile);

/// SHA-256 of a file's bytes, lower-case hexadecimal. For a .gltf, over its bytes followed by those of every buffer
/// file it names, in order; data: uris are part of its own bytes. For a .pvd likewise with the files of the series.
/// \throw base::InputError
std::string sha256OfInput(const std::filesystem::path& path);
/// The same of a file whose own bytes were read already.
std::string sha256OfInput(const std::filesystem::path& path, std::string_view bytes);
/// The bytes of an input file. \throw base::InputError when there is none, or it is no regular file
std::string readInput(const std::filesystem::path& path);
/// SHA-256 of bytes, lower-case hexadecimal.
std::string sha256(std::string_view bytes);

/// Absolute, normalised path of an input of the study in that file.
std::filesystem::path resolve(const InputFile& input, const std::filesystem::path& studyFile);

/// The study as another study file must say it: relative paths of inputs are rewritten so that they resolve to the
/// same files from that file's folder. Absolute ones stay, and so does everything when the folder is the same.
Study rebased(Study study, const std::filesystem::path& fromFile, const std::filesystem::path& toFile);

/// Names and texts of the sample studies built into the program, each with `description` fields.
std::vector<std::string> templateNames();
/// \throw base::InputError for an unknown name, listing the known ones
std::string templateText(std::string_view wanted);

}  // namespace lorica::study
