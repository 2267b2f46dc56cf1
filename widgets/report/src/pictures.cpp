#include <QBuffer>
#include <QColor>
#include <algorithm>
#include <array>

#include "lorica/analysis/picture.h"
#include "lorica/analysis/posed_scene.h"
#include "lorica/analysis/shot_paths.h"
#include "lorica/base/error.h"
#include "lorica/base/files.h"
#include "lorica/base/table.h"
#include "lorica/document/appearance.h"
#include "lorica/geometry/measures.h"
#include "lorica/io/export.h"
#include "lorica/report/report.h"
#include "lorica/study/reserved_names.h"
#include "picture_files.h"

namespace lorica::report {

namespace {

namespace fs = std::filesystem;

/// About 300 dpi where three poses share a page.
constexpr double metresPerPixel = 0.002;
constexpr std::size_t mostPoses = 24;  ///< more would make a picture book
constexpr double margin = 0.02;        ///< m around the body
/// Of armor, so that organs behind it show.
constexpr double armorOpacity = 0.38;
constexpr std::array<const char*, 3> viewNames{"front", "side", "back"};

QImage imageOf(const analysis::Picture& picture) {
  QImage image(static_cast<int>(picture.columns), static_cast<int>(picture.rows), QImage::Format_RGB888);
  for (std::size_t row = 0; row < picture.rows; ++row) {
    std::copy_n(picture.rgb.begin() + static_cast<std::ptrdiff_t>(3 * row * picture.columns), 3 * picture.columns,
                image.scanLine(static_cast<int>(row)));
  }
  // As PNG files are read back, so that the same picture gives the same PDF.
  return image.convertToFormat(QImage::Format_RGB32);
}

/// Pieces say themselves whether they are worn: the study's default hides all systems but the first.
bool isHidden(const study::Study& study, const std::string& structure) {
  return std::any_of(study.displays.begin(), study.displays.end(),
                     [&](const study::Display& display) { return display.structure == structure && !display.visible; });
}

analysis::MeshLook lookOf(const study::Study& study, const std::string& structure, std::optional<double> opacity) {
  const document::Appearance appearance = document::appearanceOf(study, structure);
  const QColor colour = appearance.colour;
  return {{static_cast<std::uint8_t>(colour.red()), static_cast<std::uint8_t>(colour.green()),
           static_cast<std::uint8_t>(colour.blue())},
          isHidden(study, structure) ? 0.0 : opacity.value_or(appearance.opacity)};
}

/// Looks of all meshes of a scene with one model, one system worn.
std::vector<analysis::MeshLook> looksOf(const analysis::LoadedStudy& study, const analysis::PosedScene& scene,
                                        const std::string& system) {
  std::vector<analysis::MeshLook> looks;
  for (std::size_t mesh = 0; mesh < scene.scene().meshes(); ++mesh) {
    const analysis::StructureRef what = analysis::structureOfMesh(scene.layout(), static_cast<std::uint32_t>(mesh));
    switch (what.kind) {
      case analysis::StructureRef::Kind::body:
        looks.push_back(lookOf(study.study, "body", std::nullopt));
        break;
      case analysis::StructureRef::Kind::organ:
        looks.push_back(lookOf(study.study, study.organs[what.index]->name, std::nullopt));
        break;
      case analysis::StructureRef::Kind::piece: {
        const bool worn = study.study.systems[study.systemOfPiece[what.index]].name == system;
        looks.push_back(lookOf(study.study, study.pieces[what.index]->name, worn ? armorOpacity : 0.0));
        break;
      }
    }
  }
  return looks;
}

geometry::Box3d boxOf(const analysis::LoadedStudy& study, const analysis::PosedScene& scene) {
  geometry::Box3d box = geometry::bounds(scene.body().skin);
  for (std::size_t p = 0; p < study.pieces.size(); ++p) {
    box.extend(geometry::bounds(scene.piece(p)));
  }
  return box;
}

std::size_t pixels(double metres) {
  return static_cast<std::size_t>((metres + 2.0 * margin) / metresPerPixel) + 1;
}

/// One width for all pictures of a set, so that they stand below each other.
struct Extent {
  double across = 0.0;  ///< m, along x
  double deep = 0.0;    ///< along z

  void take(const geometry::Box3d& box) {
    across = std::max(across, box.sizes().x());
    deep = std::max(deep, box.sizes().z());
  }
};

analysis::PictureFrame frameOf(const geometry::Box3d& box, const Extent& extent, const geometry::Vec3d& towards) {
  analysis::PictureFrame frame;
  frame.centre = box.center();
  frame.towards = towards;
  frame.pixel = metresPerPixel;
  frame.columns = pixels(std::abs(towards.x()) > 0.5 ? extent.deep : extent.across);
  frame.rows = pixels(box.sizes().y());
  return frame;
}

std::vector<LegendEntry> legendOf(const study::Study& study) {
  std::vector<LegendEntry> legend;
  const auto add = [&](const std::string& structure, const std::string& system) {
    if (!isHidden(study, structure)) {
      legend.push_back({structure, system, document::appearanceOf(study, structure).colour.rgb()});
    }
  };
  add("body", "");
  for (const study::Organ& organ : study.organs) {
    add(organ.name, "");
  }
  for (const study::ArmorSystem& system : study.systems) {
    for (const study::ArmorPiece& piece : system.pieces) {
      add(piece.name, system.name);
    }
  }
  return legend;
}

/// The model that shows most of what a pose does.
viscera::OrganModel shownModel(const analysis::RunResult& result) {
  const auto& models = result.models;
  for (const viscera::OrganModel wanted : {viscera::OrganModel::dynamic, viscera::OrganModel::dynamicThesis}) {
    if (std::find(models.begin(), models.end(), wanted) != models.end()) {
      return wanted;
    }
  }
  return models.front();
}

std::string pngOf(const QImage& image) {
  QBuffer buffer;
  buffer.open(QIODevice::WriteOnly);
  if (!image.save(&buffer, "PNG")) {
    throw base::Error("a picture cannot be written as PNG");
  }
  return buffer.data().toStdString();
}

}  // namespace

PictureSet drawPictures(const analysis::LoadedStudy& study, const analysis::RunResult& result, base::Threads threads,
                        const base::Progress& progress) {
  PictureSet set;
  set.metresPerPixel = metresPerPixel;
  set.legend = legendOf(study.study);
  const viscera::OrganModel model = shownModel(result);
  set.model = viscera::name(model);
  std::vector<std::string> systems;
  for (const study::ArmorSystem& system : study.study.systems) {
    systems.push_back(system.name);
  }
  if (systems.empty()) {
    systems.emplace_back(study::unarmored);
  }
  // Posed twice, first for the extent of all: holding every pose would need memory for each.
  analysis::PosedScene scene(study, {model}, std::nullopt, raycast::SceneUse::manyFrames, threads);
  const std::vector<std::string> shown(
      result.poses.begin(),
      result.poses.begin() + static_cast<std::ptrdiff_t>(std::min(mostPoses, result.poses.size())));
  const auto poses = static_cast<double>(shown.size());
  const auto pose = [&](const std::string& name) { scene.move(analysis::resolvePose(study, name).pose, threads); };
  Extent extent;
  for (std::size_t p = 0; p < shown.size(); ++p) {
    progress.check();
    pose(shown[p]);
    extent.take(boxOf(study, scene));
    progress.report(0.2 * static_cast<double>(p + 1) / poses);
  }
  const double total = poses + static_cast<double>(systems.size() - 1);
  const auto draw = [&](const std::string& name, const std::string& system) {
    const auto done = static_cast<double>(set.poses.size());
    const base::Progress share = progress.part(0.2 + 0.8 * done / total, 0.2 + 0.8 * (done + 1.0) / total);
    pose(name);
    const std::vector<analysis::MeshLook> looks = looksOf(study, scene, system);
    const geometry::Box3d box = boxOf(study, scene);
    const auto from = [&](const geometry::Vec3d& towards, double begin, double end) {
      return imageOf(
          analysis::drawScene(scene.scene(), looks, frameOf(box, extent, towards), threads, share.part(begin, end)));
    };
    PosePictures pictures{name, system, {}, {}, {}};
    pictures.front = from(-geometry::Vec3d::UnitZ(), 0.0, 0.3);
    pictures.side = from(-geometry::Vec3d::UnitX(), 0.3, 0.6);
    pictures.back = from(geometry::Vec3d::UnitZ(), 0.6, 1.0);
    set.poses.push_back(std::move(pictures));
  };
  for (const std::string& name : shown) {
    draw(name, systems.front());
  }
  for (std::size_t s = 1; s < systems.size() && !shown.empty(); ++s) {
    draw(shown.front(), systems[s]);
  }
  return set;
}

std::vector<base::FileBytes> pictureFiles(const PictureSet& set, const std::string& studyHash, const fs::path& folder) {
  const fs::path place = folder / "pictures";
  std::vector<base::FileBytes> files;
  std::string table = "file,pose,system,view,model,metres_per_pixel,study_sha256\n";
  for (std::size_t i = 0; i < set.poses.size(); ++i) {
    const PosePictures& pictures = set.poses[i];
    const std::array<const QImage*, 3> views{&pictures.front, &pictures.side, &pictures.back};
    for (std::size_t v = 0; v < views.size(); ++v) {
      const std::string name = "pose_" + std::to_string(i + 1) + "_" + viewNames.at(v) + ".png";
      files.push_back({place / name, pngOf(*views.at(v))});
      table += io::csvRow(std::array{name, pictures.pose, pictures.system, std::string(viewNames.at(v)), set.model,
                                     io::csvNumber(set.metresPerPixel), studyHash});
    }
  }
  std::string legend = "structure,system,colour\n";
  for (const LegendEntry& entry : set.legend) {
    legend += io::csvRow(std::array{entry.structure, entry.system, QColor(entry.colour).name().toStdString()});
  }
  files.push_back({place / "legend.csv", legend});
  files.push_back({place / "pictures.csv", table});
  return files;
}

namespace {

[[noreturn]] void damaged(const fs::path& file, const std::string& place, const std::string& text) {
  throw base::InputError(file.string(), place, text + "; run the study again with --pdf, or delete the folder");
}

QImage readPicture(const fs::path& file) {
  QImage image;
  const std::string bytes = base::readFile(file);
  constexpr int largest = 20000;
  if (!image.loadFromData(reinterpret_cast<const uchar*>(bytes.data()), static_cast<int>(bytes.size()), "PNG") ||
      image.width() > largest || image.height() > largest) {
    damaged(file, "", "is not a PNG picture as a run writes it");
  }
  return image.convertToFormat(QImage::Format_RGB32);
}

void readLegend(const fs::path& file, PictureSet& set) {
  const base::Table table(base::readFile(file), file.string());
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const QColor colour(QString::fromStdString(table.text(row, "colour")));
    if (!colour.isValid()) {
      damaged(file, "line " + std::to_string(table.line(row)), "expected a colour such as #d8ac8e");
    }
    set.legend.push_back({table.text(row, "structure"), table.text(row, "system"), colour.rgb()});
  }
}

}  // namespace

PictureSet readPictures(const fs::path& folder, const study::RunFacts& facts) {
  PictureSet set;
  const fs::path place = folder / "pictures";
  const fs::path list = place / "pictures.csv";
  std::error_code ignored;
  if (!fs::exists(list, ignored)) {
    return set;
  }
  const base::Table table(base::readFile(list), list.string());
  for (std::size_t row = 0; row < table.rows(); ++row) {
    if (table.text(row, "study_sha256") != facts.studyHash) {
      return {};
    }
    const std::string& name = table.text(row, "file");
    // A name, never a path out of the folder.
    if (fs::path(name).filename() != name || name.empty() || name == "..") {
      damaged(list, "line " + std::to_string(table.line(row)), "expected the name of a file beside this one");
    }
    const std::string& pose = table.text(row, "pose");
    const std::string& system = table.text(row, "system");
    if (set.poses.empty() || set.poses.back().pose != pose || set.poses.back().system != system) {
      set.poses.push_back({pose, system, {}, {}, {}});
    }
    PosePictures& pictures = set.poses.back();
    const std::string& view = table.text(row, "view");
    QImage& image = view == viewNames[0] ? pictures.front : view == viewNames[1] ? pictures.side : pictures.back;
    image = readPicture(place / name);
    set.model = table.text(row, "model");
    set.metresPerPixel = table.number(row, "metres_per_pixel");
  }
  for (const PosePictures& pictures : set.poses) {
    if (pictures.front.isNull() || pictures.side.isNull() || pictures.back.isNull() || !(set.metresPerPixel > 0.0)) {
      damaged(list, "", "expected a front, a side and a back view of pose '" + pictures.pose + "' and their scale");
    }
  }
  readLegend(place / "legend.csv", set);
  return set;
}

}  // namespace lorica::report
