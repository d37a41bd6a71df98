#include "emulator/quality/records.hpp"

namespace gonio {

const char* study_name(PanelRecord::Study study) {
  return study == PanelRecord::Study::inspection ? "inspection" : "gauge";
}

const char* run_kind_name(RunRecord::Kind kind) {
  return kind == RunRecord::Kind::simulated ? "simulated" : "measured";
}

}  // namespace gonio
