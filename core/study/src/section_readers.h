#pragma once

/// \file
/// Readers of the sections of a study file that stand by themselves. All throw base::InputError with the JSON pointer.

#include <string>

#include "json_node.h"
#include "lorica/study/study.h"

namespace lorica::study {

/// The member `description`, empty when absent.
std::string readDescription(const Node& node);
std::string sha256Text(const Node& node);

Source readSource(const Node& node);

}  // namespace lorica::study
