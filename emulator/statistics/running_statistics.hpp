#pragma once

namespace gonio {

struct ChannelStatistics {
  int n = 0;  ///< readings; the others are 0 while there is none, standard_deviation below two
  double mean = 0.0, standard_deviation = 0.0, minimum = 0.0, maximum = 0.0;
  [[nodiscard]] double range() const { return maximum - minimum; }
};

/// Statistics of values that come one at a time, without loss of digits and without keeping them.
///
///   mean_n = mean_(n-1) + (x - mean_(n-1)) / n,   M_n = M_(n-1) + (x - mean_(n-1)) (x - mean_n),
///   s = sqrt(M_n / (n - 1))
///
/// The mean of equal values is that value to the last bit. @see Welford, Technometrics 4, 419
/// (1962)
class RunningStatistics {
 public:
  void add(double x);
  [[nodiscard]] const ChannelStatistics& result() const { return result_; }

 private:
  ChannelStatistics result_;
  double sum_of_squares_ = 0.0;  // of the deviations from the mean
};

}  // namespace gonio
