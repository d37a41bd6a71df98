// Writes the pages that a browser looks at: write_pages FOLDER.
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>

#include "emulator/core/text_file.hpp"
#include "reports/conformance_report.hpp"
#include "reports/qa_history.hpp"
#include "reports/qa_report.hpp"
#include "tests/unit/reports/example_report.hpp"
#include "tests/unit/reports/hostile_certificate.hpp"
#include "tests/unit/reports/hostile_qa.hpp"
#include "tests/unit/reports/hostile_report.hpp"

namespace gonio {
namespace {

/// The example many times over: its tables are longer than a sheet of paper.
ConformanceReport long_report() {
  constexpr int copies = 12;
  ConformanceReport report = test::example_report();
  const std::vector<ClauseResult> clauses = report.clauses;
  const std::vector<CaseResult> cases = report.cases;
  for (int copy = 1; copy < copies; ++copy) {
    const std::string suffix = "_" + std::to_string(copy);
    for (ClauseResult clause : clauses) {
      clause.id += suffix;
      clause.effects.clear();
      for (std::size_t& index : clause.cases) {
        index += std::size_t(copy) * cases.size();
      }
      report.clauses.push_back(clause);
    }
    for (CaseResult result : cases) {
      result.clause += suffix;
      result.address += suffix;
      report.cases.push_back(result);
    }
  }
  return report;
}

void write_certificates(const std::filesystem::path& folder) {
  const Certificate sound = test::example_certificate();
  write_text_file(folder / "certificate.html", certificate_page(test::report_of(sound)));
  const std::string text = test::hostile_text(folder / "trace");
  Certificate hostile = test::hostile_certificate(text);
  for (std::size_t i = 0; i < hostile.geometries.size(); ++i) {  // ours: they stand in narrow heads
    for (std::size_t j = 0; j < hostile.geometries[i].effects.size(); ++j) {
      hostile.geometries[i].effects[j].component = sound.geometries[i].effects[j].component;
    }
  }
  write_text_file(folder / "hostile_certificate.html",
                  certificate_page(test::hostile_report_of(hostile, text)));
}

/// All charts; then with points that stand together.
void write_qa(const std::filesystem::path& folder) {
  QaResult many = test::example_qa();
  for (ChannelSummary& channel : many.channels) {
    channel.charts.individual = test::example_chart(channel.mean, 1.0, 400, 250);
  }
  const std::string text = test::hostile_text(folder / "trace");
  write_text_file(folder / "qa.html", qa_page(test::example_qa(), "0.1.0"));
  write_text_file(folder / "qa_many.html", qa_page(many, "0.1.0"));
  write_text_file(folder / "hostile_qa.html", qa_page(test::hostile_qa(text), text));
  write_text_file(folder / "qa_history.html",
                  history_page(test::example_history(), "sqlite:qa.db", "0.1.0"));
  write_text_file(folder / "hostile_qa_history.html",
                  history_page(test::hostile_history(text), text, text));
}

void write_pages(const std::filesystem::path& folder) {
  const ConformanceReport hostile = test::hostile_report(test::hostile_text(folder / "trace"));
  write_text_file(folder / "conformance.html", conformance_page(test::example_report()));
  write_text_file(folder / "conformance.xml", conformance_junit(test::example_report()));
  write_text_file(folder / "long.html", conformance_page(long_report()));
  write_text_file(folder / "hostile.html", conformance_page(hostile));
  write_text_file(folder / "hostile.xml", conformance_junit(hostile));
  write_certificates(folder);
  write_qa(folder);
}

}  // namespace
}  // namespace gonio

int main(int count, char** arguments) {
  if (count != 2) {
    std::fputs("usage: write_pages FOLDER\n", stderr);
    return 2;
  }
  try {
    gonio::write_pages(arguments[1]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "write_pages: %s\n", error.what());
    return 1;
  }
  return 0;
}
