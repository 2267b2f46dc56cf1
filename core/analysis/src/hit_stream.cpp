#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <utility>

#include "lorica/analysis/shot_report.h"
#include "lorica/base/error.h"
#include "lorica/base/files.h"
#include "lorica/base/units.h"
#include "lorica/io/export.h"
#include "named_passages.h"

namespace lorica::analysis {

namespace {

/// Which shots a block holds.
struct Block {
  std::size_t source = 0;
  std::size_t pose = 0;
  std::uint32_t trial = 0;
  std::uint64_t first = 0;
};

/// One form of the file: a head, a text for each block of shots, an end.
class Form {
 public:
  virtual ~Form() = default;
  virtual std::string head() const = 0;
  virtual void add(std::uint64_t shot, const raycast::Ray& ray, const std::vector<NamedPassage>& passages) = 0;
  /// What was added since the last call.
  virtual std::string take() = 0;
  virtual std::string end() const = 0;
};

/// What each passage keeps of itself under its own system, or its own model and no armor.
std::vector<double> claimed(const study::Overlap& overlap, const std::vector<NamedPassage>& passages) {
  std::vector<double> lengths(passages.size(), 0.0);
  for (std::size_t i = 0; i < passages.size(); ++i) {
    const NamedPassage& wanted = passages[i];
    std::vector<NamedPassage> fellows;
    std::size_t place = 0;
    for (std::size_t k = 0; k < passages.size(); ++k) {
      place = k == i ? fellows.size() : place;
      if (passages[k].kind == "body" || (passages[k].kind == wanted.kind && passages[k].group == wanted.group)) {
        fellows.push_back(passages[k]);
      }
    }
    lengths[i] = claimedLengths(overlap, fellows)[place];
  }
  return lengths;
}

class CsvForm final : public Form {
 public:
  CsvForm(const LoadedStudy& study, const RunResult& result, const Block& block)
      : overlap_(&study.study.overlap),
        names_{result.sources[block.source].source.name, result.poses[block.pose], std::to_string(block.trial + 1)} {}

  std::string head() const override {
    return "source,pose,trial,shot,order,structure,kind,system_or_model,enter_m,exit_m,thickness_mm,"
           "normal_thickness_mm,claimed_mm,obliquity_in_deg,obliquity_out_deg,depth_mm\n";
  }
  void add(std::uint64_t shot, const raycast::Ray& /*ray*/, const std::vector<NamedPassage>& passages) override {
    const std::vector<double> kept = claimed(*overlap_, passages);
    for (std::size_t i = 0; i < passages.size(); ++i) {
      const NamedPassage& named = passages[i];
      const shotline::Passage& p = named.passage;
      const auto thick = [&](double metres) { return p.closed ? fmt::format("{:.4f}", 1000.0 * metres) : ""; };
      text_ += io::csvRow(std::array{
          names_[0], names_[1], names_[2], std::to_string(shot), std::to_string(i + 1), named.structure, named.kind,
          named.group, fmt::format("{:.7f}", p.enter), p.closed ? fmt::format("{:.7f}", p.exit) : std::string(),
          thick(p.thickness()), thick(p.normalThickness()), thick(kept[i]),
          fmt::format("{:.3f}", base::degrees(p.obliquityIn)), fmt::format("{:.3f}", base::degrees(p.obliquityOut)),
          named.depth ? fmt::format("{:.4f}", 1000.0 * *named.depth) : std::string()});
    }
  }
  std::string take() override { return std::exchange(text_, {}); }
  std::string end() const override { return {}; }

 private:
  const study::Overlap* overlap_;
  std::array<std::string, 3> names_;
  std::string text_;
};

/// VTK's XML of polygonal data, in text, a piece for each block. Numbers stand for names, which the field data lists.
class VtpForm final : public Form {
 public:
  VtpForm(const LoadedStudy& study, const RunResult& result, const Block& block) : result_(&result), block_(block) {
    structures_.emplace_back("body");
    for (const auto& piece : study.pieces) {
      structures_.push_back(piece->name);
    }
    for (const auto& organ : study.organs) {
      structures_.push_back(organ->name);
    }
  }

  std::string head() const override {
    std::vector<std::string> sources;
    for (const ShotSource& source : result_->sources) {
      sources.push_back(source.source.name);
    }
    std::vector<std::string> models;
    for (const viscera::OrganModel model : result_->models) {
      models.push_back(viscera::name(model));
    }
    return "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" "
           "byte_order=\"LittleEndian\">\n<PolyData>\n"
           "<FieldData>\n" +
           names("structure_names", structures_) + names("source_names", sources) +
           names("pose_names", result_->poses) + names("model_names", models) + "</FieldData>\n";
  }
  void add(std::uint64_t shot, const raycast::Ray& ray, const std::vector<NamedPassage>& passages) override {
    const geometry::Vec3d origin = ray.origin.cast<double>();
    const geometry::Vec3d direction = ray.direction.cast<double>().normalized();
    for (const NamedPassage& named : passages) {
      const shotline::Passage& p = named.passage;
      for (const double t : {p.enter, p.exit}) {
        const geometry::Vec3d point = origin + t * direction;
        points_ += fmt::format("{:.6f} {:.6f} {:.6f}\n", point.x(), point.y(), point.z());
      }
      lines_ += fmt::format("{} {}\n", 2 * count_, 2 * count_ + 1);
      ends_ += fmt::format("{}\n", 2 * count_ + 2);
      columns_[0] += fmt::format("{}\n", shot);
      columns_[1] += fmt::format("{}\n", indexOf(structures_, named.structure));
      columns_[2] += fmt::format("{}\n", modelOf(named));
      columns_[3] += fmt::format("{:.4f}\n", 1000.0 * p.thickness());
      columns_[4] += fmt::format("{:.3f}\n", base::degrees(p.obliquityIn));
      ++count_;
    }
  }
  std::string take() override {
    if (count_ == 0) {
      return {};
    }
    std::string same;
    const auto constant = [&](const char* name, std::uint64_t value) { same += array("Int32", name, repeated(value)); };
    constant("source", block_.source);
    constant("pose", block_.pose);
    constant("trial", block_.trial + 1U);
    std::string text =
        fmt::format("<Piece NumberOfPoints=\"{}\" NumberOfLines=\"{}\">\n<Points>\n", 2 * count_, count_);
    text += "<DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">\n" + points_ +
            "</DataArray>\n</Points>\n";
    text += "<Lines>\n" + array("Int64", "connectivity", lines_) + array("Int64", "offsets", ends_) +
            "</Lines>\n<CellData>\n";
    text += same + array("Int64", "shot", columns_[0]) + array("Int32", "structure", columns_[1]) +
            array("Int32", "model", columns_[2]) + array("Float64", "thickness_mm", columns_[3]) +
            array("Float64", "obliquity_in_deg", columns_[4]) + "</CellData>\n</Piece>\n";
    count_ = 0;
    points_.clear();
    lines_.clear();
    ends_.clear();
    columns_ = {};
    return text;
  }
  std::string end() const override { return "</PolyData>\n</VTKFile>\n"; }

 private:
  static std::string array(const char* type, const char* name, const std::string& values) {
    return fmt::format("<DataArray type=\"{}\" Name=\"{}\" format=\"ascii\">\n{}</DataArray>\n", type, name, values);
  }
  /// Texts as VTK writes them: the numbers of their bytes, each text with a zero at its end.
  static std::string names(const char* name, const std::vector<std::string>& texts) {
    std::string bytes;
    for (const std::string& text : texts) {
      for (const char letter : text) {
        bytes += fmt::format("{} ", static_cast<unsigned>(static_cast<unsigned char>(letter)));
      }
      bytes += "0 ";
    }
    return fmt::format("<Array type=\"String\" Name=\"{}\" NumberOfTuples=\"{}\" format=\"ascii\">\n{}\n</Array>\n",
                       name, texts.size(), bytes);
  }
  std::string repeated(std::uint64_t value) const {
    std::string text;
    for (std::uint64_t i = 0; i < count_; ++i) {
      text += fmt::format("{}\n", value);
    }
    return text;
  }
  static std::size_t indexOf(const std::vector<std::string>& texts, const std::string& wanted) {
    return static_cast<std::size_t>(std::find(texts.begin(), texts.end(), wanted) - texts.begin());
  }
  /// Index into the models; -1 for what is no organ.
  int modelOf(const NamedPassage& named) const {
    for (std::size_t m = 0; named.kind == "organ" && m < result_->models.size(); ++m) {
      if (viscera::name(result_->models[m]) == named.group) {
        return static_cast<int>(m);
      }
    }
    return -1;
  }

  const RunResult* result_;
  Block block_;
  std::vector<std::string> structures_;
  std::uint64_t count_ = 0;
  std::string points_;
  std::string lines_;
  std::string ends_;
  std::array<std::string, 5> columns_;
};

std::unique_ptr<Form> makeForm(const LoadedStudy& study, const RunResult& result, HitFormat format,
                               const Block& block) {
  if (format == HitFormat::csv) {
    return std::make_unique<CsvForm>(study, result, block);
  }
  return std::make_unique<VtpForm>(study, result, block);
}

/// The text of one block of shots.
std::string blockText(const LoadedStudy& study, const RunResult& result, const PosedScene& scene, HitFormat format,
                      const Block& block, std::uint64_t count) {
  const std::unique_ptr<Form> form = makeForm(study, result, format, block);
  const shotline::ShotGenerator shots(result.sources[block.source].source, result.seed, block.trial);
  std::vector<raycast::Ray> rays(static_cast<std::size_t>(count));
  shots.shots(block.first, rays);
  raycast::Caster caster(scene.scene());
  const PassageNamer namer(study, scene);
  caster.castMany(rays, [&](std::size_t i, std::span<const raycast::Hit> hits) {
    if (!hits.empty()) {
      form->add(block.first + i, rays[i], namer.name(rays[i], hits));
    }
  });
  return form->take();
}

}  // namespace

void writeHits(const LoadedStudy& study, const RunResult& result, HitFormat format, const std::filesystem::path& folder,
               base::Threads threads, const base::Progress& progress) {
  constexpr std::uint64_t shotsPerBlock = 4096;
  constexpr std::uint64_t blocksAtOnce = 16;
  base::FileDraft file(folder / (format == HitFormat::csv ? "hits.csv" : "hits.vtp"));
  file.write(makeForm(study, result, format, {})->head());
  const double poses = static_cast<double>(std::max<std::size_t>(1, result.poses.size()));
  for (std::size_t p = 0; p < result.poses.size(); ++p) {
    const PosedScene scene(study, result.models, resolvePose(study, result.poses[p]).pose, raycast::SceneUse::manyRays,
                           threads);
    for (std::size_t s = 0; s < result.sources.size(); ++s) {
      const std::uint64_t shots = result.sources[s].shots;
      const std::size_t trials = result.results[s * result.poses.size() + p].trials.size();
      for (std::uint32_t trial = 0; trial < trials; ++trial) {
        for (std::uint64_t first = 0; first < shots; first += shotsPerBlock * blocksAtOnce) {
          progress.check();
          const std::uint64_t blocks = std::min(blocksAtOnce, (shots - first + shotsPerBlock - 1) / shotsPerBlock);
          std::vector<std::string> texts(static_cast<std::size_t>(blocks));
          base::parallelFor(texts.size(), 1, threads, [&](std::size_t begin, std::size_t end) {
            for (std::size_t b = begin; b < end; ++b) {
              const std::uint64_t start = first + b * shotsPerBlock;
              texts[b] =
                  blockText(study, result, scene, format, {s, p, trial, start}, std::min(shotsPerBlock, shots - start));
            }
          });
          for (const std::string& text : texts) {
            file.write(text);
          }
        }
      }
      progress.report(
          (static_cast<double>(p) + static_cast<double>(s + 1) / static_cast<double>(result.sources.size())) / poses);
    }
  }
  file.write(makeForm(study, result, format, {})->end());
  progress.check();
  file.commit();
}

}  // namespace lorica::analysis
