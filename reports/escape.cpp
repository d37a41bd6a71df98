#include "reports/escape.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "emulator/core/unicode.hpp"

namespace gonio {

namespace {

constexpr std::string_view replacement_character = "\xEF\xBF\xBD";

bool is_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; }

/// Bytes of the control character that `text`, which is not empty, begins with; 0 if it does not.
std::size_t control_size(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  if (byte(0) < 0x20 || byte(0) == 0x7F) {
    return 1;
  }
  const bool is_wide = byte(0) == 0xC2 && text.size() > 1 && byte(1) >= 0x80 && byte(1) < 0xA0;
  return is_wide ? 2 : 0;
}

void remove_all(std::string& text, std::string_view what) {
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at)) {
    text.erase(at, what.size());
  }
}

/// An underscore within a word is none but itself: ids stay as they are.
bool is_within_word(std::string_view line, std::size_t at) {
  return at > 0 && at + 1 < line.size() && is_word(line[at - 1]) && is_word(line[at + 1]);
}

}  // namespace

std::string clean_text(std::string_view text) {
  std::string clean;
  for (auto bad = find_bad_text(text); bad; bad = find_bad_text(text)) {
    clean += text.substr(0, bad->position);
    text.remove_prefix(bad->position);
    const std::size_t control = control_size(text);
    clean += control == 0 ? replacement_character : std::string_view();
    text.remove_prefix(std::max(control, std::size_t{1}));
  }
  clean += text;
  remove_all(clean, "\xEF\xBF\xBE");
  remove_all(clean, "\xEF\xBF\xBF");
  return clean;
}

std::string one_line(std::string_view text) {
  std::string line;
  for (const char c : clean_text(text)) {
    const bool is_space = c == ' ' || c == '\t' || c == '\n' || c == '\r';
    if (!is_space) {
      line += c;
    } else if (!line.empty() && line.back() != ' ') {
      line += ' ';
    }
  }
  if (line.ends_with(' ')) {
    line.pop_back();
  }
  return line;
}

std::string xml_text(std::string_view text) {
  std::string escaped;
  for (const char c : clean_text(text)) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      case '\'':
        escaped += "&#39;";
        break;
      case '\t':
        escaped += "&#9;";
        break;
      case '\n':
        escaped += "&#10;";
        break;
      case '\r':
        escaped += "&#13;";
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}

std::string markdown_text(std::string_view text) {
  const std::string line = one_line(text);
  std::string escaped;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    const bool is_markup = std::string_view(R"(\`*[]|~$!)").find(c) != std::string_view::npos ||
                           (c == '_' && !is_within_word(line, i));
    if (c == '<' || c == '>' || c == '&') {
      escaped += c == '<' ? "&lt;" : c == '>' ? "&gt;" : "&amp;";
    } else {
      escaped += is_markup ? std::string{'\\', c} : std::string{c};
    }
  }
  return escaped;
}

std::string css_text(std::string_view text) {
  std::string css;
  for (const char c : one_line(text)) {
    const auto byte = static_cast<unsigned char>(c);
    const bool stays = is_word(c) || c == ' ' || byte >= 0x80;
    css += stays ? std::string(1, c) : fmt::format("\\{:06X} ", byte);
  }
  return css;
}

}  // namespace gonio
