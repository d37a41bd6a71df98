// What a device reads, and how it behaves.
#include <fmt/format.h>

#include <cmath>

#include "tests/conformance/measurands.hpp"

namespace gonio::conformance {

namespace {

constexpr int usual_readings = 3;

int read_count(YamlMap& when, int usual = usual_readings) {
  const auto readings = when.optional("readings");
  return readings ? readings->integer(1, 999) : usual;
}

std::string read_sample(YamlMap& when, MeasurandContext& context,
                        const std::string& key = "sample") {
  std::string id = when.required(key).id();
  context.samples.insert(id);
  return id;
}

double read_duration_s(YamlMap& when, const std::string& key) {
  return when.required(key).time_s(Range::not_negative());
}

/// Whether a clause of one geometry, or of none, is about this one.
bool is_meant(const Clause& clause, const std::string& geometry) {
  return !clause.geometry || *clause.geometry == geometry;
}

std::optional<double> full_scale(const MeasurementContext& context, const std::string& geometry) {
  const auto channel = context.bench.channel(geometry);
  return channel ? context.bench.port().channels()[*channel].full_scale_gu : std::nullopt;
}

Finding finding_of(const MeasurementContext& context, const ChannelReadings& readings,
                   const std::string& subject) {
  Finding finding{.geometry = readings.geometry, .subject = subject, .unit = "GU"};
  finding.full_scale = full_scale(context, readings.geometry);
  if (readings.is_over_range) {
    finding.text = "over_range";
    return finding;
  }
  finding.value = readings.mean_gu();
  finding.expanded_uncertainty = context.bench.expanded_uncertainty_gu(readings);
  return finding;
}

std::vector<Finding> findings_of(const MeasurementContext& context,
                                 const std::vector<ChannelReadings>& all,
                                 const std::string& subject) {
  std::vector<Finding> findings;
  for (const ChannelReadings& readings : all) {
    if (is_meant(context.clause, readings.geometry)) {
      findings.push_back(finding_of(context, readings, subject));
    }
  }
  if (findings.empty()) {
    throw NotOffered("the device has no such geometry");
  }
  return findings;
}

/// Mean of readings of a sample, after calibration.
Measurement read_gloss(YamlMap& when, MeasurandContext& context) {
  const std::string sample = read_sample(when, context);
  const int readings = read_count(when);
  return [=](const MeasurementContext& c) {
    c.bench.prepare();
    return findings_of(c, c.bench.read(PortCover::sample, sample, readings), sample);
  };
}

/// The ratio of readings of two samples.
Measurement read_gloss_ratio(YamlMap& when, MeasurandContext& context) {
  const std::string sample = read_sample(when, context);
  const std::string to = read_sample(when, context, "to");
  const int readings = read_count(when);
  return [=](const MeasurementContext& c) {
    c.bench.prepare();
    const auto above = findings_of(c, c.bench.read(PortCover::sample, sample, readings), sample);
    const auto below = findings_of(c, c.bench.read(PortCover::sample, to, readings), to);
    std::vector<Finding> ratios;
    for (std::size_t j = 0; j < above.size(); ++j) {
      if (!above[j].value || !below[j].value) {
        continue;  // over range: it tells nothing of their ratio
      }
      const double ratio = *above[j].value / *below[j].value;
      const double relative = std::hypot(above[j].expanded_uncertainty / *above[j].value,
                                         below[j].expanded_uncertainty / *below[j].value);
      ratios.push_back({.geometry = above[j].geometry,
                        .subject = fmt::format("{} / {}", sample, to),
                        .value = ratio,
                        .expanded_uncertainty = ratio * relative});
    }
    if (ratios.empty()) {
      throw NotOffered("both samples are over the range of the device");
    }
    return ratios;
  };
}

struct LinearityArtefact {
  std::string sample;
  PolishedArtefact made_of;
};

/// The angle at which the device states that it works: an angle that is off is no error of
/// linearity.
Angle working_angle(const MeasurementContext& c, const std::string& geometry) {
  const auto stated = c.bench.port().setup(*c.bench.channel(geometry), SetupQuantity::theta_i);
  return stated ? stated->value : c.set.standard->geometry(geometry).theta_i.nominal;
}

/// Deviation of one artefact from its closed form, relative to full scale.
Finding deviation_from_line(const MeasurementContext& c, const ChannelReadings& readings,
                            const LinearityArtefact& artefact) {
  const Standard& standard = *c.set.standard;
  const Angle theta_i = working_angle(c, readings.geometry);
  const double expected = closed_form_gloss(artefact.made_of, theta_i, standard.scale);
  Finding finding{.geometry = readings.geometry, .subject = artefact.sample};
  const double scale =
      full_scale(c, readings.geometry)
          .value_or(closed_form_gloss({.reflectance = 1.0}, theta_i, standard.scale));
  if (readings.is_over_range) {
    finding.text = expected > scale ? "" : "over_range";
    finding.note =
        fmt::format("over range; {:.1f} GU expected, full scale {:.1f} GU", expected, scale);
    return finding;
  }
  finding.value = (readings.mean_gu() - expected) / scale;
  finding.expanded_uncertainty = c.bench.expanded_uncertainty_gu(readings) / scale;
  finding.note = fmt::format("read {:.2f} GU, closed form {:.2f} GU, full scale {:.1f} GU",
                             readings.mean_gu(), expected, scale);
  return finding;
}

Measurement read_linearity(YamlMap& when, MeasurandContext& context) {
  std::vector<LinearityArtefact> artefacts;
  for (const YamlNode& node : when.required("artefacts").list()) {
    artefacts.push_back(node.read_map([&](YamlMap& map) {
      LinearityArtefact artefact{.sample = read_sample(map, context), .made_of = {}};
      artefact.made_of = read_polished_artefact(map.required("fresnel"));
      return artefact;
    }));
  }
  const int readings = read_count(when);
  return [=](const MeasurementContext& c) {
    c.bench.prepare();
    std::vector<Finding> findings;
    for (const LinearityArtefact& artefact : artefacts) {
      for (const auto& read : c.bench.read(PortCover::sample, artefact.sample, readings)) {
        if (!is_meant(c.clause, read.geometry)) {
          continue;
        }
        Finding finding = deviation_from_line(c, read, artefact);
        if (finding.value || !finding.text.empty()) {
          findings.push_back(std::move(finding));
        }
      }
    }
    return findings;
  };
}

/// Reading of the black trap, after its zero was found there, or without.
Measurement read_zero(YamlMap& when, MeasurandContext&) {
  const auto corrected = when.optional("corrected");
  const bool is_corrected = !corrected || corrected->boolean();
  const int readings = read_count(when, 10);
  return [=](const MeasurementContext& c) {
    if (is_corrected) {
      c.bench.prepare();
    } else {
      c.bench.forget();
      c.bench.wait_until_ready();
      c.bench.must(DeviceCommand::restart);
      c.bench.wait_until_ready();
      c.bench.port().place(PortCover::tile);
      c.bench.must(DeviceCommand::calibrate);
    }
    return findings_of(c, c.bench.read(PortCover::black_trap, {}, readings), "black trap");
  };
}

/// The tile as the expected reading: what its certificate says.
void expect_tile(const MeasurementContext& c, std::vector<Finding>& findings) {
  for (Finding& finding : findings) {
    finding.expected =
        c.bench.port().channels()[*c.bench.channel(finding.geometry)].tile_assigned_gu;
    finding.origin = "assigned value of the tile";
  }
}

/// Reading of the tile after the device has worked for some time since its calibration.
Measurement read_drift(YamlMap& when, MeasurandContext&) {
  const double over_s = read_duration_s(when, "over");
  const int readings = read_count(when);
  return [=](const MeasurementContext& c) {
    c.bench.forget();
    c.bench.prepare();
    c.bench.port().pass(over_s);
    auto findings = findings_of(c, c.bench.read(PortCover::tile, {}, readings), "tile");
    expect_tile(c, findings);
    c.bench.forget();
    return findings;
  };
}

/// Change of the reading of the tile from the end of the warm-up on.
Measurement read_warm_up_change(YamlMap& when, MeasurandContext&) {
  const double settle_s = read_duration_s(when, "settle");
  const int readings = read_count(when);
  return [=](const MeasurementContext& c) {
    c.bench.must(DeviceCommand::restart);
    c.bench.forget();
    c.bench.prepare();
    const auto first = findings_of(c, c.bench.read(PortCover::tile, {}, readings), "tile");
    c.bench.port().pass(settle_s);
    auto findings = findings_of(c, c.bench.read(PortCover::tile, {}, readings), "tile");
    for (std::size_t j = 0; j < findings.size(); ++j) {
      if (findings[j].value && first[j].value) {
        findings[j].value = *findings[j].value - *first[j].value;
        findings[j].expanded_uncertainty =
            std::hypot(findings[j].expanded_uncertainty, first[j].expanded_uncertainty);
      }
    }
    c.bench.forget();
    return findings;
  };
}

std::string name_of(DeviceError error) {
  switch (error) {
    case DeviceError::none:
      return "none";
    case DeviceError::warming_up:
      return "warming_up";
    case DeviceError::not_calibrated:
      return "not_calibrated";
    case DeviceError::busy:
      return "busy";
    case DeviceError::lamp_failure:
      return "lamp_failure";
    default:
      return fmt::format("error_{}", int(error));
  }
}

/// What the device says when it is asked to measure too early.
Measurement read_refusal(YamlMap& when, MeasurandContext&) {
  (void)when.required("command").choice({"measure"});
  const bool is_warm = when.required("state").choice({"warm_up", "not_calibrated"}) != "warm_up";
  return [=](const MeasurementContext& c) {
    c.bench.forget();
    c.bench.must(DeviceCommand::restart);
    if (is_warm) {
      c.bench.wait_until_ready();
    }
    const DeviceError error = c.bench.port().command(DeviceCommand::measure);
    return std::vector<Finding>{{.text = name_of(error)}};
  };
}

Measurement read_calibration_due(YamlMap& when, MeasurandContext&) {
  const double after_s = read_duration_s(when, "after");
  return [=](const MeasurementContext& c) {
    c.bench.forget();
    c.bench.prepare();
    c.bench.port().pass(after_s);
    const bool is_due = c.bench.port().status().is_calibration_due;
    c.bench.forget();
    return std::vector<Finding>{{.text = is_due ? "yes" : "no"}};
  };
}

/// Standard deviation of readings of the same place, one after the other.
Measurement read_repeatability(YamlMap& when, MeasurandContext& context) {
  const std::string sample = read_sample(when, context);
  const int readings = read_count(when, 10);
  return [=](const MeasurementContext& c) {
    c.bench.prepare();
    const auto all = c.bench.read(PortCover::sample, sample, readings);
    auto findings = findings_of(c, all, sample);
    for (Finding& finding : findings) {
      for (const ChannelReadings& one : all) {
        if (one.geometry == finding.geometry && finding.value) {
          finding.value = one.deviation_gu();
          finding.expanded_uncertainty = 0.0;
          finding.note = fmt::format("of {} readings", readings);
        }
      }
    }
    return findings;
  };
}

}  // namespace

std::map<std::string, MeasurandReader> reading_measurands() {
  return {{"gloss", read_gloss},
          {"gloss_ratio", read_gloss_ratio},
          {"linearity", read_linearity},
          {"zero", read_zero},
          {"tile_deviation", read_gloss},
          {"drift", read_drift},
          {"warm_up_change", read_warm_up_change},
          {"refusal", read_refusal},
          {"calibration_due", read_calibration_due},
          {"repeatability", read_repeatability}};
}

}  // namespace gonio::conformance
