#pragma once

namespace lorica::gui {

/// How the program looks on every desktop: Qt's Fusion style, buttons of dialogs without the style's icons, the
/// program's own icon. \pre there is a QApplication
void useOwnLook();

}  // namespace lorica::gui
