#pragma once

#include <QObject>
#include <map>
#include <memory>
#include <span>
#include <vector>

#include "lorica/analysis/loaded_study.h"
#include "lorica/jobs/job.h"

namespace lorica::viewport {

/// The coarse triangles of everything a study shows, made on a thread of their own when they are first wanted, once
/// for every mesh however many frames and panes show it. Used on the window's thread alone.
class CoarseMeshes : public QObject {
  Q_OBJECT

 public:
  using Triangles = std::shared_ptr<const std::vector<geometry::Triangle>>;

  explicit CoarseMeshes(QObject* parent = nullptr) : QObject(parent) {}

  /// What is shown now; null: nothing. Keeps what was made for meshes that this study shares with the one before.
  void setStudy(std::shared_ptr<const analysis::LoadedStudy> study);
  /// Starts to make what is missing; made() follows.
  void make();
  /// Coarse ones for the triangles of a mesh of the study; null while there are none, and for a small mesh.
  Triangles of(std::span<const geometry::Triangle> triangles) const;

 Q_SIGNALS:
  void made();

 private:
  /// Triangles are known by where they are: the study keeps them there.
  using Key = const geometry::Triangle*;
  using Found = std::map<Key, Triangles>;

  std::shared_ptr<const analysis::LoadedStudy> study_;
  Found found_;
  std::unique_ptr<jobs::Job> job_;
};

}  // namespace lorica::viewport
