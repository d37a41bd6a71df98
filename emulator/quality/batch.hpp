#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "emulator/core/catalog.hpp"
#include "emulator/core/input_error.hpp"
#include "emulator/core/interval.hpp"
#include "emulator/instrument/instrument.hpp"
#include "emulator/quality/measured_format.hpp"
#include "emulator/quality/records.hpp"
#include "emulator/standard/decision.hpp"
#include "emulator/standard/standard.hpp"
#include "emulator/surface/sample_deviation.hpp"
#include "emulator/uncertainty/distribution.hpp"

namespace gonio {

/// What may vary in a product: the parameters of SampleDeviation, in its order. The roughness is
/// the logarithm of its ratio to that of the sample file, so that 0.01 is 1 %; the others are
/// added.
using ProductDeviation = std::array<double, sample_parameter_count>;

/// How one parameter varies. What varies within a panel is the unevenness of the film.
struct ParameterSpread {
  Distribution lots = {}, panels = {};
  double within_panel = 0.0;  ///< standard deviation of a normal distribution

  [[nodiscard]] double total() const;  ///< standard deviation of all three together
};

/// Two parameters whose deviations go together, in lots, from panel to panel and within a panel.
struct ProductCorrelation {
  std::size_t a = 0, b = 0;  ///< of sample_parameter_names
  double coefficient = 0.0;
};

/// A place on a panel: of the centre of a reading.
struct PanelPlace {
  double x_mm = 0.0;  ///< along the plane of measurement, from the left edge
  double y_mm = 0.0;  ///< across it
};

struct Product {
  std::filesystem::path sample = {};
  ProductDeviation offset = {};  ///< of what is made from the sample file, on average
  std::array<ParameterSpread, sample_parameter_count> spread = {};
  std::vector<ProductCorrelation> correlations = {};
  /// Of what varies within a panel; nothing: each place for itself.
  std::optional<double> correlation_length_mm = {};
  double panel_length_mm = 150.0, panel_width_mm = 100.0;
  SourceMark mark = {};
};

/// Limits of one channel.
struct Requirement {
  std::uint32_t channel = 0;  ///< of Batch::channels
  Interval limits = {};
  std::optional<double> target = {};
  SourceMark mark = {};
};

/// When a lot is accepted.
struct AcceptanceRule {
  enum class Kind {
    attributes,  ///< at most so many of its panels do not conform
    mean,        ///< the mean of its panels keeps within the limits
    variables    ///< its mean keeps k standard deviations of its panels away from the limits
  };
  Kind kind = Kind::attributes;
  std::uint64_t nonconforming = 0;
  double k = 0.0;
};

struct SamplingPlan {
  std::uint64_t lots = 1;
  std::uint64_t panels = 1;  ///< of each lot
  std::vector<PanelPlace> positions = {};
  /// Where further readings are taken, if the reading rule of the standard asks for them.
  std::vector<PanelPlace> further_positions = {};
  std::uint32_t repetitions = 1;  ///< readings at each position
  AcceptanceRule accept = {};
  double accepted_lots = 1.0;  ///< share of the lots that has to be accepted, in (0, 1]
  /// Share of a lot's panels that may lie beyond the limits: what a plan by attributes or variables
  /// is to tell from more. In [0, 1).
  double acceptable_share = 0.01;
};

struct OperatorStatement {
  std::string id;
  double bias_gu = 0.0;
  double repeatability_gu = 0.0;  ///< standard deviation, besides that of the instrument
};

/// How uncertainty is taken into account at limits.
struct DecisionStatement {
  DecisionRule rule = DecisionRule::guarded;
  double guard_band_factor = 1.0;  ///< of U
  /// Of a panel's mean, k = 2, in gloss units; nothing: of a reading, as the instrument's file
  /// states.
  std::optional<double> expanded_uncertainty_gu = {};
  SourceMark mark = {};  ///< of the map `decision`, or of the file
};

/// Each of `panels` is read by each appraiser (instrument and operator), so many times.
struct GaugePlan {
  std::uint64_t panels = 10;
  std::uint32_t repetitions = 3;
};

/// A batch file, with all that it names.
struct Batch {
  std::filesystem::path file = {};
  std::string id = {}, title = {}, notes = {};
  Standard standard;
  std::optional<Product> product = {};  ///< nothing: for measured readings only
  std::vector<BatchChannel> channels = {};
  std::vector<Requirement> requirements = {};
  bool selected_only = false;  ///< only the geometry that the standard selects has to keep limits
  SamplingPlan plan = {};
  std::vector<Instrument> instruments = {};
  std::vector<OperatorStatement> operators = {};  ///< one at least
  DecisionStatement decision = {};
  std::optional<GaugePlan> gauge = {};
  std::uint64_t control_baseline = 100;  ///< subgroups
  std::optional<MeasuredFormat> measured = {};
  std::uint64_t seed = 1;
  /// By channel; empty where the channel has none.
  std::vector<std::optional<std::array<double, 3>>> colour_references = {};  ///< L*, a*, b*

  [[nodiscard]] const Requirement* requirement(std::uint32_t channel) const;
  /// Instruments times operators: appraiser a is instrument a / n_operators with operator
  /// a % n_operators.
  [[nodiscard]] std::size_t appraisers() const { return instruments.size() * operators.size(); }
};

/// Reads a file of schema gonio/batch/1.
/// @throws InputError  for anything that is not as the schema says.
[[nodiscard]] Batch load_batch(const std::filesystem::path& path, const Catalog& catalog);

}  // namespace gonio
