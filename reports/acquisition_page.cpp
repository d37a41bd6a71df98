#include <fmt/format.h>

#include "reports/acquisition_report.hpp"
#include "reports/acquisition_words.hpp"
#include "reports/page_charts.hpp"

namespace gonio {

namespace {

std::vector<double> list_of(const Eigen::ArrayXd& values) { return {values.begin(), values.end()}; }

PageData spectrum_figure(Figures& figures, const AcquiredSpectrum& one) {
  const ReflectanceSpectrum& spectrum = one.spectrum;
  const std::vector<double> lambda = list_of(spectrum.wavelength_nm);
  std::vector<SpectralCurve> curves{
      {.title = "reflectance", .wavelength_nm = lambda, .value = list_of(spectrum.reflectance)}};
  if (spectrum.u.size() > 0) {
    curves.push_back({.title = "plus 2 u",
                      .wavelength_nm = lambda,
                      .value = list_of(spectrum.reflectance + 2.0 * spectrum.u)});
    curves.push_back({.title = "minus 2 u",
                      .wavelength_nm = lambda,
                      .value = list_of(spectrum.reflectance - 2.0 * spectrum.u)});
  }
  return curves_figure(
      figures, CurveKind::reflectance,
      fmt::format("Reflectance relative to the mirror, geometry {}", spectrum.geometry), curves);
}

}  // namespace

std::string acquisition_page(const AcquisitionResult& result, const std::string& version) {
  Figures figures;
  PageList list;
  for (const AcquiredSpectrum& one : result.spectra) {
    list.push_back(spectrum_figure(figures, one));
  }
  PageData data;
  data.set("heading", result.title);
  data.set("version", version);
  set_text(data, "sample", result.sample);
  data.set("table", PageData(PageList{table_data(acquisition_table(result))}));
  set_list(data, "notes", text_list(acquisition_notes(result)));
  data.set("figures", PageData(list));
  return render_page("acquisition", result.title, data);
}

}  // namespace gonio
