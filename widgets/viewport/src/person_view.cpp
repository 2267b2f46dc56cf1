#include "lorica/viewport/person_view.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkLightKit.h>
#include <vtkPoints.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkRenderer.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>

#include <QEvent>
#include <QSurfaceFormat>
#include <QTimer>
#include <QVBoxLayout>
#include <algorithm>
#include <array>
#include <vector>

#include "canvas.h"
#include "lorica/document/appearance.h"
#include "lorica/geometry/measures.h"
#include "lorica/study/study.h"
#include "mesh_actor.h"

namespace lorica::viewport {

namespace {

using geometry::Vec3d;

constexpr double lowest = -0.09;    ///< m, what the picture shows at least
constexpr double highest = 2.16;    ///< m, above the tallest person there can be
constexpr double frontWidth = 1.5;  ///< m, of a large person's hands
constexpr double sideWidth = 0.9;
constexpr double behind = 3.0;  ///< m, of the scale
constexpr std::array heights{0.0, 0.5, 1.0, 1.5, 2.0};

/// One of the two pictures.
struct Side {
  Vec3d from;    ///< where the viewer stands
  Vec3d across;  ///< what is to the right in the picture
  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkCamera> camera;
  vtkNew<vtkLightKit> light;
  vtkNew<vtkActor> scale;
  std::unique_ptr<MeshActor> body;
};

void addScale(Side& side) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> lines;
  for (const double height : heights) {
    const Vec3d middle = Vec3d(0.0, height, 0.0) - behind * side.from;
    const Vec3d left = middle - 5.0 * side.across;
    const Vec3d right = middle + 5.0 * side.across;
    const std::array<vtkIdType, 2> ends{points->InsertNextPoint(left.data()), points->InsertNextPoint(right.data())};
    lines->InsertNextCell(2, ends.data());
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetLines(lines);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  side.scale->SetMapper(mapper);
  side.scale->GetProperty()->SetColor(0.74, 0.76, 0.79);
  side.scale->GetProperty()->LightingOff();
  side.renderer->AddActor(side.scale);
}

}  // namespace

struct PersonView::Impl {
  Canvas* widget = nullptr;
  vtkNew<vtkGenericOpenGLRenderWindow> window;
  std::array<Side, 2> sides{Side{Vec3d::UnitZ(), Vec3d::UnitX(), {}, {}, {}, {}, {}},
                            Side{Vec3d::UnitX(), -Vec3d::UnitZ(), {}, {}, {}, {}, {}}};
  std::array<vtkNew<vtkTextActor>, heights.size()> labels;
  std::shared_ptr<const geometry::TriangleMesh> skin;
  std::vector<geometry::Vec3f> normals;
  bool dimmed = false;
  QTimer drawing;
};

PersonView::PersonView(QWidget* parent) : QWidget(parent), impl_(std::make_unique<Impl>()) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  impl_->widget = new Canvas(this);
  QSurfaceFormat format = QVTKOpenGLNativeWidget::defaultFormat();
  format.setSamples(0);
  impl_->widget->setFormat(format);
  impl_->window->SetMultiSamples(0);
  impl_->widget->setRenderWindow(impl_->window);
  // Nothing to turn here; the wheel and the keys are the dialog's.
  impl_->widget->setAttribute(Qt::WA_TransparentForMouseEvents);
  impl_->widget->setFocusPolicy(Qt::NoFocus);
  layout->addWidget(impl_->widget);
  for (Side& side : impl_->sides) {
    side.renderer->SetBackground(0.90, 0.915, 0.93);
    side.renderer->SetBackground2(0.97, 0.975, 0.98);
    side.renderer->GradientBackgroundOn();
    side.renderer->UseFXAAOn();
    side.renderer->AutomaticLightCreationOff();
    side.light->SetKeyLightIntensity(0.85);
    side.light->AddLightsToRenderer(side.renderer);
    side.camera->ParallelProjectionOn();
    side.renderer->SetActiveCamera(side.camera);
    impl_->window->AddRenderer(side.renderer);
    addScale(side);
  }
  for (std::size_t i = 0; i < heights.size(); ++i) {
    vtkTextActor* label = impl_->labels[i];
    label->SetInput(tr("%1 m").arg(heights[i], 0, 'f', 1).toUtf8().constData());
    label->GetTextProperty()->SetFontFamilyToArial();
    label->GetTextProperty()->SetColor(0.42, 0.44, 0.48);
    label->GetTextProperty()->SetVerticalJustificationToBottom();
    label->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
    impl_->sides.front().renderer->AddViewProp(label);
  }
  impl_->window->GetInteractor()->EnableRenderOff();
  impl_->drawing.setSingleShot(true);
  impl_->drawing.setInterval(0);
  connect(&impl_->drawing, &QTimer::timeout, this, [this] { impl_->window->Render(); });
  arrange();
}

PersonView::~PersonView() {
  impl_->drawing.stop();
  for (Side& side : impl_->sides) {
    impl_->window->RemoveRenderer(side.renderer);
  }
}

const std::shared_ptr<const geometry::TriangleMesh>& PersonView::skin() const {
  return impl_->skin;
}

bool PersonView::isDimmed() const {
  return impl_->dimmed;
}

void PersonView::showSkin(std::shared_ptr<const geometry::TriangleMesh> skin) {
  std::vector<geometry::Vec3f> normals;
  if (skin != nullptr) {
    normals = geometry::vertexNormals(skin->positions, skin->triangles);
  }
  for (Side& side : impl_->sides) {
    if (side.body != nullptr) {
      side.renderer->RemoveActor(side.body->actor());
      side.body.reset();
    }
  }
  // Nothing draws the old ones any more.
  impl_->skin = std::move(skin);
  impl_->normals = std::move(normals);
  if (impl_->skin != nullptr) {
    for (Side& side : impl_->sides) {
      side.body = std::make_unique<MeshActor>(impl_->skin->triangles);
      side.body->show(impl_->skin->positions, impl_->normals);
      side.renderer->AddActor(side.body->actor());
    }
  }
  impl_->dimmed = false;
  restyle();
}

void PersonView::setDimmed(bool dimmed) {
  if (dimmed != impl_->dimmed) {
    impl_->dimmed = dimmed;
    restyle();
  }
}

void PersonView::restyle() {
  const QColor colour = document::defaultAppearance(study::Study(), "body").colour;
  constexpr double paleness = 0.55;
  const auto paled = [this](double channel) { return impl_->dimmed ? channel + paleness * (0.93 - channel) : channel; };
  for (const Side& side : impl_->sides) {
    if (side.body != nullptr) {
      vtkProperty* property = side.body->actor()->GetProperty();
      property->SetColor(paled(colour.redF()), paled(colour.greenF()), paled(colour.blueF()));
      property->SetAmbient(impl_->dimmed ? 0.6 : 0.15);
      property->SetDiffuse(impl_->dimmed ? 0.4 : 0.85);
    }
  }
  impl_->drawing.start();
}

void PersonView::arrange() {
  // Both pictures have the same metres to a pixel.
  const double width = std::max(1, this->width());
  const double height = std::max(1, this->height());
  const double shown = std::max(highest - lowest, height / width * (frontWidth + sideWidth));
  const double middle = 0.5 * (lowest + highest);
  const double split = frontWidth / (frontWidth + sideWidth);
  impl_->sides[0].renderer->SetViewport(0.0, 0.0, split, 1.0);
  impl_->sides[1].renderer->SetViewport(split, 0.0, 1.0, 1.0);
  for (Side& side : impl_->sides) {
    const Vec3d focus(0.0, middle, 0.0);
    const Vec3d position = focus + 5.0 * side.from;
    side.camera->SetFocalPoint(focus.data());
    side.camera->SetPosition(position.data());
    side.camera->SetViewUp(0.0, 1.0, 0.0);
    side.camera->SetParallelScale(0.5 * shown);
    side.camera->SetClippingRange(0.1, 20.0);
  }
  for (std::size_t i = 0; i < heights.size(); ++i) {
    vtkTextActor* label = impl_->labels[i];
    label->GetTextProperty()->SetFontSize(
        std::max(8, static_cast<int>(0.62 * fontMetrics().height() * devicePixelRatioF())));
    label->SetPosition(0.015, 0.5 + (heights[i] - middle) / shown + 0.003);
  }
  impl_->drawing.start();
}

void PersonView::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  arrange();
}

void PersonView::changeEvent(QEvent* event) {
  QWidget::changeEvent(event);
  if (event->type() == QEvent::FontChange) {
    arrange();
  }
}

QImage PersonView::picture() {
  impl_->window->Render();
  return impl_->widget->grabFramebuffer();
}

}  // namespace lorica::viewport
