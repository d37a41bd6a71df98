#pragma once

#include <string>
#include <vector>

#include "reports/certificate_report.hpp"
#include "reports/component_words.hpp"
#include "reports/conformance_report.hpp"
#include "reports/uncertain_words.hpp"

// How a certificate is put into words, the same in every format. Nothing is escaped here.

namespace gonio {

/// What the verdict means, in a sentence.
[[nodiscard]] std::string certificate_meaning(const Certificate& certificate);
/// What a reader must know before using it, a sentence each.
[[nodiscard]] std::vector<std::string> certificate_warnings(const Certificate& certificate);
/// The rule by which limits are decided, with its guard band.
[[nodiscard]] std::string decision_words(const Certificate& certificate);
/// That nobody measured this instrument, and what that means.
[[nodiscard]] std::string simulation_words();

/// A limit as what was observed: its words are those of the conformance reports. U has two
/// digits.
[[nodiscard]] Observation observation_of(const CertificateLimit& limit);
/// Names of the ladder, whatever the lists hold.
[[nodiscard]] std::string sample_id(const Certificate& certificate, std::size_t sample);
[[nodiscard]] std::string sample_title(const Certificate& certificate, std::size_t sample);
/// e.g. "pass, not counted".
[[nodiscard]] std::string verdict_of(const CertificateLimit& limit);
/// To whole numbers; in words what is infinite.
[[nodiscard]] std::string freedom_text(double degrees_of_freedom);
/// The standard uncertainty of an input, to three digits: it is put in, not a result.
[[nodiscard]] std::string input_text(double standard_uncertainty);
/// The corner of a worst case, e.g. "theta_i 59.9 deg, theta_r 60.1 deg".
[[nodiscard]] std::string corner_text(const GeometryCertificate& geometry, const WorstCase& corner);
/// Whether Monte Carlo read the sample through the optics themselves.
[[nodiscard]] bool is_read_directly(const GeometryCertificate& geometry, std::size_t sample);
/// The largest error of the surrogate, and which samples were read without it.
[[nodiscard]] std::string surrogate_words(const Certificate& certificate,
                                          const GeometryCertificate& geometry);

/// What the readings of tiles tell of a set-up, and how well the model holds, in a sentence.
[[nodiscard]] std::string fit_words(const SetupEstimate& estimate);
/// What they do not tell apart, in a sentence.
[[nodiscard]] std::string confusion_words(const SetupEstimate& estimate,
                                          const Confusion& confusion);

}  // namespace gonio
