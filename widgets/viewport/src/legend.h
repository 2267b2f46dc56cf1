#pragma once

#include <QColor>
#include <QString>
#include <QStringList>
#include <QWidget>
#include <optional>
#include <vector>

#include "colour_scale.h"
#include "lorica/document/study_document.h"
#include "lorica/jobs/organ_colours.h"

namespace lorica::viewport {

/// What the legend of the view says.
struct LegendText {
  struct Entry {
    enum class Mark { line, dot, smallDot, axes } mark = Mark::line;
    QColor colour;
    QString text;
    bool operator==(const Entry&) const = default;
  };
  /// A bar of the colours of organs.
  struct Bar {
    QString title;  ///< with its unit
    ColourScale scale;
    double unit = 1.0;  ///< how many of the title's units are one of the scale's
    QString note;       ///< what lies beyond the ends
  };
  QString title;
  std::vector<Entry> entries;
  QStringList notes;
  std::optional<Bar> bar;

  bool isEmpty() const { return entries.empty() && notes.isEmpty() && !bar; }
};

/// For what is drawn of how organs deform. \param frame may be null \param colours of that frame, null while not known
LegendText legendFor(const document::StudyDocument& document, const jobs::Frame* frame,
                     const jobs::OrganColours* colours, const ColourScale& scale);

/// A small box over the view. It takes no events; hidden while it has nothing to say.
class Legend : public QWidget {
 public:
  explicit Legend(QWidget* parent);
  void show(LegendText text);
  const LegendText& text() const { return text_; }
  QSize sizeHint() const override;

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  int lineHeight() const;
  int markWidth() const;
  int width() const;
  int paintEntries(QPainter& painter, int y) const;
  void paintBar(QPainter& painter, int y) const;

  LegendText text_;
};

}  // namespace lorica::viewport
