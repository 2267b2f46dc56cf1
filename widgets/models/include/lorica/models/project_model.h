#pragma once

/// \file
/// The project as a tree: body with its regions, organs, armor, poses, sources, runs.

#include <QAbstractItemModel>
#include <memory>
#include <optional>
#include <vector>

#include "lorica/document/study_document.h"

namespace lorica::models {

enum class Section { body, organs, armor, poses, sources, runs };

/// Follows a document. Check boxes and names are edited through commands. It resets when rows come, go or are renamed,
/// and tells finer of everything else. Without a study it has no rows.
class ProjectModel : public QAbstractItemModel {
  Q_OBJECT

 public:
  enum Column { nameColumn, detailsColumn, columnTotal };
  /// document::ItemRef; invalid for heads of sections.
  static constexpr int itemRole = Qt::UserRole;
  /// QColor and double (0 to 1) of what is drawn.
  static constexpr int colourRole = Qt::UserRole + 1;
  static constexpr int opacityRole = Qt::UserRole + 2;
  /// Text that names the row across resets.
  static constexpr int keyRole = Qt::UserRole + 3;

  explicit ProjectModel(document::StudyDocument& document, QObject* parent = nullptr);
  ~ProjectModel() override;

  std::optional<document::ItemRef> itemAt(const QModelIndex& index) const;
  /// In the first column; invalid when the tree has no such row.
  QModelIndex indexOf(const document::ItemRef& item) const;
  QModelIndex indexOf(Section section) const;
  /// \pre index is valid
  Section sectionAt(const QModelIndex& index) const;
  /// What is drawn of a row and of those below it: names for document::appearanceOf().
  std::vector<std::string> structuresAt(const QModelIndex& index) const;

  QModelIndex index(int row, int column, const QModelIndex& parent = {}) const override;
  QModelIndex parent(const QModelIndex& child) const override;
  int rowCount(const QModelIndex& parent = {}) const override;
  int columnCount(const QModelIndex& parent = {}) const override;
  Qt::ItemFlags flags(const QModelIndex& index) const override;
  QVariant data(const QModelIndex& index, int role = Qt::DisplayRole) const override;
  bool setData(const QModelIndex& index, const QVariant& value, int role = Qt::EditRole) override;
  QVariant headerData(int section, Qt::Orientation orientation, int role = Qt::DisplayRole) const override;

 Q_SIGNALS:
  /// A new name cannot be taken; one sentence.
  void renameRefused(QString text);

 private:
  struct Node;
  static const Node& nodeOf(const QModelIndex& index);
  QModelIndex indexOf(const Node& node, int column) const;
  const Node* find(const Node& below, const document::ItemRef& item) const;

  std::unique_ptr<Node> makeTree() const;
  void follow();
  void tellChanged(const Node& node, const QList<int>& roles);
  void tellDisplayChanged();

  QString nameOf(const Node& node) const;
  QString detailsOf(const Node& node) const;
  QString sectionDetails(const Node& node) const;
  QString descriptionOf(const Node& node) const;
  QVariant checkStateOf(const Node& node) const;
  void show(const Node& node, bool visible);
  bool rename(const document::ItemRef& item, const QString& name);

  document::StudyDocument& document_;
  std::unique_ptr<Node> root_;
};

/// A round spot of a colour.
QIcon colourSwatch(const QColor& colour);

}  // namespace lorica::models
