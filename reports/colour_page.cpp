#include <fmt/format.h>

#include "reports/colour_report.hpp"
#include "reports/colour_words.hpp"
#include "reports/device_page.hpp"
#include "reports/page_charts.hpp"

namespace gonio {

namespace {

PageData colour_section(Figures& figures, const ColourHeader& header,
                        const ColourMeasurement& measurement) {
  const Eigen::ArrayXd& nanometres = header.grid.nanometres();
  std::vector<SpectralCurve> curves;
  for (const ColourGeometryResult& result : measurement.geometries) {
    const Eigen::ArrayXd& factor = result.reading.radiance_factor;
    curves.push_back({.title = fmt::format("geometry {}", result.id),
                      .wavelength_nm = {nanometres.begin(), nanometres.end()},
                      .value = {factor.begin(), factor.end()}});
  }
  return device_section(
      measurement.sample, measurement.sample_title,
      {curves_figure(figures, CurveKind::radiance_factor,
                     fmt::format("Spectral radiance factor of {}", measurement.sample), curves)});
}

}  // namespace

std::string colour_page(const ColourHeader& header,
                        const std::vector<ColourMeasurement>& measurements) {
  Figures figures;
  PageList sections;
  for (const ColourMeasurement& measurement : measurements) {
    sections.push_back(colour_section(figures, header, measurement));
  }
  const Standard& standard = header.instrument.standard;
  return device_page(
      {.title = measurements.size() == 1 ? fmt::format("Colour of {}", measurements.front().sample)
                                         : fmt::format("Colour of {} samples", measurements.size()),
       .subtitle = fmt::format("{}: {}", standard.id, standard.title),
       .facts = {{"Instrument", header.instrument.title},
                 {"Computed for", conditions_words(header.conditions)},
                 {"Reference", "perfect reflecting diffuser through the same apertures"},
                 {"Wavelengths",
                  fmt::format("{:g} nm to {:g} nm, {}", header.grid.first().nanometres(),
                              header.grid.last().nanometres(), header.grid.size())},
                 {"Transcription", standard.transcription}},
       .tables = {colour_table(measurements)},
       .notes = colour_notes(header, measurements)},
      sections);
}

}  // namespace gonio
