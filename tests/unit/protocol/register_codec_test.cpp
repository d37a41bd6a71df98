#include "emulator/protocol/register_codec.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <vector>

namespace gonio {
namespace {

using testing::ElementsAre;
using Words = std::vector<std::uint16_t>;

constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr double over_range = std::numeric_limits<double>::infinity();

Point point(PointType type, double scale = 1.0, bool is_swapped = false) {
  Point result{.id = "p", .value = "p", .meaning = ""};
  result.type = type;
  result.scale = scale;
  result.is_word_swapped = is_swapped;
  return result;
}

Words encoded(const Point& point, double value) {
  const bool is_long = point.type == PointType::int32 || point.type == PointType::uint32 ||
                       point.type == PointType::float32;
  Words words(is_long ? 2 : 1);
  encode_number(point, value, words);
  return words;
}

TEST(RegisterCodec, PutsTheHighWordOfAFloatFirst) {
  EXPECT_THAT(encoded(point(PointType::float32), 123456.0), ElementsAre(0x47F1, 0x2000));
  EXPECT_THAT(encoded(point(PointType::float32), -123.45), ElementsAre(0xC2F6, 0xE666));
  EXPECT_THAT(encoded(point(PointType::float32), 100.0), ElementsAre(0x42C8, 0x0000));
  EXPECT_THAT(encoded(point(PointType::float32), 252.55), ElementsAre(0x437C, 0x8CCD));
}

TEST(RegisterCodec, PutsTheLowWordFirstWhereAsked) {
  EXPECT_THAT(encoded(point(PointType::float32, 1.0, true), 123456.0), ElementsAre(0x2000, 0x47F1));
  EXPECT_THAT(encoded(point(PointType::uint32, 1.0, true), 0x12345678),
              ElementsAre(0x5678, 0x1234));
}

TEST(RegisterCodec, EncodesIntegers) {
  EXPECT_THAT(encoded(point(PointType::int16), -12345), ElementsAre(0xCFC7));
  EXPECT_THAT(encoded(point(PointType::uint16), 54321), ElementsAre(0xD431));
  EXPECT_THAT(encoded(point(PointType::int32), -123456789), ElementsAre(0xF8A4, 0x32EB));
  EXPECT_THAT(encoded(point(PointType::uint32), 4294967295.0), ElementsAre(0xFFFF, 0xFFFF));
  EXPECT_THAT(encoded(point(PointType::boolean), 1.0), ElementsAre(1));
}

TEST(RegisterCodec, RoundsScaledIntegersToTheNearest) {
  EXPECT_THAT(encoded(point(PointType::int16, 0.1), 95.84), ElementsAre(958));
  EXPECT_THAT(encoded(point(PointType::int16, 0.1), 95.86), ElementsAre(959));
  EXPECT_THAT(encoded(point(PointType::int16, 0.1), -0.26), ElementsAre(0xFFFD));
}

TEST(RegisterCodec, MarksWhatThereIsNoneOf) {
  EXPECT_THAT(encoded(point(PointType::float32), none), ElementsAre(0x7FC0, 0x0000));
  EXPECT_THAT(encoded(point(PointType::int16, 0.1), none), ElementsAre(0x8000));
  EXPECT_THAT(encoded(point(PointType::int32), none), ElementsAre(0x8000, 0x0000));
  EXPECT_THAT(encoded(point(PointType::uint16), none), ElementsAre(0xFFFF));
  EXPECT_THAT(encoded(point(PointType::uint32), none), ElementsAre(0xFFFF, 0xFFFF));
  EXPECT_THAT(encoded(point(PointType::boolean), none), ElementsAre(0));
}

TEST(RegisterCodec, MarksWhatIsOverRange) {
  EXPECT_THAT(encoded(point(PointType::float32), over_range), ElementsAre(0x7FC0, 0x0000));
  EXPECT_THAT(encoded(point(PointType::int16, 0.1), over_range), ElementsAre(0x7FFF));
  EXPECT_THAT(encoded(point(PointType::int32), over_range), ElementsAre(0x7FFF, 0xFFFF));
}

TEST(RegisterCodec, NeverTakesANumberForAMark) {
  EXPECT_THAT(encoded(point(PointType::int16, 0.1), 1e6), ElementsAre(0x7FFE));
  EXPECT_THAT(encoded(point(PointType::int16, 0.1), -1e6), ElementsAre(0x8001));
}

TEST(RegisterCodec, ReadsBackWhatItWrote) {
  for (const bool is_swapped : {false, true}) {
    for (const PointType type : {PointType::int16, PointType::uint16, PointType::int32,
                                 PointType::uint32, PointType::float32}) {
      const Point p = point(type, 1.0, is_swapped);
      for (const double value : {0.0, 1.0, 258.0, 32000.0}) {
        EXPECT_EQ(decode_number(p, encoded(p, value)), value);
      }
    }
  }
  const Point tenths = point(PointType::int16, 0.1);
  EXPECT_DOUBLE_EQ(decode_number(tenths, encoded(tenths, -95.8)), -95.8);
  EXPECT_TRUE(std::isnan(decode_number(tenths, encoded(tenths, none))));
  EXPECT_EQ(decode_number(tenths, encoded(tenths, over_range)), over_range);
}

TEST(RegisterCodec, PutsTwoCharactersIntoARegister) {
  Words words(4);
  encode_text("-123.45", words);
  EXPECT_THAT(words, ElementsAre(0x2D31, 0x3233, 0x2E34, 0x3500));
  EXPECT_EQ(decode_text(words), "-123.45");
}

TEST(RegisterCodec, CutsTextThatIsTooLong) {
  Words words(2);
  encode_text("abcdef", words);
  EXPECT_EQ(decode_text(words), "abcd");
  encode_text("", words);
  EXPECT_EQ(decode_text(words), "");
}

}  // namespace
}  // namespace gonio
