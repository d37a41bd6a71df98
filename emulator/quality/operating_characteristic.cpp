#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "emulator/quality/acceptance_probability.hpp"
#include "emulator/quality/lot_study.hpp"
#include "emulator/quality/risk_study.hpp"
#include "emulator/statistics/sampling_plan.hpp"

namespace gonio {

namespace {

/// A curve is not looked at more closely than that share of its range.
constexpr double finest_step = 1.0 / 1024.0;
constexpr std::size_t fewest_points = 4;

/// Points of a curve, of which the next one is where it changes most.
class CurveStudy {
 public:
  CurveStudy(const Batch& batch, const ReadingUncertainties& uncertainties,
             const OcRequest& request, const RiskOptions& options)
      : batch_(batch),
        uncertainties_(uncertainties),
        request_(request),
        options_(options),
        closed_form_(batch, uncertainties, request.channel),
        progress_(options, "operating characteristic",
                  std::max(request.points, fewest_points) * study_steps(options.lots_per_point)) {}

  [[nodiscard]] OcCurve result() {
    const std::size_t points = std::max(request_.points, fewest_points);
    const std::size_t even = std::max(fewest_points - 1, points / 2);
    for (std::size_t i = 0; i < even; ++i) {
      const double share = double(i) / double(even - 1);
      try_at(i + 1 == even ? request_.high : request_.low + share * (request_.high - request_.low));
    }
    if (request_.low < 0.0 && request_.high > 0.0 && !points_.contains(0.0)) {
      try_at(0.0);  // the product as it is
    }
    while (points_.size() < points && try_where_it_changes()) {
    }
    progress_.finish();
    OcCurve curve{.channel = request_.channel,
                  .parameter = request_.parameter,
                  .closed_form = has_exact_ ? closed_form_.closed_form() : std::string(),
                  .lots = options_.lots_per_point,
                  .present_mean = present_mean(),
                  .points = {}};
    for (const auto& [offset, point] : points_) {
      curve.points.push_back(point);
    }
    return curve;
  }

 private:
  [[nodiscard]] double present_mean() const {
    const auto present = request_.shifted(0.0);
    const auto normal = present->normal_components(request_.channel);
    return normal ? normal->mean : true_mean(*present, request_.channel, options_.lots_per_point);
  }

  /// Acceptance of the normal product that has the moments of what was simulated: of lots and
  /// panels, and of what panel means are off, by instrument. Of these, what its uncertainty states
  /// is shared by a lot; the rest is each panel's own.
  [[nodiscard]] std::optional<double> for_moments(const ChannelTruths& seen) const {
    std::vector<double> bias;
    double own = 0.0, panels = 0.0;  // sum of squares, and of how many
    for (std::size_t i = 0; i < seen.errors.size(); ++i) {
      const Moments& errors = seen.errors[i];
      const double shared =
          uncertainties_[i * batch_.channels.size() + request_.channel].systematic;
      const double sd = errors.standard_deviation();
      bias.push_back(errors.mean());
      own += double(errors.count()) * std::max(0.0, sd * sd - shared * shared);
      panels += double(errors.count());
    }
    const double readings = double(batch_.plan.positions.size() * batch_.plan.repetitions);
    return closed_form_({.mean = seen.lot_means.mean(),
                         .sd_lots = seen.lot_means.standard_deviation(),
                         .sd_panels = seen.lot_spreads.root_mean_square(),
                         .sd_readings = panels > 0.0 ? std::sqrt(readings * own / panels) : 0.0},
                        bias);
  }

  void try_at(double offset) {
    const auto source = request_.shifted(offset);
    const LotStudy study =
        study_lots(batch_, uncertainties_, *source, options_.lots_per_point, progress_);
    const ChannelTruths& seen = study.channels[request_.channel];
    OcPoint point{.offset = offset,
                  .mean = seen.lot_means.mean(),
                  .beyond = seen.lot_beyond.mean(),
                  .accepted = proportion(study.lots.accepted, study.lots.all)};
    const auto drawn_from = source->normal_components(request_.channel);
    if (drawn_from) {
      point.mean = drawn_from->mean;
      if (const Requirement* requirement = batch_.requirement(request_.channel)) {
        point.beyond =
            beyond_limits(point.mean, std::hypot(drawn_from->sd_lots, drawn_from->sd_panels),
                          requirement->limits);
      }
    }
    point.exact = drawn_from ? closed_form_(*drawn_from) : for_moments(seen);
    has_exact_ = has_exact_ || point.exact.has_value();
    points_.emplace(offset, point);
  }

  using Point = std::map<double, OcPoint>::const_iterator;

  static double slope(Point a, Point b) {
    return (b->second.accepted.value - a->second.accepted.value) / (b->first - a->first);
  }

  /// How much acceptance changes from a to the next point, and how far it may bend away in between:
  /// the top of a curve between two limits may be there.
  [[nodiscard]] double change_after(Point a) const {
    const Point b = std::next(a), after = std::next(b);
    const double width = b->first - a->first;
    const double before = a == points_.begin() ? slope(a, b) : slope(std::prev(a), a);
    const double then = after == points_.end() ? slope(a, b) : slope(b, after);
    return width * (std::abs(slope(a, b)) + 0.25 * std::abs(before - then));
  }

  /// In the middle of the step in which most is decided, the widest of equal ones.
  /// @return  false if all steps are too small.
  bool try_where_it_changes() {
    const double finest = finest_step * (request_.high - request_.low);
    double best = -1.0, width = 0.0, offset = 0.0;
    for (Point a = points_.begin(); std::next(a) != points_.end(); ++a) {
      const Point b = std::next(a);
      const double change = change_after(a), wide = b->first - a->first;
      if (wide > finest && (change > best || (change == best && wide > width))) {
        best = change;
        width = wide;
        offset = 0.5 * (a->first + b->first);
      }
    }
    if (width == 0.0) {
      return false;
    }
    try_at(offset);
    return true;
  }

  const Batch& batch_;
  const ReadingUncertainties& uncertainties_;
  const OcRequest& request_;
  const RiskOptions& options_;
  AcceptanceProbability closed_form_;
  StudyProgress progress_;
  std::map<double, OcPoint> points_;
  bool has_exact_ = false;
};

}  // namespace

OcCurve operating_characteristic(const Batch& batch, const ReadingUncertainties& uncertainties,
                                 const OcRequest& request, const RiskOptions& options) {
  if (!(request.low < request.high)) {
    throw std::invalid_argument(
        fmt::format("operating_characteristic: expected a range of offsets, found {} to {}",
                    request.low, request.high));
  }
  return CurveStudy(batch, uncertainties, request, options).result();
}

}  // namespace gonio
