#include "named_passages.h"

#include <algorithm>

#include "lorica/analysis/shot_paths.h"

namespace lorica::analysis {

std::vector<NamedPassage> PassageNamer::name(const raycast::Ray& ray, std::span<const raycast::Hit> hits) const {
  std::vector<NamedPassage> named;
  std::optional<double> skin;
  for (const shotline::Passage& passage : shotline::passagesOf(ray, hits, scene_->scene())) {
    NamedPassage made;
    made.passage = passage;
    const StructureRef ref = structureOfMesh(scene_->layout(), passage.mesh);
    switch (ref.kind) {
      case StructureRef::Kind::body:
        made.structure = "body";
        made.kind = "body";
        skin = skin ? skin : passage.enter;
        break;
      case StructureRef::Kind::piece:
        made.structure = study_->pieces[ref.index]->name;
        made.kind = "armor";
        made.group = study_->study.systems[study_->systemOfPiece[ref.index]].name;
        break;
      case StructureRef::Kind::organ:
        made.structure = study_->organs[ref.index]->name;
        made.kind = "organ";
        made.group = viscera::name(scene_->models()[ref.model]);
        break;
    }
    named.push_back(std::move(made));
  }
  for (NamedPassage& passage : named) {
    if (skin) {
      passage.depth = passage.passage.enter - *skin;
    }
  }
  return named;
}

namespace {

/// Rank in the study's list; those not in it come after, in equal ranks.
std::size_t rankOf(const study::Overlap& overlap, const NamedPassage& passage) {
  const auto found = std::find(overlap.order.begin(), overlap.order.end(), passage.structure);
  return static_cast<std::size_t>(found - overlap.order.begin());
}

}  // namespace

std::vector<shotline::Segment> segmentsOf(const study::Overlap& overlap, std::span<const NamedPassage> passages) {
  std::vector<shotline::Passage> plain;
  for (const NamedPassage& passage : passages) {
    plain.push_back(passage.passage);
  }
  std::vector<shotline::Segment> segments = shotline::partition(plain, shotline::OverlapPolicy::allClaim);
  for (shotline::Segment& segment : segments) {
    const auto isBody = [&](std::size_t owner) { return passages[owner].kind == "body"; };
    if (!std::all_of(segment.owners.begin(), segment.owners.end(), isBody)) {
      std::erase_if(segment.owners, isBody);
    }
    if (segment.owners.size() < 2 || overlap.policy == shotline::OverlapPolicy::allClaim) {
      continue;
    }
    const bool priority = overlap.policy == shotline::OverlapPolicy::priority;
    // Owners stand in the order they are entered, so the first of equal rank is the outermost.
    segment.owners = {
        *std::min_element(segment.owners.begin(), segment.owners.end(), [&](std::size_t a, std::size_t b) {
          return priority ? rankOf(overlap, passages[a]) < rankOf(overlap, passages[b]) : a < b;
        })};
  }
  return segments;
}

std::vector<double> claimedLengths(const study::Overlap& overlap, std::span<const NamedPassage> passages) {
  std::vector<double> lengths(passages.size(), 0.0);
  for (const shotline::Segment& segment : segmentsOf(overlap, passages)) {
    for (const std::size_t owner : segment.owners) {
      lengths[owner] += segment.to - segment.from;
    }
  }
  return lengths;
}

std::vector<NamedPassage> passagesUnder(std::span<const NamedPassage> passages, const std::string& system,
                                        const std::string& model) {
  std::vector<NamedPassage> chosen;
  std::copy_if(passages.begin(), passages.end(), std::back_inserter(chosen), [&](const NamedPassage& passage) {
    return passage.kind == "body" || passage.group == (passage.kind == "armor" ? system : model);
  });
  return chosen;
}

}  // namespace lorica::analysis
