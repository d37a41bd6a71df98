#pragma once

#include <string>
#include <string_view>

// Text of others, made harmless for the form it goes into.

namespace gonio {

/// Text alone: bytes that are no UTF-8 become U+FFFD, control characters other than tab and line
/// break vanish, and so do the two codes that XML forbids.
[[nodiscard]] std::string clean_text(std::string_view text);
/// Clean text in one line: each run of white space becomes one space, none at the ends.
[[nodiscard]] std::string one_line(std::string_view text);
/// Clean text for the content of an XML or HTML element, or for an attribute in double quotes.
/// Line breaks and tabs are written as references, which attributes keep.
[[nodiscard]] std::string xml_text(std::string_view text);
/// One line for a cell of a table or for a paragraph, after its first word, in Markdown: nothing
/// in it is markup.
[[nodiscard]] std::string markdown_text(std::string_view text);

/// One line for a string of CSS in double quotes: what is no letter, digit or space stands there by
/// its number.
[[nodiscard]] std::string css_text(std::string_view text);

}  // namespace gonio
