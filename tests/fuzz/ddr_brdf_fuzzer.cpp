// Input: the text of a file.

#include <cstdint>
#include <string_view>

#include "emulator/measured/ddr_brdf.hpp"
#include "tests/fuzz/brdf_checks.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  gonio::test::require_brdf_or_refusal([&] { return gonio::parse_ddr(text, "file"); });
  return 0;
}
