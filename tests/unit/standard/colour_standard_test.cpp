#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "emulator/standard/standard.hpp"
#include "tests/unit/message_of.hpp"
#include "tests/unit/standard/shipped_standards.hpp"
#include "tests/unit/temporary_folder.hpp"

// What standards of colour state beyond those of gloss.

namespace gonio {
namespace {

using test::message_of;
using test::replaced;
using test::shipped_standard;
using test::TemporaryFolder;
using test::user_standard;

Standard load_text(const std::string& text) {
  const TemporaryFolder folder;
  return load_standard(folder.file("standard.yaml", text));
}

/// A user's standard of colour with that receptor.
std::string with_receptor(const std::string& receptor) {
  const std::string text = replaced(
      replaced(user_standard(), "relative_to: reference_glass", "relative_to: perfect_diffuser"),
      "  refractive_index: {nominal: 1.567, evidence: {level: C2, sources: []}}\n", "");
  return text.substr(0, text.find("    receptor:\n")) + "    receptor: " + receptor + "\n";
}

const std::string flop =
    "flop:\n"
    "  near: \"60\"\n"
    "  face: \"60\"\n"
    "  far: \"60\"\n"
    "  factor: {nominal: 2.69, evidence: {level: C1, sources: []}}\n"
    "  power: {nominal: 1.11, evidence: {level: memory, sources: []}}\n"
    "  face_power: {nominal: 0.86, evidence: {level: C2, sources: []}}\n";

TEST(ColourStandard, IsRelativeToThePerfectDiffuser) {
  EXPECT_TRUE(load_text(with_receptor("{collects: hemisphere}")).scale.is_of_colour());
  EXPECT_FALSE(load_text(user_standard()).scale.is_of_colour());
  EXPECT_FALSE(shipped_standard("astm_c346/87").scale.is_of_colour());
}

TEST(SphereReceptor, HasATrapOrNone) {
  constexpr double rounding = 1e-12;
  const ApertureLimits whole =
      load_text(with_receptor("{collects: hemisphere}")).geometries.front().receptor;
  EXPECT_TRUE(whole.is_sphere);
  EXPECT_FALSE(whole.diameter);
  EXPECT_TRUE(whole.is_known());
  const ApertureLimits trapped =
      load_text(with_receptor("{collects: hemisphere, trap: {nominal: 8 deg, evidence: {level: C1, "
                              "sources: []}}}"))
          .geometries.front()
          .receptor;
  EXPECT_TRUE(trapped.is_sphere);
  EXPECT_NEAR(trapped.diameter->known().nominal.degrees(), 8.0, rounding);
  EXPECT_FALSE(load_text(with_receptor("{collects: hemisphere, trap: unknown}"))
                   .geometries.front()
                   .receptor.is_known());
  EXPECT_FALSE(load_text(user_standard()).geometries.front().receptor.is_sphere);
}

TEST(SphereReceptor, IsRefusedWhereItMakesNoSense) {
  const auto error = [](const std::string& text) {
    return message_of([&] { (void)load_text(text); });
  };
  EXPECT_THAT(error(with_receptor("{collects: sphere}")),
              testing::HasSubstr("receptor.collects: expected one of hemisphere, found 'sphere'"));
  EXPECT_THAT(error(with_receptor("{collects: hemisphere, diameter: unknown}")),
              testing::HasSubstr("receptor.diameter: expected one of the keys collects, trap"));
  EXPECT_THAT(error(replaced(user_standard(), "    source:\n      in_plane",
                             "    source:\n      collects: hemisphere\n      in_plane")),
              testing::HasSubstr("source.collects: expected one of the keys"));
}

TEST(FlopRule, IsReadWithTheWeakestEvidenceOfItsNumbers) {
  const Standard standard = load_text(with_receptor("{collects: hemisphere}") + flop);
  ASSERT_TRUE(standard.flop);
  EXPECT_EQ(standard.flop->factor.nominal, 2.69);
  EXPECT_EQ(standard.flop->power.nominal, 1.11);
  EXPECT_EQ(standard.flop->face_power.nominal, 0.86);
  EXPECT_EQ(standard.flop->evidence().level, "memory");
}

TEST(FlopRule, NamesGeometriesOfItsStandard) {
  EXPECT_THAT(message_of([] {
                (void)load_text(with_receptor("{collects: hemisphere}") +
                                replaced(flop, "far: \"60\"", "far: \"110\""));
              }),
              testing::HasSubstr("expected names of the geometries 60, found '110'"));
}

}  // namespace
}  // namespace gonio
