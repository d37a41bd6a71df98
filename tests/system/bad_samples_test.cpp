#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/system/program.hpp"

// A bad sample ends the program with status 2, with its place and what was expected on standard
// error, with nothing on standard output and without a file of results.

namespace gonio {
namespace {

namespace fs = std::filesystem;
using test::Outcome;
using test::Program;
using test::sample_text;

/// Measures a file with this text. @return  what stands on standard error.
std::string error_of(const std::string& text) {
  const Program program;
  (void)program.file("bad.yaml", text);
  const Outcome outcome =
      program.run({"measure", "--sample", "bad.yaml", "--spectrum", "spectrum.csv"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_EQ(outcome.out, "");
  EXPECT_FALSE(fs::exists(program.folder() / "spectrum.csv"));
  EXPECT_EQ(std::distance(fs::directory_iterator(program.folder()), fs::directory_iterator()), 1);
  return outcome.err;
}

std::string error_of_surface(const std::string& lines) {
  return error_of(sample_text("surface:\n" + lines));
}

const std::string rough = "  model: cook_torrance\n  refractive_index: 1.5\n";

TEST(BadSampleKeys, Unknown) {
  EXPECT_EQ(error_of_surface(rough + "  rms_slope: 0.1\n  colour: red\n"),
            "bad.yaml:8:3: surface.colour: expected one of the keys diffuse, model, normalization, "
            "refractive_index, rms_slope, specular, found 'colour'\n");
}

TEST(BadSampleKeys, Missing) {
  EXPECT_EQ(error_of_surface(rough),
            "bad.yaml:5:3: surface.rms_slope: expected the key 'rms_slope', found 'only model, "
            "refractive_index'\n");
}

TEST(BadSampleKeys, Doubled) {
  EXPECT_EQ(error_of_surface(rough + "  rms_slope: 0.1\n  rms_slope: 0.2\n"),
            "bad.yaml:8:3: surface.rms_slope: expected each key once, found 'the key 'rms_slope' a "
            "second time'\n");
}

TEST(BadSampleKeys, WrongSchema) {
  EXPECT_EQ(error_of("schema: gonio/instrument/1\nid: mine\n"),
            "bad.yaml:1:9: schema: expected gonio/sample/1, found 'gonio/instrument/1'\n");
}

TEST(BadSampleKeys, WrongModel) {
  const std::string message = error_of_surface("  model: phong\n");
  EXPECT_THAT(message, testing::StartsWith("bad.yaml:5:10: surface.model: expected one of "));
  EXPECT_THAT(message, testing::HasSubstr(" cook_torrance, ggx, lambertian, "));
  EXPECT_THAT(message, testing::EndsWith(", found 'phong'\n"));
}

// Numbers.

std::string error_of_slope(const std::string& value) {
  return error_of_surface(rough + "  rms_slope: " + value + "\n");
}

TEST(BadSampleNumbers, OfTheWrongUnit) {
  EXPECT_EQ(error_of_slope("0.1 deg"),
            "bad.yaml:7:14: surface.rms_slope: expected a number in (0, 1], found '0.1 deg'\n");
  EXPECT_EQ(error_of_surface("  model: coherent_roughness\n  rms_height: 50\n"
                             "  correlation_length: 2 um\n  refractive_index: 1.5\n"),
            "bad.yaml:6:15: surface.rms_height: expected a length (nm, um, mm) >= 0, found '50'\n");
}

TEST(BadSampleNumbers, NotANumber) {
  EXPECT_EQ(error_of_slope(".nan"),
            "bad.yaml:7:14: surface.rms_slope: expected a number in (0, 1], found '.nan'\n");
  EXPECT_EQ(error_of_slope("nan"),
            "bad.yaml:7:14: surface.rms_slope: expected a number in (0, 1], found 'nan'\n");
  EXPECT_EQ(error_of_slope(".inf"),
            "bad.yaml:7:14: surface.rms_slope: expected a number in (0, 1], found '.inf'\n");
}

TEST(BadSampleNumbers, NegativeOrZeroRoughness) {
  EXPECT_EQ(error_of_slope("-0.1"),
            "bad.yaml:7:14: surface.rms_slope: expected a number in (0, 1], found '-0.1'\n");
  EXPECT_EQ(error_of_slope("0"),
            "bad.yaml:7:14: surface.rms_slope: expected a number in (0, 1], found '0'\n");
}

TEST(BadSampleNumbers, SharesThatSumToMoreThanOne) {
  EXPECT_EQ(error_of_surface(rough + "  rms_slope: 0.1\n  specular: 0.7\n  diffuse: 0.4\n"),
            "bad.yaml:9:12: surface.diffuse: expected specular + diffuse <= 1 (specular is 0.7), "
            "found '1.1'\n");
}

TEST(BadSampleNumbers, WeightsThatSumToMoreThanOne) {
  EXPECT_EQ(error_of(sample_text("lobes:\n"
                                 "  - {model: smooth, weight: 0.7, refractive_index: 1.5}\n"
                                 "  - {model: smooth, weight: 0.4, refractive_index: 1.5}\n")),
            "bad.yaml:6:29: lobes[1].weight: expected weights of sum <= 1, found '1.1'\n");
}

TEST(BadSampleNumbers, AnIndexSoLargeThatNothingCanBeComputed) {
  EXPECT_THAT(error_of_surface("  model: smooth\n  refractive_index: 1e160\n"),
              testing::StartsWith("bad.yaml:6:21: surface.refractive_index: expected "));
  EXPECT_THAT(error_of_surface("  model: smooth\n  refractive_index: {n: 1e300, k: 1e300}\n"),
              testing::StartsWith("bad.yaml:6:25: surface.refractive_index.n: expected "));
}

// Files that the sample names.

TEST(BadSampleFiles, AnIndexThatDoesNotCoverTheWavelengths) {
  const std::string ordal = (test::source_tree / "fixtures/nk/main/Cu/Ordal.yml").string();
  EXPECT_EQ(error_of_surface("  model: smooth\n  refractive_index: {file: '" + ordal + "'}\n"),
            "bad.yaml:6:28: surface.refractive_index.file: expected values from 380 nm to 780 nm, "
            "found 'values from 517 nm to 55600 nm'\n");
}

TEST(BadSampleFiles, AnIndexThatIsNotThere) {
  EXPECT_EQ(error_of_surface("  model: smooth\n  refractive_index: {file: nothing.yml}\n"),
            "bad.yaml:6:28: surface.refractive_index.file: expected a file, found 'nothing.yml'\n");
}

// Text that is no sample at all.

TEST(BadSampleText, Empty) {
  EXPECT_EQ(error_of(""), "bad.yaml: expected a file with content, found 'an empty file'\n");
}

TEST(BadSampleText, Truncated) {
  EXPECT_EQ(error_of("schema: gonio/sample/1\nid: p\ntitle: \"P"),
            "bad.yaml:3:10: expected YAML, found 'illegal EOF in scalar'\n");
  EXPECT_EQ(error_of("schema: gonio/sample/1\nid: p\nti"),
            "bad.yaml:1:1: title: expected the key 'title', found 'only schema, id, ti'\n");
  EXPECT_THAT(error_of("schema: gonio/sample/1\nid: p\ntitle: P\nsurface: {model: smooth, refr"),
              testing::StartsWith("bad.yaml:4:"));
}

TEST(BadSampleText, AnAliasBomb) {
  std::string bomb = "a: &a [x,x,x,x,x,x,x,x,x]\n";
  for (char c = 'b'; c < 'k'; ++c) {
    bomb += std::string(1, c) + ": &" + c + " [*" + char(c - 1) + ",*" + char(c - 1) + "]\n";
  }
  EXPECT_EQ(error_of(bomb),
            "bad.yaml:1:4: expected a value without an anchor, found 'an anchor'\n");
}

std::string times(const std::string& text, int count) {
  std::string result;
  for (int i = 0; i < count; ++i) {
    result += text;
  }
  return result;
}

TEST(BadSampleText, ANestingBomb) {
  constexpr int deep = 100'000;
  EXPECT_EQ(error_of(times("- ", deep) + "x\n"),
            "bad.yaml:1:129: expected nesting of at most 64 levels, found 'more'\n");
  EXPECT_THAT(error_of("a: " + times("{a: ", deep) + times("}", deep)),
              testing::HasSubstr("expected nesting of at most 64 levels, found 'more'\n"));
  EXPECT_THAT(error_of("a: " + times("[", deep)), testing::StartsWith("bad.yaml:1:"));
  EXPECT_THAT(error_of(times("? ", deep)), testing::StartsWith("bad.yaml:1:"));
}

TEST(BadSampleText, BinaryGarbage) {
  std::string garbage;
  unsigned state = 12345;  // a fixed seed
  for (int i = 0; i < 20'000; ++i) {
    state = state * 1664525u + 1013904223u;
    garbage += char(state >> 24);
  }
  EXPECT_THAT(error_of(garbage), testing::StartsWith("bad.yaml:"));
  EXPECT_THAT(error_of(std::string(1000, '\0')), testing::StartsWith("bad.yaml:"));
}

TEST(BadSampleText, AnIdThatIsNoUtf8) {
  const Program program;
  (void)program.file("bad.yaml",
                     "schema: gonio/sample/1\nid: \"\xff\xe9\"\ntitle: Mine\n"
                     "surface: {model: smooth, refractive_index: 1.5}\n");
  const Outcome outcome = program.run({"measure", "--sample", "bad.yaml", "--format", "json"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_EQ(outcome.out, "");
  EXPECT_THAT(outcome.err, testing::StartsWith("bad.yaml:"));
}

std::string error_of_id(const std::string& id) {
  return error_of("schema: gonio/sample/1\nid: " + id +
                  "\ntitle: Mine\nsurface: {model: smooth, refractive_index: 1.5}\n");
}

TEST(BadSampleText, AnIdThatIsNone) {
  const std::string expected =
      "bad.yaml:2:5: id: expected an id of letters, digits, '_', '-' and '.', found '";
  EXPECT_EQ(error_of_id("my paint"), expected + "my paint'\n");
  EXPECT_EQ(error_of_id("\"a,b\""), expected + "a,b'\n");
  EXPECT_EQ(error_of_id("grün"), expected + "grün'\n");
  EXPECT_THAT(error_of_id(std::string(65, 'a')), testing::StartsWith(expected));
}

TEST(BadSampleText, ATitleOfTwoLines) {
  EXPECT_EQ(error_of("schema: gonio/sample/1\nid: p\ntitle: \"P\\nQ\"\n"),
            "bad.yaml:3:8: title: expected text in one line, without tabs, found 'P Q'\n");
}

TEST(BadSampleText, AControlCharacterWrittenAsAnEscape) {
  EXPECT_EQ(error_of("schema: gonio/sample/1\nid: p\ntitle: \"\\e[31mP\"\n"),
            "bad.yaml:3:8: expected UTF-8 text without control characters, "
            "found 'the control character U+001B'\n");
}

}  // namespace
}  // namespace gonio
