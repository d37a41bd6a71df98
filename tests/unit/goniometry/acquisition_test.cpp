#include "emulator/goniometry/acquisition.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "emulator/uncertainty/random.hpp"
#include "tests/unit/message_of.hpp"
#include "tests/unit/temporary_folder.hpp"

namespace gonio::test {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;

const std::filesystem::path source_tree(GONIO_SOURCE_DIR);

Counts counts_of(const ArrayXd& axis, Eigen::ArrayXXd repeats, const std::string& file = "c.csv") {
  return {.axis = axis, .repeats = std::move(repeats), .mark = {.file = file}};
}

/// Twenty pixels of 1 nm: dark 100, mirror 10,100 in 0.01 s, sample 5100 in 0.05 s: the ratio 0.1.
Acquisition plain() {
  const ArrayXd axis = ArrayXd::LinSpaced(20, 400.5, 419.5);
  const auto flat = [&](double value, const char* file) {
    return counts_of(axis, Eigen::ArrayXXd::Constant(20, 1, value), file);
  };
  return {.id = "plain",
          .title = "Plain",
          .wavelength_nm = axis,
          .grid = WavelengthGrid(nanometres(402.5), nanometres(5), 4),
          .darks = {{.counts = flat(100, "d1"), .time_s = 0.01},
                    {.counts = flat(100, "d2"), .time_s = 0.05}},
          .geometries = {{.id = "60",
                          .mirror = {.counts = flat(10100, "m"), .time_s = 0.01},
                          .sample = {.counts = flat(5100, "s"), .time_s = 0.05},
                          .mirror_dark = 0,
                          .sample_dark = 1}}};
}

TEST(Acquire, IsTheRatioOfNetCountsByTime) {
  const AcquisitionResult result = acquire(plain());
  ASSERT_EQ(result.spectra.size(), 1u);
  const AcquiredSpectrum& one = result.spectra.front();
  EXPECT_TRUE(one.spectrum.reflectance.isApproxToConstant(0.1, 1e-12));
  EXPECT_EQ(one.spectrum.wavelength_nm.size(), 4);
  EXPECT_EQ(one.spectrum.u.size(), 0) << "one repeat says nothing of noise";
  EXPECT_EQ(result.noise, NoiseModel::none);
}

TEST(Acquire, MultipliesByTheReflectanceOfTheMirror) {
  Acquisition acquisition = plain();
  acquisition.mirror_reflectance =
      SpectralTable(ArrayXd::LinSpaced(2, 400.0, 420.0), ArrayXd::Constant(2, 0.9), {});
  EXPECT_TRUE(
      acquire(acquisition).spectra.front().spectrum.reflectance.isApproxToConstant(0.09, 1e-12));
}

TEST(Acquire, PropagatesTheNoiseOfTheDetector) {
  Acquisition acquisition = plain();
  acquisition.detector.read_noise = 20.0;
  acquisition.detector.electrons_per_count = 2.0;
  const AcquiredSpectrum one = acquire(acquisition).spectra.front();
  // By hand: variance 400 + counts / 2 of a reading, of which five make a band.
  const double s = (400.0 + 5100.0 / 2.0) / 5.0;
  const double m = (400.0 + 10100.0 / 2.0) / 5.0;
  const double d = (400.0 + 100.0 / 2.0) / 5.0;
  const double of_sample = (s + d) / (5000.0 * 5000.0);
  const double of_mirror = (m + d) / (10000.0 * 10000.0);
  EXPECT_NEAR(one.spectrum.u(0), 0.1 * std::sqrt(of_sample + of_mirror), 1e-12);
  EXPECT_NEAR(one.sample_share + one.mirror_share + one.dark_share, 1.0, 1e-12);
}

TEST(Acquire, CountsADarkThatBothShareOnce) {
  Acquisition acquisition = plain();
  acquisition.detector.read_noise = 20.0;
  AcquiredGeometry& geometry = acquisition.geometries.front();
  geometry.sample = {.counts = geometry.mirror.counts, .time_s = 0.01};
  geometry.sample_dark = 0;
  const AcquiredSpectrum one = acquire(acquisition).spectra.front();
  EXPECT_TRUE(one.shares_dark);
  EXPECT_NEAR(one.spectrum.reflectance(0), 1.0, 1e-12);
  EXPECT_NEAR(one.dark_share, 0.0, 1e-12) << "it cancels in a ratio of 1";
}

TEST(Acquire, LeavesOutSaturatedPixelsAndCountsThem) {
  Acquisition acquisition = plain();
  acquisition.detector.linear_up_to = 60000.0;
  Eigen::ArrayXXd& sample = acquisition.geometries.front().sample.counts.repeats;
  sample(2, 0) = 65535.0;
  sample(7, 0) = 61000.0;
  const AcquiredSpectrum one = acquire(acquisition).spectra.front();
  EXPECT_EQ(one.saturated, 1u);
  EXPECT_EQ(one.beyond_linear, 1u);
  EXPECT_TRUE(one.spectrum.reflectance.isApproxToConstant(0.1, 1e-12));
  sample.setConstant(65535.0);
  EXPECT_NE(message_of([&] { (void)acquire(acquisition); }).find("linear range"),
            std::string::npos);
}

TEST(Acquire, RefusesAMirrorWithoutLight) {
  Acquisition acquisition = plain();
  acquisition.geometries.front().mirror.counts.repeats.setConstant(100.0);
  EXPECT_NE(message_of([&] { (void)acquire(acquisition); }).find("light of the mirror"),
            std::string::npos);
}

/// How often rho is within 2 u of what was planted, over pixels and trials.
double share_within_2u(Index repeats) {
  constexpr std::uint64_t seed = 6;
  constexpr std::uint64_t trials = 200;
  constexpr double sigma = 30.0;
  std::size_t within = 0;
  std::size_t all = 0;
  for (std::uint64_t trial = 0; trial < trials; ++trial) {
    Acquisition acquisition = plain();
    std::uint64_t stream = 0;
    const auto noisy = [&](Counts& counts) {
      const double mean = counts.repeats(0, 0);
      counts.repeats.resize(20, repeats);
      Draws(seed, trial, stream++)
          .normal({counts.repeats.data(), std::size_t(counts.repeats.size())});
      counts.repeats = (mean + sigma * counts.repeats).round();
    };
    for (TimedCounts& dark : acquisition.darks) {
      noisy(dark.counts);
    }
    noisy(acquisition.geometries.front().mirror.counts);
    noisy(acquisition.geometries.front().sample.counts);
    const AcquiredSpectrum one = acquire(acquisition).spectra.front();
    for (Index j = 0; j < one.spectrum.u.size(); ++j) {
      within += std::abs(one.spectrum.reflectance(j) - 0.1) < 2.0 * one.spectrum.u(j) ? 1 : 0;
      ++all;
    }
  }
  return double(within) / double(all);
}

TEST(Acquire, StatesAnUncertaintyThatHolds) {
  // 800 bands: 95.4 % are within 2 u of a normal; 3 standard deviations of that count are 2.2 %.
  constexpr double chance = 0.022;
  EXPECT_NEAR(share_within_2u(3), 0.954, chance) << "pooled";
  EXPECT_NEAR(share_within_2u(12), 0.954, chance) << "of each pixel";
}

TEST(LoadAcquisition, ReadsTheShippedExample) {
  const AcquisitionResult result = acquire(
      load_acquisition(source_tree / "fixtures/measured/black_glass_spectra/acquisition.yaml"));
  ASSERT_EQ(result.spectra.size(), 3u);
  EXPECT_EQ(result.noise, NoiseModel::pooled);
  const double planted[] = {0.049093, 0.101471, 0.602427};
  for (std::size_t i = 0; i < 3; ++i) {
    const ReflectanceSpectrum& spectrum = result.spectra[i].spectrum;
    const ArrayXd weight = spectrum.u.square().inverse();
    const double mean = (weight * spectrum.reflectance).sum() / weight.sum();
    EXPECT_NEAR(mean, planted[i], 4.0 / std::sqrt(weight.sum())) << spectrum.geometry;
  }
  EXPECT_GT(result.spectra[2].saturated, 0u);
}

/// A folder with an acquisition of two pixels whose YAML has one line in place of another.
std::string refusal_with(const std::string& line, const std::string& instead) {
  const TemporaryFolder folder;
  (void)folder.file("c.csv", "0,100\n1,200\n");
  (void)folder.file("other.csv", "0,100\n2,200\n");
  std::string text =
      "schema: gonio/acquisition/1\nid: a\ntitle: A\ndetector: {saturation: 65535}\n"
      "wavelength_calibration: [400, 400]\n"
      "darks: [{counts: c.csv, integration_time: 10 ms}]\n"
      "geometries:\n  \"60\":\n    mirror: {counts: c.csv, integration_time: 10 ms}\n"
      "    sample: {counts: c.csv, integration_time: 10 ms}\n";
  text.replace(text.find(line), line.size(), instead);
  const auto path = folder.file("a.yaml", text);
  const std::string message = message_of([&] { (void)load_acquisition(path); });
  const std::size_t slash = message.rfind(folder.path().string());
  return slash == std::string::npos ? message
                                    : message.substr(slash + folder.path().string().size() + 1);
}

TEST(LoadAcquisition, SaysWhereAFileIsWrong) {
  EXPECT_EQ(refusal_with("    sample: {counts: c.csv, integration_time: 10 ms}",
                         "    sample: {counts: c.csv, integration_time: 20 ms}"),
            "a.yaml:10:13: geometries.60.sample: expected an integration time that has a dark, "
            "found '0.02 s'");
  EXPECT_EQ(refusal_with("[400, 400]", "[400, -1]"),
            "a.yaml:5:25: wavelength_calibration: expected wavelengths > 0 nm that ascend with the "
            "pixels, found '400 to 399 nm'");
  EXPECT_EQ(refusal_with("{saturation: 65535}", "{saturation: 65535, gain: 2}"),
            "a.yaml:4:31: detector.gain: expected one of the keys electrons_per_count, "
            "linear_up_to, read_noise, saturation, found 'gain'");
}

}  // namespace
}  // namespace gonio::test
