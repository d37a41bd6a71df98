#include "emulator/core/input_error.hpp"

#include <fmt/format.h>

#include <utility>

namespace gonio {

namespace {

constexpr std::size_t longest_quote = 80;

std::string quoted(const std::string& found) {
  if (found == "nothing") {
    return found;
  }
  std::string text = found.substr(0, longest_quote);
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < ' ' || c == '\x7f') {
      c = ' ';
    }
  }
  return fmt::format("'{}{}'", text, found.size() > longest_quote ? "..." : "");
}

}  // namespace

std::string SourceMark::text() const {
  std::string result = file;
  if (line > 0) {
    result += fmt::format(":{}:{}", line, column);
  }
  if (!key.empty()) {
    result += ": " + key;
  }
  return result;
}

InputError::InputError(SourceMark mark, const std::string& expected, const std::string& found)
    : std::runtime_error(
          fmt::format("{}: expected {}, found {}", mark.text(), expected, quoted(found))),
      mark_(std::move(mark)) {}

}  // namespace gonio
