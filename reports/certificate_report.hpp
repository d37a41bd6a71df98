#pragma once

#include <map>
#include <string>

#include "emulator/procedure/certificate.hpp"
#include "reports/laboratory.hpp"

namespace gonio {

/// Of which samples a budget is shown.
enum class Budgets {
  main,  ///< the one with the largest U, and the one that reads most like the reference
  all
};

/// What stands on a certificate.
struct CertificateReport {
  const Certificate& certificate;
  Laboratory laboratory = {};
  std::string version = {};  ///< of gonio
  std::string date = {};     ///< of today, YYYY-MM-DD: issued then unless the laboratory says when
  std::map<std::string, std::string> sources = {};  ///< what the source keys stand for
  Budgets budgets = Budgets::main;
};

/// For a terminal: verdict, limits, the ladder of each geometry, budgets, the set-up from readings.
[[nodiscard]] std::string certificate_text(const CertificateReport& report, bool styled);
/// Schema gonio/certificate/1: everything, numbers at full precision.
[[nodiscard]] std::string certificate_json(const CertificateReport& report);
/// A page that prints on A4 as a calibration certificate; charts inside, no network needed.
/// @throws std::system_error  if gnuplot cannot be run.
[[nodiscard]] std::string certificate_page(const CertificateReport& report);

}  // namespace gonio
