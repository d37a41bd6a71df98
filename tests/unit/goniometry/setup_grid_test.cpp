#include "emulator/goniometry/setup_grid.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "emulator/goniometry/calibration_plan.hpp"
#include "emulator/goniometry/instrument_file.hpp"
#include "tests/unit/goniometry/simulated_spectra.hpp"
#include "tests/unit/message_of.hpp"
#include "tests/unit/temporary_folder.hpp"

namespace gonio::test {
namespace {

/// Black glass at 60 deg as the paper's set-up sees it without noise.
SetupModel exact(const Instrument& planted, MirrorReference reference = MirrorReference::source) {
  const Unknown unknown{.instrument = planted,
                        .spectra = {unmeasured(shipped_family("black_glass_n1567"), "60")},
                        .free = {},
                        .reference = reference};
  const SetupModel model = unknown.model();
  std::vector<CalibrationSpectrum> spectra = unknown.spectra;
  spectra.front().spectrum.reflectance = model(Eigen::VectorXd(0));
  return {shipped_instrument("paper_setup"),
          std::move(spectra),
          {},
          reference,
          std::make_shared<ApertureIntegrator>()};
}

const GridAxes sizes{.angle_offsets = {degrees(-0.5), degrees(0.0), degrees(0.5)},
                     .sources = {degrees(4.2), degrees(4.7), degrees(5.2)},
                     .receptors = {degrees(4.2), degrees(4.7), degrees(5.2)},
                     .patches = {3072, 49152, 196608}};

TEST(TryGrid, HasTheSmallestErrorAtThePlantedSetUp) {
  const SetupGrid grid = try_grid(exact(shipped_instrument("paper_setup")), sizes, std::nullopt);
  EXPECT_EQ(grid.rows.size(), size_of(sizes));
  EXPECT_LT(grid.as_built.rmse, 1e-8);
  const GridRow& best = grid.best(std::nullopt);
  EXPECT_EQ(best.angle_offset, degrees(0.0));
  EXPECT_EQ(best.source, degrees(4.7));
  EXPECT_EQ(best.receptor, degrees(4.7));
  EXPECT_LT(best.rmse, 1e-8);
}

TEST(TryGrid, FindsThatAReceptorIsToBeAtLeastAsLargeAsTheSource) {
  // [Mihalik], section 7.1. Where the mirror is seen through the same receptor its size cancels.
  const GridFindings by_source =
      findings_of(try_grid(exact(shipped_instrument("paper_setup")), sizes, std::nullopt));
  EXPECT_GT(by_source.receptor_smaller, 1e3 * by_source.receptor_at_least_source + 1e-3);
  const GridFindings by_receptor = findings_of(try_grid(
      exact(shipped_instrument("paper_setup"), MirrorReference::receptor), sizes, std::nullopt));
  EXPECT_LT(by_receptor.receptor_smaller, 1e-4);
}

TEST(TryGrid, GainsNothingByFurtherSubdivision) {
  // [Mihalik], section 7.1, of 196,608 patches. By numbers: spectra with an error as theirs.
  SetupModel model = exact(shipped_instrument("paper_setup"));
  std::vector<CalibrationSpectrum> spectra = model.spectra();
  constexpr double error_of_paper = 0.0058;
  spectra.front().spectrum.reflectance.head(8) += error_of_paper;
  spectra.front().spectrum.reflectance.tail(8) -= error_of_paper;
  const SetupModel measured(model.instrument(), spectra, {}, MirrorReference::source,
                            std::make_shared<ApertureIntegrator>());
  const SetupGrid grid = try_grid(measured, sizes, 196608);
  constexpr double printed_to = 5e-5;
  EXPECT_NEAR(grid.as_built.rmse, error_of_paper, printed_to);
  const GridFindings found = findings_of(grid);
  ASSERT_EQ(found.subdivisions.size(), 4u);
  ASSERT_TRUE(found.enough_patches.has_value());
  EXPECT_LE(*found.enough_patches, 196608);
}

TEST(TryGrid, RefusesASubdivisionThatIsNone) {
  GridAxes axes = sizes;
  axes.patches = {1000};
  const SetupModel model = exact(shipped_instrument("paper_setup"));
  EXPECT_EQ(message_of([&] { (void)try_grid(model, axes, std::nullopt); }),
            "expected a number of patches 3 N^2, N a multiple of 4, found 1000");
  EXPECT_EQ(patch_resolution(196608), 256);
  EXPECT_EQ(patch_resolution(3 * 255 * 255), std::nullopt);
}

TEST(CalibrationPlan, OfThePaperIsShipped) {
  const CalibrationPlan plan =
      load_calibration_plan(find_calibration_plan("paper_7_1", shipped()), shipped());
  EXPECT_EQ(plan.patches, 196608);
  EXPECT_EQ(plan.geometries, std::vector<std::string>{"60"});
  EXPECT_EQ(plan.grid.sources.size(), 5u);
  EXPECT_NEAR(plan.grid.sources[2].degrees(), 4.7, 1e-12);
  const Instrument paper = load_instrument(plan.instrument, shipped());
  EXPECT_EQ(as_built(paper, "60", SetupQuantity::source_diameter)->value, degrees(4.7));
  EXPECT_EQ(as_built(paper, "60", SetupQuantity::receptor_diameter)->value, degrees(4.7));
}

TEST(CalibrationPlan, SaysWhereAFileIsWrong) {
  const TemporaryFolder folder;
  const auto refusal = [&](const std::string& line) {
    const auto path = folder.file(
        "p.yaml",
        "schema: gonio/calibration/1\nid: p\ntitle: P\ninstrument: paper_setup\nsample: "
        "black_glass_n1567\n" +
            line + "\n");
    const std::string message = message_of([&] { (void)load_calibration_plan(path, shipped()); });
    return message.substr(message.find("p.yaml"));
  };
  EXPECT_EQ(refusal("integrator: {patches: 1000}"),
            "p.yaml:6:23: integrator.patches: expected a number of patches 3 N^2, N a multiple of "
            "4, e.g. 196608, found '1000'");
  EXPECT_EQ(refusal("grid: {source: {from: 1 deg, to: 2 deg, step: 0.3 deg}, receptor: [1 deg]}"),
            "p.yaml:6:16: grid.source: expected `to` a whole number of steps above `from`, 1000 at "
            "most, found 'a map'");
}

TEST(InstrumentYaml, IsReadBackAsTheSameSetUp) {
  const GridRow row{
      .angle_offset = degrees(0.25), .source = degrees(4.2), .receptor = degrees(5.0)};
  Instrument instrument = with_setup(shipped_instrument("paper_setup"), {"60"}, row);
  instrument = with_quantity(std::move(instrument), "60", SetupQuantity::theta_i,
                             {.value = degrees(60.2345), .expanded_uncertainty = degrees(0.012)});
  const TemporaryFolder folder;
  const Instrument read = load_instrument(
      folder.file("i.yaml", instrument_yaml(instrument, "mine", "of \"spectra\"")), shipped());
  EXPECT_EQ(read.id, "mine");
  EXPECT_EQ(read.notes, "of \"spectra\"");
  const auto theta_i = as_built(read, "60", SetupQuantity::theta_i);
  EXPECT_NEAR(theta_i->value.degrees(), 60.2345, 1e-6);
  EXPECT_NEAR(theta_i->expanded_uncertainty.degrees(), 0.012, 1e-6);
  EXPECT_NEAR(as_built(read, "60", SetupQuantity::theta_r)->value.degrees(), 60.25, 1e-6);
  EXPECT_NEAR(as_built(read, "60", SetupQuantity::receptor_diameter)->value.degrees(), 5.0, 1e-6);
  EXPECT_NEAR(as_built(read, "20", SetupQuantity::source_diameter)->value.degrees(), 4.7, 1e-6);
}

}  // namespace
}  // namespace gonio::test
