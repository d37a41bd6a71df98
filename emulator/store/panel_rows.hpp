#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "emulator/store/database.hpp"
#include "emulator/store/rows.hpp"

namespace gonio {

/// Writes panels with their readings.
class PanelWriter {
 public:
  explicit PanelWriter(soci::session& session);

  /// @throws soci::soci_error  then the writer is of no use any more.
  /// @throws std::invalid_argument  for a NaN, or a text with a zero byte.
  void write(std::int64_t run, std::span<const PanelRecord> panels);

 private:
  using Panels = RowWriter<long long, std::string, long long, long long, std::string, std::string>;
  using Channels = RowWriter<long long, std::string, long long, long long, long long, double,
                             double, double, std::string, std::string, NullableNumber>;
  using Readings = RowWriter<long long, std::string, long long, long long, long long, long long,
                             long long, long long, long long, double>;
  Panels panels_;
  Channels channels_;
  Readings readings_;
};

/// Reads the panels of a study in the order of their numbers, some at a time, since libpq keeps all
/// that a query gives.
class PanelReader {
 public:
  PanelReader(Database& database, std::int64_t run, PanelRecord::Study study);
  PanelReader(const PanelReader&) = delete;
  PanelReader& operator=(const PanelReader&) = delete;

  /// @return  the next of them; none at the end.
  std::vector<PanelRecord> next();

 private:
  using Panels = RowReader<long long, long long, std::string, std::string>;
  using Channels = RowReader<long long, long long, long long, double, double, double, std::string,
                             std::string, NullableNumber>;
  using Readings =
      RowReader<long long, long long, long long, long long, long long, long long, double>;
  void read_panels(std::vector<PanelRecord>& page);
  void read_channels(std::vector<PanelRecord>& page);
  void read_readings(std::vector<PanelRecord>& page);

  Database& database_;
  long long run_;
  PanelRecord::Study study_;
  std::string study_name_;
  long long after_ = 0, last_ = 0;  ///< numbers of panels: beyond the one, up to the other
  Panels panels_;
  Channels channels_;
  Readings readings_;
};

}  // namespace gonio
