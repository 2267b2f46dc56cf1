#include "lorica/panels/property_form.h"

#include <QCheckBox>
#include <QColorDialog>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QLocale>
#include <QPainter>
#include <QPlainTextEdit>
#include <QResizeEvent>
#include <QSignalBlocker>
#include <QStyle>
#include <QToolButton>

namespace lorica::panels {

ElidedLabel::ElidedLabel(QWidget* parent) : QWidget(parent) {
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
}

void ElidedLabel::setText(const QString& text) {
  if (text == text_) {
    return;
  }
  text_ = text;
  setToolTip(text);
  setAccessibleName(text);
  updateGeometry();
  update();
}

QSize ElidedLabel::sizeHint() const {
  return {fontMetrics().horizontalAdvance(text_) + 2, fontMetrics().height()};
}

QSize ElidedLabel::minimumSizeHint() const {
  return {fontMetrics().averageCharWidth() * 8, fontMetrics().height()};
}

void ElidedLabel::paintEvent(QPaintEvent* /*event*/) {
  QPainter painter(this);
  painter.setPen(palette().color(QPalette::WindowText));
  painter.drawText(rect(), Qt::AlignLeft | Qt::AlignVCenter, fontMetrics().elidedText(text_, elide_, width()));
}

namespace {

/// A text editor that says when the user is done with it.
class Paragraph : public QPlainTextEdit {
 public:
  explicit Paragraph(std::function<void()> done) : done_(std::move(done)) {
    setTabChangesFocus(true);
    setLineWrapMode(QPlainTextEdit::WidgetWidth);
  }
  QSize sizeHint() const override {
    return {fontMetrics().averageCharWidth() * 24, fontMetrics().lineSpacing() * 4 + 2 * frameWidth() + 8};
  }
  QSize minimumSizeHint() const override {
    return {fontMetrics().averageCharWidth() * 12, fontMetrics().lineSpacing() * 2 + 2 * frameWidth() + 8};
  }

 protected:
  void focusOutEvent(QFocusEvent* event) override {
    QPlainTextEdit::focusOutEvent(event);
    if (event->reason() != Qt::PopupFocusReason) {
      done_();
    }
  }

 private:
  std::function<void()> done_;
};

/// Wrapped text that asks for its height as a plain widget does: where a form has rows whose height follows their
/// width, Qt gives rows that come back no height.
class WrappedLabel : public QLabel {
 public:
  using QLabel::QLabel;
  bool hasHeightForWidth() const override { return false; }
  QSize sizeHint() const override { return {QLabel::sizeHint().width(), heightForWidth(width())}; }
  QSize minimumSizeHint() const override { return {0, heightForWidth(width())}; }

 protected:
  void resizeEvent(QResizeEvent* event) override {
    QLabel::resizeEvent(event);
    if (event->size().width() != event->oldSize().width()) {
      updateGeometry();
    }
  }
};

/// Wheels scroll the panel; a number changes under the wheel only once it was clicked.
class CalmWheel : public QObject {
 public:
  using QObject::QObject;
  bool eventFilter(QObject* watched, QEvent* event) override {
    auto* widget = qobject_cast<QWidget*>(watched);
    if (event->type() == QEvent::Wheel && widget != nullptr && !widget->hasFocus()) {
      event->ignore();
      return true;
    }
    return false;
  }
};

void name(QWidget* editor, const Field& field) {
  editor->setObjectName(QString::fromLatin1(field.id));
  editor->setAccessibleName(field.label);
  if (!field.tip.isEmpty()) {
    editor->setToolTip(field.tip);
  }
}

void calm(QWidget* editor) {
  editor->setFocusPolicy(Qt::StrongFocus);
  editor->installEventFilter(new CalmWheel(editor));
}

}  // namespace

PropertyForm::PropertyForm(document::StudyDocument& document, QWidget* parent)
    : QWidget(parent), document_(document), layout_(new QFormLayout(this)) {
  layout_->setFieldGrowthPolicy(QFormLayout::AllNonFixedFieldsGrow);
  layout_->setLabelAlignment(Qt::AlignLeft | Qt::AlignVCenter);
  layout_->setContentsMargins(0, 0, 0, 0);
  const int gap = fontMetrics().height() / 3;
  layout_->setVerticalSpacing(gap);
  layout_->setHorizontalSpacing(2 * gap);
}

void PropertyForm::onRefresh(std::function<void()> update) {
  updates_.push_back(std::move(update));
  const bool before = std::exchange(refreshing_, true);
  updates_.back()();
  refreshing_ = before;
}

void PropertyForm::refresh() {
  const bool before = std::exchange(refreshing_, true);
  for (const std::function<void()>& update : updates_) {
    update();
  }
  refreshing_ = before;
}

void PropertyForm::section(const QString& title) {
  auto* label = new QLabel(title, this);
  QFont bold = label->font();
  bold.setBold(true);
  label->setFont(bold);
  label->setContentsMargins(0, layout_->rowCount() == 0 ? 0 : fontMetrics().height() / 2, 0, 0);
  layout_->addRow(label);
}

void PropertyForm::row(const QString& label, QWidget* widget, std::function<void()> update) {
  if (label.isNull()) {
    layout_->addRow(widget);
  } else {
    layout_->addRow(label, widget);
  }
  if (update) {
    onRefresh(std::move(update));
  }
}

void PropertyForm::showRowWhile(QWidget* widget, std::function<bool()> when) {
  onRefresh([this, widget, when = std::move(when)] { layout_->setRowVisible(widget, when()); });
}

ElidedLabel* PropertyForm::fact(const Field& field, std::function<QString()> get) {
  auto* label = new ElidedLabel(this);
  label->setObjectName(QString::fromLatin1(field.id));
  row(field.label, label, [label, get = std::move(get)] { label->setText(get()); });
  return label;
}

QLabel* PropertyForm::note(const Field& field, std::function<QString()> get) {
  auto* label = new WrappedLabel(this);
  label->setWordWrap(true);
  label->setTextFormat(Qt::PlainText);
  // A long word is no reason to widen the form.
  QSizePolicy policy = label->sizePolicy();
  policy.setHorizontalPolicy(QSizePolicy::Ignored);
  label->setSizePolicy(policy);
  name(label, field);
  row(field.label, label, [label, get = std::move(get)] { label->setText(get()); });
  return label;
}

QLabel* PropertyForm::trouble(const char* id, std::function<QString()> get) {
  QLabel* label = note({id, QLatin1String("")}, get);
  label->setObjectName(QString::fromLatin1(id) + QStringLiteral("_trouble"));
  label->setAccessibleName({});
  QPalette colours = label->palette();
  const bool dark = colours.color(QPalette::Window).lightness() < 128;
  colours.setColor(QPalette::WindowText, dark ? QColor(255, 140, 130) : QColor(170, 20, 20));
  label->setPalette(colours);
  showRowWhile(label, [get = std::move(get)] { return !get().isEmpty(); });
  return label;
}

QLineEdit* PropertyForm::line(const Field& field, std::function<QString()> get,
                              std::function<void(const QString&)> set) {
  auto* edit = new QLineEdit(this);
  name(edit, field);
  connect(edit, &QLineEdit::editingFinished, this, [this, edit, set = std::move(set)] {
    if (!refreshing_ && edit->isModified()) {
      edit->setModified(false);
      set(edit->text());
    }
  });
  const bool untold = field.tip.isEmpty();
  row(field.label, edit, [edit, untold, get = std::move(get)] {
    const QString text = get();
    if (untold) {
      edit->setToolTip(text);  // a narrow panel cuts long names
    }
    // What is being typed stays until it is taken over.
    if (edit->text() != text && !(edit->hasFocus() && edit->isModified())) {
      edit->setText(text);
      edit->setCursorPosition(0);
    }
  });
  return edit;
}

QPlainTextEdit* PropertyForm::paragraph(const Field& field, std::function<QString()> get,
                                        std::function<void(const QString&)> set) {
  // The editor needs to know itself, which it does not before it is made.
  auto self = std::make_shared<QPlainTextEdit*>(nullptr);
  auto* edit = new Paragraph([this, self, set = std::move(set)] {
    if (!refreshing_ && (*self)->document()->isModified()) {
      (*self)->document()->setModified(false);
      set((*self)->toPlainText());
    }
  });
  *self = edit;
  name(edit, field);
  row(field.label, edit, [edit, get = std::move(get)] {
    const QString text = get();
    if (edit->toPlainText() != text && !(edit->hasFocus() && edit->document()->isModified())) {
      edit->setPlainText(text);
      edit->document()->setModified(false);
    }
  });
  return edit;
}

QDoubleSpinBox* PropertyForm::makeSpin(const NumberRange& range) {
  auto* spin = new QDoubleSpinBox(this);
  spin->setDecimals(range.decimals);
  spin->setRange(range.low, range.high);
  spin->setSingleStep(range.step);
  spin->setSuffix(range.suffix);
  spin->setKeyboardTracking(false);
  spin->setGroupSeparatorShown(range.high > 1000.0);
  spin->setMinimumWidth(fontMetrics().averageCharWidth() * 8);
  spin->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  calm(spin);
  return spin;
}

QDoubleSpinBox* PropertyForm::number(const Field& field, const NumberRange& range, std::function<double()> get,
                                     std::function<void(double)> set) {
  QDoubleSpinBox* spin = makeSpin(range);
  name(spin, field);
  connect(spin, &QDoubleSpinBox::valueChanged, this, [this, set = std::move(set)](double value) {
    if (!refreshing_) {
      set(value);
    }
  });
  row(field.label, spin, [spin, get = std::move(get)] { spin->setValue(get()); });
  return spin;
}

QWidget* PropertyForm::numbers(const Field& field, const std::vector<NumberPart>& parts,
                               std::function<std::vector<double>()> get,
                               const std::function<void(std::size_t, double)>& set) {
  auto* group = new QWidget(this);
  name(group, field);
  auto* layout = new QHBoxLayout(group);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(fontMetrics().height() / 4);
  std::vector<QDoubleSpinBox*> spins;
  for (std::size_t which = 0; which < parts.size(); ++which) {
    const NumberPart& part = parts[which];
    QDoubleSpinBox* spin = makeSpin(part.range);
    const QString id = QString::fromLatin1(part.id);
    spin->setPrefix(part.prefix);
    spin->setObjectName(QString::fromLatin1(field.id) + u'_' + id);
    spin->setAccessibleName(field.label + u' ' + id);
    spin->setButtonSymbols(QAbstractSpinBox::NoButtons);
    spin->setToolTip(field.tip);
    spins.push_back(spin);
    layout->addWidget(spin, 1);
    connect(spin, &QDoubleSpinBox::valueChanged, this, [this, which, set](double value) {
      if (!refreshing_) {
        set(which, value);
      }
    });
  }
  row(field.label, group, [spins, get = std::move(get)] {
    const std::vector<double> values = get();
    for (std::size_t which = 0; which < spins.size(); ++which) {
      spins[which]->setValue(values[which]);
    }
  });
  return group;
}

QWidget* PropertyForm::triple(const Field& field, const NumberRange& range, std::function<geometry::Vec3d()> get,
                              const std::function<void(const geometry::Vec3d&)>& set) {
  const auto values = [get] {
    const geometry::Vec3d point = get();
    return std::vector<double>(point.begin(), point.end());
  };
  return numbers(field, {{"x", range, "x "}, {"y", range, "y "}, {"z", range, "z "}}, values,
                 [get, set](std::size_t axis, double value) {
                   // The other two keep the digits that are not shown.
                   geometry::Vec3d point = get();
                   point[static_cast<Eigen::Index>(axis)] = value;
                   set(point);
                 });
}

QComboBox* PropertyForm::choice(const Field& field, std::function<std::vector<Choice>()> choices,
                                std::function<QString()> get, std::function<void(const QString&)> set) {
  auto* combo = new QComboBox(this);
  name(combo, field);
  combo->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  combo->setMinimumContentsLength(8);
  calm(combo);
  connect(combo, &QComboBox::currentIndexChanged, this, [this, combo, set = std::move(set)](int index) {
    if (!refreshing_ && index >= 0) {
      set(combo->itemData(index).toString());
    }
  });
  row(field.label, combo, [combo, choices = std::move(choices), get = std::move(get)] {
    const std::vector<Choice> wanted = choices();
    bool same = static_cast<std::size_t>(combo->count()) == wanted.size();
    for (std::size_t i = 0; same && i < wanted.size(); ++i) {
      const int index = static_cast<int>(i);
      same = combo->itemText(index) == wanted[i].text && combo->itemData(index).toString() == wanted[i].id;
    }
    if (!same) {
      combo->clear();
      for (const Choice& one : wanted) {
        combo->addItem(one.text, one.id);
        combo->setItemData(combo->count() - 1, one.tip, Qt::ToolTipRole);
      }
    }
    combo->setCurrentIndex(combo->findData(get()));
  });
  return combo;
}

QCheckBox* PropertyForm::check(const Field& field, const QString& text, std::function<bool()> get,
                               std::function<void(bool)> set) {
  auto* box = new QCheckBox(text, this);
  name(box, field);
  box->setAccessibleName(text);
  connect(box, &QCheckBox::toggled, this, [this, set = std::move(set)](bool on) {
    if (!refreshing_) {
      set(on);
    }
  });
  row(field.label, box, [box, get = std::move(get)] { box->setChecked(get()); });
  return box;
}

QToolButton* PropertyForm::colour(const Field& field, const std::function<QColor()>& get,
                                  std::function<void(const QColor&)> set, std::function<void()> reset) {
  auto* group = new QWidget(this);
  auto* layout = new QHBoxLayout(group);
  layout->setContentsMargins(0, 0, 0, 0);
  auto* button = new QToolButton(group);
  name(button, field);
  button->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  layout->addWidget(button);
  auto* back = new QToolButton(group);
  back->setText(tr("Default"));
  back->setObjectName(QString::fromLatin1(field.id) + QStringLiteral("_default"));
  back->setAutoRaise(true);
  layout->addWidget(back);
  layout->addStretch(1);
  connect(button, &QToolButton::clicked, this, [this, get, set = std::move(set), label = field.label] {
    const QColor picked = QColorDialog::getColor(get(), this, label);
    if (picked.isValid()) {
      set(picked);
    }
  });
  connect(back, &QToolButton::clicked, this, [reset = std::move(reset)] { reset(); });
  row(field.label, group, [button, get] {
    const QColor colour = get();
    const int side = button->style()->pixelMetric(QStyle::PM_SmallIconSize);
    QPixmap swatch(side, side);
    swatch.fill(colour);
    button->setIcon(QIcon(swatch));
    button->setText(colour.name());
  });
  return button;
}

QString readable(double value, int decimals) {
  QString text = QLocale::c().toString(value, 'f', decimals);
  if (text.contains(u'.')) {
    while (text.endsWith(u'0')) {
      text.chop(1);
    }
    if (text.endsWith(u'.')) {
      text.chop(1);
    }
  }
  return text;
}

}  // namespace lorica::panels
