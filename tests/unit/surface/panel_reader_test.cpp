#include "emulator/surface/panel_reader.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <png.h>

#include <cmath>
#include <string>
#include <vector>

#include "emulator/core/text_file.hpp"
#include "emulator/surface/models.hpp"
#include "emulator/surface/sample_family.hpp"
#include "tests/unit/message_of.hpp"
#include "tests/unit/temporary_folder.hpp"

namespace gonio {
namespace {

using test::message_of;
using testing::EndsWith;
using testing::HasSubstr;

const WavelengthGrid one_wavelength(nanometres(555), nanometres(1), 1);
const Vector3 up(0.0, 0.0, 1.0);

constexpr const char* head = "schema: gonio/sample/1\nid: mine\ntitle: Mine\n";
constexpr const char* size = "panel: {length: 150 mm, width: 100 mm}\n";
constexpr const char* white = "surface: {model: lambertian, reflectance: 0.5}\n";

/// A folder with a sample file and what it names.
class PanelFile : public testing::Test {
 protected:
  /// @param rest  from line 4 on.
  SampleFamily load(const std::string& rest) {
    return SampleFamily::load(folder_.file("mine.yaml", head + rest), one_wavelength);
  }
  std::string message(const std::string& rest) {
    return message_of([&] { (void)load(rest); });
  }
  /// The message for a map of diffuse_reflectance in the file of this text.
  std::string grid_message(const std::string& text) {
    (void)folder_.file("grid.csv", text);
    return message(std::string(size) + white + "maps: {diffuse_reflectance: {file: grid.csv}}\n");
  }
  std::string image_message() {
    return message(std::string(size) + white +
                   "maps: {diffuse_reflectance: {file: map.png, black: -0.5, white: 0.5}}\n");
  }
  void write_png(const std::vector<png_uint_16>& pixels, png_uint_32 width, png_uint_32 format) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = width;
    image.height = png_uint_32(pixels.size() * 2 / (width * PNG_IMAGE_PIXEL_SIZE(format)));
    image.format = format;
    ASSERT_NE(png_image_write_to_file(&image, (folder_.path() / "map.png").c_str(), 0,
                                      pixels.data(), 0, nullptr),
              0)
        << image.message;
  }
  /// Changes the bytes of map.png.
  template <class Change>
  void damage_png(Change&& change) {
    std::string bytes = read_text_file(folder_.path() / "map.png");
    change(bytes);
    (void)folder_.file("map.png", bytes);
  }

  const test::TemporaryFolder folder_;
};

double mean_reflectance(const SampleFamily& family) {
  return M_PI * family.sample().surface.brdf(up, up)(0);
}

constexpr const char* stripe =
    "regions:\n"
    "  - {id: base, surface: {model: lambertian, reflectance: 0.25}}\n"
    "  - {id: stripe, rectangle: {centre: [75 mm, 50 mm], length: 30 mm, width: 100 mm},\n"
    "     surface: {model: lambertian, reflectance: 0.75}}\n";

TEST_F(PanelFile, OfRegionsIsTheirMeanByArea) {
  constexpr double rounding = 1e-9;
  const SampleFamily family = load(std::string(size) + stripe);
  EXPECT_EQ(family.regions(), 2u);
  EXPECT_EQ(family.layout()->regions[1].id, "stripe");
  EXPECT_NEAR(mean_reflectance(family), 0.8 * 0.25 + 0.2 * 0.75, rounding);
  EXPECT_NEAR(M_PI * family.surface(1).brdf(up, up)(0), 0.75, rounding);
  EXPECT_THROW((void)family.surface(2), std::out_of_range);
}

TEST_F(PanelFile, DeviatesInAllRegions) {
  constexpr double rounding = 1e-9;
  const Sample sample = load(std::string(size) + stripe).sample({.diffuse_reflectance = 0.125});
  EXPECT_NEAR(M_PI * sample.surface.brdf(up, up)(0), 0.8 * 0.375 + 0.2 * 0.875, rounding);
  ASSERT_TRUE(sample.panel);
  const Surface at_the_stripe =
      sample.panel->mixed(shares(*sample.panel->layout, Spot{.x_mm = 75, .y_mm = 20}));
  EXPECT_NEAR(M_PI * at_the_stripe.brdf(up, up)(0), 0.875, rounding);
}

TEST_F(PanelFile, OfAHomogeneousPanelIsItsSurfaceBitForBit) {
  const Sample plain = load(white).sample();
  const Sample panel = load(std::string(size) + white).sample();
  EXPECT_EQ(plain.surface.brdf(up, up)(0), panel.surface.brdf(up, up)(0));
  EXPECT_FALSE(plain.panel);
  ASSERT_TRUE(panel.panel);
  EXPECT_EQ(panel.panel->layout->length_mm, 150.0);
  EXPECT_EQ(panel.panel->layout->width_mm, 100.0);
}

TEST_F(PanelFile, WithAConstantMapIsTheDeviatedSample) {
  constexpr double rounding = 1e-12;
  (void)folder_.file("grid.csv", "0.125,0.125\n0.125,0.125\n");
  const std::string text = std::string(size) + white;
  const Sample mapped = load(text + "maps: {diffuse_reflectance: {file: grid.csv}}\n").sample({});
  const Sample deviated = load(text).sample({.diffuse_reflectance = 0.125});
  EXPECT_NEAR(mapped.surface.brdf(up, up)(0), deviated.surface.brdf(up, up)(0), rounding);
}

TEST_F(PanelFile, ReadsAGreyImageFromBlackToWhite) {
  constexpr double of_16_bits = 1e-5;
  write_png({0, 65535, 16384, 65535}, 2, PNG_FORMAT_LINEAR_Y);
  const SampleFamily family =
      load(std::string(size) + white +
           "maps: {diffuse_reflectance: {file: map.png, black: -0.5, white: 0.5}}\n");
  const ParameterMap& map = *family.layout()->maps[2];
  EXPECT_NEAR(map.at(0, 0), -0.5, of_16_bits);
  EXPECT_NEAR(map.at(150, 0), 0.5, of_16_bits);
  EXPECT_NEAR(map.at(0, 100), -0.25, of_16_bits);
  EXPECT_NEAR(map.at(75, 0), 0.0, of_16_bits);
}

TEST_F(PanelFile, RefusesImagesThatAreNoGreyMap) {
  write_png({0, 0, 0, 0, 0, 0}, 2, PNG_FORMAT_LINEAR_RGB);
  EXPECT_THAT(image_message(),
              EndsWith("map.png: expected a grey image without transparency: which number a colour "
                       "stands for is not known, found 'colours'"));
  write_png({0, 0, 0, 0}, 2, PNG_FORMAT_LINEAR_Y_ALPHA);
  EXPECT_THAT(image_message(), EndsWith("found 'transparency'"));
  (void)folder_.file("map.png", "not an image\n");
  EXPECT_THAT(image_message(), EndsWith("map.png: expected a PNG image, found 'something else'"));
}

TEST_F(PanelFile, RefusesADamagedImage) {
  const std::vector<png_uint_16> pixels(64 * 64, 1234);
  write_png(pixels, 64, PNG_FORMAT_LINEAR_Y);
  damage_png([](std::string& bytes) { bytes.resize(bytes.size() / 2); });
  EXPECT_THAT(image_message(), HasSubstr("map.png: expected a PNG image that is whole, found "));
  write_png(pixels, 64, PNG_FORMAT_LINEAR_Y);
  damage_png([](std::string& bytes) { bytes[bytes.size() - 20] ^= 0x55; });
  EXPECT_THAT(image_message(), HasSubstr("map.png: expected a PNG image that is whole, found "));
}

TEST_F(PanelFile, RefusesAHugeImageBeforeItsPixelsAreRead) {
  // Width and height in the header, with its check sum; no pixels follow.
  const std::string header(
      "\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR\0\x0f\x42\x40\0\x0f\x42\x40\x08\0\0\0\0", 29);
  png_uint_32 crc = 0xFFFFFFFFu;
  for (const char c : header.substr(12)) {
    crc ^= static_cast<unsigned char>(c);
    for (int i = 0; i < 8; ++i) {
      crc = (crc >> 1) ^ (0xEDB88320u & (0u - (crc & 1u)));
    }
  }
  crc = ~crc;
  std::string bytes = header;
  for (int shift = 24; shift >= 0; shift -= 8) {
    bytes += char((crc >> shift) & 0xFF);
  }
  bytes += std::string("\0\0\0\0IDAT\x35\xaf\x06\x1e", 12);
  (void)folder_.file("map.png", bytes);
  EXPECT_THAT(image_message(), EndsWith("map.png: expected an image of at most 4000000 pixels, "
                                        "found '1000000 x 1000000'"));
}

TEST_F(PanelFile, RefusesABadGridAtItsPlace) {
  EXPECT_THAT(grid_message("0,0\n0,x\n"), EndsWith("grid.csv:2:3: expected a number, found 'x'"));
  EXPECT_THAT(grid_message("0,0\n0,\n"),
              EndsWith("grid.csv:2:3: expected a number, found nothing"));
  EXPECT_THAT(grid_message("0,0\n0\n"),
              EndsWith("grid.csv:2:1: expected 2 numbers as in the first row, found '1'"));
  EXPECT_THAT(grid_message("a,b\n0,0\n"), EndsWith("grid.csv:1:1: expected a number, found 'a'"));
  EXPECT_THAT(grid_message("# nothing\n"),
              EndsWith("grid.csv: expected rows of numbers, found 'none'"));
}

TEST_F(PanelFile, RefusesWhatIsNoPanel) {
  const std::string base = "  - {id: base, surface: {model: lambertian, reflectance: 0.25}}\n";
  const std::string shape = "rectangle: {centre: [75 mm, 50 mm], length: 30 mm, width: 9 mm}";
  const std::string surface = "surface: {model: smooth, reflectance: 1}";
  const struct {
    std::string text, expected;
  } cases[] = {
      {stripe,
       "mine.yaml:1:1: panel: expected the key 'panel', found 'only schema, id, title, "
       "regions'"},
      {"panel: {length: 150 mm, width: 0 mm}\n" + std::string(white),
       "mine.yaml:4:32: panel.width: expected a length (nm, um, mm) > 0, found '0 mm'"},
      {std::string(size) + white + "regions:\n" + base,
       "mine.yaml:5:10: surface: expected either surface or regions, found 'both'"},
      {std::string(size) + "regions:\n  - {id: base, " + shape + ", " + surface + "}\n",
       "mine.yaml:6:5: regions[0]: expected a first region without a shape, which covers the "
       "panel, "
       "found 'a shape'"},
      {std::string(size) + "regions:\n" + base + "  - {id: two, " + surface + "}\n",
       "mine.yaml:7:5: regions[1]: expected the key 'rectangle' or 'ellipse': only the first "
       "region "
       "covers the panel, found 'none'"},
      {std::string(size) + "regions:\n" + base + "  - {id: base, " + shape + ", " + surface + "}\n",
       "mine.yaml:7:10: regions[1].id: expected an id that no other region has, found 'base'"},
      {std::string(size) + "regions:\n" + base +
           "  - {id: b, ellipse: {centre: [200 mm, 5 mm], length: 9 mm, width: 9 mm}, " + surface +
           "}\n",
       "mine.yaml:7:31: regions[1].ellipse.centre: expected a region on the panel of 150 mm x 100 "
       "mm, found '200 mm, 5 mm'"},
      {std::string(size) + "regions:\n" + base +
           "  - {id: b, ellipse: {centre: [20 mm], length: 9 mm, width: 9 mm}, " + surface + "}\n",
       "mine.yaml:7:31: regions[1].ellipse.centre: expected a list of two lengths, x and y, found "
       "'1'"},
  };
  for (const auto& [text, expected] : cases) {
    EXPECT_THAT(message(text), EndsWith(expected)) << text;
  }
}

TEST_F(PanelFile, RefusesMapsThatTheSampleCannotBear) {
  (void)folder_.file("grid.csv", "0,1\n");
  const std::string rough =
      std::string(size) + "surface: {model: ggx, alpha: 0.5, refractive_index: 1.5}\n";
  EXPECT_THAT(
      message(rough + "maps: {roughness: {file: grid.csv}}\n"),
      EndsWith("mine.yaml:6:19: maps.roughness: expected values that keep each model within "
               "its range, found 'alpha must be in (0, 1], is 0.5 exp(1) = 1.35914'"));
  EXPECT_THAT(
      message(rough + "maps: {diffuse_reflectance: {file: grid.csv}}\n"),
      EndsWith("mine.yaml:6:29: maps.diffuse_reflectance: expected a map of a parameter that "
               "the sample has, found 'diffuse_reflectance'"));
  EXPECT_THAT(
      message(rough + "maps: {roughness: {file: mine.yaml}}\n"),
      EndsWith("mine.yaml:6:26: maps.roughness.file: expected a file that ends with .png or "
               ".csv, found 'mine.yaml'"));
  EXPECT_THAT(message(rough + "maps: {roughness: {file: none.png}}\n"),
              EndsWith("maps.roughness.file: expected a file, found 'none.png'"));
}

}  // namespace
}  // namespace gonio
