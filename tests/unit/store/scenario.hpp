#pragma once

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <span>
#include <string>
#include <vector>

#include "emulator/store/database.hpp"
#include "emulator/store/rows.hpp"
#include "emulator/store/store.hpp"
#include "tests/unit/message_of.hpp"
#include "tests/unit/store/random_records.hpp"
#include "tests/unit/store/same_records.hpp"

// What every store must do, whatever database it is in: begun, added to, opened again, finished.

namespace gonio::test {

constexpr std::uint32_t scenario_seed = 20261122;

class Scenario {
 public:
  explicit Scenario(std::string url) : url_(std::move(url)) {}

  void runs() {
    keeps_a_run();
    keeps_panels();
    tells_what_a_reading_rests_on();
    refuses_what_is_there();
    finds_what_is_unfinished();
    finishes();
    lists_runs();
  }

 private:
  using Study = PanelRecord::Study;

  void keeps_a_run() {
    Store store(url_);
    EXPECT_THAT(store.runs(), testing::IsEmpty());
    first_.record = random_.run("coil", "f1");
    first_.record.id = store.begin(first_.record);
    EXPECT_EQ(Store(url_).run(first_.record.id).record, first_.record);
    EXPECT_FALSE(store.run(first_.record.id).outcome.has_value());
    EXPECT_THROW(static_cast<void>(store.run(first_.record.id + 1)), std::out_of_range);
  }

  /// More panels than are read at a time, in chunks that no number of rows at once divides.
  void keeps_panels() {
    Store store(url_);
    gauge_ = random_.panels(Study::gauge, 1, 7);
    inspection_ = random_.panels(Study::inspection, 1, 1100);
    store.add(first_.record.id, gauge_);
    const std::span<const PanelRecord> all(inspection_);
    store.add(first_.record.id, all.first(333));
    store.add(first_.record.id, all.subspan(333, 1));
    store.add(first_.record.id, all.subspan(334));
    store.add(first_.record.id, {});
    expect_panels(Store(url_), first_.record.id, inspection_);
    expect_panels(store, first_.record.id, gauge_);
    EXPECT_EQ(store.panels(first_.record.id + 1, Study::inspection), 0U);
  }

  /// All readings of all panels stand in the view, each with what it needs to be had again.
  void tells_what_a_reading_rests_on() {
    Database database(url_);
    const long long run = first_.record.id;
    long long rows = 0;
    database.session() << "SELECT count(*) FROM reading_provenance WHERE run = :run",
        soci::use(run), soci::into(rows);
    EXPECT_EQ(static_cast<std::size_t>(rows), 12 * (gauge_.size() + inspection_.size()));
    std::map<std::string, double> found;
    RowReader<std::string, std::string, std::string, long long, long long, std::string, double>(
        database.session(),
        "SELECT study, channel, operator, position, lot, seed || ' ' || gonio_version || ' ' || "
        "sample || ' ' || sample_sha256 || ' ' || instrument || ' ' || instrument_sha256 || ' ' || "
        "batch || ' ' || fingerprint, value FROM reading_provenance "
        "WHERE run = :run AND panel = 3",
        run)
        .for_each([&](const std::string& study, const std::string& channel,
                      const std::string& operator_, long long position, long long lot,
                      const std::string& rest, double value) {
          found[fmt::format("{} {} {} {} {} {}", study, channel, operator_, position, lot, rest)] =
              value;
        });
    std::map<std::string, double> expected;
    for (const PanelRecord& panel : {gauge_[2], inspection_[2]}) {
      for (const ReadingRecord& reading : panel.readings) {
        expected[provenance(panel, reading)] = reading.value;
      }
    }
    EXPECT_EQ(found, expected);
  }

  [[nodiscard]] std::string provenance(const PanelRecord& panel,
                                       const ReadingRecord& reading) const {
    const RunRecord& run = first_.record;
    const HashedFile& instrument = run.instruments[reading.instrument];
    return fmt::format("{} {} {} {} {} {} {} {} {} {} {} {} {}", study_name(panel.study),
                       run.channels[reading.channel].id, run.operators[reading.operator_],
                       reading.position, panel.lot, run.seed, run.gonio_version, run.sample.name,
                       run.sample.sha256, instrument.name, instrument.sha256, run.batch,
                       run.fingerprint);
  }

  /// From a second connection: the whole chunk is refused, and both go on.
  void refuses_what_is_there() {
    Store one(url_);
    Store other(url_);
    std::vector<PanelRecord> chunk = random_.panels(Study::inspection, 1101, 60);
    one.add(first_.record.id, std::span(chunk).last(1));
    const std::string message = message_of([&] { other.add(first_.record.id, chunk); });
    EXPECT_THAT(message, testing::HasSubstr("something of it is there already"));
    EXPECT_EQ(other.panels(first_.record.id, Study::inspection), 1101U);
    other.add(first_.record.id, std::span(chunk).first(59));
    inspection_.insert(inspection_.end(), chunk.begin(), chunk.end());
    expect_panels(one, first_.record.id, inspection_);
    EXPECT_THROW(one.add(first_.record.id + 1, chunk), StoreError);
  }

  void finds_what_is_unfinished() {
    Store store(url_);
    second_.record = random_.run("it's another", "f2");
    second_.record.id = store.begin(second_.record);
    EXPECT_GT(second_.record.id, first_.record.id);
    EXPECT_EQ(store.unfinished("f1")->record, first_.record);
    EXPECT_EQ(store.unfinished("f2")->record, second_.record);
    EXPECT_FALSE(store.unfinished("f3").has_value());
    RunRecord again = random_.run("coil", "f1");
    again.id = store.begin(again);
    EXPECT_EQ(store.unfinished("f1")->record, again);
    store.finish(again.id, {});
    EXPECT_EQ(store.unfinished("f1")->record, first_.record);
    third_ = {again, RunOutcome{}};
  }

  void finishes() {
    Store store(url_);
    first_.outcome = random_.outcome();
    store.finish(first_.record.id, *first_.outcome);
    EXPECT_FALSE(store.unfinished("f1").has_value());
    const auto more = random_.panels(Study::inspection, 5000, 1);
    for (const std::string& message :
         {message_of([&] { store.add(first_.record.id, more); }),
          message_of([&] { Store(url_).finish(first_.record.id, *first_.outcome); })}) {
      EXPECT_THAT(message, testing::HasSubstr("is finished: nothing can be added to it"));
    }
    EXPECT_EQ(store.panels(first_.record.id, Study::inspection), inspection_.size());
  }

  void lists_runs() {
    const Store store(url_);
    expect_runs(store.runs(), {first_, second_, third_});
    expect_runs(store.runs("coil"), {first_, third_});
    expect_runs(store.runs("it's another"), {second_});
    expect_runs(store.runs("none"), {});
  }

  static void expect_runs(const std::vector<StoredRun>& got,
                          const std::vector<StoredRun>& expected) {
    ASSERT_EQ(got.size(), expected.size());
    for (std::size_t i = 0; i < got.size(); ++i) {
      EXPECT_EQ(got[i].record, expected[i].record);
      ASSERT_EQ(got[i].outcome.has_value(), expected[i].outcome.has_value());
      if (got[i].outcome) {
        EXPECT_TRUE(is_same(*got[i].outcome, *expected[i].outcome));
      }
    }
  }

  std::string url_;
  RandomRecords random_{scenario_seed};
  StoredRun first_ = {}, second_ = {}, third_ = {};
  std::vector<PanelRecord> gauge_ = {}, inspection_ = {};
};

}  // namespace gonio::test
