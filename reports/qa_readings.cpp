#include "reports/qa_readings.hpp"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

#include "emulator/core/csv_cell.hpp"
#include "reports/escape.hpp"
#include "reports/qa_values_json.hpp"

namespace gonio {

namespace {

using nlohmann::ordered_json;

/// One cell, whatever the text holds.
std::string cell(const std::string& text) { return csv_cell(one_line(text)); }

std::string json_string(const std::string& text) {
  return ordered_json(text).dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

/// Of that number; `other` for one that the run has not.
const std::string& at(const std::vector<std::string>& texts, std::uint32_t number,
                      const std::string& other) {
  return number < texts.size() ? texts[number] : other;
}

const std::string nothing;
const std::string json_nothing = "null";

std::string json_number(double value) {
  return std::isfinite(value) ? fmt::format("{}", value) : json_nothing;
}

std::string json_number(const std::optional<double>& value) {
  return value ? json_number(*value) : json_nothing;
}

}  // namespace

QaReadingsCsv::QaReadingsCsv(std::ostream& out, const RunRecord& run)
    : out_(out), run_(fmt::format("{}", run.id)) {
  for (const BatchChannel& channel : run.channels) {
    channels_.push_back(cell(channel.id));
    units_.push_back(cell(channel.unit));
  }
  const auto end_of_row = [&](const std::string& instrument_sha256) {
    return fmt::format("{},{},{},{}\n", run.seed, cell(instrument_sha256), cell(run.sample.sha256),
                       cell(run.gonio_version));
  };
  for (const HashedFile& instrument : run.instruments) {
    instruments_.push_back(cell(instrument.name));
    provenance_.push_back(end_of_row(instrument.sha256));
  }
  no_provenance_ = end_of_row("");
  for (const std::string& name : run.operators) {
    operators_.push_back(cell(name));
  }
  out_ << "run,study,lot,panel,label,channel,position,repetition,instrument,operator,value,unit,"
          "seed,instrument_sha256,sample_sha256,gonio_version\n";
}

void QaReadingsCsv::add(const PanelRecord& panel) {
  fmt::memory_buffer rows;
  const std::string begin = fmt::format("{},{},{},{},{},", run_, study_name(panel.study), panel.lot,
                                        panel.number, cell(panel.label));
  for (const ReadingRecord& reading : panel.readings) {
    fmt::format_to(std::back_inserter(rows), "{}{},{},{},{},{},", begin,
                   at(channels_, reading.channel, nothing), reading.position, reading.repetition,
                   at(instruments_, reading.instrument, nothing),
                   at(operators_, reading.operator_, nothing));
    if (std::isfinite(reading.value)) {
      fmt::format_to(std::back_inserter(rows), "{}", reading.value);
    }
    fmt::format_to(std::back_inserter(rows), ",{},{}", at(units_, reading.channel, nothing),
                   at(provenance_, reading.instrument, no_provenance_));
  }
  out_.write(rows.data(), std::streamsize(rows.size()));
}

QaReadingsJson::QaReadingsJson(std::ostream& out, const RunRecord& run) : out_(out) {
  for (const BatchChannel& channel : run.channels) {
    channels_.push_back(json_string(channel.id));
  }
  for (const HashedFile& instrument : run.instruments) {
    instruments_.push_back(json_string(instrument.name));
  }
  for (const std::string& name : run.operators) {
    operators_.push_back(json_string(name));
  }
  ordered_json record = json_of(run);
  record["batch_text"] = run.batch_text;
  out_ << "{\"schema\": \"gonio/qa_readings/1\",\n\"run\": "
       << record.dump(-1, ' ', false, ordered_json::error_handler_t::replace) << ",\n\"panels\": [";
}

void QaReadingsJson::add(const PanelRecord& panel) {
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out,
                 "{}\n{{\"study\": \"{}\", \"number\": {}, \"lot\": {}, \"label\": {}, "
                 "\"verdict\": \"{}\", \"channels\": [",
                 is_first_ ? "" : ",", study_name(panel.study), panel.number, panel.lot,
                 json_string(panel.label), verdict_name(panel.verdict));
  const char* comma = "";
  for (const ChannelResult& result : panel.channels) {
    fmt::format_to(out,
                   "{}{{\"channel\": {}, \"n\": {}, \"mean\": {}, \"range\": {}, \"sd\": {}, "
                   "\"uniformity\": \"{}\", \"verdict\": \"{}\", \"truth\": {}}}",
                   comma, at(channels_, result.channel, json_nothing), result.n,
                   json_number(result.mean), json_number(result.range),
                   json_number(result.standard_deviation), panel_verdict_name(result.uniformity),
                   verdict_name(result.verdict), json_number(result.truth));
    comma = ", ";
  }
  fmt::format_to(out, "], \"readings\": [");
  comma = "";
  for (const ReadingRecord& reading : panel.readings) {
    fmt::format_to(out,
                   "{}{{\"channel\": {}, \"position\": {}, \"repetition\": {}, \"instrument\": {}, "
                   "\"operator\": {}, \"value\": {}}}",
                   comma, at(channels_, reading.channel, json_nothing), reading.position,
                   reading.repetition, at(instruments_, reading.instrument, json_nothing),
                   at(operators_, reading.operator_, json_nothing), json_number(reading.value));
    comma = ", ";
  }
  fmt::format_to(out, "]}}");
  out_.write(text.data(), std::streamsize(text.size()));
  is_first_ = false;
}

void QaReadingsJson::finish() { out_ << "\n]}\n"; }

}  // namespace gonio
