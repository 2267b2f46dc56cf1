#include "lorica/commands/study_command.h"

namespace lorica::commands {

ReplaceStudy::ReplaceStudy(document::StudyDocument& document, study::Study after, document::Changes what,
                           const QString& text)
    : StudyCommand(document, what, text), before_(document.study()), after_(std::move(after)) {}

void ReplaceStudy::undo() {
  apply([this](study::Study& study) { study = before_; });
}

void ReplaceStudy::redo() {
  apply([this](study::Study& study) { study = after_; });
}

}  // namespace lorica::commands
