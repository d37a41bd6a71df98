#include <fmt/format.h>

#include "reports/acquisition_report.hpp"
#include "reports/acquisition_words.hpp"

namespace gonio {

std::string acquisition_text(const AcquisitionResult& result, bool styled) {
  std::string text = heading_text(result.title, styled) + "\n";
  text += table_text(acquisition_table(result), styled) + "\n";
  for (const std::string& note : acquisition_notes(result)) {
    text += note + "\n";
  }
  return text;
}

std::string acquisition_csv(const AcquisitionResult& result) {
  std::vector<ReflectanceSpectrum> spectra;
  for (const AcquiredSpectrum& one : result.spectra) {
    spectra.push_back(one.spectrum);
  }
  return reflectance_spectra_csv(spectra);
}

}  // namespace gonio
