#include "emulator/store/names.hpp"

#include <fmt/format.h>

#include <array>

#include "emulator/store/store.hpp"

namespace gonio {
namespace {

template <class Value, std::size_t n>
Value value_of(const std::string& name, const char* what, const std::array<Value, n>& values,
               const char* (*name_of)(Value)) {
  for (const Value value : values) {
    if (name == name_of(value)) {
      return value;
    }
  }
  throw StoreError(fmt::format("the store is damaged: expected {}, found '{}'", what, name));
}

}  // namespace

const char* channel_kind_name(BatchChannel::Kind kind) {
  switch (kind) {
    case BatchChannel::Kind::gloss:
      return "gloss";
    case BatchChannel::Kind::colour_difference:
      return "colour_difference";
    case BatchChannel::Kind::haze:
      break;
  }
  return "haze";
}

RunRecord::Kind run_kind_of(const std::string& name) {
  using Kind = RunRecord::Kind;
  return value_of(name, "a kind of run", std::array{Kind::simulated, Kind::measured},
                  run_kind_name);
}

BatchChannel::Kind channel_kind_of(const std::string& name) {
  using Kind = BatchChannel::Kind;
  return value_of(name, "a kind of channel",
                  std::array{Kind::gloss, Kind::colour_difference, Kind::haze}, channel_kind_name);
}

ConformanceVerdict verdict_of(const std::string& name) {
  using enum ConformanceVerdict;
  return value_of(name, "a verdict",
                  std::array{pass, fail, inconclusive, not_applicable, skipped, error},
                  verdict_name);
}

PanelVerdict panel_verdict_of(const std::string& name) {
  using enum PanelVerdict;
  return value_of(name, "a verdict of a panel",
                  std::array{accepted, more_readings, not_uniform, rejected}, panel_verdict_name);
}

}  // namespace gonio
