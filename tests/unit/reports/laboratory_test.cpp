#include "reports/laboratory.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/unit/message_of.hpp"
#include "tests/unit/temporary_folder.hpp"

namespace gonio {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

Laboratory read(const std::string& text) {
  const test::TemporaryFolder folder;
  return load_laboratory(folder.file("lab.yaml", "schema: gonio/laboratory/1\n" + text));
}

std::string error_of(const std::string& text) {
  return test::message_of([&] { (void)read(text); });
}

TEST(Laboratory, ThatShipsIsReadWhole) {
  const Laboratory laboratory =
      load_laboratory(std::string(GONIO_SOURCE_DIR) + "/fixtures/laboratories/example.yaml");
  EXPECT_EQ(laboratory.name, "Example Gloss Laboratory");
  EXPECT_EQ(laboratory.certificate_number, "EGL-2026-0042");
  EXPECT_EQ(laboratory.calibrated, "2026-01-15");
  EXPECT_EQ(laboratory.temperature, "23 degC +- 1 degC");
  EXPECT_EQ(laboratory.reference_standards.size(), 2u);
  for (const std::string* text :
       {&laboratory.address, &laboratory.accreditation, &laboratory.customer, &laboratory.received,
        &laboratory.issued, &laboratory.humidity, &laboratory.traceability, &laboratory.procedure,
        &laboratory.signatory, &laboratory.notes}) {
    EXPECT_NE(*text, "");
  }
}

TEST(Laboratory, NeedStateNothing) {
  const Laboratory laboratory = read("");
  EXPECT_EQ(laboratory.name, "");
  EXPECT_EQ(laboratory.issued, "");
  EXPECT_TRUE(laboratory.reference_standards.empty());
}

TEST(Laboratory, HasItsStandardsInTheirOrder) {
  EXPECT_THAT(read("reference_standards: [tile 1, tile 2]\n").reference_standards,
              ElementsAre("tile 1", "tile 2"));
}

TEST(Laboratory, OfAnotherSchemaIsRefused) {
  const test::TemporaryFolder folder;
  EXPECT_THAT(test::message_of([&] {
                (void)load_laboratory(folder.file("lab.yaml", "schema: gonio/sample/1\n"));
              }),
              HasSubstr("lab.yaml:1:9: schema: expected gonio/laboratory/1"));
}

TEST(Laboratory, RefusesKeysThatNobodyReads) {
  EXPECT_THAT(error_of("phone: 1\n"), HasSubstr("lab.yaml:2:1: phone: "));
  EXPECT_THAT(error_of("laboratory: {phone: 1}\n"), HasSubstr("lab.yaml:2:14: laboratory.phone: "));
}

TEST(Laboratory, RefusesDatesThatNoCalendarHas) {
  for (const char* date : {"2026-02-29", "2026-13-01", "2026-00-10", "26-01-02", "2026-1-02",
                           "2026/01/02", "01.02.2026", "today", "2026-01-0x"}) {
    EXPECT_THAT(error_of(std::string("received: ") + date + "\n"),
                HasSubstr(std::string("lab.yaml:2:11: received: expected a date (YYYY-MM-DD), "
                                      "found '") +
                          date + "'"));
  }
  EXPECT_EQ(read("received: 2024-02-29\n").received, "2024-02-29");
}

TEST(Laboratory, RefusesDatesThatRunBackwards) {
  EXPECT_THAT(error_of("received: 2026-01-12\ncalibrated: 2026-01-11\n"),
              HasSubstr("lab.yaml:3:13: calibrated: expected a date not before 2026-01-12, found "
                        "'2026-01-11'"));
  EXPECT_THAT(error_of("received: 2026-01-12\nissued: 2026-01-11\n"), HasSubstr("lab.yaml:3:9"));
  EXPECT_EQ(read("calibrated: 2026-01-12\nissued: 2026-01-12\n").issued, "2026-01-12");
}

}  // namespace
}  // namespace gonio
