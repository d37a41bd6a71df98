#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "emulator/standard/standard.hpp"
#include "tests/unit/message_of.hpp"
#include "tests/unit/standard/shipped_standards.hpp"
#include "tests/unit/temporary_folder.hpp"

// What a standard of one's own may have wrong, and the place and the words of the message.

namespace gonio {
namespace {

using test::message_of;
using test::replaced;
using test::TemporaryFolder;
using test::user_standard;

/// The message for a file with this text, without the file's name.
std::string error_of(const std::string& text) {
  const TemporaryFolder folder;
  const auto file = folder.file("standard.yaml", text);
  const std::string message = message_of([&] { (void)load_standard(file); });
  return message.starts_with(file.string()) ? message.substr(file.string().size()) : message;
}

std::string error_with(const std::string& from, const std::string& to) {
  return error_of(replaced(user_standard(), from, to));
}

const std::string theta_i = "    theta_i: {nominal: 60 deg,";

TEST(StandardErrors, OfKeys) {
  EXPECT_EQ(error_with("edition: first\n", "edition: first\ncolour: red\n"),
            ":5:1: colour: expected one of the keys edition, flop, geometries, haze, id, notes, "
            "readings, "
            "rounding, scale, schema, selection, spectral, title, transcription, found 'colour'");
  EXPECT_EQ(error_with("title: House method\n", ""),
            ":1:1: title: expected the key 'title', found 'only schema, id, edition, "
            "transcription, scale, spectral, geometries'");
  EXPECT_EQ(error_with("  unit: GU\n", "  unit: GU\n  unit: GU\n"),
            ":8:3: scale.unit: expected each key once, found 'the key 'unit' a second time'");
  EXPECT_EQ(error_with("gonio/standard/1", "gonio/standard/2"),
            ":1:9: schema: expected gonio/standard/1, found 'gonio/standard/2'");
  EXPECT_EQ(error_with("complete", "all"),
            ":5:16: transcription: expected one of partial, complete, found 'all'");
  EXPECT_EQ(error_with("reference_glass", "glass"),
            ":8:16: scale.relative_to: expected one of reference_glass, incident_flux, "
            "perfect_diffuser, found "
            "'glass'");
  EXPECT_EQ(error_with("level: C2", "level: C9"),
            ":9:43: scale.value.evidence.level: expected one of C2, C1+calc, C1, calc, memory, "
            "memory-low, found 'C9'");
}

TEST(StandardErrors, OfAngles) {
  const std::string key =
      ":20:24: geometries[0].theta_i.nominal: expected an angle (deg, rad, mrad)";
  EXPECT_EQ(error_with(theta_i, "    theta_i: {nominal: 60,"), key + " in [0, 90), found '60'");
  EXPECT_EQ(error_with(theta_i, "    theta_i: {nominal: 60 nm,"),
            key + " in [0, 90), found '60 nm'");
  EXPECT_EQ(error_with(theta_i, "    theta_i: {nominal: 90 deg,"),
            key + " in [0, 90), found '90 deg'");
  EXPECT_EQ(error_with(theta_i, "    theta_i: {nominal: nan deg,"),
            key + " in [0, 90), found 'nan deg'");
  EXPECT_EQ(
      error_with(theta_i, "    theta_i: {nominal: 60 deg, tolerance: -0.1 deg,"),
      ":20:43: geometries[0].theta_i.tolerance: expected an angle (deg, rad, mrad) > 0, found "
      "'-0.1 deg'");
  EXPECT_EQ(error_with("0.75 deg", "0 deg"),
            ":22:27: geometries[0].source.in_plane.nominal: expected an angle (deg, rad, mrad) in "
            "(0, 120], found '0 deg'");
}

TEST(StandardErrors, OfNumbers) {
  EXPECT_EQ(error_with("nominal: 100,", "nominal: 0,"),
            ":9:20: scale.value.nominal: expected a number > 0, found '0'");
  EXPECT_EQ(error_with("nominal: 1.567,", "nominal: .nan,"),
            ":10:31: scale.refractive_index.nominal: expected a number in (0, 1000], found '.nan'");
}

TEST(StandardErrors, OfAnApertureThatIsRoundAndNot) {
  EXPECT_EQ(error_with("    receptor:\n",
                       "    receptor:\n"
                       "      diameter: {nominal: 5 deg, evidence: {level: C2, sources: []}}\n"),
            ":26:7: geometries[0].receptor.in_plane: expected one of the keys diameter, found "
            "'in_plane'");
}

TEST(StandardErrors, OfASpectrumThatIsNotThere) {
  const TemporaryFolder folder;
  const std::string missing = (folder.path() / "missing.csv").string();
  const std::string message =
      error_with((test::source_tree / "fixtures/illuminants/c.csv").string(), missing);
  EXPECT_THAT(message, testing::ContainsRegex(
                           ":1[0-9]:[0-9]+: spectral.source.file: expected a file, found '"));
  EXPECT_THAT(message, testing::HasSubstr("found '" + missing.substr(0, 20)));
}

TEST(StandardErrors, OfGeometriesThatOthersName) {
  EXPECT_EQ(error_with(theta_i, "    relative_to: \"20\"\n" + theta_i),
            ":1:1: expected names of the geometries 60, found '20'");
  const std::string rules = "selection:\n  first: \"60\"\n  rules:\n    - ";
  const std::string evidence = ", evidence: {level: C2, sources: []}}\n";
  EXPECT_EQ(error_of(user_standard() + rules + "{geometry: \"20\", when_above: 70 GU" + evidence),
            ":1:1: expected names of the geometries 60, found '20'");
  EXPECT_EQ(error_of(user_standard() + rules + "{geometry: \"60\", when_above: 70" + evidence),
            ":30:36: selection.rules[0].when_above: expected a gloss value (GU), found '70'");
  EXPECT_EQ(error_of(user_standard() + rules + "{geometry: \"60\"" + evidence),
            ":30:7: selection.rules[0].when_below: expected the key 'when_below', found 'only "
            "geometry, evidence'");
  EXPECT_EQ(error_of(user_standard() + rules +
                     "{geometry: \"60\", when_above: 70 GU, when_below: 10 GU" + evidence),
            ":30:43: selection.rules[0].when_below: expected one of the keys evidence, geometry, "
            "when_above, found 'when_below'");
  EXPECT_EQ(error_of(user_standard() + "haze:\n  - {id: h, from: \"60\", minus: \"20\"" + evidence),
            ":1:1: expected names of the geometries 60, found '20'");
}

TEST(StandardErrors, OfAGeometryThatStandsTwice) {
  const std::string text = user_standard();
  const std::string geometry = text.substr(text.find("  - id"));
  EXPECT_EQ(error_of(text + geometry),
            ":27:5: geometries[1]: expected each geometry once, found '60'");
}

TEST(StandardErrors, OfAnEmptyListOfGeometries) {
  const std::string text = user_standard();
  EXPECT_EQ(error_of(text.substr(0, text.find("geometries:")) + "geometries: []\n"),
            ":18:13: geometries: expected a list of at least one item, found 'a list'");
}

}  // namespace
}  // namespace gonio
