#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace gonio {

/// A cell of a table in text form.
struct DelimitedCell {
  std::string text;  ///< without the quotes, or the blanks, around it
  int line = 1;      ///< of its first character
  int column = 1;    ///< counted in characters
};

/// Calls row(cells) for each row that is not blank. Lines end in LF or CRLF. A cell may stand in
/// quotes, and then hold the delimiter, line breaks and doubled quotes. @see RFC 4180
/// @param text  UTF-8.   @param file  stands in messages.
/// @throws InputError  for a quote that is not closed, or with more than blanks after it.
void for_each_delimited_row(std::string_view text, char delimiter, const std::string& file,
                            const std::function<void(const std::vector<DelimitedCell>&)>& row);

}  // namespace gonio
