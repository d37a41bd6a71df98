// Input: the beginning of a file.

#include <cstdint>
#include <string_view>

#include "emulator/measured/brdf_file.hpp"
#include "tests/fuzz/require.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view beginning(reinterpret_cast<const char*>(data), size);
  const auto format = gonio::brdf_format_of(beginning, size);
  gonio::test::require(format != gonio::BrdfFormat::rgl || beginning.starts_with("tensor_file"),
                       "an RGL file begins with its name");
  gonio::test::require(!format || size >= 4, "some text");
  return 0;
}
