#include "welcome_page.h"

#include <QDir>
#include <QFileInfo>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>
#include <algorithm>

namespace lorica::gui {

namespace {

constexpr int recentWidth = 420;

}  // namespace

QString recentText(const QString& file, const QFontMetrics& metrics, int width) {
  const QFileInfo info(file);
  QString folder = QDir::toNativeSeparators(info.absolutePath());
  const QString home = QDir::toNativeSeparators(QDir::homePath());
  if (folder == home || folder.startsWith(home + QDir::separator())) {
    folder.replace(0, home.size(), QStringLiteral("~"));
  }
  const QString head = info.fileName() + QStringLiteral("   ");
  return head +
         metrics.elidedText(folder, Qt::ElideMiddle, std::max(width / 3, width - metrics.horizontalAdvance(head)));
}

WelcomePage::WelcomePage(QWidget* parent) : QWidget(parent) {
  auto* outer = new QVBoxLayout(this);
  auto* column = new QVBoxLayout;
  column->setSpacing(8);
  auto* title = new QLabel(tr("Lorica"));
  QFont large = title->font();
  large.setPointSizeF(2.0 * large.pointSizeF());
  title->setFont(large);
  title->setAlignment(Qt::AlignHCenter);
  column->addWidget(title);
  auto* text =
      new QLabel(tr("Which part of a person does this armor cover, in which task, and how sure are we?\n"
                    "Open a study, or drop a study or the files of a body, its organs and armor here."));
  text->setAlignment(Qt::AlignHCenter);
  column->addWidget(text);
  column->addSpacing(12);
  const auto button = [&](const QString& label, auto signal) {
    auto* made = new QPushButton(label);
    connect(made, &QPushButton::clicked, this, signal);
    column->addWidget(made);
  };
  button(tr("Open the sample study"), &WelcomePage::sampleRequested);
  button(tr("New study with the built-in human..."), &WelcomePage::humanRequested);
  button(tr("Open a study..."), &WelcomePage::openRequested);
  button(tr("Import a body, organs and armor..."), &WelcomePage::importRequested);
  column->addSpacing(12);
  recent_ = new QVBoxLayout;
  recent_->setSpacing(2);
  column->addLayout(recent_);
  outer->addStretch(2);
  auto* row = new QHBoxLayout;
  row->addStretch();
  row->addLayout(column);
  row->addStretch();
  outer->addLayout(row);
  outer->addStretch(3);
}

void WelcomePage::setRecentFiles(const QStringList& files) {
  while (QLayoutItem* item = recent_->takeAt(0)) {
    delete item->widget();
    delete item;
  }
  if (files.isEmpty()) {
    return;
  }
  recent_->addWidget(new QLabel(tr("Recent studies")));
  for (const QString& file : files) {
    auto* link = new QPushButton;
    link->setText(recentText(file, link->fontMetrics(), recentWidth).replace('&', QLatin1String("&&")));
    link->setFlat(true);
    link->setToolTip(file);
    link->setStyleSheet(QStringLiteral("text-align: left"));
    connect(link, &QPushButton::clicked, this, [this, file] { Q_EMIT fileRequested(file); });
    recent_->addWidget(link);
  }
}

}  // namespace lorica::gui
