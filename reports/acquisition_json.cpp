#include <nlohmann/json.hpp>

#include "reports/acquisition_report.hpp"
#include "reports/acquisition_words.hpp"
#include "reports/json_values.hpp"

namespace gonio {

namespace {

using nlohmann::ordered_json;

const char* name_of(NoiseModel model) {
  switch (model) {
    case NoiseModel::repeats:
      return "repeats";
    case NoiseModel::pooled:
      return "pooled";
    case NoiseModel::detector:
      return "detector";
    case NoiseModel::none:
      break;
  }
  return "none";
}

ordered_json spectrum_json(const AcquiredSpectrum& one) {
  ordered_json json{
      {"geometry", one.spectrum.geometry},
      {"saturated_pixels", one.saturated},
      {"nonlinear_pixels", one.beyond_linear},
      {"bands_without_value", one.without_value},
      {"low_signal_bands", one.low_signal},
      {"linear_bands", one.linear_bands},
      {"dynamic_range", one.dynamic_range},
      {"signal_to_noise", one.signal_to_noise},
      {"shares_dark", one.shares_dark},
      {"variance_shares",
       {{"sample", one.sample_share}, {"mirror", one.mirror_share}, {"dark", one.dark_share}}},
      {"wavelength_nm", json_of(one.spectrum.wavelength_nm)},
      {"reflectance", json_of(one.spectrum.reflectance)}};
  json["u"] = one.spectrum.u.size() > 0 ? ordered_json(json_of(one.spectrum.u)) : nullptr;
  return json;
}

}  // namespace

std::string acquisition_json(const AcquisitionResult& result) {
  ordered_json json{{"schema", "gonio/acquired_spectra/1"},
                    {"id", result.id},
                    {"title", result.title},
                    {"sample", result.sample},
                    {"noise", name_of(result.noise)},
                    {"notes", acquisition_notes(result)}};
  json["correlated_geometries"] = result.correlated;
  json["spectra"] = ordered_json::array();
  for (const AcquiredSpectrum& one : result.spectra) {
    json["spectra"].push_back(spectrum_json(one));
  }
  return json_text(json);
}

}  // namespace gonio
