#include "load_meshes.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>

#include "lorica/base/error.h"
#include "lorica/base/parallel.h"
#include "lorica/study/study_file.h"

namespace lorica::analysis {

bool selects(const study::MeshSource& source, const std::string& part) {
  return source.parts.empty() || std::find(source.parts.begin(), source.parts.end(), part) != source.parts.end();
}

bool fits(std::string_view name, std::string_view pattern) {
  std::size_t n = 0;
  std::size_t p = 0;
  std::size_t star = std::string_view::npos;
  std::size_t resume = 0;
  while (n < name.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      resume = n;
    } else if (p < pattern.size() && pattern[p] == name[n]) {
      ++p;
      ++n;
    } else if (star != std::string_view::npos) {
      p = star + 1;
      n = ++resume;
    } else {
      return false;
    }
  }
  return pattern.find_first_not_of('*', p) == std::string_view::npos;
}

MergedMesh mergeParts(const io::Model& model, const std::function<bool(const std::string&)>& keep, bool skinnedOnly) {
  MergedMesh merged;
  std::vector<const io::Part*> chosen;
  for (const io::Part& part : model.parts) {
    if (!keep(part.name)) {
      continue;
    }
    if (skinnedOnly && !part.weights) {
      ++merged.unskinnedParts;
      continue;
    }
    chosen.push_back(&part);
  }
  std::size_t influences = 0;
  bool weighted = !chosen.empty();
  for (const io::Part* part : chosen) {
    geometry::append(merged.mesh, part->mesh);
    weighted = weighted && part->weights.has_value();
    influences = std::max(influences, part->weights ? part->weights->influences : 0);
  }
  if (weighted) {
    human::SkinWeights& all = merged.weights.emplace();
    all.influences = influences;
    for (const io::Part* part : chosen) {
      const human::SkinWeights& own = *part->weights;
      for (std::size_t v = 0; v < own.vertices(); ++v) {
        for (std::size_t k = 0; k < influences; ++k) {
          const bool used = k < own.influences;
          all.joints.push_back(used ? own.joints[v * own.influences + k] : 0);
          all.weights.push_back(used ? own.weights[v * own.influences + k] : 0.0F);
        }
      }
    }
  }
  return merged;
}

namespace {

io::ImportOptions optionsOf(const study::InputFile& input) {
  io::ImportOptions options;
  options.units = input.units;
  if (input.up) {
    options.up = *input.up == 'z' ? io::UpAxis::z : io::UpAxis::y;
  }
  return options;
}

}  // namespace

HashedModel importHashed(const std::filesystem::path& path, const io::ImportOptions& options) {
  const std::string bytes = study::readInput(path);
  HashedModel result;
  std::exception_ptr ofModel;
  std::exception_ptr ofHash;
  base::parallelFor(2, 1, {}, [&](std::size_t begin, std::size_t end) {
    for (std::size_t task = begin; task < end; ++task) {
      try {
        // The longer one is begun first.
        if (task == 0) {
          result.model = io::importModel(path, bytes, options);
        } else {
          result.sha256 = study::sha256OfInput(path, bytes);
        }
      } catch (const base::Error&) {
        (task == 0 ? ofModel : ofHash) = std::current_exception();
      }
    }
  });
  for (const std::exception_ptr& failure : {ofHash, ofModel}) {
    if (failure) {
      std::rethrow_exception(failure);
    }
  }
  return result;
}

std::string MeshLibrary::keyOf(const study::InputFile& input) const {
  return fmt::format("{}|{}|{}", study::resolve(input, studyFile_).string(),
                     input.units ? base::name(*input.units) : "", input.up ? std::string(1, *input.up) : "");
}

const io::Model& MeshLibrary::keep(const study::InputFile& input, HashedModel read) {
  for (base::Issue issue : read.model.issues) {
    issue.file = input.path;  // as the study says it: results do not depend on where the study lies
    issues_.push_back(std::move(issue));
  }
  return models_.emplace(keyOf(input), std::move(read)).first->second.model;
}

const io::Model& MeshLibrary::file(const study::InputFile& input) {
  const auto known = models_.find(keyOf(input));
  return known != models_.end()
             ? known->second.model
             : keep(input, {io::importModel(study::resolve(input, studyFile_), optionsOf(input)), {}});
}

const io::Model& MeshLibrary::newFile(study::InputFile& input) {
  const auto known = models_.find(keyOf(input));
  if (known != models_.end() && !known->second.sha256.empty()) {
    input.sha256 = known->second.sha256;
    return known->second.model;
  }
  HashedModel read = importHashed(study::resolve(input, studyFile_), optionsOf(input));
  input.sha256 = read.sha256;
  return keep(input, std::move(read));
}

const manikin::Human& MeshLibrary::human(const human::Person& person, base::Threads threads,
                                         const base::Progress& progress) {
  if (!human_) {
    human_ = std::make_unique<manikin::Human>(manikin::keptHuman(person, threads, progress));
  }
  return *human_;
}

void MeshLibrary::checkParts(const study::MeshSource& source, const io::Model& model, const std::string& file) {
  for (const std::string& wanted : source.parts) {
    const bool there =
        std::any_of(model.parts.begin(), model.parts.end(), [&](const io::Part& part) { return part.name == wanted; });
    if (!there) {
      throw base::InputError(file, "", fmt::format("has no part named \"{}\", which the study asks for", wanted));
    }
  }
}

}  // namespace lorica::analysis
