#include "driver_presenter.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkPoints.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkUnsignedCharArray.h>

#include "driver_colours.h"

namespace lorica::viewport {

namespace {

using document::Driver;
using geometry::Vec3f;

struct Style {
  QColor colour;
  float size;  ///< logical pixels: of points or of lines
  bool isLine;
};

constexpr double axisShare = 0.3;     ///< length of an axis, of the spacing of sites
constexpr double middleShare = 1.0;   ///< likewise, of the site in the middle
constexpr double jointAxis = 0.10;    ///< metres
constexpr double dotsPerInch = 72.0;  ///< of a screen at 100 %, as VTK has it

}  // namespace

/// Puts points and the lines or dots of them together.
class DriverPresenter::Drawing {
 public:
  vtkIdType point(const Vec3f& place) { return points_->InsertNextPoint(place.data()); }
  void dot(const Vec3f& place) {
    const vtkIdType at = point(place);
    dots_->InsertNextCell(1, &at);
  }
  void line(vtkIdType from, vtkIdType to) {
    const std::array<vtkIdType, 2> ends{from, to};
    lines_->InsertNextCell(2, ends.data());
  }
  void line(const Vec3f& from, const Vec3f& to, const QColor& colour) {
    line(point(from), point(to));
    colours_->SetNumberOfComponents(3);
    const std::array<unsigned char, 3> rgb{static_cast<unsigned char>(colour.red()),
                                           static_cast<unsigned char>(colour.green()),
                                           static_cast<unsigned char>(colour.blue())};
    colours_->InsertNextTypedTuple(rgb.data());
  }
  void axes(const jobs::DriverFrame& frame, double length) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      line(frame.origin, frame.origin + static_cast<float>(length) * frame.axes[axis], axisColours[axis]);
    }
  }
  void giveTo(vtkPolyData* data) {
    data->SetPoints(points_);
    data->SetVerts(dots_);
    data->SetLines(lines_);
    data->GetCellData()->SetScalars(colours_->GetNumberOfTuples() > 0 ? colours_.Get() : nullptr);
  }

 private:
  vtkNew<vtkPoints> points_;
  vtkNew<vtkCellArray> dots_;
  vtkNew<vtkCellArray> lines_;
  vtkNew<vtkUnsignedCharArray> colours_;
};

DriverPresenter::DriverPresenter(vtkRenderer* renderer, std::size_t model) : Presenter(renderer), model_(model) {
  for (Drawn& layer : layers_) {
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputData(layer.data);
    mapper->SetScalarModeToUseCellData();
    mapper->SetColorModeToDirectScalars();
    layer.actor->SetMapper(mapper);
    layer.actor->GetProperty()->LightingOff();
    renderer->AddActor(layer.actor);
  }
}

DriverPresenter::~DriverPresenter() {
  for (const Drawn& layer : layers_) {
    renderer()->RemoveActor(layer.actor);
  }
}

vtkIdType DriverPresenter::drawn(Driver driver) const {
  const auto cells = [this](std::initializer_list<Layer> layers) {
    vtkIdType sum = 0;
    for (const Layer layer : layers) {
      sum += layers_[layer].data->GetNumberOfCells();
    }
    return sum;
  };
  switch (driver) {
    case Driver::lattice:
      return cells({edges});
    case Driver::controlPoints:
      return cells({points});
    case Driver::sites:
      return cells({sites, otherSites});
    case Driver::rays:
      return cells({rays, otherRays});
    case Driver::frames:
      return cells({axes, otherAxes});
  }
  return 0;
}

/// Lines and points are as large to the eye on every screen.
void DriverPresenter::scaleToScreen() {
  std::array<Style, layerTotal> styles;
  styles[edges] = {latticeColour, 1.3F, true};
  styles[points] = {controlPointColour, 6.0F, false};
  styles[otherSites] = {otherSiteColour, 4.0F, false};
  styles[sites] = {siteColour, 8.0F, false};
  styles[otherRays] = {otherRayColour, 1.0F, true};
  styles[rays] = {rayColour, 2.4F, true};
  styles[anchors] = {rayColour, 8.0F, false};
  styles[otherAxes] = {Qt::black, 1.6F, true};
  styles[axes] = {Qt::black, 3.0F, true};
  vtkRenderWindow* window = renderer()->GetRenderWindow();
  const double scale = window == nullptr ? 1.0 : window->GetDPI() / dotsPerInch;
  for (std::size_t l = 0; l < styles.size(); ++l) {
    vtkProperty* property = layers_[l].actor->GetProperty();
    const QColor& colour = styles[l].colour;
    property->SetColor(colour.redF(), colour.greenF(), colour.blueF());
    const auto size = static_cast<float>(styles[l].size * scale);
    if (styles[l].isLine) {
      property->SetLineWidth(size);
    } else {
      property->SetPointSize(size);
      property->RenderPointsAsSpheresOn();
    }
  }
}

void DriverPresenter::buildSites(std::array<Drawing, layerTotal>& drawings, document::Drivers shown) const {
  const jobs::OrganDrivers& drivers = frame_->drivers[model_];
  const double spacing = frame_->study->study.siteSpacing;
  if (shown.testFlag(Driver::sites)) {
    for (const Vec3f& place : drivers.otherSites) {
      drawings[otherSites].dot(place);
    }
  }
  for (std::size_t s = 0; s < drivers.sites.size(); ++s) {
    const jobs::DriverSite& site = drivers.sites[s];
    const bool middle = s == drivers.layout->middle;
    if (shown.testFlag(Driver::sites)) {
      drawings[sites].dot(site.frame.origin);
    }
    if (shown.testFlag(Driver::frames)) {
      drawings[middle ? axes : otherAxes].axes(site.frame, (middle ? middleShare : axisShare) * spacing);
    }
    for (const Vec3f& anchor : site.anchors) {
      if (shown.testFlag(Driver::rays)) {
        Drawing& drawing = drawings[middle ? rays : otherRays];
        drawing.line(drawing.point(site.frame.origin), drawing.point(anchor));
        if (middle) {
          drawings[anchors].dot(anchor);
        }
      }
    }
  }
  if (drivers.joint && shown.testFlag(Driver::frames)) {
    drawings[axes].axes(*drivers.joint, jointAxis);
  }
}

void DriverPresenter::restyle(const document::StudyDocument& document) {
  std::array<Drawing, layerTotal> drawings;
  const document::Inspection& inspection = document.inspection();
  if (frame_ != nullptr && inspection.showsDrivers() && frame_->driversOf == inspection.organ) {
    const jobs::OrganDrivers& drivers = frame_->drivers[model_];
    if (inspection.drivers.testFlag(Driver::lattice)) {
      for (const Vec3f& place : drivers.controlPoints) {
        drawings[edges].point(place);
      }
      for (const auto& [from, to] : drivers.layout->edges) {
        drawings[edges].line(from, to);
      }
    }
    if (inspection.drivers.testFlag(Driver::controlPoints)) {
      for (const Vec3f& place : drivers.controlPoints) {
        drawings[points].dot(place);
      }
    }
    buildSites(drawings, inspection.drivers);
  }
  for (std::size_t l = 0; l < layers_.size(); ++l) {
    drawings[l].giveTo(layers_[l].data);
    layers_[l].actor->SetVisibility(layers_[l].data->GetNumberOfPoints() > 0 ? 1 : 0);
  }
  scaleToScreen();
}

}  // namespace lorica::viewport
