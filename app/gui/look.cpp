#include "look.h"

#include <QApplication>
#include <QIcon>
#include <QProxyStyle>

// Q_INIT_RESOURCE declares a function, and must not do so in a namespace.
static void initIcon() {
  Q_INIT_RESOURCE(icon);
}

namespace lorica::gui {

namespace {

class OwnStyle final : public QProxyStyle {
 public:
  OwnStyle() : QProxyStyle(QStringLiteral("Fusion")) {}
  int styleHint(StyleHint hint, const QStyleOption* option, const QWidget* widget,
                QStyleHintReturn* back) const override {
    if (hint == SH_DialogButtonBox_ButtonsHaveIcons) {
      return 0;
    }
    return QProxyStyle::styleHint(hint, option, widget, back);
  }
};

}  // namespace

void useOwnLook() {
  QApplication::setStyle(new OwnStyle);
  initIcon();
  QApplication::setWindowIcon(QIcon(QStringLiteral(":/lorica.svg")));
}

}  // namespace lorica::gui
