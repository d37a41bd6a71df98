#include "emulator/measured/brdf_file.hpp"

#include <stdexcept>

#include "emulator/measured/astm_brdf.hpp"
#include "emulator/measured/ddr_brdf.hpp"
#include "emulator/measured/merl_brdf.hpp"
#include "emulator/measured/rgl_brdf.hpp"
#include "emulator/measured/sampled_brdf.hpp"
#include "emulator/measured/zemax_brdf.hpp"

namespace gonio {

namespace {

BrdfFile astm_file(const std::filesystem::path& path) {
  const BrdfSamples samples = read_astm(path);
  BrdfFile result{.file = path, .format = BrdfFormat::astm, .brdf = nullptr};
  if (const auto name = samples.notes.find("SAMPLE_NAME"); name != samples.notes.end()) {
    result.description = name->second;
  }
  result.brdf = std::make_shared<SampledBrdf>(samples, result.warnings);
  return result;
}

}  // namespace

std::string_view brdf_format_name(BrdfFormat format) {
  switch (format) {
    case BrdfFormat::rgl:
      return "RGL";
    case BrdfFormat::merl:
      return "MERL";
    case BrdfFormat::astm:
      return "ASTM E1392";
    case BrdfFormat::zemax:
      return "Zemax";
    case BrdfFormat::ddr:
      return "Integra DDR";
  }
  return "";
}

BrdfFile load_brdf(const std::filesystem::path& path) {
  switch (brdf_format(path)) {
    case BrdfFormat::astm:
      return astm_file(path);
    case BrdfFormat::zemax:
      return read_zemax(path);
    case BrdfFormat::ddr:
      return read_ddr(path);
    case BrdfFormat::rgl:
      return read_rgl(path);
    case BrdfFormat::merl:
      return read_merl(path);
  }
  throw std::logic_error("a format without a reader");
}

}  // namespace gonio
