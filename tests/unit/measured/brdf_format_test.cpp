#include <gtest/gtest.h>

#include <cstring>
#include <string_view>

#include "emulator/core/text_file.hpp"
#include "emulator/measured/brdf_file.hpp"
#include "tests/unit/measured/measured_fixture.hpp"
#include "tests/unit/message_of.hpp"

namespace gonio::test {
namespace {

using namespace std::literals;

std::string merl_header(std::int32_t a, std::int32_t b, std::int32_t c) {
  const std::int32_t nodes[3] = {a, b, c};
  std::string header(sizeof nodes, '\0');
  std::memcpy(header.data(), nodes, sizeof nodes);
  return header;
}

TEST(BrdfFormat, IsFoundInShippedFiles) {
  for (const std::string material : {"colodur_napoli_4f", "satin_rosaline"}) {
    EXPECT_EQ(brdf_format(brdf_fixtures + material + "_rgb.bsdf"), BrdfFormat::rgl);
    EXPECT_EQ(brdf_format(brdf_fixtures + material + ".zemax.bsdf"), BrdfFormat::zemax);
    EXPECT_EQ(brdf_format(brdf_fixtures + material + ".astm"), BrdfFormat::astm);
    EXPECT_EQ(brdf_format(brdf_fixtures + material + ".ddr"), BrdfFormat::ddr);
  }
}

TEST(BrdfFormat, IsOfTheContentNotOfTheName) {
  const std::string path = testing::TempDir() + "brdf_format_test.ddr";
  write_text_file(path, "\xEF\xBB\xBFSAMPLE_NAME x\r\nVARS theta_i,theta_s,f\r\n0,0,1\r\n");
  EXPECT_EQ(brdf_format(path), BrdfFormat::astm);
  EXPECT_EQ(load_brdf(path).format, BrdfFormat::astm);
  std::filesystem::remove(path);
}

TEST(BrdfFormat, OfMerlIsItsNumbersOfNodes) {
  EXPECT_EQ(brdf_format_of(merl_header(90, 90, 180), 12), BrdfFormat::merl);  // truncated
  EXPECT_EQ(brdf_format_of(merl_header(2, 3, 4), 12 + 24 * 24), BrdfFormat::merl);
  EXPECT_FALSE(brdf_format_of(merl_header(2, 3, 4), 12));
  EXPECT_FALSE(brdf_format_of(merl_header(-2, 3, -4), 12 + 24 * 24));
}

TEST(BrdfFormat, IsNothingElse) {
  for (const std::string_view text :
       {"tensor_fil"sv, "just text\n"sv, ""sv, "\n\n"sv, "varsity 1"sv, "the VARS\n"sv}) {
    EXPECT_FALSE(brdf_format_of(text, text.size())) << text;
  }
  const std::string path = testing::TempDir() + "brdf_format_test.txt";
  write_text_file(path, "wavelength,value\n");
  EXPECT_EQ(message_of([&] { (void)load_brdf(path); }),
            path +
                ": expected a measured BRDF: RGL .bsdf, MERL .binary, ASTM E1392 text, Zemax "
                ".bsdf or Integra .ddr, found 'wavelength,value'");
  write_text_file(path, "");
  EXPECT_EQ(message_of([&] { (void)load_brdf(path); }),
            path + ": expected a file with content, found 'an empty file'");
  std::filesystem::remove(path);
  EXPECT_EQ(message_of([&] { (void)load_brdf(path); }), path + ": expected a file, found nothing");
  EXPECT_EQ(message_of([&] { (void)load_brdf(testing::TempDir()); }),
            testing::TempDir() + ": expected a file, found 'a folder'");
}

}  // namespace
}  // namespace gonio::test
