#include "reports/acquisition_words.hpp"

#include <fmt/format.h>

#include <cmath>

#include "reports/qa_words.hpp"
#include "reports/uncertain_words.hpp"

namespace gonio {

namespace {

std::string number_or_dash(double value) {
  return value > 0.0 && std::isfinite(value) ? fmt::format("{:.0f}", value) : "-";
}

std::vector<std::string> notes_of(const AcquiredSpectrum& one) {
  const std::string& id = one.spectrum.geometry;
  std::vector<std::string> notes;
  if (one.saturated > 0) {
    notes.push_back(fmt::format("{}: {} of the detector saturated and left out", id,
                                count_text(one.saturated, "pixel")));
  }
  if (one.beyond_linear > 0) {
    notes.push_back(fmt::format("{}: {} beyond the linear range and left out", id,
                                count_text(one.beyond_linear, "pixel")));
  }
  if (one.without_value > 0) {
    notes.push_back(
        fmt::format("{}: {} of the grid without a value: no valid pixels there, or no "
                    "light of the mirror",
                    id, count_text(one.without_value, "band")));
  }
  if (one.low_signal > 0) {
    notes.push_back(
        fmt::format("{}: low signal in {}: the mirror is less than 10 times its "
                    "uncertainty, and u of the ratio is too small there",
                    id, count_text(one.low_signal, "band")));
  }
  if (one.linear_bands > 0) {
    notes.push_back(fmt::format("{}: {} linear between pixels, which lie wider than the grid", id,
                                count_text(one.linear_bands, "band")));
  }
  return notes;
}

}  // namespace

std::string noise_words(NoiseModel model) {
  switch (model) {
    case NoiseModel::repeats:
      return "standard error of the mean of each pixel";
    case NoiseModel::pooled:
      return "repeats, pooled over pixels: variance a + b * counts";
    case NoiseModel::detector:
      return "read noise and electrons per count, as stated";
    case NoiseModel::none:
      break;
  }
  return "not known: one repeat, and no noise of the detector stated";
}

ReportTable acquisition_table(const AcquisitionResult& result) {
  ReportTable table{.caption = "Spectra relative to the mirror",
                    .heads = {"geometry", ">bands", ">from nm", ">to nm", ">mean", ">median rho/u",
                              ">dynamic range", ">u2 by sample", ">by mirror", ">by dark"}};
  for (const AcquiredSpectrum& one : result.spectra) {
    const auto& lambda = one.spectrum.wavelength_nm;
    const auto share = [&](double value) {
      return one.signal_to_noise > 0.0 ? fmt::format("{:.0f} %", 100.0 * value) : "-";
    };
    table.rows.push_back({one.spectrum.geometry, fmt::format("{}", lambda.size()),
                          fmt::format("{:g}", lambda(0)),
                          fmt::format("{:g}", lambda(lambda.size() - 1)),
                          fmt::format("{:.6f}", one.spectrum.reflectance.mean()),
                          number_or_dash(one.signal_to_noise), number_or_dash(one.dynamic_range),
                          share(one.sample_share), share(one.mirror_share), share(one.dark_share)});
  }
  return table;
}

std::vector<std::string> acquisition_notes(const AcquisitionResult& result) {
  std::vector<std::string> notes{"uncertainty: " + noise_words(result.noise)};
  for (const AcquiredSpectrum& one : result.spectra) {
    for (std::string& note : notes_of(one)) {
      notes.push_back(std::move(note));
    }
    if (one.shares_dark && result.noise != NoiseModel::none) {
      notes.push_back(
          fmt::format("{}: sample and mirror share a dark, whose error enters the ratio once",
                      one.spectrum.geometry));
    }
  }
  for (const std::string& group : result.correlated) {
    notes.push_back(fmt::format(
        "geometries {} share a file: its errors are common to them, which u does not tell", group));
  }
  return notes;
}

}  // namespace gonio
