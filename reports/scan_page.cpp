#include <fmt/format.h>

#include "reports/page.hpp"
#include "reports/scan_charts.hpp"
#include "reports/scan_report.hpp"

namespace gonio {

namespace {

ReportTable facts_table(const ScanReport& report) {
  ReportTable table{.caption = "The scan", .heads = {"what", "value"}};
  for (const ScanFact& fact : scan_facts(report)) {
    table.rows.push_back({fact.what, fact.value});
  }
  return table;
}

std::vector<std::string> notes_of(const ScanReport& report) {
  std::vector<std::string> notes;
  if (!report.plan.notes.empty()) {
    notes.push_back(report.plan.notes);
  }
  bool has_sum = false;
  for (const ScanLobe& lobe : report.lobes) {
    has_sum = has_sum || lobe.hemispherical.has_value();
  }
  notes.emplace_back(
      has_sum
          ? "Reflectance is the sum of f_r over the positions, each weighted by its part of the "
            "hemisphere; integrated, the same by quadrature. A lobe narrower than the steps is "
            "missed by the sum."
          : "Reflectance into the hemisphere cannot be added up: the receptor did not go all "
            "round.");
  if (report.result.missed > 0) {
    notes.push_back(
        fmt::format("The integrator missed the tolerance at {} positions.", report.result.missed));
  }
  return notes;
}

}  // namespace

std::string scan_page(const ScanReport& report) {
  Figures figures;
  PageData data("heading", report.sample_title);
  data.set("plan", report.plan.title);
  data.set("peaks", PageData(PageList{table_data(scan_table(report))}));
  data.set("notes", PageData(text_list(notes_of(report))));
  data.set("in_plane", PageData(in_plane_figures(figures, report)));
  data.set("hemispheres", PageData(hemisphere_figures(figures, report)));
  data.set("spectra", PageData(spectrum_figures(figures, report)));
  data.set("facts", PageData(PageList{table_data(facts_table(report))}));
  return render_page("scan", report.sample_title, data);
}

}  // namespace gonio
