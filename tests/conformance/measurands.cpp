#include "tests/conformance/measurands.hpp"

namespace gonio::conformance {

const std::map<std::string, MeasurandReader>& measurands() {
  static const std::map<std::string, MeasurandReader> all = [] {
    std::map<std::string, MeasurandReader> readers = setup_measurands();
    readers.merge(reading_measurands());
    readers.merge(statistics_measurands());
    readers.merge(evaluation_measurands());
    return readers;
  }();
  return all;
}

}  // namespace gonio::conformance
