// Input: a file of MERL, with counts that fit it.

#include <cstdint>

#include "emulator/core/input_error.hpp"
#include "emulator/measured/merl_brdf.hpp"
#include "tests/fuzz/measured_fuzzer.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto bytes = std::as_bytes(std::span(data, size));
  const bool is_named = gonio::is_merl(bytes, size);
  try {
    gonio::test::check(gonio::parse_merl(bytes, "input"));
    gonio::test::require(is_named, "what can be read is found by its content");
  } catch (const gonio::InputError&) {
    return 0;
  }
  return 0;
}
