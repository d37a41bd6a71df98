#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <vector>

#include "emulator/quality/batch.hpp"
#include "emulator/quality/panel_source.hpp"
#include "emulator/quality/qa_result.hpp"
#include "emulator/quality/reading_uncertainty.hpp"
#include "emulator/quality/risk_study.hpp"

// Lots that are made up to see what a plan says of them.

namespace gonio {

/// Mean and variance of values, of which parts may be put together.
class Moments {
 public:
  void add(double value);
  void add(const Moments& other);

  [[nodiscard]] std::uint64_t count() const { return n_; }
  [[nodiscard]] double mean() const { return mean_; }
  [[nodiscard]] double standard_deviation() const;  ///< of a sample; 0 below two
  [[nodiscard]] double root_mean_square() const;

 private:
  std::uint64_t n_ = 0;
  double mean_ = 0.0;
  double sum_of_squares_ = 0.0;  // of the deviations from the mean
};

/// How decisions came out.
struct DecisionCounts {
  std::uint64_t all = 0, conforming = 0, accepted = 0, producer = 0, consumer = 0;

  void add(bool conforms, bool is_accepted);
  void add(const DecisionCounts& other);
  [[nodiscard]] RiskSummary summary() const;
};

/// What the truth of lots and panels was in one channel, and what of it was seen.
struct ChannelTruths {
  Moments lot_means, lot_spreads, lot_beyond;
  Moments panels;                    ///< truths
  std::vector<Moments> errors = {};  ///< of panel means, by instrument

  void add(const ChannelTruths& other);
  [[nodiscard]] Moments all_errors() const;
};

struct LotStudy {
  DecisionCounts lots, panels;
  std::vector<ChannelTruths> channels = {};

  void add(const LotStudy& other);
  [[nodiscard]] Estimate not_accepted() const;  ///< share of lots
};

/// Tells how far a work is, from whatever thread.
class StudyProgress {
 public:
  StudyProgress(const RiskOptions& options, const char* work, std::size_t total)
      : options_(options), work_(work), total_(total) {}

  void advance(std::size_t steps = 1);
  void finish();  ///< whatever is left will not be done

 private:
  const RiskOptions& options_;
  const char* work_;
  std::size_t total_, done_ = 0;
  std::mutex one_at_a_time_;
};

/// Steps of progress that so many lots are.
[[nodiscard]] std::size_t study_steps(std::uint64_t lots);

/// Makes lots, each with the panels of the plan, and judges them. Their numbers are far beyond
/// those of any run, so that a study never sees the panels that it speaks of; studies of the same
/// seed see the same draws, so that their differences are those of what was changed. The same for
/// any number of threads.
[[nodiscard]] LotStudy study_lots(const Batch& batch, const ReadingUncertainties& uncertainties,
                                  const PanelSource& source, std::uint64_t lots,
                                  StudyProgress& progress);

/// Mean over the true means of the same lots.
[[nodiscard]] double true_mean(const PanelSource& source, std::uint32_t channel,
                               std::uint64_t lots);

}  // namespace gonio
