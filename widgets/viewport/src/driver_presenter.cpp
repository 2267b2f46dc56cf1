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

constexpr double axisShare = 0.35;    ///< length of an axis, of the spacing of sites
constexpr float jointAxis = 0.10F;    ///< metres
constexpr double dotsPerInch = 72.0;  ///< of a screen at 100 %, as VTK has it

/// Puts points and the lines or dots of them together.
class Drawing {
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

void addAxes(Drawing& drawing, const jobs::DriverFrame& frame, float length) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    drawing.line(frame.origin, frame.origin + length * frame.axes[axis], axisColours[axis]);
  }
}

}  // namespace

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

vtkPolyData* DriverPresenter::drawn(Driver driver) const {
  switch (driver) {
    case Driver::lattice:
      return layers_[edges].data;
    case Driver::controlPoints:
      return layers_[points].data;
    case Driver::sites:
      return layers_[sites].data;
    case Driver::rays:
      return layers_[rays].data;
    case Driver::frames:
      return layers_[axes].data;
  }
  return nullptr;
}

/// Lines and points are as large to the eye on every screen.
void DriverPresenter::scaleToScreen() {
  const std::array<Style, layerTotal> styles{{{latticeColour, 1.3F, true},
                                              {controlPointColour, 6.0F, false},
                                              {siteColour, 8.0F, false},
                                              {otherSiteColour, 4.0F, false},
                                              {rayColour, 1.3F, true},
                                              {rayColour, 5.0F, false},
                                              {Qt::black, 2.2F, true}}};
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

void DriverPresenter::restyle(const document::StudyDocument& document) {
  std::array<Drawing, layerTotal> drawings;
  const document::Inspection& inspection = document.inspection();
  if (frame_ != nullptr && inspection.showsDrivers() && frame_->driversOf == inspection.organ) {
    const jobs::OrganDrivers& drivers = frame_->drivers[model_];
    const auto shows = [&](Driver driver) { return inspection.drivers.testFlag(driver); };
    const auto axis = static_cast<float>(axisShare * frame_->study->study.siteSpacing);
    if (shows(Driver::lattice)) {
      for (const Vec3f& place : drivers.controlPoints) {
        drawings[edges].point(place);
      }
      for (const auto& [from, to] : drivers.layout->edges) {
        drawings[edges].line(from, to);
      }
    }
    if (shows(Driver::controlPoints)) {
      for (const Vec3f& place : drivers.controlPoints) {
        drawings[points].dot(place);
      }
    }
    if (shows(Driver::sites)) {
      for (const Vec3f& place : drivers.otherSites) {
        drawings[otherSites].dot(place);
      }
    }
    for (const jobs::DriverSite& site : drivers.sites) {
      if (shows(Driver::sites)) {
        drawings[sites].dot(site.frame.origin);
      }
      if (shows(Driver::frames)) {
        addAxes(drawings[axes], site.frame, axis);
      }
      for (const Vec3f& anchor : site.anchors) {
        if (shows(Driver::rays)) {
          drawings[rays].line(drawings[rays].point(site.frame.origin), drawings[rays].point(anchor));
          drawings[anchors].dot(anchor);
        }
      }
    }
    if (drivers.joint && shows(Driver::frames)) {
      addAxes(drawings[axes], *drivers.joint, jointAxis);
    }
  }
  for (std::size_t l = 0; l < layers_.size(); ++l) {
    drawings[l].giveTo(layers_[l].data);
    layers_[l].actor->SetVisibility(layers_[l].data->GetNumberOfPoints() > 0 ? 1 : 0);
  }
  scaleToScreen();
}

}  // namespace lorica::viewport
