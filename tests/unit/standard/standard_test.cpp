#include "emulator/standard/standard.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <stdexcept>
#include <string>

#include "tests/unit/message_of.hpp"
#include "tests/unit/standard/shipped_standards.hpp"
#include "tests/unit/temporary_folder.hpp"

namespace gonio {
namespace {

using test::message_of;
using test::replaced;
using test::shipped_standard;
using test::TemporaryFolder;
using test::user_standard;

constexpr double rounding = 1e-12;  // of deg to rad and back

Standard load_text(const std::string& text) {
  const TemporaryFolder folder;
  return load_standard(folder.file("standard.yaml", text));
}

/// The receptor's perpendicular size written as `value`.
std::string with_receptor_size(const std::string& value) {
  return replaced(user_standard(), "{nominal: 11.7 deg, evidence: {level: C2, sources: []}}",
                  value);
}

TEST(StandardLoad, ReadsWhatTheFileSays) {
  const Standard standard = load_text(user_standard());
  EXPECT_EQ(standard.id, "house/1");
  EXPECT_EQ(standard.title, "House method");
  EXPECT_EQ(standard.edition, "first");
  EXPECT_EQ(standard.transcription, "complete");
  EXPECT_EQ(standard.scale.unit, "GU");
  EXPECT_EQ(standard.scale.reference, Scale::Reference::glass);
  EXPECT_EQ(standard.scale.value.nominal, 100.0);
  EXPECT_EQ(standard.scale.refractive_index->nominal, 1.567);
  EXPECT_FALSE(standard.scale.reference_wavelength);
  ASSERT_EQ(standard.geometries.size(), 1u);
  const GeometryLimits& geometry = standard.geometries.front();
  EXPECT_NEAR(geometry.theta_i.nominal.degrees(), 60.0, rounding);
  EXPECT_FALSE(geometry.theta_i.tolerance);
  EXPECT_NEAR(geometry.receptor.perpendicular->known().nominal.degrees(), 11.7, rounding);
  EXPECT_EQ(geometry.theta_i.mark.line, 20);
  EXPECT_EQ(geometry.receptor.perpendicular->mark.line, 26);
  EXPECT_FALSE(standard.selection);
  EXPECT_FALSE(standard.rounding);
  EXPECT_TRUE(standard.haze.empty());
}

TEST(StandardLoad, TakesTheMirrorDirectionForAReceptorThatTheFileDoesNotPlace) {
  const Standard standard = load_text(user_standard());
  EXPECT_EQ(standard.geometries.front().receptor_angle(),
            standard.geometries.front().theta_i.nominal);
}

TEST(StandardLoad, ReadsAReceptorOnTheSourcesSideOfTheNormal) {
  const Standard standard = load_text(
      replaced(user_standard(), "    source:\n      in_plane",
               "    theta_r: {nominal: -15 deg, tolerance: 0.2 deg, evidence: {level: C1, "
               "sources: []}}\n    source:\n      in_plane"));
  EXPECT_NEAR(standard.geometries.front().receptor_angle().degrees(), -15.0, rounding);
  EXPECT_NEAR(standard.geometries.front().theta_r->tolerance->degrees(), 0.2, rounding);
}

TEST(StandardLoad, ReadsARoundReceptor) {
  const Standard standard =
      load_text(replaced(with_receptor_size("unknown"),
                         "      in_plane: {nominal: 4.4 deg, evidence: {level: C2, sources: []}}\n"
                         "      perpendicular: unknown",
                         "      diameter: {nominal: 5 deg, evidence: {level: C1, sources: []}}"));
  const ApertureLimits& receptor = standard.geometries.front().receptor;
  EXPECT_TRUE(receptor.is_circle());
  EXPECT_NEAR(receptor.diameter->known().nominal.degrees(), 5.0, rounding);
  EXPECT_FALSE(standard.geometries.front().source.is_circle());
}

TEST(StandardUnknownSize, LoadsAndFailsAtItsPlaceOnlyWhenItIsNeeded) {
  const TemporaryFolder folder;
  const auto file = folder.file("standard.yaml", with_receptor_size("unknown"));
  const Standard standard = load_standard(file);
  EXPECT_EQ(message_of([&] { (void)standard.geometries.front().receptor.perpendicular->known(); }),
            file.string() +
                ":26:22: geometries[0].receptor.perpendicular: expected a number, to measure in "
                "this geometry, found 'unknown'");
}

TEST(StandardGeometry, OfAnUnknownIdIsOutOfRange) {
  const Standard standard = load_text(user_standard());
  EXPECT_EQ(standard.geometry("60").id, "60");
  EXPECT_THROW((void)standard.geometry("20"), std::out_of_range);
}

// Evidence.

TEST(Evidence, IsInformativeWhenItRestsOnMemory) {
  for (const char* level : {"C2", "C1+calc", "C1", "calc"}) {
    EXPECT_FALSE(Evidence{.level = level}.is_informative()) << level;
  }
  EXPECT_TRUE(Evidence{.level = "memory"}.is_informative());
  EXPECT_TRUE(Evidence{.level = "memory-low"}.is_informative());
}

TEST(Evidence, OfAGeometryIsThatOfItsWeakestKnownNumber) {
  EXPECT_EQ(load_text(user_standard()).geometries.front().evidence().level, "C2");
  for (const char* level : {"C1+calc", "C1", "calc", "memory", "memory-low"}) {
    const std::string text = with_receptor_size(
        "{nominal: 11.7 deg, evidence: {level: " + std::string(level) + ", sources: []}}");
    EXPECT_EQ(load_text(text).geometries.front().evidence().level, level);
  }
  EXPECT_EQ(load_text(with_receptor_size("unknown")).geometries.front().evidence().level, "C2");
}

TEST(Evidence, OfAGeometryCountsThePlaceOfItsReceptor) {
  const Standard standard = load_text(
      replaced(user_standard(), "    source:\n      in_plane",
               "    theta_r: {nominal: 58 deg, evidence: {level: memory-low, sources: []}}\n"
               "    source:\n      in_plane"));
  EXPECT_EQ(standard.geometries.front().evidence().level, "memory-low");
}

// A geometry of another standard.

TEST(StandardSameAs, EqualsItsOriginInAllButTheId) {
  const Standard haze = shipped_standard("astm_d4039/09");
  const Standard origin = shipped_standard("astm_d523/14");
  for (const char* id : {"20", "60"}) {
    const GeometryLimits& copy = haze.geometry(id);
    const GeometryLimits& original = origin.geometry(id);
    EXPECT_EQ(copy.theta_i.nominal, original.theta_i.nominal);
    EXPECT_EQ(copy.theta_i.tolerance, original.theta_i.tolerance);
    EXPECT_EQ(copy.theta_i.evidence.sources, original.theta_i.evidence.sources);
    EXPECT_EQ(copy.receptor_angle(), original.receptor_angle());
    EXPECT_EQ(copy.source.in_plane->known().nominal, original.source.in_plane->known().nominal);
    EXPECT_EQ(copy.source.perpendicular->known().nominal,
              original.source.perpendicular->known().nominal);
    EXPECT_EQ(copy.receptor.in_plane->known().nominal, original.receptor.in_plane->known().nominal);
    EXPECT_EQ(copy.receptor.perpendicular->known().nominal,
              original.receptor.perpendicular->known().nominal);
    EXPECT_EQ(copy.evidence().level, original.evidence().level);
  }
}

/// user_standard() with a geometry "20" that is the "60" of another standard.
std::string borrower_of(const std::string& standard) {
  return user_standard() + "  - {id: \"20\", same_as: {standard: " + standard +
         ", geometry: \"60\"}}\n";
}

/// Writes <family>/<edition>/standard.yaml.
std::filesystem::path write_standard(const TemporaryFolder& folder, const std::string& id,
                                     const std::string& text) {
  std::filesystem::create_directories(folder.path() / id);
  return folder.file(id + "/standard.yaml", text);
}

TEST(StandardSameAs, IsLookedUpBesideTheFileAndThenInTheCatalog) {
  const TemporaryFolder folder;
  const auto file = write_standard(folder, "house/2", borrower_of("iso_2813/2014"));
  EXPECT_NEAR(load_standard(file, test::shipped()).geometry("20").theta_i.nominal.degrees(), 60.0,
              rounding);
  (void)write_standard(folder, "iso_2813/2014", replaced(user_standard(), "60 deg", "45 deg"));
  EXPECT_NEAR(load_standard(file, test::shipped()).geometry("20").theta_i.nominal.degrees(), 45.0,
              rounding);
}

TEST(StandardSameAs, OfAStandardThatIsNotThereIsAnErrorAtItsPlace) {
  const TemporaryFolder folder;
  const auto file = write_standard(folder, "house/2", borrower_of("house/3"));
  EXPECT_EQ(message_of([&] { (void)load_standard(file); }),
            file.string() +
                ":27:36: geometries[1].same_as.standard: expected a standard file, "
                "found 'house/3'");
}

TEST(StandardSameAs, MayNotLeadBack) {
  const TemporaryFolder folder;
  const auto one = write_standard(folder, "house/1", borrower_of("house/2"));
  const auto two = write_standard(folder, "house/2", borrower_of("house/1"));
  EXPECT_EQ(message_of([&] { (void)load_standard(one); }),
            two.string() +
                ":27:36: geometries[1].same_as.standard: expected a standard that does "
                "not borrow from this one, found 'house/1'");
}

}  // namespace
}  // namespace gonio
