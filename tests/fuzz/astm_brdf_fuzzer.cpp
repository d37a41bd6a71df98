// Input: the text of a file.

#include <cstdint>
#include <string_view>
#include <vector>

#include "emulator/measured/astm_brdf.hpp"
#include "emulator/measured/sampled_brdf.hpp"
#include "tests/fuzz/brdf_checks.hpp"

namespace {

using gonio::BrdfSamples;
using gonio::test::require;

void require_same(const BrdfSamples& samples, const BrdfSamples& again) {
  require(again.channels == samples.channels, "the channels written");
  require(again.notes.size() == samples.notes.size(), "the notes written");
  require((again.theta_i == samples.theta_i).all() && (again.phi_i == samples.phi_i).all() &&
              (again.theta_r == samples.theta_r).all() && (again.phi_r == samples.phi_r).all(),
          "the angles written");
  require((again.f_r == samples.f_r).all(), "the f_r written");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    const BrdfSamples samples = gonio::parse_astm(text, "file");
    require_same(samples, gonio::parse_astm(gonio::astm_text(samples), "again"));
    std::vector<std::string> warnings;
    gonio::test::require_brdf(gonio::SampledBrdf(samples, warnings));
  } catch (const gonio::InputError&) {
    return 0;
  }
  return 0;
}
