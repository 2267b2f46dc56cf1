#pragma once

#include <QLayout>
#include <memory>
#include <vector>

namespace lorica::panels {

/// Puts widgets in rows, as many in one as fit, so that a narrow dock stays usable.
class FlowLayout : public QLayout {
 public:
  explicit FlowLayout(QWidget* parent = nullptr);
  ~FlowLayout() override;

  void addItem(QLayoutItem* item) override;
  int count() const override { return static_cast<int>(items_.size()); }
  QLayoutItem* itemAt(int index) const override;
  QLayoutItem* takeAt(int index) override;
  Qt::Orientations expandingDirections() const override { return {}; }
  bool hasHeightForWidth() const override { return true; }
  int heightForWidth(int width) const override;
  QSize sizeHint() const override;
  QSize minimumSize() const override;
  void setGeometry(const QRect& rect) override;

 private:
  enum class Place { measure, move };
  /// \return the height it takes
  int arrange(const QRect& rect, Place place) const;

  std::vector<std::unique_ptr<QLayoutItem>> items_;
};

}  // namespace lorica::panels
