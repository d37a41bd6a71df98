#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "emulator/quality/records.hpp"

// All readings of a run, panel by panel, in memory that does not grow with them. Whether the stream
// took what was written is for its owner to ask.

namespace gonio {

/// One row for each reading, numbers at full precision, with all that it takes to compute it again.
class QaReadingsCsv {
 public:
  /// Writes the head. @param out  has to outlive this object.
  QaReadingsCsv(std::ostream& out, const RunRecord& run);

  void add(const PanelRecord& panel);  ///< of either study

 private:
  std::ostream& out_;
  std::string run_;
  std::vector<std::string> channels_, units_;         // cells, by number
  std::vector<std::string> instruments_, operators_;  // cells, by number
  std::vector<std::string> provenance_;               // end of a row, by number of instrument
  std::string no_provenance_;                         // of an instrument that the run has not
};

/// Schema gonio/qa_readings/1: the run, then its panels, a line each, with what was judged of them.
class QaReadingsJson {
 public:
  /// Writes the beginning. @param out  has to outlive this object.
  QaReadingsJson(std::ostream& out, const RunRecord& run);

  void add(const PanelRecord& panel);  ///< of either study
  /// Writes the end; nothing may be added after that.
  void finish();

 private:
  std::ostream& out_;
  std::vector<std::string> channels_, instruments_, operators_;  // strings of JSON, by number
  bool is_first_ = true;
};

}  // namespace gonio
