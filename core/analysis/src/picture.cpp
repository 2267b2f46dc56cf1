#include "lorica/analysis/picture.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "lorica/base/error.h"
#include "lorica/raycast/caster.h"

namespace lorica::analysis {

namespace {

using geometry::Vec3d;
using geometry::Vec3f;

constexpr std::size_t edgeGrid = 3;
/// Steps between neighbours that the eye takes for an edge, of 255.
constexpr int edgeStep = 16;
constexpr double ambient = 0.42;
/// A translucent surface at a right angle to the view is this much of the way to opaque.
constexpr double slantDensity = 0.55;

/// Directions of the frame.
struct View {
  explicit View(const PictureFrame& frame)
      : towards(frame.towards.normalized()),
        right(towards.cross(frame.up).normalized()),
        up(right.cross(towards)),
        light((-towards + 0.7 * up - 0.6 * right).normalized()) {}

  Vec3d towards;
  Vec3d right;
  Vec3d up;
  Vec3d light;
};

/// Normals of a mesh's vertices, weighted by the areas around them.
std::vector<Vec3f> vertexNormals(const raycast::Scene& scene, raycast::MeshIndex mesh) {
  const raycast::MeshTopology& topology = scene.topology(mesh);
  const Vec3f* positions = scene.positions(mesh);
  std::vector<Vec3f> normals(topology.vertices, Vec3f::Zero());
  for (const geometry::Triangle& triangle : topology.triangles) {
    const Vec3f& a = positions[triangle[0]];
    const Vec3f across = (positions[triangle[1]] - a).cross(positions[triangle[2]] - a);
    for (const auto corner : triangle) {
      normals[corner] += across;
    }
  }
  for (Vec3f& normal : normals) {
    normal.normalize();  // leaves zero as it is
  }
  return normals;
}

class Painter {
 public:
  Painter(const raycast::Scene& scene, std::span<const MeshLook> looks, const PictureFrame& frame)
      : scene_(scene), looks_(looks), frame_(frame), view_(frame) {
    double reach = 0.0;
    for (std::size_t m = 0; m < scene.meshes(); ++m) {
      const raycast::MeshIndex mesh{m};
      normals_.push_back(vertexNormals(scene, mesh));
      for (std::size_t v = 0; v < scene.topology(mesh).vertices; ++v) {
        reach = std::max(reach, (scene.positions(mesh)[v].cast<double>() - frame.centre).norm());
      }
    }
    start_ = frame.centre - (reach + 1.0) * view_.towards;
  }

  /// The ray through a place in the picture, in pixels from its upper left corner.
  raycast::Ray rayAt(double column, double row) const {
    const double x = (column - 0.5 * static_cast<double>(frame_.columns)) * frame_.pixel;
    const double y = (0.5 * static_cast<double>(frame_.rows) - row) * frame_.pixel;
    return {(start_ + x * view_.right + y * view_.up).cast<float>(), view_.towards.cast<float>()};
  }

  /// Red, green and blue, 0 to 255.
  Vec3d colourOf(const raycast::Caster& caster, const raycast::Ray& ray, std::span<const raycast::Hit> hits) const {
    Vec3d colour = Vec3d::Zero();
    double through = 1.0;
    for (const raycast::Hit& hit : hits) {
      const MeshLook& look = looks_[hit.mesh];
      if (look.opacity <= 0.0 || (!hit.entering && caster.isClosed(hit))) {
        continue;
      }
      const Vec3d normal = normalAt(ray, hit);
      const double facing = std::min(1.0, std::abs(normal.dot(view_.towards)));
      const double lit = ambient + (1.0 - ambient) * std::max(0.0, normal.dot(view_.light));
      const double slant = 1.0 - facing;
      const double opacity = look.opacity + (1.0 - look.opacity) * slantDensity * slant * slant;
      const Vec3d paint(look.colour[0], look.colour[1], look.colour[2]);
      colour += through * opacity * lit * paint;
      through *= 1.0 - opacity;
      if (through < 1e-3) {
        break;
      }
    }
    return colour + through * Vec3d::Constant(255.0);
  }

 private:
  /// The smooth normal of a surface, turned to the viewer.
  Vec3d normalAt(const raycast::Ray& ray, const raycast::Hit& hit) const {
    const raycast::MeshIndex mesh{hit.mesh};
    const geometry::Triangle& triangle = scene_.topology(mesh).triangles[hit.triangle];
    const auto corner = [&](std::size_t i) -> Vec3d { return scene_.positions(mesh)[triangle[i]].cast<double>(); };
    const Vec3d point = ray.origin.cast<double>() + hit.t * ray.direction.cast<double>();
    const Vec3d a = corner(0);
    const Vec3d b = corner(1);
    const Vec3d c = corner(2);
    const Vec3d flat = (b - a).cross(c - a);
    const double area = flat.squaredNorm();
    Vec3d normal = flat;
    if (area > 0.0) {
      const double atB = (point - a).cross(c - a).dot(flat) / area;
      const double atC = (b - a).cross(point - a).dot(flat) / area;
      const auto& normals = normals_[hit.mesh];
      const Vec3d smooth = (1.0 - atB - atC) * normals[triangle[0]].cast<double>() +
                           atB * normals[triangle[1]].cast<double>() + atC * normals[triangle[2]].cast<double>();
      normal = smooth.allFinite() && smooth.norm() > 0.0 ? smooth : flat;
    }
    normal.normalize();
    return normal.dot(view_.towards) > 0.0 ? Vec3d(-normal) : normal;
  }

  const raycast::Scene& scene_;
  std::span<const MeshLook> looks_;
  const PictureFrame& frame_;
  View view_;
  Vec3d start_;
  std::vector<std::vector<Vec3f>> normals_;  ///< per mesh
};

void put(Picture& picture, std::size_t pixel, const Vec3d& colour) {
  for (int channel = 0; channel < 3; ++channel) {
    picture.rgb[3 * pixel + static_cast<std::size_t>(channel)] =
        static_cast<std::uint8_t>(std::lround(std::clamp(colour[channel], 0.0, 255.0)));
  }
}

void drawRow(const Painter& painter, raycast::Caster& caster, std::size_t row, Picture& picture) {
  std::vector<raycast::Ray> rays;
  for (std::size_t column = 0; column < picture.columns; ++column) {
    rays.push_back(painter.rayAt(static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5));
  }
  caster.castMany(rays, [&](std::size_t column, std::span<const raycast::Hit> hits) {
    put(picture, row * picture.columns + column, painter.colourOf(caster, rays[column], hits));
  });
}

/// Pixels of a row that differ from one of their neighbours.
std::vector<std::size_t> edgesIn(const Picture& picture, std::size_t row) {
  const auto differ = [&](std::size_t a, std::size_t b) {
    for (std::size_t channel = 0; channel < 3; ++channel) {
      if (std::abs(picture.rgb[3 * a + channel] - picture.rgb[3 * b + channel]) > edgeStep) {
        return true;
      }
    }
    return false;
  };
  std::vector<std::size_t> columns;
  for (std::size_t column = 0; column < picture.columns; ++column) {
    const std::size_t pixel = row * picture.columns + column;
    if ((column > 0 && differ(pixel, pixel - 1)) || (column + 1 < picture.columns && differ(pixel, pixel + 1)) ||
        (row > 0 && differ(pixel, pixel - picture.columns)) ||
        (row + 1 < picture.rows && differ(pixel, pixel + picture.columns))) {
      columns.push_back(column);
    }
  }
  return columns;
}

void smoothRow(const Painter& painter, raycast::Caster& caster, std::size_t row, const Picture& rough,
               Picture& picture) {
  std::vector<raycast::Ray> rays;
  for (const std::size_t column : edgesIn(rough, row)) {
    rays.clear();
    for (std::size_t i = 0; i < edgeGrid * edgeGrid; ++i) {
      const auto inside = [](std::size_t step) { return (static_cast<double>(step) + 0.5) / edgeGrid; };
      rays.push_back(painter.rayAt(static_cast<double>(column) + inside(i % edgeGrid),
                                   static_cast<double>(row) + inside(i / edgeGrid)));
    }
    Vec3d sum = Vec3d::Zero();
    caster.castMany(rays, [&](std::size_t i, std::span<const raycast::Hit> hits) {
      sum += painter.colourOf(caster, rays[i], hits);
    });
    put(picture, row * picture.columns + column, sum / static_cast<double>(rays.size()));
  }
}

}  // namespace

Picture drawScene(const raycast::Scene& scene, std::span<const MeshLook> looks, const PictureFrame& frame,
                  base::Threads threads, const base::Progress& progress) {
  LORICA_CHECK(looks.size() == scene.meshes(), "a look for every mesh");
  LORICA_CHECK(frame.pixel > 0.0 && frame.towards.cross(frame.up).norm() > 0.0, "a frame that shows something");
  const Painter painter(scene, looks, frame);
  Picture rough{frame.columns, frame.rows, std::vector<std::uint8_t>(3 * frame.columns * frame.rows)};
  constexpr std::size_t grain = 16;
  const auto overRows = [&](const auto& work) {
    base::parallelFor(frame.rows, grain, threads, [&](std::size_t begin, std::size_t end) {
      raycast::Caster caster(scene);
      for (std::size_t row = begin; row < end; ++row) {
        progress.check();
        work(caster, row);
      }
    });
  };
  overRows([&](raycast::Caster& caster, std::size_t row) { drawRow(painter, caster, row, rough); });
  progress.report(0.5);
  Picture picture = rough;
  overRows([&](raycast::Caster& caster, std::size_t row) { smoothRow(painter, caster, row, rough, picture); });
  progress.report(1.0);
  return picture;
}

}  // namespace lorica::analysis
