#include "lorica/analysis/shot_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "lorica/base/error.h"
#include "lorica/base/units.h"
#include "lorica/study/provenance.h"
#include "named_passages.h"

namespace lorica::analysis {

namespace {

std::optional<std::uint64_t> wholeNumber(std::string_view text) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() && !text.empty() ? std::optional(value)
                                                                                   : std::nullopt;
}

}  // namespace

ShotName shotNamed(const std::string& text) {
  const std::size_t last = text.rfind(':');
  const std::size_t middle = last == std::string::npos || last == 0 ? std::string::npos : text.rfind(':', last - 1);
  if (middle != std::string::npos && middle > 0) {
    const auto trial = wholeNumber(std::string_view(text).substr(middle + 1, last - middle - 1));
    const auto shot = wholeNumber(std::string_view(text).substr(last + 1));
    if (trial && shot && *trial >= 1 && *trial <= 100000) {
      return {text.substr(0, middle), static_cast<std::uint32_t>(*trial - 1), *shot};
    }
  }
  throw base::InputError(
      "", "", fmt::format("\"{}\" names no shot; expected SOURCE:TRIAL:SHOT, trials from 1, shots from 0", text));
}

std::vector<ShotDetails> shotDetails(const LoadedStudy& study, const RunResult& plan, const ShotName& name,
                                     base::Threads threads) {
  const auto source = std::find_if(plan.sources.begin(), plan.sources.end(),
                                   [&](const ShotSource& s) { return s.source.name == name.source; });
  if (source == plan.sources.end()) {
    throw base::InputError(study.file.string(), "/sources",
                           fmt::format("the study has no source named \"{}\"", name.source));
  }
  const std::uint32_t trials = trialsOf(plan, static_cast<std::size_t>(source - plan.sources.begin()));
  if (name.trial >= trials && !(study.study.stop && shotline::isDrawn(source->source))) {
    throw base::InputError(
        study.file.string(), "/trials",
        fmt::format("there is no trial {} of source \"{}\"; it has {}", name.trial + 1, name.source, trials));
  }
  if (name.shot >= source->shots) {
    throw base::InputError(
        study.file.string(), "/sources",
        fmt::format("source \"{}\" has no shot {}; its shots are 0 to {}", name.source, name.shot, source->shots - 1));
  }
  const raycast::Ray ray = shotline::ShotGenerator(source->source, plan.seed, name.trial).shot(name.shot);
  std::vector<ShotDetails> details;
  for (const std::string& pose : plan.poses) {
    const PosedScene scene(study, plan.models, resolvePose(study, pose).pose, raycast::SceneUse::manyRays, threads);
    raycast::Caster caster(scene.scene());
    details.push_back({pose, ray, PassageNamer(study, scene).name(ray, caster.cast(ray))});
  }
  return details;
}

namespace {

std::string millimetres(double metres) {
  return fmt::format("{:.2f}", 1000.0 * metres);
}

void appendPassages(std::string& text, const std::vector<NamedPassage>& passages) {
  text +=
      fmt::format("  {:<22} {:<6} {:<15} {:>10} {:>10} {:>10} {:>10} {:>7} {:>7} {:>9}\n", "structure", "kind",
                  "system or model", "enter mm", "exit mm", "thick mm", "normal mm", "in deg", "out deg", "depth mm");
  for (const NamedPassage& named : passages) {
    const shotline::Passage& p = named.passage;
    const bool thick = p.closed;
    text += fmt::format("  {:<22} {:<6} {:<15} {:>10} {:>10} {:>10} {:>10} {:>7.1f} {:>7.1f} {:>9}\n", named.structure,
                        named.kind, named.group, millimetres(p.enter), thick ? millimetres(p.exit) : "open",
                        thick ? millimetres(p.thickness()) : "-", thick ? millimetres(p.normalThickness()) : "-",
                        base::degrees(p.obliquityIn), base::degrees(p.obliquityOut),
                        named.depth ? millimetres(*named.depth) : "-");
  }
}

void appendSegments(std::string& text, const study::Overlap& overlap, const std::vector<NamedPassage>& passages) {
  for (const shotline::Segment& segment : segmentsOf(overlap, passages)) {
    std::string owners;
    for (const std::size_t owner : segment.owners) {
      owners += (owners.empty() ? "" : " + ") + passages[owner].structure;
    }
    text += fmt::format("  {:>10} to {:>10}  {:>10} mm  {}\n", millimetres(segment.from), millimetres(segment.to),
                        millimetres(segment.to - segment.from), owners.empty() ? "gap" : owners);
  }
}

std::string armorInOrder(const std::vector<NamedPassage>& passages) {
  std::string pieces;
  for (const NamedPassage& named : passages) {
    if (named.kind == "armor") {
      pieces += (pieces.empty() ? "" : ", ") + named.structure;
    }
  }
  return pieces.empty() ? "none" : pieces;
}

}  // namespace

std::string shotReport(const LoadedStudy& study, const RunResult& plan, const ShotName& name, base::Threads threads) {
  std::string text;
  for (const ShotDetails& details : shotDetails(study, plan, name, threads)) {
    const geometry::Vec3f& o = details.ray.origin;
    const geometry::Vec3d d = details.ray.direction.cast<double>().normalized();
    text += fmt::format("shot {}:{}:{}, pose {}\n", name.source, name.trial + 1, name.shot, details.pose);
    text += fmt::format("from ({:.4f}, {:.4f}, {:.4f}) m along ({:.5f}, {:.5f}, {:.5f}); lengths from there\n", o.x(),
                        o.y(), o.z(), d.x(), d.y(), d.z());
    // 0 less the component: a level shot comes from elevation 0, not -0.
    text += fmt::format("comes from azimuth {:.2f}, elevation {:.2f} degrees; {}\n",
                        base::degrees(std::atan2(0.0 - d.x(), 0.0 - d.z())),
                        base::degrees(std::asin(std::clamp(0.0 - d.y(), -1.0, 1.0))), study::azimuthConvention);
    if (details.passages.empty()) {
      text += "  crosses nothing\n\n";
      continue;
    }
    appendPassages(text, details.passages);
    for (const std::string& system : plan.systems) {
      for (const viscera::OrganModel model : plan.models) {
        const auto here = passagesUnder(details.passages, system, viscera::name(model));
        text += fmt::format("armor system {}, organs {}; armor in order: {}\n", system, viscera::name(model),
                            armorInOrder(here));
        appendSegments(text, study.study.overlap, here);
      }
    }
    text += "\n";
  }
  return text;
}

}  // namespace lorica::analysis
