#include "lorica/jobs/organ_colours.h"

#include <algorithm>

#include "lorica/parenting/skin_side.h"

namespace lorica::jobs {

namespace {

using document::Colouring;
using geometry::Vec3d;
using geometry::Vec3f;

void compute(OrganColours& colours, const base::Progress& progress) {
  const Frame& frame = *colours.frame;
  const auto& organs = frame.study->organs;
  const std::size_t slots = organs.size() * frame.scene->models().size();
  std::vector<std::vector<float>> values(slots);
  const auto posed = [&](std::size_t slot) -> const geometry::Positions& {
    return frame.scene->organ(slot % organs.size(), slot / organs.size());
  };
  if (colours.what == Colouring::strain) {
    base::parallelFor(slots, 1, {}, [&](std::size_t begin, std::size_t end) {
      for (std::size_t slot = begin; slot < end; ++slot) {
        progress.check();
        values[slot] = edgeStrain(organs[slot % organs.size()]->rig.rest, posed(slot));
      }
    });
  } else {
    const std::shared_ptr<const raycast::MeshTopology> topology = frame.study->body->skinTopology();
    if (topology->hasOpenEdges) {
      colours.trouble = QObject::tr("The skin does not close: nothing can be told to lie beyond it.");
      return;
    }
    raycast::Scene skin(raycast::SceneUse::manyRays);
    skin.add(frame.scene->body().skin, topology);
    skin.build();
    for (std::size_t slot = 0; slot < slots; ++slot) {
      const auto share = [slots](std::size_t done) { return static_cast<double>(done) / static_cast<double>(slots); };
      values[slot] = protrusion(posed(slot), skin, {}, progress.part(share(slot), share(slot + 1)));
    }
  }
  colours.values = std::move(values);
}

}  // namespace

std::vector<float> edgeStrain(const geometry::TriangleMesh& rest, std::span<const Vec3f> posed) {
  std::vector<double> before(posed.size(), 0.0);
  std::vector<double> now(posed.size(), 0.0);
  for (const geometry::Triangle& triangle : rest.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = triangle[k];
      const std::uint32_t b = triangle[(k + 1) % 3];
      const double restLength = (rest.positions[a] - rest.positions[b]).norm();
      const double length = (posed[a] - posed[b]).norm();
      for (const std::uint32_t v : {a, b}) {
        before[v] += restLength;
        now[v] += length;
      }
    }
  }
  std::vector<float> strain(posed.size(), 0.0F);
  for (std::size_t v = 0; v < strain.size(); ++v) {
    strain[v] = before[v] > 0.0 ? static_cast<float>(now[v] / before[v] - 1.0) : 0.0F;
  }
  return strain;
}

std::vector<float> protrusion(std::span<const Vec3f> points, const raycast::Scene& skin, base::Threads threads,
                              const base::Progress& progress) {
  std::vector<float> depth(points.size(), 0.0F);
  base::parallelFor(points.size(), 256, threads, [&](std::size_t begin, std::size_t end) {
    progress.check();
    raycast::Caster caster(skin);
    for (std::size_t i = begin; i < end; ++i) {
      const Vec3d point = points[i].cast<double>();
      // A ray from a point of the skin decides nothing, and would be traced again against every triangle.
      if (raycast::closestPoint(skin, point, parenting::onSkin) ||
          raycast::windingNumber(caster, raycast::MeshIndex{0}, point) >= 1) {
        continue;
      }
      if (const auto nearest = raycast::closestPoint(skin, point)) {
        depth[i] = static_cast<float>(nearest->distance);
      }
    }
  });
  progress.report(1.0);
  return depth;
}

OrganColourer::OrganColourer(QObject* parent) : QObject(parent) {
  qRegisterMetaType<std::shared_ptr<const lorica::jobs::OrganColours>>();
}

OrganColourer::~OrganColourer() = default;

void OrganColourer::abandon() {
  jobs::abandon(job_, this);
}

void OrganColourer::request(std::shared_ptr<const Frame> frame, Colouring what) {
  abandon();
  auto colours = std::make_shared<OrganColours>();
  colours->frame = std::move(frame);
  colours->what = what;
  job_ = std::make_unique<Job>(QString(), [colours](const base::Progress& progress) { compute(*colours, progress); });
  connect(job_.get(), &Job::finished, this, [this, colours] { Q_EMIT ready(colours); });
  connect(job_.get(), &Job::failed, this, [this, colours](const QString& text) {
    colours->values.clear();
    colours->trouble = text;
    Q_EMIT ready(colours);
  });
  connect(job_.get(), &Job::ended, this, [this, job = job_.get()] {
    if (job_.get() == job) {
      job_.release()->deleteLater();
    }
  });
  job_->start();
}

}  // namespace lorica::jobs
