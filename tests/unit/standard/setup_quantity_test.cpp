#include "emulator/standard/setup_quantity.hpp"

#include <gtest/gtest.h>

#include "tests/unit/standard/shipped_standards.hpp"

namespace gonio {
namespace {

using test::shipped_standard;
using enum SetupQuantity;

TEST(SetupQuantityNames, LeadBackToTheQuantity) {
  for (std::size_t i = 0; i < setup_quantity_count; ++i) {
    EXPECT_EQ(setup_quantity(setup_quantity_names[i]), SetupQuantity(i));
  }
  EXPECT_EQ(setup_quantity("receptor_diameter"), receptor_diameter);
  EXPECT_EQ(setup_quantity("theta"), std::nullopt);
  EXPECT_EQ(setup_quantity(""), std::nullopt);
}

TEST(SetupLimit, IsTheStandardsNumberOfThatQuantity) {
  const Standard standard = shipped_standard("iso_2813/2014");
  const GeometryLimits& limits = standard.geometry("60");
  EXPECT_EQ(limit_of(limits, theta_i), &limits.theta_i);
  EXPECT_EQ(limit_of(limits, theta_r), &*limits.theta_r);
  EXPECT_EQ(limit_of(limits, source_in_plane)->nominal, degrees(0.75));
  EXPECT_EQ(limit_of(limits, source_perpendicular)->nominal, degrees(2.5));
  EXPECT_EQ(limit_of(limits, receptor_in_plane)->nominal, degrees(4.4));
  EXPECT_EQ(limit_of(limits, receptor_perpendicular)->nominal, degrees(11.7));
  EXPECT_EQ(limit_of(limits, receptor_perpendicular)->tolerance, degrees(0.2));
}

TEST(SetupLimit, IsNullWhereTheStandardSaysNothing) {
  const Standard rectangles = shipped_standard("iso_2813/2014");
  EXPECT_EQ(limit_of(rectangles.geometry("60"), source_diameter), nullptr);
  EXPECT_EQ(limit_of(rectangles.geometry("60"), receptor_diameter), nullptr);
  const Standard round = shipped_standard("tappi_t653/om_07");
  EXPECT_EQ(limit_of(round.geometry("20"), receptor_diameter)->nominal, degrees(5.0));
  EXPECT_EQ(limit_of(round.geometry("20"), receptor_in_plane), nullptr);
  GeometryLimits mirror = rectangles.geometry("60");
  mirror.theta_r.reset();
  EXPECT_EQ(limit_of(mirror, theta_r), nullptr);
}

TEST(SetupLimit, IsNullWhereTheNumberIsUnknown) {
  const Standard paper = shipped_standard("tappi_t480/om_15");
  EXPECT_EQ(limit_of(paper.geometry("75"), source_in_plane), nullptr);
  EXPECT_EQ(limit_of(paper.geometry("75"), receptor_perpendicular), nullptr);
}

}  // namespace
}  // namespace gonio
