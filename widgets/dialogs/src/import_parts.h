#pragma once

/// \file
/// What the parts of the import dialog have in common.

#include <QString>
#include <filesystem>

class QTableWidget;

namespace lorica::dialogs {

std::filesystem::path pathOf(const QString& text);
/// With '/' between folders.
QString textOf(const std::filesystem::path& path);
/// Whole rows, no grid, nothing to edit but what is put into cells.
void makeCalm(QTableWidget& table);

}  // namespace lorica::dialogs
