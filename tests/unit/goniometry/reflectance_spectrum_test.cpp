#include "emulator/goniometry/reflectance_spectrum.hpp"

#include <gtest/gtest.h>

#include <utility>

#include "tests/unit/message_of.hpp"
#include "tests/unit/temporary_folder.hpp"

namespace gonio::test {
namespace {

ReflectanceSpectrum spectrum(const char* geometry, Eigen::ArrayXd u = {}) {
  return {.geometry = geometry,
          .wavelength_nm = Eigen::ArrayXd::LinSpaced(2, 400.0, 500.0),
          .reflectance = Eigen::ArrayXd::LinSpaced(2, 0.1, 0.2),
          .u = std::move(u)};
}

/// What is said of a file of that text, without the folder.
std::string refusal_of(std::string_view text) {
  const TemporaryFolder folder;
  const auto path = folder.file("s.csv", text);
  std::string message = message_of([&] { (void)load_reflectance_spectra(path); });
  return message.substr(message.find("s.csv"));
}

TEST(ReflectanceSpectraCsv, HasAColumnForEachGeometryAndUncertainty) {
  EXPECT_EQ(
      reflectance_spectra_csv({spectrum("20"), spectrum("60", Eigen::ArrayXd::Constant(2, 0.01))}),
      "wavelength_nm,20,60,u_60\n400,0.1,0.1,0.01\n500,0.2,0.2,0.01\n");
}

TEST(ReflectanceSpectraCsv, LeavesCellsEmptyWhereASpectrumHasNoValue) {
  auto other = spectrum("60", Eigen::ArrayXd::Constant(2, 0.01));
  other.wavelength_nm(1) = 501.0;
  EXPECT_EQ(reflectance_spectra_csv({spectrum("20"), other}),
            "wavelength_nm,20,60,u_60\n400,0.1,0.1,0.01\n500,0.2,,\n501,,0.2,0.01\n");
}

TEST(LoadReflectanceSpectra, ReadsBackWhatWasWrittenToTheLastBit) {
  auto other = spectrum("60", Eigen::ArrayXd::Constant(2, 1.0 / 7.0));
  other.wavelength_nm(1) = 501.0 + 1.0 / 3.0;
  other.reflectance(0) = 0.1 + 1e-17 / 3.0;
  const TemporaryFolder folder;
  const auto spectra = load_reflectance_spectra(
      folder.file("s.csv", reflectance_spectra_csv({spectrum("20"), other})));
  ASSERT_EQ(spectra.size(), 2u);
  EXPECT_EQ(spectra[0].geometry, "20");
  EXPECT_EQ(spectra[0].u.size(), 0);
  EXPECT_TRUE((spectra[0].reflectance == spectrum("20").reflectance).all());
  EXPECT_EQ(spectra[1].geometry, "60");
  EXPECT_TRUE((spectra[1].wavelength_nm == other.wavelength_nm).all());
  EXPECT_TRUE((spectra[1].reflectance == other.reflectance).all());
  EXPECT_TRUE((spectra[1].u == other.u).all());
  EXPECT_EQ(spectra[1].mark.line, 1);
  EXPECT_EQ(spectra[1].mark.column, 18);
}

TEST(LoadReflectanceSpectra, TakesColumnsInAnyOrderAndComments) {
  const TemporaryFolder folder;
  const auto spectra = load_reflectance_spectra(
      folder.file("s.csv", "# of a glass\nu_60, 60 ,wavelength_nm\n0.01,0.1,400\n,,410\n"));
  ASSERT_EQ(spectra.size(), 1u);
  EXPECT_EQ(spectra[0].wavelength_nm.size(), 1);
  EXPECT_EQ(spectra[0].u(0), 0.01);
}

TEST(LoadReflectanceSpectra, SaysWhereAFileIsWrong) {
  EXPECT_EQ(refusal_of("# nothing\n"), "s.csv: expected a header and a spectrum, found 'none'");
  EXPECT_EQ(refusal_of("wavelength_nm,60\n"), "s.csv: expected a spectrum, found 'none'");
  EXPECT_EQ(refusal_of("lambda,60\n400,0.1\n"),
            "s.csv:1:1: expected a column wavelength_nm, found 'lambda'");
  EXPECT_EQ(refusal_of("wavelength_nm\n400\n"),
            "s.csv:1:1: expected a column of a geometry, found 'none'");
  EXPECT_EQ(refusal_of("wavelength_nm,\n400,1\n"),
            "s.csv:1:15: expected the name of a column, found nothing");
  EXPECT_EQ(refusal_of("wavelength_nm,60,60\n400,1,1\n"),
            "s.csv:1:18: expected each column once, found '60 a second time'");
  EXPECT_EQ(refusal_of("wavelength_nm,60,u_20\n400,1,1\n"),
            "s.csv:1:18: expected an uncertainty of a geometry that has a column, found 'u_20'");
  EXPECT_EQ(refusal_of("wavelength_nm,60\n400\n"), "s.csv:2:1: expected 2 cells, found '1 cells'");
  EXPECT_EQ(refusal_of("wavelength_nm,60\n400,a\n"), "s.csv:2:5: 60: expected a number, found 'a'");
  EXPECT_EQ(refusal_of("wavelength_nm,60\n-4,1\n"),
            "s.csv:2:1: wavelength_nm: expected a number > 0, found '-4'");
  EXPECT_EQ(refusal_of("wavelength_nm,60\n400,1\n400,1\n"),
            "s.csv:3:1: wavelength_nm: expected more than the wavelength before, 400, found '400'");
  EXPECT_EQ(refusal_of("wavelength_nm,60,u_60\n400,1,0\n"),
            "s.csv:2:7: u_60: expected a number > 0, found '0'");
  EXPECT_EQ(refusal_of("wavelength_nm,60,u_60\n400,1,\n"),
            "s.csv:2:7: u_60: expected a number > 0, found nothing");
  EXPECT_EQ(refusal_of("wavelength_nm,60\n400,\n"),
            "s.csv:1:15: 60: expected a value at one wavelength at least, found 'none'");
}

}  // namespace
}  // namespace gonio::test
