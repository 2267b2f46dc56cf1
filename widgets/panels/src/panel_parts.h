#pragma once

/// \file
/// Small things that the panels have in common.

#include <QKeySequence>
#include <QString>
#include <QStringList>
#include <functional>

class QComboBox;
class QTableView;
class QWidget;

namespace lorica::panels {

inline constexpr int panelMargin = 6;

/// A page that says why there is nothing to see.
QWidget* makeEmptyPage(const QString& text, QWidget* parent);

/// A combo box that a long entry does not make wide; the list it opens shows entries whole.
QComboBox* makeChoice(const QString& tip, QWidget* parent);

/// A calm table: whole rows, no grid, no wrapping.
QTableView* makeTable(QWidget* parent);

/// Entries of a combo box; keeps what was chosen when it is still there. \param all a first entry without data, or
/// empty
void refill(QComboBox& combo, const QStringList& entries, const QString& all = {});

/// The same of organ models: entries are names as files have them, what is seen is the window's.
void refillModels(QComboBox& combo, const QStringList& names, const QString& all = {});

/// Does something when a key is pressed in a widget, before any shortcut of the window gets it.
void onKey(QWidget& widget, QKeySequence::StandardKey key, std::function<void()> action);

}  // namespace lorica::panels
