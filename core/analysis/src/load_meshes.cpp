#include "load_meshes.h"

#include <fmt/format.h>

#include <algorithm>

#include "lorica/base/error.h"
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

const io::Model& MeshLibrary::file(const study::InputFile& input) {
  const std::filesystem::path path = study::resolve(input, studyFile_);
  const std::string key = fmt::format("{}|{}|{}", path.string(), input.units ? base::name(*input.units) : "",
                                      input.up ? std::string(1, *input.up) : "");
  const auto known = models_.find(key);
  if (known != models_.end()) {
    return known->second;
  }
  io::ImportOptions options;
  options.units = input.units;
  if (input.up) {
    options.up = *input.up == 'z' ? io::UpAxis::z : io::UpAxis::y;
  }
  io::Model model = io::importModel(path, options);
  for (base::Issue issue : model.issues) {
    issue.file = input.path;  // as the study says it: results do not depend on where the study lies
    issues_.push_back(std::move(issue));
  }
  return models_.emplace(key, std::move(model)).first->second;
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
