#include "emulator/quality/run_record.hpp"

#include <gtest/gtest.h>

#include "tests/unit/quality/made_product.hpp"
#include "tests/unit/temporary_folder.hpp"

namespace gonio {

namespace {

using test::TemporaryFolder;

Batch batch_in(const TemporaryFolder& folder, const std::string& text = "text of a batch\n") {
  Batch batch = test::MadeProduct("black_semi_gloss", {"60"}).batch;
  batch.file = folder.file("batch.yaml", text);
  return batch;
}

}  // namespace

TEST(RunRecord, TellsAllThatARunRestsOn) {
  const TemporaryFolder folder;
  const Batch batch = batch_in(folder);
  const RunRecord run = run_record(batch, std::nullopt, 12, "1.2.3");
  EXPECT_EQ(run.kind, RunRecord::Kind::simulated);
  EXPECT_EQ(run.batch_text, "text of a batch\n");
  EXPECT_EQ(run.sample.name, "black_semi_gloss");
  EXPECT_EQ(run.sample.sha256.size(), 64U);
  EXPECT_EQ(run.instruments.at(0).sha256.size(), 64U);
  EXPECT_EQ(run.operators, std::vector<std::string>{"anna"});
  EXPECT_EQ(run.panels, 12U);
  EXPECT_EQ(run.gonio_version, "1.2.3");
}

TEST(RunRecord, HasAFingerprintOfAllThatChangesResults) {
  const TemporaryFolder folder;
  Batch batch = batch_in(folder);
  const auto fingerprint = [&](const std::string& version = "1") {
    return run_record(batch, std::nullopt, 12, version).fingerprint;
  };
  const std::string first = fingerprint();
  EXPECT_EQ(fingerprint(), first);
  EXPECT_NE(fingerprint("2"), first);
  batch.seed = 7;
  EXPECT_NE(fingerprint(), first);
  batch = batch_in(folder, "another text\n");
  EXPECT_NE(fingerprint(), first);
  batch = batch_in(folder);
  EXPECT_EQ(fingerprint(), first);
  batch.product->sample.replace_filename("red_satin.yaml");
  EXPECT_NE(fingerprint(), first);
}

TEST(RunRecord, OfMeasuredReadingsKnowsTheirFile) {
  const TemporaryFolder folder;
  const auto readings = folder.file("readings.csv", "panel,60\na,50\n");
  const RunRecord run = run_record(batch_in(folder), readings, 1, "1");
  EXPECT_EQ(run.kind, RunRecord::Kind::measured);
  EXPECT_EQ(run.readings.name, "readings.csv");
  EXPECT_EQ(run.readings.sha256.size(), 64U);
}

}  // namespace gonio
