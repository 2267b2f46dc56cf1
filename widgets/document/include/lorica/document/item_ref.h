#pragma once

#include <string>

namespace lorica::document {

enum class ItemKind { study, body, region, organ, system, piece, pose, source, run };

/// One thing of the project by its name, which is unique within its kind. Names survive undo, pointers would not.
/// The study and the body are named by their kind alone: their name is empty. The pose `rest` is a pose. A run's name
/// is that of its RunRecord.
struct ItemRef {
  ItemKind kind = ItemKind::study;
  std::string name;
  bool operator==(const ItemRef&) const = default;
};

}  // namespace lorica::document
