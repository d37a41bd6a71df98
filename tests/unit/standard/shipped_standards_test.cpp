#include "tests/unit/standard/shipped_standards.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "emulator/core/yaml_map.hpp"

namespace gonio {
namespace {

using test::ids_of_shipped;
using test::shipped_standard;

TEST(ShippedStandards, AreThese) {
  EXPECT_THAT(
      ids_of_shipped(Catalog::Kind::standard),
      testing::IsSupersetOf({"astm_c346/87", "astm_c584/81", "astm_d2457/13", "astm_d4039/09",
                             "astm_d523/14", "astm_e430/11", "iso_13803/2014", "iso_2813/2014",
                             "iso_7668/2018", "jis_k_5600_4_7/1999", "jis_z_8741/1997",
                             "tappi_t480/om_15", "tappi_t653/om_07"}));
}

TEST(ShippedStandards, HaveTheIdOfTheirFolder) {
  for (const std::string& id : ids_of_shipped(Catalog::Kind::standard)) {
    EXPECT_EQ(shipped_standard(id).id, id);
  }
}

TEST(ShippedStandards, ClaimNoMoreThanAPartialTranscription) {
  for (const std::string& id : ids_of_shipped(Catalog::Kind::standard)) {
    EXPECT_EQ(shipped_standard(id).transcription, "partial") << id;
  }
}

std::vector<Evidence> evidence_of_readings(const Standard& standard) {
  std::vector<Evidence> evidence;
  const auto add = [&](const auto& part) {
    if (part) {
      evidence.push_back(part->evidence);
    }
  };
  if (standard.readings) {
    evidence.push_back(standard.readings->count.evidence);
    add(standard.readings->more);
    add(standard.readings->not_uniform);
    add(standard.readings->reject);
    add(standard.readings->report);
  }
  return evidence;
}

/// Every source that a number of the standard names.
std::set<std::string> sources_of(const Standard& standard) {
  std::set<std::string> sources;
  const auto add = [&](const Evidence& evidence) {
    sources.insert(evidence.sources.begin(), evidence.sources.end());
  };
  add(standard.scale.value.evidence);
  if (standard.scale.refractive_index) {
    add(standard.scale.refractive_index->evidence);
  }
  for (const GeometryLimits& geometry : standard.geometries) {
    add(geometry.theta_i.evidence);
    if (geometry.theta_r) {
      add(geometry.theta_r->evidence);
    }
    for (const ApertureLimits* aperture : {&geometry.source, &geometry.receptor}) {
      for (const auto* size :
           {&aperture->in_plane, &aperture->perpendicular, &aperture->diameter}) {
        if (*size && (*size)->value) {
          add((*size)->value->evidence);
        }
      }
    }
  }
  for (const Evidence& evidence : evidence_of_readings(standard)) {
    add(evidence);
  }
  return sources;
}

TEST(ShippedStandards, NameOnlySourcesThatAreListed) {
  std::set<std::string> listed;
  const YamlNode file = YamlNode::load(test::source_tree / "standards/sources.yaml");
  file.read_map([&](YamlMap& map) {
    map.expect_schema("gonio/sources/1");
    map.required("sources").for_each_entry(
        [&](const std::string& key, const YamlNode&) { listed.insert(key); });
    return true;
  });
  for (const std::string& id : ids_of_shipped(Catalog::Kind::standard)) {
    for (const std::string& source : sources_of(shipped_standard(id))) {
      EXPECT_TRUE(listed.contains(source)) << id << " names " << source;
    }
  }
}

TEST(ShippedStandards, SayMemoryWhereNoSourceIsNamed) {
  for (const std::string& id : ids_of_shipped(Catalog::Kind::standard)) {
    for (const GeometryLimits& geometry : shipped_standard(id).geometries) {
      if (geometry.theta_i.evidence.sources.empty()) {
        EXPECT_TRUE(geometry.theta_i.evidence.is_informative()) << id << " " << geometry.id;
      }
    }
    for (const Evidence& evidence : evidence_of_readings(shipped_standard(id))) {
      EXPECT_TRUE(!evidence.sources.empty() || evidence.is_informative()) << id << " readings";
    }
  }
}

// ASTM D523, Table 1: angle, 2 tan(angle / 2), and that relative to the receptor of 60 deg. All
// digits as printed (a licensed translation that kept them).

struct TableRow {
  const char* element;
  Stated<Angle> loaded;
  double angle_deg, tolerance_deg;
  double size, size_tolerance, relative, relative_tolerance;
};

std::vector<TableRow> table_1() {
  const Standard d523 = shipped_standard("astm_d523/14");
  const ApertureLimits source = d523.geometry("60").source;
  const ApertureLimits at_20 = d523.geometry("20").receptor;
  const ApertureLimits at_60 = d523.geometry("60").receptor;
  const ApertureLimits at_85 = d523.geometry("85").receptor;
  const auto known = [](const std::optional<ApertureSize>& size) { return size->known(); };
  return {{"source in plane", known(source.in_plane), 0.75, 0.25, 0.0131, 0.0044, 0.171, 0.057},
          {"source across", known(source.perpendicular), 2.5, 0.5, 0.0436, 0.0087, 0.568, 0.114},
          {"60 in plane", known(at_60.in_plane), 4.4, 0.1, 0.0768, 0.0018, 1.000, 0.023},
          {"60 across", known(at_60.perpendicular), 11.7, 0.2, 0.2049, 0.0035, 2.668, 0.046},
          {"20 in plane", known(at_20.in_plane), 1.8, 0.05, 0.0314, 0.0009, 0.409, 0.012},
          {"20 across", known(at_20.perpendicular), 3.6, 0.1, 0.0629, 0.0018, 0.819, 0.023},
          {"85 in plane", known(at_85.in_plane), 4.0, 0.3, 0.0698, 0.0052, 0.909, 0.068},
          {"85 across", known(at_85.perpendicular), 6.0, 0.3, 0.1048, 0.0052, 1.365, 0.068}};
}

double size_of(Angle angle) { return 2.0 * std::tan(angle.radians() / 2.0); }

TEST(AstmD523Table1, HasTheAnglesInDegrees) {
  constexpr double rounding = 1e-12;
  for (const TableRow& row : table_1()) {
    EXPECT_NEAR(row.loaded.nominal.degrees(), row.angle_deg, rounding) << row.element;
    EXPECT_NEAR(row.loaded.tolerance->degrees(), row.tolerance_deg, rounding) << row.element;
  }
}

TEST(AstmD523Table1, AgreesWithTwiceTheTangentOfTheHalfAngle) {
  constexpr double printed = 0.51e-4;     // four decimals
  constexpr double difference = 0.56e-4;  // a tolerance seems to be a difference of such sizes
  for (const TableRow& row : table_1()) {
    EXPECT_NEAR(size_of(row.loaded.nominal), row.size, printed) << row.element;
    EXPECT_NEAR(size_of(*row.loaded.tolerance), row.size_tolerance, difference) << row.element;
  }
}

TEST(AstmD523Table1, AgreesWithTheSizesRelativeToTheReceptorOfSixtyDegrees) {
  constexpr double printed = 1.1e-3;  // three decimals, of sizes that were rounded before
  const double unit = size_of(degrees(4.4));
  for (const TableRow& row : table_1()) {
    EXPECT_NEAR(size_of(row.loaded.nominal) / unit, row.relative, printed) << row.element;
    EXPECT_NEAR(size_of(*row.loaded.tolerance) / unit, row.relative_tolerance, printed)
        << row.element;
  }
}

TEST(AstmD523Table1, HoldsForIso2813Too) {
  const Standard iso = shipped_standard("iso_2813/2014");
  const Standard d523 = shipped_standard("astm_d523/14");
  for (const char* id : {"20", "60", "85"}) {
    const GeometryLimits& a = iso.geometry(id);
    const GeometryLimits& b = d523.geometry(id);
    EXPECT_EQ(a.theta_i.nominal, b.theta_i.nominal);
    EXPECT_EQ(a.receptor.in_plane->known().nominal, b.receptor.in_plane->known().nominal);
    EXPECT_EQ(a.receptor.perpendicular->known().nominal, b.receptor.perpendicular->known().nominal);
    EXPECT_EQ(a.source.in_plane->known().nominal, b.source.in_plane->known().nominal);
    EXPECT_EQ(a.source.perpendicular->known().nominal, b.source.perpendicular->known().nominal);
  }
}

}  // namespace
}  // namespace gonio
