#pragma once

/// \file
/// JSON text to a tree, strict where a person's mistake would else be silent: errors with line and column, no key
/// twice, no bottomless nesting.

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace lorica::study {

/// Objects keep the order of their keys.
using Json = nlohmann::ordered_json;

/// Levels a text may nest; a study needs eight.
inline constexpr std::size_t deepestNesting = 32;

/// \param file how errors name the text
/// \throw base::InputError with line and column (syntax) or JSON pointer (a key twice, too deep)
Json parseJson(std::string_view text, const std::string& file);

/// `key` or an index as one more step of a JSON pointer; control characters are escaped, very long keys cut.
std::string pointerStep(std::string_view key);

/// Text in quotes for an error of one line: control characters are escaped, long text is cut.
std::string inQuotes(std::string_view text);

}  // namespace lorica::study
