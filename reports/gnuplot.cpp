#include "reports/gnuplot.hpp"

#include "reports/process.hpp"

namespace gonio {

std::string run_gnuplot(const std::string& script) {
  return run_to_end(
      {.arguments = {"gnuplot", "--default-settings", "-"}, .purpose = "which draws the charts"},
      script);
}

}  // namespace gonio
