#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace gonio {

/// What a laboratory says of itself and of a calibration, for its certificate. Empty: not stated.
///
///     schema: gonio/laboratory/1
///     laboratory: {name: ..., address: ..., accreditation: ...}
///     certificate_number: 2026-0042
///     customer: ...
///     received: 2026-01-12        # dates: YYYY-MM-DD
///     calibrated: 2026-01-15
///     issued: 2026-01-16
///     environment: {temperature: 23 degC +- 1 degC, humidity: 45 % to 55 %}   # in words
///     reference_standards: [..., ...]
///     traceability: ...
///     procedure: ...
///     signatory: ...
///     notes: ...
struct Laboratory {
  std::string name = {}, address = {}, accreditation = {};
  std::string certificate_number = {}, customer = {};
  std::string received = {}, calibrated = {}, issued = {};  ///< YYYY-MM-DD
  std::string temperature = {}, humidity = {};
  std::vector<std::string> reference_standards = {};
  std::string traceability = {}, procedure = {}, signatory = {}, notes = {};
};

/// Reads a file of schema gonio/laboratory/1.
/// @throws InputError  for anything that is not as above, a date that no calendar has included, and
///                     dates that run backwards.
[[nodiscard]] Laboratory load_laboratory(const std::filesystem::path& file);

}  // namespace gonio
