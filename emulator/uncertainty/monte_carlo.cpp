#include "emulator/uncertainty/monte_carlo.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <stdexcept>

#include "emulator/core/parallel_for.hpp"
#include "emulator/uncertainty/input_sampler.hpp"

namespace gonio {

namespace {

constexpr std::size_t block_trials = 10'000;
constexpr std::size_t round_blocks = 8;  // whatever the number of threads: it decides where to stop

/// What a block tells of an output, in the order mean, standard deviation, low, high.
using Figures = Eigen::Array4d;
/// Of all outputs, shape (4, n_outputs).
using BlockFigures = Eigen::Array<double, 4, Eigen::Dynamic>;

/// The value that would stand at `place` if the values were sorted, between two of them where it is
/// no whole number. Their order changes.
double sample_quantile(std::vector<double>::iterator first, std::vector<double>::iterator last,
                       double place) {
  const double below = std::floor(place);
  const auto at = first + std::ptrdiff_t(below);
  std::nth_element(first, at, last);
  const double next = at + 1 == last ? *at : *std::min_element(at + 1, last);
  return std::lerp(*at, next, place - below);
}

/// @param y  its order changes.
Figures figures_of(std::vector<double>& y, double coverage) {
  const auto n = double(y.size());
  const Eigen::Map<const Eigen::ArrayXd> values(y.data(), Eigen::Index(y.size()));
  const double origin = y.front();  // so that equal values have no deviation, to the last bit
  const double mean = origin + (values - origin).mean();
  const double variance = (values - mean).square().sum() / (n - 1.0);
  // Of n values the k-th, counted from 1, has on average a share k / (n + 1) below it.
  const auto place = [&](double p) { return std::clamp(p * (n + 1.0) - 1.0, 0.0, n - 1.0); };
  const double low = sample_quantile(y.begin(), y.end(), place(0.5 * (1.0 - coverage)));
  const double high = sample_quantile(y.begin(), y.end(), place(0.5 * (1.0 + coverage)));
  return {mean, std::sqrt(variance), low, high};
}

/// Runs one block of trials after the other.
class Blocks {
 public:
  Blocks(const InputSet& inputs, std::size_t n_outputs, const BatchModel& model,
         const MonteCarloOptions& options)
      : sampler_(inputs, options.seed),
        n_inputs_(Eigen::Index(inputs.size())),
        n_outputs_(Eigen::Index(n_outputs)),
        model_(model),
        options_(options) {}

  [[nodiscard]] const std::vector<BlockFigures>& done() const { return done_; }

  void run(std::size_t count) {
    const std::size_t first = done_.size();
    done_.resize(first + count);
    parallel_for(count, [&](std::size_t i) {
      done_[first + i] = one(first + i);
      const std::lock_guard<std::mutex> one_at_a_time(mutex_);
      ++finished_;
      if (options_.advance) {
        options_.advance(finished_ * block_trials);
      }
    });
  }

 private:
  [[nodiscard]] BlockFigures one(std::size_t number) const {
    Eigen::ArrayXXd x(Eigen::Index(block_trials), n_inputs_);
    Eigen::ArrayXXd y(Eigen::Index(block_trials), n_outputs_);
    sampler_.draw(number * block_trials, x);
    model_(x, y);
    if (y.rows() != Eigen::Index(block_trials) || y.cols() != n_outputs_ || !y.allFinite()) {
      throw std::domain_error(
          fmt::format("monte_carlo: expected {} finite outputs of {} trials from the model",
                      n_outputs_, block_trials));
    }
    BlockFigures figures(4, n_outputs_);
    std::vector<double> column(block_trials);
    for (Eigen::Index j = 0; j < n_outputs_; ++j) {
      std::copy_n(y.col(j).data(), block_trials, column.begin());
      figures.col(j) = figures_of(column, options_.coverage);
    }
    return figures;
  }

  InputSampler sampler_;
  Eigen::Index n_inputs_, n_outputs_;
  const BatchModel& model_;
  const MonteCarloOptions& options_;
  std::vector<BlockFigures> done_ = {};
  std::size_t finished_ = 0;
  std::mutex mutex_ = {};
};

/// Half a unit of the second digit. @see JCGM 101:2008, 7.9.2
double numerical_tolerance(double u) { return 0.5 * std::pow(10.0, std::floor(std::log10(u)) - 1); }

MonteCarloOutput output_of(const std::vector<BlockFigures>& blocks, Eigen::Index output) {
  const auto n = double(blocks.size());
  Figures sum = Figures::Zero();
  double variance = 0.0;
  for (const BlockFigures& block : blocks) {
    sum += block.col(output) - blocks.front().col(output);
    variance += block(1, output) * block(1, output) / n;
  }
  const Figures mean = blocks.front().col(output) + sum / n;
  Figures spread = Figures::Zero();
  for (const BlockFigures& block : blocks) {
    spread += (block.col(output) - mean).square();
  }
  MonteCarloOutput result{.mean = mean(0),
                          .standard_uncertainty = std::sqrt(variance + spread(0) / n),
                          .low = mean(2),
                          .high = mean(3)};
  if (blocks.size() > 1 && result.standard_uncertainty > 0.0) {
    const double of_mean = std::sqrt(spread.maxCoeff() / (n * (n - 1.0)));
    result.instability = 2.0 * of_mean / numerical_tolerance(result.standard_uncertainty);
  }
  return result;
}

MonteCarloResult result_of(const std::vector<BlockFigures>& blocks, std::size_t n_outputs) {
  MonteCarloResult result{.trials = blocks.size() * block_trials, .is_stable = blocks.size() > 1};
  for (std::size_t j = 0; j < n_outputs; ++j) {
    result.outputs.push_back(output_of(blocks, Eigen::Index(j)));
    result.is_stable = result.is_stable && result.outputs.back().instability <= 1.0;
  }
  return result;
}

std::size_t blocks_for(std::size_t trials) {
  return std::max<std::size_t>(1, (trials + block_trials - 1) / block_trials);
}

}  // namespace

MonteCarloResult monte_carlo(const InputSet& inputs, std::size_t n_outputs, const BatchModel& model,
                             const MonteCarloOptions& options) {
  if (!(options.coverage > 0.0 && options.coverage < 1.0)) {
    throw std::invalid_argument(
        fmt::format("monte_carlo: expected a coverage in (0, 1), found {}", options.coverage));
  }
  Blocks blocks(inputs, n_outputs, model, options);
  const std::size_t most = blocks_for(options.trials.value_or(options.most_trials));
  MonteCarloResult result;
  do {
    blocks.run(std::min(round_blocks, most - blocks.done().size()));
    result = result_of(blocks.done(), n_outputs);
  } while (blocks.done().size() < most && (options.trials || !result.is_stable));
  return result;
}

}  // namespace gonio
