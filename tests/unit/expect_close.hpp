#pragma once

#include <gtest/gtest.h>

#include <cmath>

namespace gonio::test {

/// Success if |got - expected| <= tolerance. Else the text gives got, expected, the error and how
/// many tolerances it is.
inline testing::AssertionResult is_close(double got, double expected, double tolerance) {
  const double error = std::abs(got - expected);
  if (error <= tolerance) {
    return testing::AssertionSuccess();
  }
  return testing::AssertionFailure() << "got " << testing::PrintToString(got) << ", expected "
                                     << testing::PrintToString(expected) << ", error " << error
                                     << ", error over tolerance " << error / tolerance;
}

/// The same with a tolerance relative to what is expected.
inline testing::AssertionResult is_close_relative(double got, double expected, double tolerance) {
  return is_close(got, expected, tolerance * std::abs(expected));
}

}  // namespace gonio::test
