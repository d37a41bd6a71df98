#include "emulator/store/panel_rows.hpp"

#include <fmt/format.h>

#include "emulator/store/cells.hpp"
#include "emulator/store/names.hpp"

namespace gonio {
namespace {

constexpr int panels_at_once = 500;

/// The panel of a page with that number, from `from` on: panels and what is on them come in the
/// order of numbers.
std::size_t panel_of(const std::vector<PanelRecord>& page, std::size_t from, long long number) {
  while (from < page.size() && page[from].number != static_cast<std::uint64_t>(number)) {
    ++from;
  }
  if (from == page.size()) {
    throw StoreError(
        fmt::format("the store is damaged: panel {} is missing, not what is on it", number));
  }
  return from;
}

std::uint32_t place(long long cell) { return static_cast<std::uint32_t>(cell); }

}  // namespace

PanelWriter::PanelWriter(soci::session& session)
    : panels_(session, "panel (run, study, panel, lot, label, verdict)"),
      channels_(session,
                "panel_channel (run, study, panel, channel, n, mean, range, standard_deviation, "
                "uniformity, verdict, truth)"),
      readings_(session,
                "reading (run, study, panel, channel, position, repetition, instrument, operator, "
                "place, value)") {}

void PanelWriter::write(std::int64_t run, std::span<const PanelRecord> panels) {
  std::vector<Panels::Row> panel_rows;
  std::vector<Channels::Row> channel_rows;
  std::vector<Readings::Row> reading_rows;
  for (const PanelRecord& panel : panels) {
    const std::string study = study_name(panel.study);
    const long long number = cell(panel.number);
    panel_rows.emplace_back(run, study, number, cell(panel.lot), cell(panel.label),
                            verdict_name(panel.verdict));
    for (const ChannelResult& channel : panel.channels) {
      channel_rows.emplace_back(run, study, number, cell(channel.channel), cell(channel.n),
                                cell(channel.mean), cell(channel.range),
                                cell(channel.standard_deviation),
                                panel_verdict_name(channel.uniformity),
                                verdict_name(channel.verdict), NullableNumber(cell(channel.truth)));
    }
    for (std::size_t i = 0; i < panel.readings.size(); ++i) {
      const ReadingRecord& reading = panel.readings[i];
      reading_rows.emplace_back(run, study, number, cell(reading.channel), cell(reading.position),
                                cell(reading.repetition), cell(reading.instrument),
                                cell(reading.operator_), cell(i), cell(reading.value));
    }
  }
  panels_.write(panel_rows);
  channels_.write(channel_rows);
  readings_.write(reading_rows);
}

PanelReader::PanelReader(Database& database, std::int64_t run, PanelRecord::Study study)
    : database_(database),
      run_(run),
      study_(study),
      study_name_(study_name(study)),
      panels_(database.session(),
              "SELECT panel, lot, label, verdict FROM panel WHERE run = :run AND study = :study "
              "AND panel > :after ORDER BY panel LIMIT " +
                  std::to_string(panels_at_once),
              run_, study_name_, after_),
      channels_(database.session(),
                "SELECT panel, channel, n, mean, range, standard_deviation, uniformity, verdict, "
                "truth FROM panel_channel WHERE run = :run AND study = :study AND panel > :after "
                "AND panel <= :last ORDER BY panel, channel",
                run_, study_name_, after_, last_),
      readings_(database.session(),
                "SELECT panel, channel, position, repetition, instrument, operator, value "
                "FROM reading WHERE run = :run AND study = :study AND panel > :after "
                "AND panel <= :last ORDER BY panel, place",
                run_, study_name_, after_, last_) {}

std::vector<PanelRecord> PanelReader::next() {
  // One state of the store: panels that come meanwhile come with all of theirs or not at all.
  return database_.transaction(Database::Access::read, [&] {
    std::vector<PanelRecord> page;
    read_panels(page);
    if (!page.empty()) {
      last_ = static_cast<long long>(page.back().number);
      read_channels(page);
      read_readings(page);
      after_ = last_;
    }
    return page;
  });
}

void PanelReader::read_panels(std::vector<PanelRecord>& page) {
  panels_.for_each(
      [&](long long number, long long lot, const std::string& label, const std::string& verdict) {
        page.push_back({.study = study_,
                        .number = static_cast<std::uint64_t>(number),
                        .lot = static_cast<std::uint64_t>(lot),
                        .label = label,
                        .verdict = verdict_of(verdict)});
      });
}

void PanelReader::read_channels(std::vector<PanelRecord>& page) {
  std::size_t panel = 0;
  channels_.for_each([&](long long number, long long channel, long long n, double mean,
                         double range, double standard_deviation, const std::string& uniformity,
                         const std::string& verdict, const NullableNumber& truth) {
    panel = panel_of(page, panel, number);
    page[panel].channels.push_back({.channel = place(channel),
                                    .n = place(n),
                                    .mean = mean,
                                    .range = range,
                                    .standard_deviation = standard_deviation,
                                    .uniformity = panel_verdict_of(uniformity),
                                    .verdict = verdict_of(verdict),
                                    .truth = truth.optional()});
  });
}

void PanelReader::read_readings(std::vector<PanelRecord>& page) {
  std::size_t panel = 0;
  readings_.for_each([&](long long number, long long channel, long long position,
                         long long repetition, long long instrument, long long operator_,
                         double value) {
    panel = panel_of(page, panel, number);
    page[panel].readings.push_back({.channel = place(channel),
                                    .position = place(position),
                                    .repetition = place(repetition),
                                    .instrument = place(instrument),
                                    .operator_ = place(operator_),
                                    .value = value});
  });
}

}  // namespace gonio
