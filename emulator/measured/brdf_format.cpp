#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "emulator/core/input_error.hpp"
#include "emulator/core/text_file.hpp"
#include "emulator/measured/brdf_file.hpp"
#include "emulator/measured/merl_brdf.hpp"
#include "emulator/measured/rgl_brdf.hpp"
#include "emulator/measured/word_reader.hpp"

namespace gonio {

namespace {

/// First words of lines that only one of the formats has.
constexpr std::array<std::pair<std::string_view, BrdfFormat>, 11> telling_words{
    {{"VARS", BrdfFormat::astm},
     {"NUM_POINTS", BrdfFormat::astm},
     {"TypeSym", BrdfFormat::ddr},
     {"TypeColorModel", BrdfFormat::ddr},
     {"TypeData", BrdfFormat::ddr},
     {"SpectralContent", BrdfFormat::zemax},
     {"ScatterType", BrdfFormat::zemax},
     {"SampleRotation", BrdfFormat::zemax},
     {"AngleOfIncidence", BrdfFormat::zemax},
     {"ScatterAzimuth", BrdfFormat::zemax},
     {"ScatterRadial", BrdfFormat::zemax}}};

std::optional<BrdfFormat> text_format(std::string_view head) {
  for (std::size_t begin = 0; begin < head.size();) {
    const std::size_t end = std::min(head.find('\n', begin), head.size());
    std::string_view line = head.substr(begin, end - begin);
    line.remove_prefix(std::min(line.find_first_not_of(" \t\r"), line.size()));
    const Word first{.text = line.substr(0, line.find_first_of(" \t\r"))};
    for (const auto& [word, format] : telling_words) {
      if (first.is(word)) {
        return format;
      }
    }
    begin = end + 1;
  }
  return std::nullopt;
}

/// What of a file tells its format.
std::string head_of(const std::filesystem::path& path) {
  constexpr std::size_t most = std::size_t(1) << 16;
  std::ifstream in(path, std::ios::binary);
  if (!in) {
    throw InputError({.file = path.string()}, "a file that may be read", "no permission");
  }
  std::string head(most, '\0');
  in.read(head.data(), std::streamsize(most));
  head.resize(std::size_t(in.gcount()));
  return head;
}

std::string shown(std::string_view head) {
  constexpr std::size_t most = 16;
  std::string text(head.substr(0, std::min(head.find('\n'), most)));
  std::ranges::replace_if(
      text, [](unsigned char c) { return c < ' ' || c > '~'; }, '.');
  return text.empty() ? "an empty line" : text;
}

}  // namespace

std::optional<BrdfFormat> brdf_format_of(std::string_view beginning, std::uintmax_t size) {
  const auto bytes = std::as_bytes(std::span(beginning));
  if (is_rgl(bytes)) {
    return BrdfFormat::rgl;
  }
  if (is_merl(bytes, size)) {
    return BrdfFormat::merl;
  }
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  return text_format(
      beginning.substr(beginning.starts_with(byte_order_mark) ? byte_order_mark.size() : 0));
}

BrdfFormat brdf_format(const std::filesystem::path& path) {
  if (const std::string there = what_stands_at(path); there != "a file") {
    throw InputError({.file = path.string()}, "a file", there);
  }
  const std::string head = head_of(path);
  if (head.empty()) {
    throw InputError({.file = path.string()}, "a file with content", "an empty file");
  }
  if (const auto format = brdf_format_of(head, std::filesystem::file_size(path))) {
    return *format;
  }
  throw InputError({.file = path.string()},
                   "a measured BRDF: RGL .bsdf, MERL .binary, ASTM E1392 text, Zemax .bsdf or "
                   "Integra .ddr",
                   shown(head));
}

}  // namespace gonio
