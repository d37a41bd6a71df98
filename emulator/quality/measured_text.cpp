#include "emulator/quality/measured_text.hpp"

#include <algorithm>
#include <utility>

#include "emulator/core/input_error.hpp"
#include "emulator/core/text_file.hpp"
#include "emulator/core/unicode.hpp"

namespace gonio {

namespace {

constexpr int largest_file_mib = 1024;

}  // namespace

std::string read_measured_text(const std::filesystem::path& file) {
  const SourceMark mark{.file = file.string()};
  std::string text = read_text_file(file, largest_file_mib);
  if (text.starts_with("\xFE\xFF")) {
    throw InputError(mark, "UTF-8, or UTF-16 with its low byte first",
                     "UTF-16 with its high byte first");
  }
  if (text.starts_with("\xFF\xFE")) {
    auto converted = utf8_from_utf16(std::string_view(text).substr(2));
    if (!converted) {
      throw InputError(mark, "UTF-16, as its byte order mark says", "half a character");
    }
    text = std::move(*converted);
  }
  if (const auto bad = find_bad_text(text)) {
    const TextPlace place = place_in_text(text, bad->position);
    throw InputError({.file = file.string(), .line = place.line, .column = place.column},
                     "text in UTF-8, or in UTF-16 with a byte order mark", bad->what);
  }
  return text;
}

char delimiter_of(std::string_view text) {
  const std::size_t first = std::min(text.find_first_not_of("\r\n"), text.size());
  bool quoted = false;
  bool semicolon = false;
  bool comma = false;
  for (const char c : text.substr(first)) {
    quoted = quoted != (c == '"');
    if (quoted) {
      continue;
    }
    if (c == '\t' || c == '\n') {
      return c == '\t' || !(semicolon || comma) ? '\t' : semicolon ? ';' : ',';
    }
    semicolon = semicolon || c == ';';
    comma = comma || c == ',';
  }
  return semicolon ? ';' : comma ? ',' : '\t';
}

}  // namespace gonio
