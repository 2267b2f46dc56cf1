#pragma once

/// \file
/// Forms that edit the study: rows of a label and an editor. Every row reads its value from the document and writes it
/// through a command; refresh() reads again, so that forms follow undo.

#include <QFormLayout>
#include <QStringList>
#include <QVariant>
#include <QWidget>
#include <functional>
#include <vector>

#include "lorica/document/study_document.h"

class QCheckBox;
class QComboBox;
class QDoubleSpinBox;
class QLabel;
class QLineEdit;
class QPlainTextEdit;
class QToolButton;

namespace lorica::panels {

/// One line of text that is cut when there is no room for it; the whole of it is its tooltip.
class ElidedLabel : public QWidget {
  Q_OBJECT

 public:
  explicit ElidedLabel(QWidget* parent = nullptr);
  void setText(const QString& text);
  const QString& text() const { return text_; }
  void setElideMode(Qt::TextElideMode mode) { elide_ = mode; }
  QSize sizeHint() const override;
  QSize minimumSizeHint() const override;

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  QString text_;
  Qt::TextElideMode elide_ = Qt::ElideMiddle;
};

/// A row of a form: the object name of its editor, its label, and what its tooltip says.
struct Field {
  const char* id;
  QString label;
  QString tip{};
};

struct NumberRange {
  double low = 0.0;
  double high = 1.0;
  double step = 0.1;
  int decimals = 2;
  QString suffix{};
};

/// One of several numbers in a row.
struct NumberPart {
  const char* id;
  NumberRange range;
  QString prefix{};
};

struct Choice {
  QString text;
  QString id;
  QString tip{};
};

class PropertyForm : public QWidget {
  Q_OBJECT

 public:
  explicit PropertyForm(document::StudyDocument& document, QWidget* parent = nullptr);

  document::StudyDocument& document() const { return document_; }
  const study::Study& study() const { return document_.study(); }
  /// Reads every value from the document again.
  void refresh();
  /// Takes nothing over any more: for forms that are about to go.
  void retire() { refreshing_ = true; }

  void section(const QString& title);
  /// A value that cannot be edited.
  ElidedLabel* fact(const Field& field, std::function<QString()> get);
  /// A fact of several lines, wrapped.
  QLabel* note(const Field& field, std::function<QString()> get);
  QLineEdit* line(const Field& field, std::function<QString()> get, std::function<void(const QString&)> set);
  /// Several lines, taken over when the focus leaves.
  QPlainTextEdit* paragraph(const Field& field, std::function<QString()> get, std::function<void(const QString&)> set);
  QDoubleSpinBox* number(const Field& field, const NumberRange& range, std::function<double()> get,
                         std::function<void(double)> set);
  /// Three numbers in a row; their object names end in _x, _y and _z.
  QWidget* triple(const Field& field, const NumberRange& range, std::function<geometry::Vec3d()> get,
                  const std::function<void(const geometry::Vec3d&)>& set);
  /// Several numbers in a row; their object names are that of the field, _ and the part's.
  /// \param set given which of them, and its new value
  QWidget* numbers(const Field& field, const std::vector<NumberPart>& parts, std::function<std::vector<double>()> get,
                   const std::function<void(std::size_t, double)>& set);
  /// \param choices asked again by every refresh
  QComboBox* choice(const Field& field, std::function<std::vector<Choice>()> choices, std::function<QString()> get,
                    std::function<void(const QString&)> set);
  QCheckBox* check(const Field& field, const QString& text, std::function<bool()> get, std::function<void(bool)> set);
  /// A colour, and a button that goes back to the program's default.
  QToolButton* colour(const Field& field, const std::function<QColor()>& get, std::function<void(const QColor&)> set,
                      std::function<void()> reset);
  /// What is wrong with the field above it; takes no room while that is nothing. \param id of that field
  QLabel* trouble(const char* id, std::function<QString()> get);
  /// A row of any widget. \param update called by refresh(); may be empty
  void row(const QString& label, QWidget* widget, std::function<void()> update = {});
  /// Does something now and at every refresh.
  void onRefresh(std::function<void()> update);
  /// Shows a row only while `when` holds.
  void showRowWhile(QWidget* widget, std::function<bool()> when);

  /// Whether values are being read, or the form is about to go: then editors do not write.
  bool isRefreshing() const { return refreshing_; }

 Q_SIGNALS:
  /// Another person is wanted for the built-in human.
  void personRequested();

 private:
  QDoubleSpinBox* makeSpin(const NumberRange& range);

  document::StudyDocument& document_;
  QFormLayout* layout_;
  std::vector<std::function<void()>> updates_;
  bool refreshing_ = false;
};

/// A number as people read it: at most `decimals` places, none of them idle.
QString readable(double value, int decimals);

}  // namespace lorica::panels
