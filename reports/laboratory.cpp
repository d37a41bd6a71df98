#include "reports/laboratory.hpp"

#include <fmt/format.h>

#include <chrono>
#include <optional>

#include "emulator/core/yaml_map.hpp"

namespace gonio {

namespace {

/// The number that these digits write; nothing if one of them is none.
std::optional<int> digits(const std::string& text) {
  int value = 0;
  for (const char c : text) {
    if (c < '0' || c > '9') {
      return std::nullopt;
    }
    value = 10 * value + (c - '0');
  }
  return value;
}

bool is_date(const std::string& text) {
  constexpr std::size_t length = 10;
  if (text.size() != length || text[4] != '-' || text[7] != '-') {
    return false;
  }
  const auto year = digits(text.substr(0, 4));
  const auto month = digits(text.substr(5, 2));
  const auto day = digits(text.substr(8));
  return year && month && day &&
         std::chrono::year_month_day{std::chrono::year(*year), std::chrono::month(unsigned(*month)),
                                     std::chrono::day(unsigned(*day))}
             .ok();
}

std::string line_of(YamlMap& map, const std::string& key) {
  const auto node = map.optional(key);
  return node ? node->line() : "";
}

std::string text_of(YamlMap& map, const std::string& key) {
  const auto node = map.optional(key);
  return node ? node->text() : "";
}

/// @param earliest  the date before which it cannot be; empty if that is not stated.
std::string date_of(YamlMap& map, const std::string& key, const std::string& earliest) {
  const auto node = map.optional(key);
  if (!node) {
    return "";
  }
  std::string date = node->line();
  if (!is_date(date)) {
    node->fail("a date (YYYY-MM-DD)");
  }
  if (date < earliest) {  // such dates sort as their letters do
    node->fail(fmt::format("a date not before {}", earliest));
  }
  return date;
}

std::vector<std::string> lines_of(YamlMap& map, const std::string& key) {
  std::vector<std::string> lines;
  if (const auto node = map.optional(key)) {
    for (const YamlNode& item : node->list()) {
      lines.push_back(item.line());
    }
  }
  return lines;
}

void read_parts(YamlMap& map, Laboratory& laboratory) {
  if (const auto node = map.optional("laboratory")) {
    node->read_map([&](YamlMap& part) {
      laboratory.name = line_of(part, "name");
      laboratory.address = text_of(part, "address");
      laboratory.accreditation = line_of(part, "accreditation");
      return true;
    });
  }
  if (const auto node = map.optional("environment")) {
    node->read_map([&](YamlMap& part) {
      laboratory.temperature = line_of(part, "temperature");
      laboratory.humidity = line_of(part, "humidity");
      return true;
    });
  }
}

}  // namespace

Laboratory load_laboratory(const std::filesystem::path& file) {
  return YamlNode::load(file).read_map([](YamlMap& map) {
    map.expect_schema("gonio/laboratory/1");
    Laboratory laboratory;
    read_parts(map, laboratory);
    laboratory.certificate_number = line_of(map, "certificate_number");
    laboratory.customer = text_of(map, "customer");
    laboratory.received = date_of(map, "received", "");
    laboratory.calibrated = date_of(map, "calibrated", laboratory.received);
    laboratory.issued = date_of(
        map, "issued", laboratory.calibrated.empty() ? laboratory.received : laboratory.calibrated);
    laboratory.reference_standards = lines_of(map, "reference_standards");
    laboratory.traceability = text_of(map, "traceability");
    laboratory.procedure = text_of(map, "procedure");
    laboratory.signatory = line_of(map, "signatory");
    laboratory.notes = text_of(map, "notes");
    return laboratory;
  });
}

}  // namespace gonio
