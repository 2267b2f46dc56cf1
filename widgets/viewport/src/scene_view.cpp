#include "lorica/viewport/scene_view.h"

#include <vtkAxesActor.h>
#include <vtkCallbackCommand.h>
#include <vtkCamera.h>
#include <vtkCaptionActor2D.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkMatrix4x4.h>
#include <vtkOrientationMarkerWidget.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>

#include <QKeyEvent>
#include <QLabel>
#include <QMouseEvent>
#include <QPainter>
#include <QSurfaceFormat>
#include <QTimer>
#include <QVBoxLayout>
#include <chrono>
#include <cmath>
#include <numbers>

#include "camera_style.h"
#include "canvas.h"
#include "coarse_meshes.h"
#include "legend.h"
#include "lorica/geometry/measures.h"
#include "lorica/models/model_texts.h"
#include "lorica/raycast/caster.h"
#include "organ_colouring.h"
#include "pane.h"

namespace lorica::viewport {

namespace {

using geometry::Vec3d;

constexpr int restMs = 200;    ///< without motion until what is shown is drawn in full
constexpr int frameMs = 2000;  ///< a frame that takes longer to compute is no longer waited for

ScreenView screenViewOf(vtkRenderer* renderer) {
  const vtkMatrix4x4* matrix =
      renderer->GetActiveCamera()->GetCompositeProjectionTransformMatrix(renderer->GetTiledAspectRatio(), -1.0, 1.0);
  ScreenView view;
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) {
      view.toClip(row, column) = matrix->GetElement(row, column);
    }
  }
  const int* size = renderer->GetSize();
  view.size = Eigen::Vector2d(size[0], size[1]);
  return view;
}

/// The axes in the corner, by what they mean for the person.
void dressAxes(vtkAxesActor* axes) {
  axes->SetXAxisLabelText("left");
  axes->SetYAxisLabelText("up");
  axes->SetZAxisLabelText("front");
  // The axis that most often points at the viewer has its name farther out, clear of the others.
  axes->SetNormalizedLabelPosition(1.3, 1.25, 2.7);
  axes->SetShaftTypeToCylinder();
  axes->SetCylinderRadius(0.03);
  axes->SetConeRadius(0.25);
  for (vtkCaptionActor2D* caption :
       {axes->GetXAxisCaptionActor2D(), axes->GetYAxisCaptionActor2D(), axes->GetZAxisCaptionActor2D()}) {
    caption->GetTextActor()->SetTextScaleModeToNone();
    vtkTextProperty* text = caption->GetCaptionTextProperty();
    text->SetColor(0.25, 0.27, 0.30);
    text->SetFontSize(11);
    text->BoldOff();
    text->ItalicOff();
    text->ShadowOff();
  }
}

}  // namespace

struct SceneView::Impl {
  explicit Impl(const document::StudyDocument& document) : colouring(document) {}

  Canvas* widget = nullptr;
  QLabel* hint = nullptr;
  Legend* legend = nullptr;
  OrganColouring colouring;
  vtkNew<vtkGenericOpenGLRenderWindow> window;
  vtkNew<vtkCamera> camera;
  vtkNew<CameraStyle> style;
  vtkNew<vtkAxesActor> axes;
  vtkNew<vtkOrientationMarkerWidget> marker;
  vtkNew<vtkRenderer> empty;  ///< behind everything, so that an empty view is not black
  std::vector<std::unique_ptr<Pane>> panes;
  std::shared_ptr<const jobs::Frame> frame;
  std::string shotFilter;
  bool compass = true;
  std::shared_ptr<const jobs::ShotInspection> inspection;
  std::shared_ptr<const jobs::SkinPatch> patch;
  std::optional<Vec3d> sourcePick;
  QPointF pressed;
  CoarseMeshes coarseMeshes;
  bool coarse = false;  ///< how the panes draw now
  double patience = 50.0;
  double fullMs = 0.0;  ///< the last drawing in full
  QTimer drawing;       ///< runs out when nothing else waits to be done
  QTimer rest;          ///< runs out when nothing has moved for a while

  const CoarseMeshes* detail() const { return coarse ? &coarseMeshes : nullptr; }
};

SceneView::SceneView(document::StudyDocument& document, QWidget* parent)
    : QWidget(parent), document_(document), impl_(std::make_unique<Impl>(document)) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  impl_->widget = new Canvas(this);
  // Its own contexts, whatever the program's default is; without multisampling, which depth peeling does not go with.
  QSurfaceFormat format = QVTKOpenGLNativeWidget::defaultFormat();
  format.setSamples(0);
  impl_->widget->setFormat(format);
  impl_->widget->setRenderWindow(impl_->window);
  impl_->widget->setFocusPolicy(Qt::StrongFocus);
  impl_->widget->installEventFilter(this);
  layout->addWidget(impl_->widget);
  impl_->hint = new QLabel(impl_->widget);
  impl_->hint->setAutoFillBackground(true);
  impl_->hint->setMargin(6);
  impl_->hint->hide();
  impl_->legend = new Legend(impl_->widget);
  impl_->window->SetMultiSamples(0);
  impl_->window->SetAlphaBitPlanes(1);
  impl_->empty->SetBackground(0.86, 0.88, 0.90);
  impl_->empty->SetBackground2(0.97, 0.975, 0.98);
  impl_->empty->GradientBackgroundOn();
  impl_->window->AddRenderer(impl_->empty);
  impl_->window->GetInteractor()->SetInteractorStyle(impl_->style);
  impl_->camera->SetViewAngle(25.0);
  impl_->camera->SetViewUp(0.0, 1.0, 0.0);
  impl_->camera->SetFocalPoint(0.0, 0.9, 0.0);
  impl_->camera->SetPosition(1.2, 1.1, 4.5);
  dressAxes(impl_->axes);
  impl_->marker->SetOrientationMarker(impl_->axes);

  impl_->drawing.setSingleShot(true);
  impl_->drawing.setInterval(0);
  connect(&impl_->drawing, &QTimer::timeout, this, &SceneView::draw);
  impl_->rest.setSingleShot(true);
  connect(&impl_->rest, &QTimer::timeout, this, &SceneView::endMotion);
  connect(&impl_->coarseMeshes, &CoarseMeshes::made, this, [this] {
    for (const auto& pane : impl_->panes) {
      pane->drawCoarsely(impl_->detail());
    }
  });
  vtkRenderWindowInteractor* interactor = impl_->window->GetInteractor();
  interactor->EnableRenderOff();
  vtkNew<vtkCallbackCommand> wanted;
  wanted->SetClientData(this);
  wanted->SetCallback([](vtkObject* caller, unsigned long, void* client, void*) {
    auto* view = static_cast<SceneView*>(client);
    if (static_cast<vtkRenderWindowInteractor*>(caller)->GetEnableRender() != 0) {
      return;  // drawn already
    }
    if (view->impl_->style->GetState() != VTKIS_NONE) {
      view->beginMotion(restMs);
    }
    view->scheduleDrawing();
  });
  interactor->AddObserver(vtkCommand::RenderEvent, wanted);

  using document::StudyDocument;
  connect(&document_, &StudyDocument::studyChanged, this, [this](document::Changes what) {
    if (what.testFlag(document::Change::display)) {
      // A slider may be dragged: in motion as the camera is.
      beginMotion(restMs);
    }
    if (what.testFlag(document::Change::display) || what.testFlag(document::Change::sources)) {
      restyle();
    }
  });
  connect(&document_, &StudyDocument::selectionChanged, this, &SceneView::restyle);
  connect(&document_, &StudyDocument::inspectionChanged, this, [this] {
    followColours();
    restyle();
  });
  connect(&impl_->colouring, &OrganColouring::found, this, [this] {
    showColours();
    restyle();
  });
}

SceneView::~SceneView() {
  impl_->drawing.stop();
  impl_->window->GetInteractor()->RemoveObservers(vtkCommand::RenderEvent);
  impl_->marker->SetInteractor(nullptr);
  for (const auto& pane : impl_->panes) {
    impl_->window->RemoveRenderer(pane->renderer());
  }
  impl_->panes.clear();
}

const std::shared_ptr<const jobs::Frame>& SceneView::frame() const {
  return impl_->frame;
}
bool SceneView::isPicking() const {
  return impl_->sourcePick.has_value();
}
void SceneView::setPatience(double ms) {
  impl_->patience = ms;
}

void SceneView::arrangePanes(std::size_t count) {
  if (impl_->panes.size() == count) {
    return;
  }
  if (impl_->marker->GetInteractor() != nullptr) {
    impl_->marker->EnabledOff();
  }
  for (const auto& pane : impl_->panes) {
    impl_->window->RemoveRenderer(pane->renderer());
  }
  impl_->panes.clear();
  for (std::size_t p = 0; p < count; ++p) {
    auto pane = std::make_unique<Pane>(p, impl_->camera);
    const double share = 1.0 / static_cast<double>(count);
    const double left = static_cast<double>(p) * share;
    // A thin line of background between the panes.
    pane->renderer()->SetViewport(left + (p > 0 ? 0.001 : 0.0), 0.0, left + share, 1.0);
    pane->shots().setFilter(impl_->shotFilter);
    pane->sources().setCompass(impl_->compass);
    pane->inspected().inspect(impl_->inspection);
    pane->patch().mark(impl_->patch);
    impl_->window->AddRenderer(pane->renderer());
    impl_->panes.push_back(std::move(pane));
  }
  if (count > 0) {
    impl_->marker->SetInteractor(impl_->window->GetInteractor());
    impl_->marker->SetCurrentRenderer(impl_->panes.front()->renderer());
    impl_->marker->SetViewport(0.0, 0.0, 0.16, 0.24);
    impl_->marker->EnabledOn();
    impl_->marker->InteractiveOff();
  }
}

void SceneView::showFrame(std::shared_ptr<const jobs::Frame> frame) {
  const bool other = frame != nullptr && (impl_->frame == nullptr || impl_->frame->study->body != frame->study->body);
  arrangePanes(frame == nullptr ? 0 : frame->scene->models().size());
  impl_->coarseMeshes.setStudy(frame == nullptr ? nullptr : frame->study);
  for (std::size_t p = 0; p < impl_->panes.size(); ++p) {
    impl_->panes[p]->showFrame(frame, models::modelLabel(frame->scene->models()[p]));
  }
  for (const auto& pane : impl_->panes) {
    pane->drawCoarsely(impl_->detail());
  }
  // The old frame goes only now that nobody draws it any more.
  impl_->frame = std::move(frame);
  followColours();
  beginMotion(restMs);
  restyle();
  if (other) {
    fit();
  }
}

void SceneView::restyle() {
  for (const auto& pane : impl_->panes) {
    pane->restyle(document_);
  }
  const OrganColouring& colouring = impl_->colouring;
  impl_->legend->show(legendFor(document_, impl_->frame.get(), colouring.colours(), colouring.scale()));
  placeLegend();
  scheduleDrawing();
}

void SceneView::followColours() {
  impl_->colouring.follow(impl_->frame);
  showColours();
}

void SceneView::showColours() {
  for (const auto& pane : impl_->panes) {
    pane->showColours(impl_->colouring.colours(), impl_->colouring.scale());
  }
}

void SceneView::placeLegend() {
  constexpr int gap = 12;
  const QSize room = impl_->widget->size();
  const QSize size = impl_->legend->size();
  impl_->legend->move(room.width() - size.width() - gap, room.height() - size.height() - gap);
}

void SceneView::scheduleDrawing() {
  impl_->drawing.start();
}

void SceneView::draw() {
  for (const auto& pane : impl_->panes) {
    pane->renderer()->ResetCameraClippingRange();
    pane->sources().placeLabels();
  }
  const auto start = std::chrono::steady_clock::now();
  impl_->window->Render();
  impl_->window->WaitForCompletion();
  const double ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  if (!impl_->coarse) {
    impl_->fullMs = ms;
    if (ms > impl_->patience) {
      impl_->coarseMeshes.make();
    }
  }
  if (impl_->rest.isActive()) {
    // Slow drawings must not look like rest.
    impl_->rest.start();
  }
  Q_EMIT drawn(ms, impl_->coarse);
}

void SceneView::expectFrame() {
  beginMotion(frameMs);
}

void SceneView::beginMotion(int rest) {
  impl_->rest.start(rest);
  if (!impl_->coarse && impl_->fullMs > impl_->patience) {
    impl_->coarse = true;
    for (const auto& pane : impl_->panes) {
      pane->drawCoarsely(impl_->detail());
    }
  }
}

void SceneView::endMotion() {
  if (impl_->style->GetState() != VTKIS_NONE) {
    impl_->rest.start();  // a button is held
    return;
  }
  if (impl_->coarse) {
    impl_->coarse = false;
    for (const auto& pane : impl_->panes) {
      pane->drawCoarsely(nullptr);
    }
    scheduleDrawing();
  }
}

void SceneView::setShotFilter(const std::string& met) {
  impl_->shotFilter = met;
  for (const auto& pane : impl_->panes) {
    pane->shots().setFilter(met);
  }
  restyle();
}

void SceneView::showCompass(bool on) {
  impl_->compass = on;
  for (const auto& pane : impl_->panes) {
    pane->sources().setCompass(on);
  }
  restyle();
}

void SceneView::markShot(std::shared_ptr<const jobs::ShotInspection> inspection) {
  impl_->inspection = std::move(inspection);
  for (const auto& pane : impl_->panes) {
    pane->inspected().inspect(impl_->inspection);
  }
  restyle();
}

void SceneView::markPatch(std::shared_ptr<const jobs::SkinPatch> patch) {
  impl_->patch = std::move(patch);
  for (const auto& pane : impl_->panes) {
    pane->patch().mark(impl_->patch);
  }
  restyle();
}

void SceneView::lookAlong(const Vec3d& towards, const Vec3d& place) {
  vtkCamera* camera = impl_->camera;
  const Vec3d from = towards.normalized();
  const Vec3d position = place + camera->GetDistance() * from;
  const bool steep = std::abs(from.y()) > 0.95;
  const Vec3d up = steep ? Vec3d(0.0, 0.0, from.y() > 0.0 ? -1.0 : 1.0) : Vec3d::UnitY();
  camera->SetFocalPoint(place.data());
  camera->SetPosition(position.data());
  camera->SetViewUp(up.data());
  scheduleDrawing();
}

void SceneView::lookFrom(StandardView view) {
  vtkCamera* camera = impl_->camera;
  const double distance = camera->GetDistance();
  const Vec3d middle(camera->GetFocalPoint());
  Vec3d from = Vec3d::UnitZ();
  Vec3d up = Vec3d::UnitY();
  switch (view) {
    case StandardView::front:
      break;
    case StandardView::back:
      from = -Vec3d::UnitZ();
      break;
    case StandardView::left:
      from = Vec3d::UnitX();
      break;
    case StandardView::right:
      from = -Vec3d::UnitX();
      break;
    case StandardView::top:
      from = Vec3d::UnitY();
      up = -Vec3d::UnitZ();
      break;
    case StandardView::bottom:
      from = -Vec3d::UnitY();
      up = Vec3d::UnitZ();
      break;
  }
  const Vec3d position = middle + distance * from;
  camera->SetPosition(position.data());
  camera->SetViewUp(up.data());
  scheduleDrawing();
}

void SceneView::fit() {
  if (impl_->frame == nullptr) {
    return;
  }
  geometry::Box3d box = geometry::bounds(impl_->frame->scene->body().skin);
  for (std::size_t p = 0; p < impl_->frame->study->pieces.size(); ++p) {
    box.extend(geometry::bounds(impl_->frame->scene->piece(p)));
  }
  fitTo(box);
}

void SceneView::fitSelection() {
  const auto& selection = document_.selection();
  if (impl_->frame == nullptr || !selection) {
    fit();
    return;
  }
  geometry::Box3d box;
  const analysis::LoadedStudy& study = *impl_->frame->study;
  const analysis::PosedScene& scene = *impl_->frame->scene;
  for (std::size_t o = 0; o < study.organs.size(); ++o) {
    for (std::size_t m = 0; m < scene.models().size(); ++m) {
      if (selection->kind == document::ItemKind::organ && study.organs[o]->name == selection->name) {
        box.extend(geometry::bounds(scene.organ(o, m)));
      }
    }
  }
  for (std::size_t p = 0; p < study.pieces.size(); ++p) {
    if (selection->kind == document::ItemKind::piece && study.pieces[p]->name == selection->name) {
      box.extend(geometry::bounds(scene.piece(p)));
    }
  }
  for (const study::Source& source : document_.study().sources) {
    if (selection->kind == document::ItemKind::source && source.name == selection->name) {
      const Vec3d aim = aimIn(*impl_->frame, source);
      const Vec3d reach = Vec3d::Constant(radiusIn(*impl_->frame, aim));
      box = geometry::Box3d(aim - reach, aim + reach);
    }
  }
  if (box.isEmpty()) {
    fit();
    return;
  }
  const Vec3d around = 0.35 * box.sizes();
  fitTo(geometry::Box3d(box.min() - around, box.max() + around));
}

void SceneView::fitTo(const geometry::Box3d& box) {
  vtkCamera* camera = impl_->camera;
  const Vec3d middle = box.center();
  const Vec3d direction(camera->GetDirectionOfProjection());
  const int* size = impl_->window->GetSize();
  const double panes = static_cast<double>(std::max<std::size_t>(1, impl_->panes.size()));
  const double aspect = size[1] > 0 ? size[0] / panes / size[1] : 1.0;
  const double half = std::tan(camera->GetViewAngle() * std::numbers::pi / 360.0);
  const double height = 0.5 * box.sizes().y();
  const double width = 0.5 * std::hypot(box.sizes().x(), box.sizes().z());
  const double distance = 1.12 * std::max(height / half, width / (half * std::max(0.1, aspect))) + 0.5 * width;
  const Vec3d position = middle - distance * direction;
  camera->SetFocalPoint(middle.data());
  camera->SetPosition(position.data());
  scheduleDrawing();
}

void SceneView::pickSource(const std::optional<Vec3d>& current) {
  const bool was = isPicking();
  impl_->sourcePick = current;
  impl_->widget->setCursor(isPicking() ? Qt::CrossCursor : Qt::ArrowCursor);
  impl_->hint->setVisible(isPicking());
  if (isPicking()) {
    impl_->hint->setText(tr("Click the body from where the shots shall come, or the floor below that place. Esc: no."));
    impl_->hint->adjustSize();
    impl_->hint->move(12, 12);
  } else if (was) {
    Q_EMIT pickCancelled();
  }
}

QImage SceneView::picture() {
  endMotion();
  impl_->drawing.stop();
  draw();
  QImage image = impl_->widget->grabFramebuffer();
  if (impl_->legend->isVisibleTo(impl_->widget)) {
    image.setDevicePixelRatio(impl_->widget->devicePixelRatioF());
    QPainter painter(&image);
    impl_->legend->render(&painter, impl_->legend->pos(), {}, DrawChildren);
    painter.end();
    image.setDevicePixelRatio(1.0);
  }
  return image;
}

bool SceneView::eventFilter(QObject* watched, QEvent* event) {
  if (watched != impl_->widget) {
    return QWidget::eventFilter(watched, event);
  }
  if (event->type() == QEvent::Resize) {
    beginMotion(restMs);
    placeLegend();
  } else if (event->type() == QEvent::MouseButtonPress) {
    impl_->pressed = static_cast<QMouseEvent*>(event)->position();
  } else if (event->type() == QEvent::MouseButtonRelease) {
    const auto* mouse = static_cast<QMouseEvent*>(event);
    const bool still = (mouse->position() - impl_->pressed).manhattanLength() < 4.0;
    if (mouse->button() == Qt::LeftButton && still) {
      click(mouse->position(), mouse->modifiers().testFlag(Qt::ShiftModifier));
    }
  } else if (event->type() == QEvent::KeyPress && isPicking() &&
             static_cast<QKeyEvent*>(event)->key() == Qt::Key_Escape) {
    pickSource(std::nullopt);
    return true;
  }
  return QWidget::eventFilter(watched, event);
}

QPointF SceneView::placeOf(const Vec3d& place) const {
  vtkRenderer* renderer = impl_->panes.front()->renderer();
  const Eigen::Vector2d pixel = screenViewOf(renderer).pixel(place);
  const int* origin = renderer->GetOrigin();
  const double scale = impl_->widget->devicePixelRatioF();
  const QPoint corner = impl_->widget->mapTo(this, QPoint());
  return {corner.x() + (pixel.x() + origin[0]) / scale,
          corner.y() + (impl_->window->GetSize()[1] - 1 - pixel.y() - origin[1]) / scale};
}

bool SceneView::clickShot(std::size_t pane, double x, double y) {
  if (!impl_->frame->shotsOfRun) {
    return false;
  }
  constexpr double tolerance = 3.0;  // logical pixels
  vtkRenderer* renderer = impl_->panes[pane]->renderer();
  const std::vector<DrawnShot>& drawn = impl_->panes[pane]->shots().drawnShots();
  const ScreenView view = screenViewOf(renderer);
  const int* origin = renderer->GetOrigin();
  const auto shot = shotAt(drawn, view, {x - origin[0], y - origin[1]}, tolerance * impl_->widget->devicePixelRatioF());
  if (shot) {
    // What is drawn are shots of the first trial.
    Q_EMIT shotClicked(QStringLiteral("%1:1:%2").arg(QString::fromStdString(impl_->frame->shotsOf),
                                                     QString::number(drawn[*shot].number)));
  }
  return shot.has_value();
}

void SceneView::click(const QPointF& place, bool throughShots) {
  if (impl_->frame == nullptr) {
    return;
  }
  const double scale = impl_->widget->devicePixelRatioF();
  const int* size = impl_->window->GetSize();
  const double x = place.x() * scale;
  const double y = size[1] - 1 - place.y() * scale;
  const auto pane = std::min(impl_->panes.size() - 1,
                             static_cast<std::size_t>(x * static_cast<double>(impl_->panes.size()) / size[0]));
  if (!impl_->sourcePick && !throughShots && clickShot(pane, x, y)) {
    return;
  }
  vtkRenderer* renderer = impl_->panes[pane]->renderer();
  const auto unproject = [&](double depth) {
    renderer->SetDisplayPoint(x, y, depth);
    renderer->DisplayToWorld();
    const double* world = renderer->GetWorldPoint();
    return Vec3d(world[0] / world[3], world[1] / world[3], world[2] / world[3]);
  };
  const Vec3d near = unproject(0.0);
  const Vec3d direction = (unproject(1.0) - near).normalized();
  const jobs::Frame& frame = *impl_->frame;
  raycast::Caster caster(frame.scene->scene());
  const auto hits = caster.cast({near.cast<float>(), direction.cast<float>()});

  if (impl_->sourcePick) {
    const Vec3d middle = geometry::bounds(frame.scene->body().skin).center();
    const double reach = (*impl_->sourcePick - middle).norm();
    std::optional<Vec3d> position;
    if (!hits.empty()) {
      // Where the line of sight enters the sphere around the body's middle on which the source is.
      const Vec3d out = near - middle;
      const double along = out.dot(direction);
      const double within = along * along - out.squaredNorm() + reach * reach;
      if (within >= 0.0) {
        position = near - (along + std::sqrt(within)) * direction;
      }
    } else if (const double floor = geometry::bounds(frame.study->body->body().skin.positions).min().y();
               direction.y() < -1e-3 && near.y() > floor) {
      position = near + (floor - near.y()) / direction.y() * direction;
      position->y() = impl_->sourcePick->y();
    }
    if (position) {
      impl_->sourcePick.reset();
      impl_->hint->hide();
      impl_->widget->setCursor(Qt::ArrowCursor);
      // Whole millimetres read better.
      Q_EMIT picked((*position * 1000.0).array().round().matrix() / 1000.0);
    }
    return;
  }

  // What one sees: the first thing that is not see-through, else the first thing at all.
  std::optional<document::ItemRef> seen;
  for (const raycast::Hit& hit : hits) {
    const analysis::StructureRef what = analysis::structureOfMesh(frame.scene->layout(), hit.mesh);
    using Kind = analysis::StructureRef::Kind;
    if (what.kind == Kind::organ && what.model != pane) {
      continue;
    }
    const document::ItemRef item =
        what.kind == Kind::body ? document::ItemRef{document::ItemKind::body, ""}
        : what.kind == Kind::piece
            ? document::ItemRef{document::ItemKind::piece, frame.study->pieces[what.index]->name}
            : document::ItemRef{document::ItemKind::organ, frame.study->organs[what.index]->name};
    const document::Appearance look =
        document::drawnAppearance(document_, item.kind == document::ItemKind::body ? std::string("body") : item.name);
    if (!look.visible) {
      continue;
    }
    if (look.opacity >= 0.5) {
      seen = item;
      break;
    }
    if (!seen) {
      seen = item;
    }
  }
  document_.select(seen);
}

}  // namespace lorica::viewport
