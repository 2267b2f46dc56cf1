#include "body_mesh.h"

#include <cmath>

#include "body_fit.h"
#include "lorica/geometry/isosurface.h"
#include "lorica/geometry/remesh.h"

namespace lorica::manikin {

namespace {

/// A ball in which triangles are smaller; between `inner` and `outer` metres from its middle they grow.
struct FinePlace {
  Vec3d middle;
  double inner;
  double outer;
  double length;
};

std::vector<FinePlace> finePlaces(const BodyJoints& joints, double size) {
  const auto& at = joints.at;
  std::vector<FinePlace> places{
      {at[jGlenohumeral], 0.10, 0.17, 0.0110},
      {at[jElbow], 0.06, 0.11, 0.0100},
      {at[jWrist], 0.04, 0.08, 0.0075},
      {at[jHip] + Vec3d(0.02, -0.02, 0.0), 0.15, 0.22, 0.0115},
      {at[jKnee], 0.09, 0.15, 0.0105},
      {at[jAnkle], 0.06, 0.11, 0.0085},
      {at[jToe], 0.07, 0.13, 0.0065},
      {at[jC7T1], 0.09, 0.14, 0.0100},
      {at[jL3L4], 0.16, 0.24, 0.0120},
      {at[jEye] + Vec3d(-0.03, -0.05, 0.01), 0.085, 0.13, 0.0056},
      {at[jHead] + Vec3d(0.06, 0.02, 0.0), 0.05, 0.09, 0.0060},
  };
  for (const Finger& finger : joints.fingers) {
    places.push_back({finger.knuckle, 0.025, 0.06, 0.0060});
    places.push_back({finger.second, 0.025, 0.06, 0.0050});
    places.push_back({finger.tip, 0.03, 0.06, 0.0046});
  }
  for (FinePlace& place : places) {
    place.inner *= size;
    place.outer *= size;
    place.length *= size;
  }
  return places;
}

}  // namespace

Vec3d ontoSurface(const std::function<double(const Vec3d&)>& field, const Vec3d& p) {
  constexpr double step = 2e-4;
  constexpr double longest = 0.004;
  Vec3d here = p;
  for (int i = 0; i < 4; ++i) {
    const double value = field(here);
    if (std::abs(value) < 1e-5) {
      break;
    }
    // Forward differences do: the step to the surface is short.
    const Vec3d gradient =
        Vec3d(field(here + Vec3d(step, 0.0, 0.0)) - value, field(here + Vec3d(0.0, step, 0.0)) - value,
              field(here + Vec3d(0.0, 0.0, step)) - value) /
        step;
    const double slope = gradient.squaredNorm();
    if (slope < 1e-4) {
      break;
    }
    Vec3d move = -value / slope * gradient;
    if (move.norm() > longest) {
      move *= longest / move.norm();
    }
    here += move;
  }
  return here;
}

geometry::TriangleMesh skinMesh(const Anthropometry& sizes, const BodyJoints& joints, const BodyField& field,
                                base::Threads threads, const base::Progress& progress) {
  const double size = sizes.person().stature / 1.755;
  // The field is asked all the time, and asking for the wish to stop costs nothing beside it.
  const auto whole = [&](const Vec3d& p) {
    progress.check();
    return field.whole(p);
  };
  const geometry::Box3d box = bodyBox(sizes, joints);
  const geometry::TriangleMesh rough = geometry::isosurface(whole, box, 0.0055 * size, 1.8, threads);
  const std::vector<FinePlace> fine = finePlaces(joints, size);
  geometry::RemeshOptions options;
  options.edgeLength = [&](const Vec3d& p) {
    const Vec3d mirrored = mirroredToLeft(p);
    double length = 0.0155 * size;
    for (const FinePlace& place : fine) {
      const double away = (mirrored - place.middle).norm();
      if (away < place.outer) {
        const double t = std::clamp((away - place.inner) / (place.outer - place.inner), 0.0, 1.0);
        length = std::min(length, place.length + t * (0.0155 * size - place.length));
      }
    }
    return length;
  };
  options.project = [&](const Vec3d& p) { return ontoSurface(whole, p); };
  options.threads = threads;
  options.rounds = 5;
  return geometry::remeshed(rough, options);
}

}  // namespace lorica::manikin
