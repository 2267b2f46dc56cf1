#pragma once

#include <QFontMetrics>
#include <QStringList>
#include <QWidget>

class QVBoxLayout;

namespace lorica::gui {

/// A recent file so that two of one name can be told apart: its name, then its folder, cut in its middle where it is
/// longer than `width` pixels.
QString recentText(const QString& file, const QFontMetrics& metrics, int width);

/// What the window shows before a study is open.
class WelcomePage : public QWidget {
  Q_OBJECT

 public:
  explicit WelcomePage(QWidget* parent = nullptr);
  void setRecentFiles(const QStringList& files);

 Q_SIGNALS:
  void openRequested();
  void humanRequested();
  void importRequested();
  void sampleRequested();
  void fileRequested(const QString& file);

 private:
  QVBoxLayout* recent_;
};

}  // namespace lorica::gui
