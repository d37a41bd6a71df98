#include "emulator/surface/sample.hpp"

#include "emulator/surface/sample_family.hpp"

namespace gonio {

Sample load_sample(const std::filesystem::path& path, const WavelengthGrid& grid) {
  return SampleFamily::load(path, grid).sample();
}

}  // namespace gonio
