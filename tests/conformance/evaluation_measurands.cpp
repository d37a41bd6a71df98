// How readings are evaluated, without any device.
#include <fmt/format.h>

#include "emulator/instrument/glossmeter.hpp"
#include "emulator/procedure/evaluation.hpp"
#include "emulator/procedure/panel.hpp"
#include "tests/conformance/measurands.hpp"

namespace gonio::conformance {

namespace {

using GlossByGeometry = std::map<std::string, double>;

GlossByGeometry read_by_geometry(const YamlNode& node) {
  GlossByGeometry gloss;
  node.for_each_entry([&](const std::string& geometry, const YamlNode& value) {
    gloss[geometry] = value.gloss_gu();
  });
  return gloss;
}

/// The value of a polished glass by its refractive index.
Measurement read_assigned_value(YamlMap& when, MeasurandContext& context) {
  context.is_evaluation = true;
  const double n = when.required("n").number(Range::positive());
  return [=](const MeasurementContext& c) {
    std::vector<Finding> findings;
    for (const GeometryLimits& geometry : c.set.standard->geometries) {
      if (geometry.relative_to || (c.clause.geometry && *c.clause.geometry != geometry.id)) {
        continue;
      }
      findings.push_back(
          {.geometry = geometry.id,
           .subject = fmt::format("n = {:g}", n),
           .unit = c.set.standard->scale.unit,
           .value = assigned_gloss(n, geometry.theta_i.nominal, c.set.standard->scale)});
    }
    return findings;
  };
}

Measurement read_selected_geometry(YamlMap& when, MeasurandContext& context) {
  context.is_evaluation = true;
  const GlossByGeometry gloss = read_by_geometry(when.required("readings"));
  return [=](const MeasurementContext& c) {
    return std::vector<Finding>{{.text = c.set.standard->select_geometry(gloss).value_or("none")}};
  };
}

Measurement read_reported_value(YamlMap& when, MeasurandContext& context) {
  context.is_evaluation = true;
  const double value = when.required("value").gloss_gu();
  return [=](const MeasurementContext& c) {
    return std::vector<Finding>{{.subject = fmt::format("{:g} GU", value),
                                 .unit = "GU",
                                 .value = reported_value(value, *c.set.standard)}};
  };
}

Measurement read_haze(YamlMap& when, MeasurandContext& context) {
  context.is_evaluation = true;
  const GlossByGeometry gloss = read_by_geometry(when.required("readings"));
  return [=](const MeasurementContext& c) {
    std::vector<Finding> findings;
    for (const HazeRule& rule : c.set.standard->haze) {
      const HazeResult result = haze(rule, gloss);
      findings.push_back({.subject = rule.id, .unit = "GU", .value = result.value});
      if (!result.value) {
        findings.back().text = "none";
      }
    }
    return findings;
  };
}

/// What the standard's rule makes of the readings of one panel.
template <class Describe>
Measurement read_panel(YamlMap& when, MeasurandContext& context, Describe describe) {
  context.is_evaluation = true;
  std::vector<double> readings;
  for (const YamlNode& reading : when.required("readings").list()) {
    readings.push_back(reading.gloss_gu());
  }
  const YamlNode place = when.node();
  return [=](const MeasurementContext& c) {
    if (!c.set.standard->readings) {
      throw InputError(place.mark(), "a standard with rules for readings", c.set.id);
    }
    Finding finding{.subject = fmt::format("{} readings", readings.size()), .unit = "GU"};
    describe(judge_panel(readings, *c.set.standard->readings), finding);
    return std::vector{finding};
  };
}

Measurement read_panel_mean(YamlMap& when, MeasurandContext& context) {
  return read_panel(when, context, [](const PanelResult& panel, Finding& finding) {
    finding.value = panel.mean_gu;
  });
}

Measurement read_panel_range(YamlMap& when, MeasurandContext& context) {
  return read_panel(when, context, [](const PanelResult& panel, Finding& finding) {
    finding.value = panel.range_gu;
  });
}

Measurement read_panel_verdict(YamlMap& when, MeasurandContext& context) {
  return read_panel(when, context, [](const PanelResult& panel, Finding& finding) {
    finding.text = panel_verdict_name(panel.verdict);
  });
}

}  // namespace

std::map<std::string, MeasurandReader> evaluation_measurands() {
  return {{"assigned_value", read_assigned_value}, {"selected_geometry", read_selected_geometry},
          {"reported_value", read_reported_value}, {"haze", read_haze},
          {"panel_mean", read_panel_mean},         {"panel_range", read_panel_range},
          {"panel_verdict", read_panel_verdict}};
}

}  // namespace gonio::conformance
