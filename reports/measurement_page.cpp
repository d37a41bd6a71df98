#include <fmt/format.h>

#include "reports/measurement_report.hpp"
#include "reports/measurement_words.hpp"
#include "reports/page.hpp"
#include "reports/page_charts.hpp"

namespace gonio {

namespace {

PageList fact_list(const MeasurementHeader& header) {
  PageList list;
  const auto add = [&](const char* name, const std::string& value) {
    PageData data("name", name);
    data.set("value", value);
    list.push_back(data);
  };
  add("Instrument", header.instrument);
  add("Reference", header.reference);
  add("Integrator", header.integrator);
  add("Wavelengths", fmt::format("{:g} nm to {:g} nm, {}", header.grid.first().nanometres(),
                                 header.grid.last().nanometres(), header.grid.size()));
  add("Transcription", header.standard.transcription);
  return list;
}

PageData reading_data(const MeasurementHeader& header, const Measurement& measurement,
                      const GeometryResult& result) {
  PageData data("sample", measurement.sample);
  data.set("geometry", result.id);
  data.set("is_selected", PageData(measurement.selected_geometry == result.id));
  data.set("reported", reported_text(result.reading.gloss, header.standard));
  data.set("computed", fixed_text(result.reading.gloss, 4));
  data.set("error", fmt::format("{:.1e}", result.reading.quadrature_error));
  data.set("reflectance", fixed_text(result.reading.luminous_reflectance, 6));
  const auto colour_text = [&](double Lab::*coordinate) {
    return result.colour ? fixed_text(result.colour->lab.*coordinate, 2) : "-";
  };
  data.set("L", colour_text(&Lab::L));
  data.set("a", colour_text(&Lab::a));
  data.set("b", colour_text(&Lab::b));
  return data;
}

PageList reading_list(const MeasurementHeader& header,
                      const std::vector<Measurement>& measurements) {
  PageList list;
  for (const Measurement& measurement : measurements) {
    for (const GeometryResult& result : measurement.geometries) {
      list.push_back(reading_data(header, measurement, result));
    }
  }
  return list;
}

PageData spectra_figure(Figures& figures, const MeasurementHeader& header,
                        const Measurement& measurement) {
  const Eigen::ArrayXd& nanometres = header.grid.nanometres();
  std::vector<SpectralCurve> curves;
  for (const GeometryResult& result : measurement.geometries) {
    const Eigen::ArrayXd& reflectance = result.reading.reflectance;
    curves.push_back({.title = fmt::format("geometry {}", result.id),
                      .wavelength_nm = {nanometres.begin(), nanometres.end()},
                      .value = {reflectance.begin(), reflectance.end()}});
  }
  return curves_figure(
      figures, CurveKind::reflectance,
      fmt::format("Spectral reflectance of {} into the receptor", measurement.sample), curves);
}

PageData sample_data(Figures& figures, const MeasurementHeader& header,
                     const Measurement& measurement, const std::vector<Footprint>& footprints) {
  PageData data("sample", measurement.sample);
  data.set("sample_title", measurement.sample_title);
  data.set("spectra", PageData(PageList{spectra_figure(figures, header, measurement)}));
  PageList list;
  for (const Footprint& footprint : footprints) {
    list.push_back(footprint_figure(figures, footprint));
  }
  set_list(data, "footprints", list);
  return data;
}

}  // namespace

std::string measurement_page(const MeasurementHeader& header,
                             const std::vector<Measurement>& measurements,
                             const std::vector<std::vector<Footprint>>& footprints) {
  Figures figures;
  PageList samples;
  for (std::size_t i = 0; i < measurements.size(); ++i) {
    samples.push_back(sample_data(figures, header, measurements[i], footprints.at(i)));
  }
  std::vector<std::string> notes = sample_notes(header, measurements);
  if (const std::string informative = informative_note(measurements); !informative.empty()) {
    notes.push_back(informative);
  }
  for (const Measurement& measurement : measurements) {
    for (const std::string& warning : measurement.warnings) {
      notes.push_back(fmt::format("{}: {}", measurement.sample, warning));
    }
  }
  const std::string title = measurements.size() == 1
                                ? fmt::format("Gloss of {}", measurements.front().sample)
                                : fmt::format("Gloss of {} samples", measurements.size());
  PageData data;
  data.set("heading", title);
  data.set("standard_id", header.standard.id);
  data.set("standard_title", header.standard.title);
  data.set("unit", header.standard.scale.unit);
  data.set("facts", PageData(fact_list(header)));
  data.set("readings", PageData(reading_list(header, measurements)));
  set_list(data, "notes", text_list(notes));
  data.set("samples", PageData(samples));
  return render_page("measurement", title, data);
}

}  // namespace gonio
