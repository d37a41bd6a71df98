#include "emulator/store/run_rows.hpp"

#include <fmt/format.h>

#include <charconv>
#include <stdexcept>

#include "emulator/store/cells.hpp"
#include "emulator/store/names.hpp"
#include "emulator/store/rows.hpp"
#include "emulator/store/store.hpp"

namespace gonio {
namespace {

std::uint64_t seed_of(const std::string& text) {
  std::uint64_t seed = 0;
  const char* end = text.data() + text.size();
  if (const auto [stop, error] = std::from_chars(text.data(), end, seed);
      error != std::errc() || stop != end) {
    throw StoreError(fmt::format("the store is damaged: expected a seed, found '{}'", text));
  }
  return seed;
}

std::uint64_t count(long long cell) { return static_cast<std::uint64_t>(cell); }

void insert_lists(soci::session& session, long long id, const RunRecord& run) {
  using Text = std::string;
  std::vector<std::tuple<long long, long long, Text, Text>> instruments;
  for (const HashedFile& file : run.instruments) {
    instruments.emplace_back(id, cell(instruments.size()), cell(file.name), cell(file.sha256));
  }
  std::vector<std::tuple<long long, long long, Text>> operators;
  for (const std::string& name : run.operators) {
    operators.emplace_back(id, cell(operators.size()), cell(name));
  }
  std::vector<std::tuple<long long, long long, Text, Text, Text, Text>> channels;
  for (const BatchChannel& channel : run.channels) {
    channels.emplace_back(id, cell(channels.size()), cell(channel.id), cell(channel.geometry),
                          channel_kind_name(channel.kind), cell(channel.unit));
  }
  write_rows(session, "run_instrument (run, instrument, name, sha256)", instruments);
  write_rows(session, "run_operator (run, operator, name)", operators);
  write_rows(session, "run_channel (run, channel, name, geometry, kind, unit)", channels);
}

void select_lists(soci::session& session, long long id, RunRecord& run) {
  using Text = std::string;
  RowReader<Text, Text>(session,
                        "SELECT name, sha256 FROM run_instrument WHERE run = :run "
                        "ORDER BY instrument",
                        id)
      .for_each([&](const Text& name, const Text& sha256) {
        run.instruments.push_back({name, sha256});
      });
  RowReader<Text>(session, "SELECT name FROM run_operator WHERE run = :run ORDER BY operator", id)
      .for_each([&](const Text& name) { run.operators.push_back(name); });
  RowReader<Text, Text, Text, Text>(session,
                                    "SELECT name, geometry, kind, unit FROM run_channel "
                                    "WHERE run = :run ORDER BY channel",
                                    id)
      .for_each([&](const Text& name, const Text& geometry, const Text& kind, const Text& unit) {
        run.channels.push_back({name, geometry, channel_kind_of(kind), unit});
      });
}

RunRecord select_record(soci::session& session, long long id) {
  RunRecord run{.id = id};
  std::string kind;
  std::string seed;
  long long lots = 0;
  long long panels = 0;
  long long gauge_panels = 0;
  session << "SELECT kind, batch, title, batch_file, batch_text, fingerprint, seed, gonio_version, "
             "standard, sample, sample_sha256, readings, readings_sha256, lots, panels, "
             "gauge_panels, started FROM run WHERE id = :id",
      soci::use(id), soci::into(kind), soci::into(run.batch), soci::into(run.title),
      soci::into(run.batch_file), soci::into(run.batch_text), soci::into(run.fingerprint),
      soci::into(seed), soci::into(run.gonio_version), soci::into(run.standard),
      soci::into(run.sample.name), soci::into(run.sample.sha256), soci::into(run.readings.name),
      soci::into(run.readings.sha256), soci::into(lots), soci::into(panels),
      soci::into(gauge_panels), soci::into(run.started);
  if (!session.got_data()) {
    throw std::out_of_range(fmt::format("no run {}", id));
  }
  run.kind = run_kind_of(kind);
  run.seed = seed_of(seed);
  run.lots = count(lots);
  run.panels = count(panels);
  run.gauge_panels = count(gauge_panels);
  select_lists(session, id, run);
  return run;
}

std::optional<RunOutcome> select_outcome(soci::session& session, long long id) {
  std::optional<RunOutcome> outcome;
  RowReader<std::string, std::string, long long, long long, NullableNumber, NullableNumber>(
      session,
      "SELECT verdict, finished, panels, readings, producer_risk, consumer_risk "
      "FROM run_outcome WHERE run = :run",
      id)
      .for_each([&](const std::string& verdict, const std::string& finished, long long panels,
                    long long readings, const NullableNumber& producer_risk,
                    const NullableNumber& consumer_risk) {
        outcome = {verdict_of(verdict),
                   finished,
                   count(panels),
                   count(readings),
                   producer_risk.optional(),
                   consumer_risk.optional()};
      });
  return outcome;
}

std::vector<ChannelTrend> select_trends(soci::session& session, long long id) {
  std::vector<ChannelTrend> trends;
  RowReader<long long, long long, long long, double, double, NullableNumber, NullableNumber,
            NullableNumber, NullableNumber>(
      session,
      "SELECT channel, panels, readings, mean, standard_deviation, low, high, cpk, ppk "
      "FROM run_trend WHERE run = :run ORDER BY channel",
      id)
      .for_each([&](long long channel, long long panels, long long readings, double mean,
                    double standard_deviation, const NullableNumber& low,
                    const NullableNumber& high, const NullableNumber& cpk,
                    const NullableNumber& ppk) {
        trends.push_back({static_cast<std::uint32_t>(channel), count(panels), count(readings), mean,
                          standard_deviation, low.optional(), high.optional(), cpk.optional(),
                          ppk.optional()});
      });
  return trends;
}

}  // namespace

std::int64_t insert_run(soci::session& session, const RunRecord& run) {
  const std::string kind = run_kind_name(run.kind);
  const std::string seed = std::to_string(run.seed);
  const long long lots = cell(run.lots);
  const long long panels = cell(run.panels);
  const long long gauge_panels = cell(run.gauge_panels);
  long long id = 0;
  session << "INSERT INTO run (kind, batch, title, batch_file, batch_text, fingerprint, seed, "
             "gonio_version, standard, sample, sample_sha256, readings, readings_sha256, lots, "
             "panels, gauge_panels, started) VALUES (:kind, :batch, :title, :batch_file, "
             ":batch_text, :fingerprint, :seed, :gonio_version, :standard, :sample, "
             ":sample_sha256, :readings, :readings_sha256, :lots, :panels, :gauge_panels, "
             ":started) RETURNING id",
      soci::use(kind), soci::use(cell(run.batch)), soci::use(cell(run.title)),
      soci::use(cell(run.batch_file)), soci::use(cell(run.batch_text)),
      soci::use(cell(run.fingerprint)), soci::use(seed), soci::use(cell(run.gonio_version)),
      soci::use(cell(run.standard)), soci::use(cell(run.sample.name)),
      soci::use(cell(run.sample.sha256)), soci::use(cell(run.readings.name)),
      soci::use(cell(run.readings.sha256)), soci::use(lots), soci::use(panels),
      soci::use(gauge_panels), soci::use(cell(run.started)), soci::into(id);
  insert_lists(session, id, run);
  return id;
}

void insert_outcome(soci::session& session, std::int64_t run, const RunOutcome& outcome) {
  using Number = NullableNumber;
  const long long id = run;
  using Outcome =
      std::tuple<long long, std::string, std::string, long long, long long, Number, Number>;
  write_rows(session,
             "run_outcome (run, verdict, finished, panels, readings, producer_risk, consumer_risk)",
             std::vector{Outcome(id, verdict_name(outcome.verdict), cell(outcome.finished),
                                 cell(outcome.panels), cell(outcome.readings),
                                 Number(cell(outcome.producer_risk)),
                                 Number(cell(outcome.consumer_risk)))});
  std::vector<std::tuple<long long, long long, long long, long long, double, double, Number, Number,
                         Number, Number>>
      trends;
  for (const ChannelTrend& trend : outcome.channels) {
    trends.emplace_back(id, cell(trend.channel), cell(trend.panels), cell(trend.readings),
                        cell(trend.mean), cell(trend.standard_deviation), Number(cell(trend.low)),
                        Number(cell(trend.high)), Number(cell(trend.cpk)), Number(cell(trend.ppk)));
  }
  write_rows(session,
             "run_trend (run, channel, panels, readings, mean, standard_deviation, low, high, cpk, "
             "ppk)",
             trends);
}

StoredRun select_run(soci::session& session, std::int64_t id) {
  StoredRun run{select_record(session, id), select_outcome(session, id)};
  if (run.outcome) {
    run.outcome->channels = select_trends(session, id);
  }
  return run;
}

bool is_finished(soci::session& session, std::int64_t run) {
  const long long id = run;
  long long outcomes = 0;
  session << "SELECT count(*) FROM run_outcome WHERE run = :run", soci::use(id),
      soci::into(outcomes);
  return outcomes > 0;
}

}  // namespace gonio
