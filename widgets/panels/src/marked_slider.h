#pragma once

#include <QSlider>
#include <vector>

namespace lorica::panels {

/// A slider with marks below its groove, that goes where it is clicked.
class MarkedSlider : public QSlider {
 public:
  explicit MarkedSlider(QWidget* parent = nullptr);
  /// \param marks places on the slider's scale, whole or between
  void setMarks(std::vector<double> marks);
  const std::vector<double>& marks() const { return marks_; }
  QSize sizeHint() const override;
  QSize minimumSizeHint() const override { return sizeHint(); }

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;

 private:
  struct Track {
    double left;
    double length;
  };
  /// Where the middle of the handle moves, and where the groove ends below.
  Track track() const;
  int markHeight() const { return fontMetrics().height() / 2; }

  std::vector<double> marks_;
};

}  // namespace lorica::panels
