#pragma once

#include <string>

#include "emulator/core/interval.hpp"
#include "emulator/statistics/control_chart.hpp"
#include "reports/page.hpp"

namespace gonio {

/// What the points of a control chart are, in the order of control.gnuplot.
enum class ControlPoints { x_bar, range, individual, moving_range, run, runs_moving_range };

/// A control chart with its limits, zones and signals, which have the shapes of their rules.
/// @param limits  of a specification, drawn too.
[[nodiscard]] PageData control_figure(Figures& figures, const ControlChart& chart,
                                      ControlPoints points, const std::string& caption,
                                      const Interval& limits = {});

}  // namespace gonio
