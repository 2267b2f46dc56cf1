#include <algorithm>

#include "driver_colours.h"
#include "legend.h"
#include "lorica/models/model_texts.h"
#include "lorica/models/numbers.h"

namespace lorica::viewport {

namespace {

using document::Colouring;
using document::Driver;
using Entry = LegendText::Entry;

QString grouped(std::size_t count) {
  return models::grouped(count);
}

/// What carries the organ in one model, in a line.
QString driverNote(const jobs::OrganDrivers& drivers) {
  if (drivers.layout->byJoint) {
    return drivers.joint ? QObject::tr("rigid, carried by joint %1").arg(QString::fromStdString(drivers.jointName))
                         : QObject::tr("not carried: the body has no joint");
  }
  if (drivers.controlPoints.empty()) {
    return QObject::tr("rigid, carried by one site");
  }
  if (drivers.layout->inSoftBody) {
    return QObject::tr("%1 control points of the soft body; no site: the skin moves it")
        .arg(grouped(drivers.controlPoints.size()));
  }
  const QString points = drivers.pruned == 0
                             ? QObject::tr("%1 control points").arg(grouped(drivers.controlPoints.size()))
                             : QObject::tr("%1 control points (%2 pruned)")
                                   .arg(grouped(drivers.controlPoints.size()), grouped(drivers.pruned));
  return QObject::tr("%1, %2 of %3 sites")
      .arg(points, grouped(drivers.sites.size()), grouped(drivers.sites.size() + drivers.otherSites.size()));
}

void addDrivers(LegendText& legend, const document::Inspection& inspection, const jobs::Frame& frame) {
  using Mark = Entry::Mark;
  legend.title = QString::fromStdString(inspection.organ);
  const auto any = [&frame](const auto& has) { return std::any_of(frame.drivers.begin(), frame.drivers.end(), has); };
  const bool sites = any([](const jobs::OrganDrivers& drivers) { return !drivers.sites.empty(); });
  const bool frames = sites || any([](const jobs::OrganDrivers& drivers) { return drivers.joint.has_value(); });
  const bool cells = any([](const jobs::OrganDrivers& drivers) { return !drivers.controlPoints.empty(); });
  const auto add = [&](Driver driver, Mark mark, const QColor& colour, const QString& text, bool drawn) {
    if (drawn && inspection.drivers.testFlag(driver)) {
      legend.entries.push_back({mark, colour, text});
    }
  };
  add(Driver::lattice, Mark::line, latticeColour, QObject::tr("lattice"), cells);
  add(Driver::controlPoints, Mark::dot, controlPointColour, QObject::tr("control point"), cells);
  add(Driver::sites, Mark::dot, siteColour, QObject::tr("interior site that drives it"), sites);
  add(Driver::sites, Mark::smallDot, otherSiteColour,
      sites ? QObject::tr("other interior site") : QObject::tr("interior site"), true);
  add(Driver::rays, Mark::line, rayColour, QObject::tr("anchor rays of the site in its middle"), sites);
  add(Driver::rays, Mark::line, otherRayColour, QObject::tr("anchor rays of the others"), sites);
  add(Driver::frames, Mark::axes, Qt::black, QObject::tr("reference frames of sites or joint"), frames);
  for (const jobs::OrganDrivers& drivers : frame.drivers) {
    const QString note = driverNote(drivers);
    legend.notes << (frame.drivers.size() == 1 ? note : models::modelLabel(drivers.layout->model) + ": " + note);
  }
}

void addColours(LegendText& legend, Colouring what, const jobs::OrganColours* colours, const ColourScale& scale) {
  if (colours == nullptr) {
    legend.notes << (what == Colouring::strain ? QObject::tr("Strain is computed when the pose rests.")
                                               : QObject::tr("Protrusion is computed when the pose rests."));
    return;
  }
  if (!colours->trouble.isEmpty()) {
    legend.notes << colours->trouble;
    return;
  }
  float least = 0.0F;
  float most = 0.0F;
  for (const std::vector<float>& values : colours->values) {
    for (const float value : values) {
      least = std::min(least, value);
      most = std::max(most, value);
    }
  }
  const bool strain = what == Colouring::strain;
  const double unit = strain ? 100.0 : 1000.0;
  const auto written = [&](double value) { return models::fixed(unit * value, 1); };
  legend.bar = LegendText::Bar{
      strain ? QObject::tr("Edge length against rest, %") : QObject::tr("Depth beyond the skin, mm"), scale, unit,
      strain     ? QObject::tr("all organs: %1 to +%2 %").arg(written(least), written(most))
      : most > 0 ? QObject::tr("all organs: up to %1 mm; grey: inside").arg(written(most))
                 : QObject::tr("no organ reaches beyond the skin")};
}

}  // namespace

LegendText legendFor(const document::StudyDocument& document, const jobs::Frame* frame,
                     const jobs::OrganColours* colours, const ColourScale& scale) {
  LegendText legend;
  const document::Inspection& inspection = document.inspection();
  if (frame != nullptr && inspection.showsDrivers() && frame->driversOf == inspection.organ) {
    addDrivers(legend, inspection, *frame);
  }
  if (frame != nullptr && inspection.colouring != Colouring::own) {
    addColours(legend, inspection.colouring, colours, scale);
  }
  return legend;
}

}  // namespace lorica::viewport
