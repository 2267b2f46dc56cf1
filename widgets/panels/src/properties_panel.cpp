#include "lorica/panels/properties_panel.h"

#include <QVBoxLayout>

#include "item_form.h"
#include "lorica/panels/property_form.h"
#include "panel_parts.h"

namespace lorica::panels {

PropertiesPanel::PropertiesPanel(document::StudyDocument& document, QWidget* parent)
    : QScrollArea(parent), document_(document) {
  setFrameShape(QFrame::NoFrame);
  setWidgetResizable(true);
  setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  using document::StudyDocument;
  connect(&document_, &StudyDocument::selectionChanged, this, &PropertiesPanel::rebuild);
  connect(&document_, &StudyDocument::replaced, this, &PropertiesPanel::rebuild);
  connect(&document_, &StudyDocument::studyChanged, this, &PropertiesPanel::refresh);
  connect(&document_, &StudyDocument::loadedChanged, this, &PropertiesPanel::refresh);
  connect(&document_, &StudyDocument::planChanged, this, &PropertiesPanel::refresh);
  rebuild();
}

QSize PropertiesPanel::sizeHint() const {
  return {fontMetrics().averageCharWidth() * 48, fontMetrics().height() * 24};
}

void PropertiesPanel::rebuild() {
  if (form_ != nullptr && item_ == document_.selection()) {
    refresh();
    return;
  }
  item_ = document_.selection();
  if (form_ != nullptr) {
    // Its thing may be gone, and we may be in the midst of a command.
    form_->retire();
    form_ = nullptr;
  }
  // An editor of the old form may be what brought us here: it lives until it has returned.
  if (QWidget* old = takeWidget()) {
    old->hide();
    old->deleteLater();
  }
  if (!item_) {
    setWidget(makeEmptyPage(document_.hasStudy() ? tr("Select something to see its properties.")
                                                 : tr("Open a study to see its properties."),
                            this));
    return;
  }
  auto* page = new QWidget;
  auto* layout = new QVBoxLayout(page);
  layout->setContentsMargins(panelMargin, panelMargin, panelMargin, panelMargin);
  form_ = makeItemForm(document_, *item_, page);
  connect(form_, &PropertyForm::personRequested, this, &PropertiesPanel::personRequested);
  layout->addWidget(form_);
  layout->addStretch(1);
  setWidget(page);
}

void PropertiesPanel::refresh() {
  // A selection that is gone is told of after the edit that took it.
  if (form_ != nullptr && item_ && document::exists(document_, *item_)) {
    form_->refresh();
  }
}

}  // namespace lorica::panels
