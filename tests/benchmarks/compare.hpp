#pragma once

#include <benchmark/benchmark.h>
#include <time.h>

#include <algorithm>
#include <vector>

namespace gonio::bench {

/// What a comparison should show: how many times faster the subject is than the reference, or how
/// many times its cost.
struct Target {
  enum class Kind { speedup_at_least, cost_at_most };
  Kind kind;
  double ratio;
};
constexpr Target speedup_at_least(double ratio) { return {Target::Kind::speedup_at_least, ratio}; }
constexpr Target cost_at_most(double ratio) { return {Target::Kind::cost_at_most, ratio}; }

/// @param values  at least one.
inline double median(std::vector<double> values) {
  const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Which time counts. That of the processor is the better one for work on one thread, since other
/// programs do not add to it; only elapsed time shows what several threads gain.
enum class Clock { processor, elapsed };

inline double seconds(Clock clock) {
  timespec now{};
  clock_gettime(clock == Clock::processor ? CLOCK_THREAD_CPUTIME_ID : CLOCK_MONOTONIC, &now);
  return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

template <class Work>
double seconds_of(Work& work, Clock clock) {
  const double start = seconds(clock);
  work();
  benchmark::ClobberMemory();
  return seconds(clock) - start;
}

/// Runs two ways of doing one thing in turns, so that a noisy machine disturbs both alike; each
/// iteration is one turn of both. Counters: `ratio`, the median over the turns; `target`;
/// `reference_s` and `subject_s`, medians of the times [s].
template <class Reference, class Subject>
void compare(benchmark::State& state, Target target, Reference reference, Subject subject,
             Clock clock = Clock::processor) {
  reference();
  subject();
  std::vector<double> reference_s;
  std::vector<double> subject_s;
  std::vector<double> ratio;
  for ([[maybe_unused]] auto turn : state) {
    reference_s.push_back(seconds_of(reference, clock));
    subject_s.push_back(seconds_of(subject, clock));
    const double speedup = reference_s.back() / subject_s.back();
    ratio.push_back(target.kind == Target::Kind::speedup_at_least ? speedup : 1.0 / speedup);
  }
  state.counters["ratio"] = median(ratio);
  state.counters["target"] = target.ratio;
  state.counters["reference_s"] = median(reference_s);
  state.counters["subject_s"] = median(subject_s);
  state.SetLabel(target.kind == Target::Kind::speedup_at_least
                     ? "ratio = reference / subject, at least target"
                     : "ratio = subject / reference, at most target");
}

}  // namespace gonio::bench
