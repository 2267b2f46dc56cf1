#include "lorica/base/issue.h"

#include <iterator>

namespace lorica::base {

const char* name(Severity severity) {
  switch (severity) {
    case Severity::note:
      return "note";
    case Severity::warning:
      return "warning";
    case Severity::error:
      return "error";
  }
  return "error";
}

std::string Issue::line() const {
  std::string where = file;
  if (!place.empty()) {
    where += where.empty() ? place : ":" + place;
  }
  return (where.empty() ? "" : where + ": ") + name(severity) + ": " + text;
}

void append(Issues& issues, Issues more) {
  issues.insert(issues.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

}  // namespace lorica::base
