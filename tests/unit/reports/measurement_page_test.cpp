#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "emulator/core/text_file.hpp"
#include "reports/measurement_report.hpp"
#include "tests/unit/procedure/laboratory.hpp"
#include "tests/unit/reports/fake_gnuplot.hpp"
#include "tests/unit/reports/hostile_report.hpp"

namespace gonio {
namespace {

using testing::HasSubstr;
using testing::Not;

const WavelengthGrid two_wavelengths(nanometres(500), nanometres(50), 2);

/// A made-up measurement of one geometry.
Measurement measurement(const std::string& sample) {
  Measurement made{.sample = sample, .sample_title = sample};
  made.geometries.push_back({.id = "60",
                             .theta_i = degrees(60),
                             .reading = {.gloss = 41.0188,
                                         .quadrature_error = 1.5e-7,
                                         .luminous_reflectance = 0.25,
                                         .reflectance = Eigen::ArrayXd::LinSpaced(2, 0.125, 0.375)},
                             .colour = {},
                             .evidence = {.level = "memory", .sources = {}}});
  made.selected_geometry = "60";
  return made;
}

std::string page_of(const std::vector<Measurement>& measurements,
                    const std::vector<std::vector<Footprint>>& footprints,
                    const std::string& instrument = "Some instrument") {
  const Standard standard = test::shipped_standard("iso_2813/2014");
  return measurement_page({.standard = standard,
                           .instrument = instrument,
                           .integrator = "aperture",
                           .reference = "reference glass",
                           .grid = two_wavelengths},
                          measurements, footprints);
}

/// How often a text stands in another.
std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++count;
  }
  return count;
}

TEST(MeasurementPage, ShowsReadingsAsReportedAndAsComputed) {
  const std::string page = page_of({measurement("a")}, {{}});
  EXPECT_THAT(page, HasSubstr("<td class=\"number\">41</td><td class=\"number\">41.0188</td>"));
  EXPECT_THAT(page, HasSubstr("60 (selected)"));
  EXPECT_THAT(page, HasSubstr("rests on numbers known only from memory"));
}

TEST(MeasurementPage, HasAChartOfSpectraForEachSampleAndOneForEachFootprint) {
  const std::string page =
      page_of({measurement("a"), measurement("b")},
              {{test::example_footprint("20"), test::example_footprint("60")}, {}});
  EXPECT_EQ(count_of(page, "<svg"), 4u);
  EXPECT_EQ(count_of(page, "No footprint: "), 1u);
}

TEST(MeasurementPage, HoldsHostileTextAsTextAndLetsNobodyRunIt) {
  const test::TemporaryFolder folder;
  const auto trace = folder.path() / "trace";
  const std::string text = test::hostile_text(trace);
  Footprint footprint = test::example_footprint("60");
  test::spoil(footprint, text);
  Measurement hostile = measurement(text);
  hostile.geometries.front().id = text;
  const std::string page = page_of({hostile}, {{footprint}}, text);
  EXPECT_THAT(page, Not(HasSubstr("<script")));
  EXPECT_THAT(page, HasSubstr("&lt;script&gt;"));
  EXPECT_FALSE(std::filesystem::exists(trace));
}

TEST(MeasurementPage, TellsGnuplotNothingButNumbers) {
  const test::FakeGnuplot recorder("cat >> $here/scripts; echo '<svg></svg>'");
  Footprint footprint = test::example_footprint("60");
  test::spoil(footprint, "hostileword");
  (void)page_of({measurement("hostileword")}, {{footprint}});
  const std::string scripts = read_text_file(recorder.folder() / "scripts");
  EXPECT_THAT(scripts, HasSubstr("$curves << END_OF_NUMBERS\n"));
  EXPECT_THAT(scripts, Not(HasSubstr("hostileword")));
}

}  // namespace
}  // namespace gonio
