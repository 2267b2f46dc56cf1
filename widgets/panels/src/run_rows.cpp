#include <QCheckBox>
#include <QLineEdit>
#include <QListWidget>
#include <QRegularExpressionValidator>
#include <QVBoxLayout>
#include <algorithm>

#include "item_form_parts.h"
#include "lorica/commands/shot_edits.h"
#include "lorica/document/appearance.h"
#include "lorica/models/model_texts.h"
#include "lorica/panels/shot_forms.h"

namespace lorica::panels {

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
