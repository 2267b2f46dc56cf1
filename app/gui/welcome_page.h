#pragma once

#include <QStringList>
#include <QWidget>

class QVBoxLayout;

namespace lorica::gui {

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
