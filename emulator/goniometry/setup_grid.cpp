#include "emulator/goniometry/setup_grid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <utility>

#include "emulator/core/parallel_for.hpp"
#include "emulator/goniometry/setup_calibration.hpp"
#include "emulator/integration/aperture_integrator.hpp"
#include "emulator/integration/patch_integrator.hpp"

namespace gonio {

namespace {

using Eigen::ArrayXd;

/// What counts as the same RMSE, relative.
constexpr double same_rmse = 0.01;

std::shared_ptr<const FluxIntegrator> integrator_of(std::optional<int> patches) {
  if (!patches) {
    return std::make_shared<ApertureIntegrator>();
  }
  const auto resolution = patch_resolution(*patches);
  if (!resolution) {
    throw std::invalid_argument(
        fmt::format("expected a number of patches 3 N^2, N a multiple of 4, found {}", *patches));
  }
  return std::make_shared<PatchIntegrator>(*resolution);
}

std::vector<std::string> geometries_of(const SetupModel& model) {
  std::vector<std::string> ids;
  for (const CalibrationSpectrum& one : model.spectra()) {
    if (std::ranges::find(ids, one.spectrum.geometry) == ids.end()) {
      ids.push_back(one.spectrum.geometry);
    }
  }
  return ids;
}

/// Fills in the errors of a row, by one instrument and integrator.
void measure(GridRow& row, const SetupModel& model, const Instrument& instrument) {
  ArrayXd difference(0);
  double sum = 0.0;
  double measured = 0.0;
  Eigen::Index n = 0;
  try {
    for (std::size_t i = 0; i < model.spectra().size(); ++i) {
      const ArrayXd& found = model.spectra()[i].spectrum.reflectance;
      sum += (model.spectrum(i, instrument) - found).square().sum();
      measured += found.square().sum();
      n += found.size();
    }
  } catch (const std::domain_error&) {  // an angle or an opening beyond its range
    sum = std::numeric_limits<double>::infinity();
  }
  row.rmse = std::isnan(sum) ? std::numeric_limits<double>::infinity() : std::sqrt(sum / double(n));
  row.relative_rmse = row.rmse / std::sqrt(measured / double(n));
}

std::vector<GridRow> rows_of(const GridAxes& axes) {
  std::vector<GridRow> rows;
  for (const Angle offset : axes.angle_offsets) {
    for (const Angle source : axes.sources) {
      for (const Angle receptor : axes.receptors) {
        for (const int patches : axes.patches) {
          rows.push_back(
              {.angle_offset = offset, .source = source, .receptor = receptor, .patches = patches});
        }
        rows.push_back({.angle_offset = offset, .source = source, .receptor = receptor});
      }
    }
  }
  return rows;
}

SetupModel with_integrator(const SetupModel& model, std::optional<int> patches) {
  return {model.instrument(), model.spectra(), {}, model.reference(), integrator_of(patches)};
}

template <class Rows, class Accepts>
auto smallest(Rows& rows, const Accepts& accepts) {
  auto best = rows.end();
  for (auto row = rows.begin(); row != rows.end(); ++row) {
    if (accepts(*row) && (best == rows.end() || row->rmse < best->rmse)) {
      best = row;
    }
  }
  return best;
}

double smallest_rmse(const std::vector<GridRow>& rows, bool at_least) {
  const auto found = smallest(rows, [&](const GridRow& row) {
    return !row.patches && (row.receptor >= row.source) == at_least;
  });
  return found == rows.end() ? std::numeric_limits<double>::infinity() : found->rmse;
}

bool is_same_setup(const GridRow& a, const GridRow& b) {
  return a.angle_offset == b.angle_offset && a.source == b.source && a.receptor == b.receptor;
}

}  // namespace

std::optional<int> patch_resolution(int patches) {
  const int n = int(std::lround(std::sqrt(double(std::max(patches, 0)) / 3.0)));
  return n >= 4 && n <= 4096 && n % 4 == 0 && 3 * n * n == patches ? std::optional(n)
                                                                   : std::nullopt;
}

const GridRow& SetupGrid::best(std::optional<int> patches) const {
  const auto found = smallest(rows, [&](const GridRow& row) { return row.patches == patches; });
  if (found == rows.end()) {
    throw std::invalid_argument("SetupGrid: no set-up with such a subdivision");
  }
  return *found;
}

const GridRow& SetupGrid::best() const {
  return *smallest(rows, [](const GridRow&) { return true; });
}

std::size_t size_of(const GridAxes& axes) {
  return axes.angle_offsets.size() * axes.sources.size() * axes.receptors.size() *
         (axes.patches.size() + 1);
}

Instrument with_setup(Instrument instrument, const std::vector<std::string>& geometries,
                      const GridRow& row) {
  for (const std::string& geometry : geometries) {
    for (const SetupQuantity quantity : {SetupQuantity::theta_i, SetupQuantity::theta_r}) {
      const Angle built = as_built(instrument, geometry, quantity)->value;
      instrument = with_quantity(std::move(instrument), geometry, quantity,
                                 {.value = degrees(built.degrees() + row.angle_offset.degrees())});
    }
    GeometryAsBuilt& built = instrument.as_built[geometry];
    built.source = {.diameter = AngleAsBuilt{.value = row.source}, .mark = built.mark};
    built.receptor = {.diameter = AngleAsBuilt{.value = row.receptor}, .mark = built.mark};
  }
  return instrument;
}

SetupGrid try_grid(const SetupModel& model, const GridAxes& axes, std::optional<int> patches,
                   const std::function<void()>& advance) {
  if (axes.angle_offsets.empty() || axes.sources.empty() || axes.receptors.empty()) {
    throw std::invalid_argument("try_grid: expected values on each axis, found none on one");
  }
  const std::vector<std::string> geometries = geometries_of(model);
  std::vector<std::pair<std::optional<int>, SetupModel>> models;
  models.emplace_back(std::nullopt, with_integrator(model, std::nullopt));
  for (const int n : axes.patches) {
    models.emplace_back(n, with_integrator(model, n));
  }
  SetupGrid grid{.rows = rows_of(axes)};
  const MeasuringGeometry first = model.instrument().geometry(geometries.front());
  grid.as_built = {.source = degrees(2.0 * first.source.radius().degrees()),
                   .receptor = degrees(2.0 * first.receptor.radius().degrees()),
                   .patches = patches};
  measure(grid.as_built, with_integrator(model, patches), model.instrument());
  std::mutex mutex;
  parallel_for(grid.rows.size(), [&](std::size_t i) {
    GridRow& row = grid.rows[i];
    const auto found =
        std::ranges::find(models, row.patches, &std::pair<std::optional<int>, SetupModel>::first);
    measure(row, found->second, with_setup(model.instrument(), geometries, row));
    if (advance) {
      const std::scoped_lock lock(mutex);
      advance();
    }
  });
  return grid;
}

GridFindings findings_of(const SetupGrid& grid) {
  const GridRow& best = grid.best(std::nullopt);
  GridFindings found{.receptor_at_least_source = smallest_rmse(grid.rows, true),
                     .receptor_smaller = smallest_rmse(grid.rows, false)};
  for (const GridRow& row : grid.rows) {
    found.as_good += !row.patches && row.rmse <= (1.0 + same_rmse) * best.rmse ? 1 : 0;
    if (is_same_setup(row, best)) {
      found.subdivisions.push_back(
          {.patches = row.patches, .at_best = row.rmse, .smallest = grid.best(row.patches).rmse});
    }
  }
  std::ranges::stable_sort(found.subdivisions, {}, [](const GridFindings::BySubdivision& one) {
    return one.patches.value_or(std::numeric_limits<int>::max());
  });
  for (std::size_t i = found.subdivisions.size() - 1; i-- > 0;) {
    const double change = std::abs(found.subdivisions[i].at_best - best.rmse);
    if (change > same_rmse * best.rmse) {
      break;
    }
    found.enough_patches = found.subdivisions[i].patches;
  }
  return found;
}

}  // namespace gonio
