#include <QCheckBox>
#include <QCoreApplication>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QLineEdit>
#include <QRegularExpressionValidator>
#include <QVBoxLayout>
#include <algorithm>
#include <array>
#include <limits>

#include "lorica/commands/edits.h"
#include "lorica/geometry/measures.h"
#include "lorica/models/model_texts.h"
#include "lorica/panels/property_form.h"

namespace lorica::panels {

namespace {

struct Text {
  Q_DECLARE_TR_FUNCTIONS(lorica::panels::PropertyForm)
};

const study::Source& sourceNamed(const study::Study& study, const std::string& name) {
  static const study::Source none;
  const auto found = std::find_if(study.sources.begin(), study.sources.end(),
                                  [&](const study::Source& source) { return source.name == name; });
  return found == study.sources.end() ? none : *found;
}

/// Where a target starts when one is asked for: the middle of the body at rest.
geometry::Vec3d middleOfBody(const document::StudyDocument& document) {
  if (document.loaded() == nullptr) {
    return {0.0, 1.0, 0.0};
  }
  const geometry::Box3d box = geometry::bounds(document.loaded()->body->body().skin.positions);
  const auto millimetres = [](double x) { return std::round(x * 1000.0) / 1000.0; };
  return {millimetres(box.center().x()), millimetres(box.center().y()), millimetres(box.center().z())};
}

}  // namespace

void addSourceRows(PropertyForm& form, const std::function<std::string()>& source) {
  document::StudyDocument& document = form.document();
  const auto here = [&document, source]() -> const study::Source& { return sourceNamed(document.study(), source()); };
  const NumberRange metres{-1000.0, 1000.0, 0.01, 3, {}};
  form.triple(
      {"position", Text::tr("Position (m)"), Text::tr("x to the person's left, y up, z ahead of the person")}, metres,
      [here] { return here().position; },
      [&document, source](const geometry::Vec3d& point) { commands::setSourcePosition(document, source(), point); });
  form.choice(
      {"target", Text::tr("Target"), Text::tr("Where the middle of the shots goes")},
      [] {
        return std::vector<Choice>{{Text::tr("Centre of the body"), QStringLiteral("body")},
                                   {Text::tr("A point"), QStringLiteral("point")}};
      },
      [here] { return here().target ? QStringLiteral("point") : QStringLiteral("body"); },
      [&document, source](const QString& id) {
        commands::setSourceTarget(document, source(),
                                  id == u"point" ? std::optional(middleOfBody(document)) : std::nullopt);
      });
  QWidget* point = form.triple(
      {"target_point", Text::tr("Target point (m)"), QString()}, metres,
      [here] { return here().target.value_or(geometry::Vec3d::Zero()); },
      [&document, source](const geometry::Vec3d& to) { commands::setSourceTarget(document, source(), to); });
  form.showRowWhile(point, [here] { return here().target.has_value(); });
  form.choice(
      {"sampler", Text::tr("Sampler"), Text::tr("How the directions of shots are drawn")},
      [] {
        return std::vector<Choice>{
            {Text::tr("Cone"), QStringLiteral("cone"), Text::tr("Even over the cone that bounds the posed body")},
            {Text::tr("Thesis (Eq 15)"), QStringLiteral("thesis"), Text::tr("For comparison with the thesis only")}};
      },
      [here] { return here().sampler == study::Sampler::thesis ? QStringLiteral("thesis") : QStringLiteral("cone"); },
      [&document, source](const QString& id) {
        commands::setSourceSampler(document, source(), id == u"thesis" ? study::Sampler::thesis : study::Sampler::cone);
      });
  QLabel* warning = form.note({"sampler_warning", QLatin1String("")}, [] {
    return Text::tr(
        "The thesis' sampler sends half of its shots backwards and its hit rate depends on the world's "
        "axes; use it for comparison only.");
  });
  form.showRowWhile(warning, [here] { return here().sampler == study::Sampler::thesis; });
  form.number(
      {"shots", Text::tr("Shots per trial")}, {1.0, 1e12, 10000.0, 0, {}},
      [here] { return static_cast<double>(here().shots); },
      [&document, source](double shots) {
        commands::setSourceShots(document, source(), static_cast<std::uint64_t>(shots));
      });
}

void addRunRows(PropertyForm& form) {
  document::StudyDocument& document = form.document();
  form.number(
      {"trials", Text::tr("Trials"),
       Text::tr("How often every source shoots; the spread between trials shows "
                "how certain a result is")},
      {1.0, 100000.0, 1.0, 0, {}}, [&document] { return static_cast<double>(document.study().trials); },
      [&document](double trials) { commands::setTrials(document, static_cast<std::uint32_t>(trials)); });
  QLineEdit* seed = form.line(
      {"seed", Text::tr("Seed"), Text::tr("A whole number; the same seed gives the same shots")},
      [&document] { return QString::number(document.study().seed); },
      [&document, &form](const QString& text) {
        bool good = false;
        const qulonglong value = text.toULongLong(&good);
        if (good) {
          commands::setSeed(document, value);
        }
        form.refresh();
      });
  seed->setValidator(new QRegularExpressionValidator(QRegularExpression(QStringLiteral("\\d{1,20}")), seed));

  auto* models = new QWidget(&form);
  auto* column = new QVBoxLayout(models);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(form.fontMetrics().height() / 6);
  std::vector<std::pair<QCheckBox*, study::OrganModel>> boxes;
  for (const models::ModelText& text : models::modelTexts()) {
    auto* box = new QCheckBox(text.label, models);
    box->setObjectName(QStringLiteral("model_") + QString::fromStdString(viscera::name(text.model)));
    box->setToolTip(text.tip);
    column->addWidget(box);
    boxes.emplace_back(box, text.model);
    QObject::connect(box, &QCheckBox::toggled, &form, [&document, &form, model = text.model](bool on) {
      if (form.isRefreshing()) {
        return;
      }
      std::vector<study::OrganModel> chosen;
      for (const models::ModelText& other : models::modelTexts()) {
        const auto& now = document.study().models;
        const bool there = std::find(now.begin(), now.end(), other.model) != now.end();
        if (other.model == model ? on : there) {
          chosen.push_back(other.model);
        }
      }
      if (!chosen.empty()) {
        commands::setModels(document, chosen);
      }
      form.refresh();
    });
  }
  form.row(Text::tr("Organ models"), models, [&document, boxes] {
    const auto& chosen = document.study().models;
    for (const auto& [box, model] : boxes) {
      const bool on = std::find(chosen.begin(), chosen.end(), model) != chosen.end();
      box->setChecked(on);
      // A run needs one model at least.
      box->setEnabled(!(on && chosen.size() == 1));
    }
  });
}

}  // namespace lorica::panels
