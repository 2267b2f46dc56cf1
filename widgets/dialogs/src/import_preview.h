#pragma once

#include <QTableWidget>

#include "lorica/base/issue.h"

namespace lorica::dialogs {

/// What was understood of the files, and what is wrong with them.
class ImportPreview : public QTableWidget {
 public:
  explicit ImportPreview(QWidget* parent = nullptr);
  /// What is wrong comes first.
  void showIssues(const base::Issues& issues);
};

}  // namespace lorica::dialogs
