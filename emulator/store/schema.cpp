#include "emulator/store/schema.hpp"

#include <fmt/format.h>

#include "emulator/store/rows.hpp"

namespace gonio {
namespace {

using Access = Database::Access;

/// Runs with their panels and readings. Whatever counts from 1 in the records does here; channels,
/// instruments and operators are numbered by their places from 0. A seed is text since it may be
/// larger than the largest BIGINT.
const Migration& runs_and_readings() {
  static const Migration migration{
      R"(CREATE TABLE run (
           id {counted_key},
           kind TEXT NOT NULL, batch TEXT NOT NULL, title TEXT NOT NULL,
           batch_file TEXT NOT NULL, batch_text TEXT NOT NULL, fingerprint TEXT NOT NULL,
           seed TEXT NOT NULL, gonio_version TEXT NOT NULL, standard TEXT NOT NULL,
           sample TEXT NOT NULL, sample_sha256 TEXT NOT NULL,
           readings TEXT NOT NULL, readings_sha256 TEXT NOT NULL,
           lots BIGINT NOT NULL, panels BIGINT NOT NULL, gauge_panels BIGINT NOT NULL,
           started TEXT NOT NULL))",
      "CREATE INDEX run_by_batch ON run (batch)",
      "CREATE INDEX run_by_fingerprint ON run (fingerprint)",
      R"(CREATE TABLE run_instrument (
           run BIGINT NOT NULL REFERENCES run (id), instrument BIGINT NOT NULL,
           name TEXT NOT NULL, sha256 TEXT NOT NULL,
           PRIMARY KEY (run, instrument)) {clustered})",
      R"(CREATE TABLE run_operator (
           run BIGINT NOT NULL REFERENCES run (id), operator BIGINT NOT NULL,
           name TEXT NOT NULL,
           PRIMARY KEY (run, operator)) {clustered})",
      R"(CREATE TABLE run_channel (
           run BIGINT NOT NULL REFERENCES run (id), channel BIGINT NOT NULL,
           name TEXT NOT NULL, geometry TEXT NOT NULL, kind TEXT NOT NULL, unit TEXT NOT NULL,
           PRIMARY KEY (run, channel)) {clustered})",
      R"(CREATE TABLE panel (
           run BIGINT NOT NULL REFERENCES run (id), study TEXT NOT NULL, panel BIGINT NOT NULL,
           lot BIGINT NOT NULL, label TEXT NOT NULL, verdict TEXT NOT NULL,
           PRIMARY KEY (run, study, panel)) {clustered})",
      R"(CREATE TABLE panel_channel (
           run BIGINT NOT NULL, study TEXT NOT NULL, panel BIGINT NOT NULL,
           channel BIGINT NOT NULL, n BIGINT NOT NULL,
           mean {number} NOT NULL, range {number} NOT NULL, standard_deviation {number} NOT NULL,
           uniformity TEXT NOT NULL, verdict TEXT NOT NULL, truth {number},
           PRIMARY KEY (run, study, panel, channel),
           FOREIGN KEY (run, study, panel) REFERENCES panel (run, study, panel)) {clustered})",
      R"(CREATE TABLE reading (
           run BIGINT NOT NULL, study TEXT NOT NULL, panel BIGINT NOT NULL,
           channel BIGINT NOT NULL, position BIGINT NOT NULL, repetition BIGINT NOT NULL,
           instrument BIGINT NOT NULL, operator BIGINT NOT NULL,
           place BIGINT NOT NULL, value {number} NOT NULL,
           PRIMARY KEY (run, study, panel, channel, position, repetition, instrument, operator),
           FOREIGN KEY (run, study, panel) REFERENCES panel (run, study, panel)) {clustered})"};
  return migration;
}

/// What finished runs came to, and one view of all that a reading rests on. Operators and
/// instruments of measured readings need not be known.
const Migration& outcomes_and_provenance() {
  static const Migration migration{
      R"(CREATE TABLE run_outcome (
           run BIGINT NOT NULL PRIMARY KEY REFERENCES run (id),
           verdict TEXT NOT NULL, finished TEXT NOT NULL,
           panels BIGINT NOT NULL, readings BIGINT NOT NULL,
           producer_risk {number}, consumer_risk {number}) {clustered})",
      R"(CREATE TABLE run_trend (
           run BIGINT NOT NULL REFERENCES run_outcome (run), channel BIGINT NOT NULL,
           panels BIGINT NOT NULL, readings BIGINT NOT NULL,
           mean {number} NOT NULL, standard_deviation {number} NOT NULL,
           low {number}, high {number}, cpk {number}, ppk {number},
           PRIMARY KEY (run, channel)) {clustered})",
      R"(CREATE VIEW reading_provenance AS
         SELECT reading.run AS run, run.batch AS batch, reading.study AS study,
                panel.lot AS lot, reading.panel AS panel, panel.label AS label,
                run_channel.name AS channel, reading.position AS position,
                reading.repetition AS repetition, run_operator.name AS operator,
                run_instrument.name AS instrument, run_instrument.sha256 AS instrument_sha256,
                reading.value AS value, run.seed AS seed,
                run.sample AS sample, run.sample_sha256 AS sample_sha256,
                run.readings AS readings, run.readings_sha256 AS readings_sha256,
                run.fingerprint AS fingerprint, run.gonio_version AS gonio_version
         FROM reading
         JOIN panel ON panel.run = reading.run AND panel.study = reading.study
                   AND panel.panel = reading.panel
         JOIN run ON run.id = reading.run
         LEFT JOIN run_channel ON run_channel.run = reading.run
                              AND run_channel.channel = reading.channel
         LEFT JOIN run_instrument ON run_instrument.run = reading.run
                                 AND run_instrument.instrument = reading.instrument
         LEFT JOIN run_operator ON run_operator.run = reading.run
                               AND run_operator.operator = reading.operator)"};
  return migration;
}

/// @return  0 for an empty database.
long long version_of(Database& database) {
  long long tables = 0;
  long long ours = 0;
  database.session() << database.dialect().count_tables, soci::into(tables), soci::into(ours);
  if (ours == 0) {
    if (tables > 0) {
      throw database.error("not a store of gonio: it holds tables of something else");
    }
    return 0;
  }
  long long version = 0;
  database.session() << "SELECT max(version) FROM gonio_schema", soci::into(version);
  return version;
}

/// Takes the next step, which another program may have taken meanwhile.
void take_step(Database& database, std::span<const Migration> migrations) {
  database.transaction(Access::migration, [&] {
    const long long version = version_of(database);
    if (version >= static_cast<long long>(migrations.size())) {
      return;
    }
    if (version == 0) {
      database.session() << "CREATE TABLE gonio_schema (version BIGINT NOT NULL PRIMARY KEY)";
    }
    for (const std::string& statement : migrations[static_cast<std::size_t>(version)]) {
      database.session() << in_dialect(statement, database.dialect());
    }
    const long long next = version + 1;
    database.session() << "INSERT INTO gonio_schema (version) VALUES (:version)", soci::use(next);
  });
}

}  // namespace

std::span<const Migration> migrations() {
  static const std::vector<Migration> all{runs_and_readings(), outcomes_and_provenance()};
  return all;
}

void migrate(Database& database, std::span<const Migration> migrations) {
  const auto version = [&] { return database.guarded([&] { return version_of(database); }); };
  const auto newest = static_cast<long long>(migrations.size());
  long long found = version();
  if (found > newest) {
    throw database.error(fmt::format(
        "the store is of version {}, newer than this gonio, which knows {}", found, newest));
  }
  database.make_durable();
  for (; found < newest; found = version()) {
    take_step(database, migrations);
  }
}

}  // namespace gonio
