#include "flow_layout.h"

#include <QWidget>
#include <algorithm>

namespace lorica::panels {

FlowLayout::FlowLayout(QWidget* parent) : QLayout(parent) {
  setContentsMargins(0, 0, 0, 0);
  setSpacing(6);
}

FlowLayout::~FlowLayout() = default;

void FlowLayout::addItem(QLayoutItem* item) {
  items_.emplace_back(item);
}

QLayoutItem* FlowLayout::itemAt(int index) const {
  return index >= 0 && index < count() ? items_[static_cast<std::size_t>(index)].get() : nullptr;
}

QLayoutItem* FlowLayout::takeAt(int index) {
  if (index < 0 || index >= count()) {
    return nullptr;
  }
  QLayoutItem* item = items_[static_cast<std::size_t>(index)].release();
  items_.erase(items_.begin() + index);
  return item;
}

int FlowLayout::heightForWidth(int width) const {
  return arrange(QRect(0, 0, width, 0), Place::measure);
}

QSize FlowLayout::sizeHint() const {
  int width = 0;
  int height = 0;
  for (const auto& item : items_) {
    width += item->sizeHint().width() + spacing();
    height = std::max(height, item->sizeHint().height());
  }
  return {std::max(0, width - spacing()), height};
}

QSize FlowLayout::minimumSize() const {
  QSize size;
  for (const auto& item : items_) {
    size = size.expandedTo(item->minimumSize());
  }
  return size;
}

void FlowLayout::setGeometry(const QRect& rect) {
  QLayout::setGeometry(rect);
  arrange(rect, Place::move);
}

int FlowLayout::arrange(const QRect& rect, Place place) const {
  std::vector<QLayoutItem*> shown;
  for (const auto& item : items_) {
    if (!item->isEmpty()) {
      shown.push_back(item.get());
    }
  }
  int top = rect.top();
  std::size_t first = 0;
  while (first < shown.size()) {
    // A row: what fits, at least one.
    int width = 0;
    int height = 0;
    std::size_t end = first;
    for (; end < shown.size(); ++end) {
      const QSize size = shown[end]->sizeHint();
      const int wider = width + (end > first ? spacing() : 0) + size.width();
      if (end > first && wider > rect.width()) {
        break;
      }
      width = wider;
      height = std::max(height, size.height());
    }
    if (place == Place::move) {
      int left = rect.left();
      for (std::size_t i = first; i < end; ++i) {
        const QSize size = shown[i]->sizeHint();
        shown[i]->setGeometry(
            QRect(left, top + (height - size.height()) / 2, std::min(size.width(), rect.width()), size.height()));
        left += size.width() + spacing();
      }
    }
    top += height + spacing();
    first = end;
  }
  return std::max(0, top - spacing() - rect.top());
}

}  // namespace lorica::panels
