#include "emulator/quality/product_optics.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "emulator/core/input_error.hpp"
#include "tests/unit/message_of.hpp"
#include "tests/unit/quality/made_product.hpp"

namespace gonio {

using test::MadeProduct;

// A tenth of the smallest step that any display has.
TEST(ProductOptics, SeeWhatTheIntegratorDoes) {
  MadeProduct made("red_satin", {"20", "60", "85"});
  const ProductDeviation half_width{0.2, 0.01, 0.02};
  const ProductOptics optics(made.batch, half_width, test::observer_1931());
  constexpr double at_most_gu = 0.01;
  EXPECT_LT(optics.error(), at_most_gu);
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> within(-1.0, 1.0);
  for (int i = 0; i < 20; ++i) {
    const Eigen::Vector3d d(0.2 * within(random), 0.01 * within(random), 0.02 * within(random));
    for (std::uint32_t c = 0; c < 3; ++c) {
      const double seen = optics.show(optics.ideal(), c, optics.see(optics.ideal(), c, 0, d));
      const double exact =
          made.gloss(c, {.roughness = d[0], .refractive_index = d[1], .diffuse_reflectance = d[2]});
      EXPECT_NEAR(seen, exact, 2.0 * optics.error() + 1e-4);
    }
  }
}

TEST(ProductOptics, ShowNoDifferenceOfColourToTheSampleItself) {
  MadeProduct made("red_satin", {"60"});
  made.batch.channels.push_back({"60/colour", "60", BatchChannel::Kind::colour_difference, ""});
  made.batch.colour_references.resize(2);
  const ProductOptics optics(made.batch, {0.05, 0.0, 0.05}, test::observer_1931());
  const auto difference = [&](double diffuse) {
    return optics.show(optics.ideal(), 1, optics.see(optics.ideal(), 1, 0, {0.0, 0.0, diffuse}));
  };
  EXPECT_NEAR(difference(0.0), 0.0, 1e-3);
  EXPECT_GT(difference(0.05), 0.02) << "most of what reaches the receptor is gloss";
}

TEST(ProductOptics, RefuseDeviationsThatNoSurfaceHas) {
  MadeProduct made("white_matt_wall_paint", {"60"});
  made.batch.product->mark = {.file = "batch.yaml", .line = 5, .column = 3, .key = "product"};
  // alpha is 0.5, and at most 1: ln 2 is the end.
  EXPECT_THAT(test::message_of([&] {
                (void)ProductOptics(made.batch, {1.0, 0.0, 0.0}, test::observer_1931());
              }),
              testing::StartsWith("batch.yaml:5:3: product: expected deviations that the sample's "
                                  "model has a meaning for, found '"));
}

TEST(Reach, IsSixSigmaOfWhatIsNormalAndTheBoundsOfTheRest) {
  Batch batch = test::made_batch({"60"});
  batch.product = Product{};
  batch.product->spread[0] = MadeProduct::normal(0.03, 0.0, 0.04);
  EXPECT_DOUBLE_EQ(reach(batch)[0], 6.0 * 0.05);
  batch.product->spread[0].panels = Distribution::bounded(Distribution::Shape::rectangular, 0.1);
  EXPECT_DOUBLE_EQ(reach(batch)[0], 6.0 * 0.05 + 0.1);
  EXPECT_EQ(reach(batch)[1], 0.0);
}

}  // namespace gonio
