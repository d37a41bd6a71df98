#include <gtest/gtest.h>

#include <charconv>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "emulator/core/text_file.hpp"
#include "reports/measurement_report.hpp"
#include "reports/qa_history.hpp"
#include "reports/qa_report.hpp"
#include "tests/unit/procedure/laboratory.hpp"
#include "tests/unit/reports/example_certificate.hpp"
#include "tests/unit/reports/example_history.hpp"
#include "tests/unit/reports/example_report.hpp"

// Reports against reports/reference/, see the README there. UPDATE_REFERENCE=1 rewrites the files.

namespace gonio {
namespace {

using test::observer;

constexpr double tolerance_gu = 1e-4;
constexpr double numbers_agree = 1e-7;  // relative; other processors round other last bits

struct Reported {
  Standard standard = test::shipped_standard("iso_2813/2014");
  std::vector<Measurement> measurements = measure_all(
      {test::shipped_sample("copper_polished"), test::shipped_sample("gold_smooth_johnson")},
      test::meter_by_standard("iso_2813/2014"), observer(), {.tolerance = tolerance_gu});
  [[nodiscard]] MeasurementHeader header() const {
    return {.standard = standard,
            .instrument = "Nominal values of iso_2813/2014",
            .integrator = "aperture",
            .reference = "reference glass n = 1.567 at all wavelengths",
            .grid = test::visible};
  }
};

/// The approved text; `current` becomes it where the reader of this test asks for that.
std::string approved(const std::string& name, const std::string& current) {
  const auto file = test::source_tree / "reports/reference" / name;
  if (const char* update = std::getenv("UPDATE_REFERENCE");
      update != nullptr && std::string(update) == "1") {
    write_text_file(file, current);
  }
  return read_text_file(file);
}

std::string without_errors(const std::string& text) {
  return std::regex_replace(text, std::regex(" [0-9]\\.[0-9]e[-+][0-9]+ "), " <error> ");
}

TEST(ApprovedReports, TextIsTheSameButForTheErrors) {
  const Reported reported;
  const std::string text = measurement_text(reported.header(), reported.measurements, false);
  EXPECT_EQ(without_errors(text), without_errors(approved("measurement.txt", text)));
}

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, separator);) {
    parts.push_back(part);
  }
  return parts;
}

std::optional<double> as_number(const std::string& cell) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  const bool whole = error == std::errc() && end == cell.data() + cell.size();
  return whole ? std::optional(value) : std::nullopt;
}

void expect_same_row(const std::vector<std::string>& names, const std::string& row,
                     const std::string& expected_row) {
  const auto cells = split(row, ',');
  const auto expected = split(expected_row, ',');
  ASSERT_EQ(cells.size(), names.size()) << row;
  ASSERT_EQ(expected.size(), names.size()) << expected_row;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto number = as_number(cells[i]);
    if (names[i] == "quadrature_error_gu") {
      EXPECT_TRUE(number && *number >= 0.0 && *number <= tolerance_gu) << row;
    } else if (number && as_number(expected[i])) {
      EXPECT_NEAR(*number, *as_number(expected[i]), numbers_agree * (1.0 + std::abs(*number)))
          << names[i] << " of " << row;
    } else {
      EXPECT_EQ(cells[i], expected[i]) << names[i] << " of " << row;
    }
  }
}

TEST(ApprovedReports, CsvIsTheSameButForTheErrors) {
  const Reported reported;
  const std::string csv = measurement_csv(reported.header(), reported.measurements);
  const auto rows = split(csv, '\n');
  const auto expected = split(approved("measurement.csv", csv), '\n');
  ASSERT_EQ(rows.size(), expected.size());
  EXPECT_EQ(rows.front(), expected.front());
  for (std::size_t i = 1; i < rows.size(); ++i) {
    expect_same_row(split(rows.front(), ','), rows[i], expected[i]);
  }
}

void expect_approved(const std::string& name, const std::string& current) {
  EXPECT_EQ(current, approved(name, current)) << name;
}

TEST(ApprovedReports, ConformanceIsTheSameInEveryTextFormat) {
  const ConformanceReport report = test::example_report();
  expect_approved("conformance.txt", conformance_text(report, false));
  expect_approved("conformance.jsonl", conformance_json_lines(report));
  expect_approved("conformance.xml", conformance_junit(report));
  expect_approved("conformance.md", conformance_markdown(report));
}

TEST(ApprovedReports, CertificateIsTheSameInEveryTextFormat) {
  const Certificate certificate = test::example_certificate();
  expect_approved("certificate.txt", certificate_text(test::report_of(certificate), false));
  const Certificate brief = test::brief_certificate();
  expect_approved("certificate.json", certificate_json(test::report_of(brief)));
}

TEST(ApprovedReports, QaIsTheSameInEveryTextFormat) {
  expect_approved("qa.txt", qa_text(test::example_qa(), false));
  expect_approved("qa.json", qa_json(test::brief_qa()));
}

TEST(ApprovedReports, HistoryIsTheSameInEveryTextFormat) {
  const auto runs = test::example_history();
  expect_approved("qa_history.txt", history_text(runs, "sqlite:qa.db", false));
  expect_approved("qa_history.csv", history_csv(runs));
}

}  // namespace
}  // namespace gonio
