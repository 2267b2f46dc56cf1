#pragma once

/// \file
/// Judges JSON by a JSON Schema (draft 2020-12), as far as the study's schema uses it. Throws on a keyword it does not
/// know, so that no rule of the schema goes unread.

#include "json_text.h"

namespace lorica::test {

class SchemaValidator {
 public:
  explicit SchemaValidator(study::Json schema) : schema_(std::move(schema)) {}

  const study::Json& schema() const { return schema_; }
  bool accepts(const study::Json& value) const { return accepts(schema_, value); }

 private:
  bool accepts(const study::Json& rule, const study::Json& value) const;
  bool obeys(const std::string& keyword, const study::Json& rule, const study::Json& value) const;
  bool membersObey(const study::Json& rule, const study::Json& value) const;
  std::size_t countAccepting(const study::Json& rules, const study::Json& value) const;

  study::Json schema_;
};

/// Of resources/schema/study.schema.json.
const SchemaValidator& studySchema();

}  // namespace lorica::test
