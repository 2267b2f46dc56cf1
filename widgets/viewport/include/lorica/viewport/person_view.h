#pragma once

/// \file
/// A person as a catalogue shows one: the skin from the front and from the side, upright, before a scale of heights
/// that stays the same, so that a taller person looks taller.

#include <QImage>
#include <QWidget>
#include <memory>

#include "lorica/geometry/triangle_mesh.h"

namespace lorica::viewport {

class PersonView : public QWidget {
  Q_OBJECT

 public:
  explicit PersonView(QWidget* parent = nullptr);
  ~PersonView() override;

  /// Metres, y up, facing +z, soles at y = 0. Null: only the scale. Not dimmed.
  void showSkin(std::shared_ptr<const geometry::TriangleMesh> skin);
  const std::shared_ptr<const geometry::TriangleMesh>& skin() const;
  /// Pales what is shown: it is no longer what is asked for.
  void setDimmed(bool dimmed);
  bool isDimmed() const;
  /// What is on the screen.
  QImage picture();

 protected:
  void resizeEvent(QResizeEvent* event) override;
  void changeEvent(QEvent* event) override;

 private:
  struct Impl;
  void arrange();
  void restyle();

  std::unique_ptr<Impl> impl_;
};

}  // namespace lorica::viewport
