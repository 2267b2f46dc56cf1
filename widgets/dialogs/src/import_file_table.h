#pragma once

#include <QTableWidget>
#include <filesystem>
#include <string>
#include <vector>

#include "lorica/dialogs/file_kinds.h"

namespace lorica::dialogs {

/// The files to import and what each holds: guessed until the user says otherwise.
class ImportFileTable : public QTableWidget {
  Q_OBJECT

 public:
  struct Entry {
    std::filesystem::path file;
    FileRole role = FileRole::organ;
    std::string system = "armor";
    bool chosen = false;  ///< by the user, not guessed
  };

  explicit ImportFileTable(QWidget* parent = nullptr);

  const std::vector<Entry>& entries() const { return entries_; }
  /// Files that are in the list already are left out. guess() shows it.
  void add(const std::filesystem::path& file);
  void setRole(std::size_t file, FileRole role);
  /// guess() shows that they are gone.
  void removeSelected();
  /// \param withSkin whether one of the files may be the body
  void guess(bool withSkin);

 Q_SIGNALS:
  /// The user chose a role or named a system.
  void edited();

 private:
  void rebuild();

  std::vector<Entry> entries_;
  bool withSkin_ = true;
};

}  // namespace lorica::dialogs
