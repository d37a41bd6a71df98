// Input: a tensor file of the RGL.

#include <cmath>
#include <cstdint>

#include "emulator/core/input_error.hpp"
#include "emulator/measured/rgl_brdf.hpp"
#include "tests/fuzz/measured_fuzzer.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    gonio::test::check(gonio::parse_rgl(std::as_bytes(std::span(data, size)), "input"));
  } catch (const gonio::InputError&) {
    return 0;
  }
  return 0;
}
