#pragma once

#include <string>

#include "tests/unit/reports/example_certificate.hpp"
#include "tests/unit/reports/hostile_report.hpp"

// The example with texts that want to be more than text, wherever a text can stand.

namespace gonio::test {

inline void spoil(Certificate& certificate, const std::string& text) {
  Instrument& instrument = certificate.instrument;
  instrument.id = instrument.title = instrument.notes = text;
  instrument.identity = {text, text, text, text, text, text};
  Standard& standard = certificate.standard;
  standard.id = standard.title = standard.edition = standard.transcription = text;
  standard.notes = standard.scale.unit = text;
  for (CertificateLimit& limit : certificate.limits) {
    limit.clause = limit.note = text;
    limit.limit.quantity = limit.limit.geometry = limit.limit.unit = text;
    spoil(limit.limit.evidence, text);
    spoil(limit.limit.mark, text);
  }
  for (std::string& sample : certificate.samples) {
    sample = text;
  }
  for (std::string& title : certificate.sample_titles) {
    title = text;
  }
  for (CertificateInput& input : certificate.inputs) {
    input.id = input.component = input.geometry = input.unit = text;
  }
}

inline void spoil(SetupEstimate& estimate, const std::string& text) {
  estimate.geometry = text;
  for (EstimatedParameter& parameter : estimate.parameters) {
    parameter.name = parameter.unit = text;
  }
  for (TileReading& reading : estimate.readings) {
    reading.sample = reading.geometry = text;
    spoil(reading.mark, text);
  }
}

inline Certificate hostile_certificate(const std::string& text) {
  Certificate certificate = example_certificate();
  spoil(certificate, text);
  for (GeometryCertificate& geometry : certificate.geometries) {
    geometry.id = text;
    for (DeviationEffect& effect : geometry.effects) {
      effect.geometry = effect.component = effect.unit = text;
    }
  }
  for (SetupEstimate& estimate : certificate.estimates) {
    spoil(estimate, text);
  }
  return certificate;
}

inline CertificateReport hostile_report_of(const Certificate& certificate,
                                           const std::string& text) {
  return {.certificate = certificate,
          .laboratory = {text,
                         text,
                         text,
                         text,
                         text,
                         text,
                         text,
                         text,
                         text,
                         text,
                         {text, text},
                         text,
                         text,
                         text,
                         text},
          .version = text,
          .date = text,
          .sources = {{text, text}}};
}

}  // namespace gonio::test
