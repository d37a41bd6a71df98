// Gloss of polished copper in the three geometries of ISO 2813: against a plain loop over nodes of
// both apertures, and 81 wavelengths against one.

#include <fmt/format.h>

#include <complex>
#include <stdexcept>

#include "emulator/optics/fresnel.hpp"
#include "emulator/optics/refractive_index.hpp"
#include "tests/benchmarks/compare.hpp"
#include "tests/benchmarks/data.hpp"
#include "tests/benchmarks/plain_lobe.hpp"

namespace gonio::bench {

namespace {

constexpr double speedup_target = 50.0;
constexpr double wavelengths_target = 1.3;
constexpr double tolerance_gu = 1e-4;
/// The plain loop is a midpoint rule of few nodes.
constexpr double plain_agreement_gu = 0.5;

/// A direction and what it counts: cos theta times solid angle [sr].
struct Node {
  Vector3 omega;
  double projected;
};

/// Midpoints of equal steps in the tangent plane of an aperture.
std::vector<Node> midpoints(const Aperture& aperture, int count_u, int count_v) {
  const double step_u = (aperture.u_high() - aperture.u_low()) / count_u;
  const double step_v = (aperture.v_high() - aperture.v_low()) / count_v;
  std::vector<Node> nodes;
  for (int a = 0; a < count_u; ++a) {
    const double u = aperture.u_low() + (a + 0.5) * step_u;
    for (int b = 0; b < count_v; ++b) {
      const double v = aperture.v_low() + (b + 0.5) * step_v;
      const Vector3 omega = aperture.frame().direction(u, v);
      const double length2 = 1.0 + u * u + v * v;
      nodes.push_back({omega, omega.z() * step_u * step_v / (length2 * std::sqrt(length2))});
    }
  }
  return nodes;
}

struct PlainSample {
  double rms_slope;
  std::complex<double> n_hat;
};

/// Eq. (16) and (17) of one geometry at one wavelength, as two loops over nodes. Fresnel's formula
/// is the library's for one pair, in real arithmetic: std::complex would double the time.
double plain_gloss(const PlainSample& sample, double reference_index,
                   const MeasuringGeometry& geometry) {
  const std::vector<Node> source = midpoints(geometry.source, 12, 24);
  const std::vector<Node> receptor = midpoints(geometry.receptor, 40, 40);
  double flux = 0.0;
  double reference = 0.0;
  for (const Node& i : source) {
    double sum = 0.0;
    for (const Node& r : receptor) {
      const double cos_d = std::sqrt(0.5 * (1.0 + i.omega.dot(r.omega)));
      sum += plain_cook_torrance(sample.rms_slope, i.omega, r.omega) *
             fresnel_reflectance(std::min(cos_d, 1.0), sample.n_hat) * r.projected;
    }
    flux += sum * i.projected;
    if (geometry.receptor.contains(mirrored(i.omega))) {
      reference += fresnel_reflectance(i.omega.z(), reference_index) * i.projected;
    }
  }
  return 100.0 * flux / reference;
}

/// The library's gloss in all three geometries.
double sum_of_gloss(const Glossmeter& glossmeter, const Surface& surface) {
  double sum = 0.0;
  for (const GeometryLimits& geometry : glossmeter.instrument().standard.geometries) {
    sum += glossmeter.read(surface, geometry.id, tolerance_gu).gloss;
  }
  return sum;
}

void expect_agreement(double plain, const GlossReading& reading) {
  if (std::abs(plain - reading.gloss) > plain_agreement_gu ||
      reading.quadrature_error > tolerance_gu) {
    throw std::runtime_error(
        fmt::format("the plain loop gives {:.4f} GU, the library {:.6f} GU +- {:.1e} GU", plain,
                    reading.gloss, reading.quadrature_error));
  }
}

void against_plain_loop(benchmark::State& state) {
  const WavelengthGrid grid = WavelengthGrid::visible();
  const Sample copper = sample("copper_polished", grid);
  const Glossmeter glossmeter = nominal_glossmeter(grid);
  const Instrument& instrument = glossmeter.instrument();
  const PlainSample plain{
      .rms_slope = 0.065,
      .n_hat =
          RefractiveIndex::load(catalog().fixture("nk/main/Cu/Johnson.yml")).at(nanometres(555))};
  const double reference_index = instrument.standard.scale.refractive_index->nominal;

  const Glossmeter green_glossmeter = nominal_glossmeter(one_wavelength());
  const Sample green_copper = sample("copper_polished", one_wavelength());
  std::vector<MeasuringGeometry> geometries;
  for (const GeometryLimits& limits : instrument.standard.geometries) {
    geometries.push_back(instrument.geometry(limits.id));
    expect_agreement(plain_gloss(plain, reference_index, geometries.back()),
                     green_glossmeter.read(green_copper.surface, limits.id, tolerance_gu));
  }
  compare(
      state, speedup_at_least(speedup_target),
      [&] {
        for (const MeasuringGeometry& geometry : geometries) {
          benchmark::DoNotOptimize(plain_gloss(plain, reference_index, geometry));
        }
      },
      [&] { benchmark::DoNotOptimize(sum_of_gloss(glossmeter, copper.surface)); });
}
BENCHMARK(against_plain_loop)->Unit(benchmark::kMillisecond);

void wavelengths_81_against_1(benchmark::State& state) {
  const Glossmeter one_glossmeter = nominal_glossmeter(one_wavelength());
  const Glossmeter all_glossmeter = nominal_glossmeter(WavelengthGrid::visible());
  const Sample one = sample("copper_polished", one_glossmeter.grid());
  const Sample all = sample("copper_polished", all_glossmeter.grid());
  compare(
      state, cost_at_most(wavelengths_target),
      [&] { benchmark::DoNotOptimize(sum_of_gloss(one_glossmeter, one.surface)); },
      [&] { benchmark::DoNotOptimize(sum_of_gloss(all_glossmeter, all.surface)); });
}
BENCHMARK(wavelengths_81_against_1)->Unit(benchmark::kMillisecond);

}  // namespace

}  // namespace gonio::bench
