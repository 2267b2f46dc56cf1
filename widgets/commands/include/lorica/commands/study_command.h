#pragma once

/// \file
/// Commands: the only way to change the study. Each is named for the undo menu, holds names and values, never
/// pointers into the study. Property edits are ChangeValue (drags merge, edits that end where they began vanish);
/// structural ones are ReplaceStudy.

#include <QUndoCommand>
#include <QUndoStack>
#include <functional>
#include <utility>

#include "lorica/document/study_document.h"

namespace lorica::commands {

/// Base of all: carries out an edit at the document.
class StudyCommand : public QUndoCommand {
 protected:
  StudyCommand(document::StudyDocument& document, document::Changes what, const QString& text)
      : QUndoCommand(text), document_(document), what_(what) {}

  void apply(const std::function<void(study::Study&)>& change) { document_.edit(document::EditKey(), what_, change); }
  const study::Study& study() const { return document_.study(); }

 private:
  document::StudyDocument& document_;
  document::Changes what_;
};

/// A value somewhere in the study, found by names.
template <class Value>
struct Property {
  QString id;  ///< which property of which thing; edits of equal ids in a row merge
  document::Changes what;
  std::function<Value(const study::Study&)> get;
  std::function<void(study::Study&, const Value&)> set;
};

/// Whether edits of one property in a row become one.
enum class Merge { no, yes };

template <class Value>
class ChangeValue final : public StudyCommand {
 public:
  ChangeValue(document::StudyDocument& document, Property<Value> property, Value value, const QString& text,
              Merge merge)
      : StudyCommand(document, property.what, text),
        property_(std::move(property)),
        before_(property_.get(document.study())),
        after_(std::move(value)),
        merge_(merge) {
    setObsolete(before_ == after_);
  }

  void undo() override {
    apply([this](study::Study& study) { property_.set(study, before_); });
  }
  void redo() override {
    apply([this](study::Study& study) { property_.set(study, after_); });
  }
  int id() const override { return merge_ == Merge::yes ? mergeId : -1; }
  bool mergeWith(const QUndoCommand* other) override {
    const auto* next = dynamic_cast<const ChangeValue*>(other);
    if (next == nullptr || next->property_.id != property_.id || next->text() != text()) {
      return false;
    }
    after_ = next->after_;
    setObsolete(before_ == after_);
    return true;
  }

 private:
  static constexpr int mergeId = 1;
  Property<Value> property_;
  Value before_;
  Value after_;
  Merge merge_;
};

/// Pushes the edit unless the property has the value already.
/// \param text what the undo menu says, e.g. "Colour of heart"
template <class Value>
void change(document::StudyDocument& document, Property<Value> property, Value value, const QString& text,
            Merge merge = Merge::no) {
  if (property.get(document.study()) == value) {
    return;
  }
  document.undoStack().push(new ChangeValue<Value>(document, std::move(property), std::move(value), text, merge));
}

/// Swaps the whole study: for edits that add, remove or rename.
class ReplaceStudy final : public StudyCommand {
 public:
  ReplaceStudy(document::StudyDocument& document, study::Study after, document::Changes what, const QString& text);
  void undo() override;
  void redo() override;

 private:
  study::Study before_;
  study::Study after_;
};

}  // namespace lorica::commands
