#include "import_parts.h"

#include <QHeaderView>
#include <QTableWidget>

namespace lorica::dialogs {

namespace fs = std::filesystem;

fs::path pathOf(const QString& text) {
  return fs::path(text.toStdU16String());
}

QString textOf(const fs::path& path) {
  return QString::fromStdU16String(path.generic_u16string());
}

void makeCalm(QTableWidget& table) {
  table.verticalHeader()->hide();
  table.setShowGrid(false);
  table.setSelectionBehavior(QAbstractItemView::SelectRows);
  table.setEditTriggers(QAbstractItemView::NoEditTriggers);
  table.horizontalHeader()->setHighlightSections(false);
  table.horizontalHeader()->setDefaultAlignment(Qt::AlignLeft | Qt::AlignVCenter);
  table.setTextElideMode(Qt::ElideMiddle);
}

}  // namespace lorica::dialogs
