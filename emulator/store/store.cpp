#include "emulator/store/store.hpp"

#include <fmt/format.h>

#include "emulator/store/database.hpp"
#include "emulator/store/panel_rows.hpp"
#include "emulator/store/run_rows.hpp"
#include "emulator/store/schema.hpp"

namespace gonio {
namespace {

using Access = Database::Access;

/// Sees to it that the run stays unfinished until the end of the transaction.
void expect_unfinished(Database& database, std::int64_t run) {
  const long long id = run;
  long long found = 0;
  database.session() << fmt::format("SELECT id FROM run WHERE id = :id{}",
                                    database.dialect().locked),
      soci::use(id), soci::into(found);
  if (!database.session().got_data()) {
    throw database.error(fmt::format("no run {}", run));
  }
  if (is_finished(database.session(), run)) {
    throw database.error(fmt::format("run {} is finished: nothing can be added to it", run));
  }
}

std::vector<long long> run_ids(soci::session& session, const std::optional<std::string>& batch) {
  std::vector<long long> ids;
  const auto add = [&](long long id) { ids.push_back(id); };
  if (batch) {
    std::string name = *batch;
    RowReader<long long>(session, "SELECT id FROM run WHERE batch = :batch ORDER BY id", name)
        .for_each(add);
  } else {
    RowReader<long long>(session, "SELECT id FROM run ORDER BY id").for_each(add);
  }
  return ids;
}

}  // namespace

struct Store::Impl {
  Database database;
  std::unique_ptr<PanelWriter> writer = {};
};

Store::Store(const std::string& url) : impl_(new Impl{Database(url)}) {
  migrate(impl_->database, migrations());
}
Store::~Store() = default;
Store::Store(Store&&) noexcept = default;
Store& Store::operator=(Store&&) noexcept = default;

const std::string& Store::url() const { return impl_->database.url(); }

std::int64_t Store::begin(const RunRecord& record) {
  return impl_->database.transaction(Access::write,
                                     [&] { return insert_run(impl_->database.session(), record); });
}

void Store::add(std::int64_t run, std::span<const PanelRecord> panels) {
  // What is left of a statement that has failed depends on the server: only good ones come back.
  std::unique_ptr<PanelWriter> writer = std::move(impl_->writer);
  impl_->database.transaction(Access::write, [&] {
    expect_unfinished(impl_->database, run);
    if (!writer) {
      writer = std::make_unique<PanelWriter>(impl_->database.session());
    }
    writer->write(run, panels);
  });
  impl_->writer = std::move(writer);
}

void Store::finish(std::int64_t run, const RunOutcome& outcome) {
  impl_->database.transaction(Access::write, [&] {
    expect_unfinished(impl_->database, run);
    insert_outcome(impl_->database.session(), run, outcome);
  });
}

StoredRun Store::run(std::int64_t id) const {
  return impl_->database.transaction(Access::read,
                                     [&] { return select_run(impl_->database.session(), id); });
}

std::optional<StoredRun> Store::unfinished(const std::string& fingerprint) const {
  Database& database = impl_->database;
  return database.transaction(Access::read, [&]() -> std::optional<StoredRun> {
    long long id = 0;
    soci::indicator found = soci::i_null;
    database.session() << "SELECT max(id) FROM run WHERE fingerprint = :fingerprint "
                          "AND id NOT IN (SELECT run FROM run_outcome)",
        soci::use(fingerprint), soci::into(id, found);
    if (found == soci::i_null) {
      return std::nullopt;
    }
    return select_run(database.session(), id);
  });
}

std::vector<StoredRun> Store::runs(const std::optional<std::string>& batch) const {
  soci::session& session = impl_->database.session();
  return impl_->database.transaction(Access::read, [&] {
    std::vector<StoredRun> runs;
    for (const long long id : run_ids(session, batch)) {
      runs.push_back(select_run(session, id));
    }
    return runs;
  });
}

std::uint64_t Store::panels(std::int64_t run, PanelRecord::Study study) const {
  return impl_->database.guarded([&] {
    const long long id = run;
    const std::string name = study_name(study);
    long long panels = 0;
    impl_->database.session() << "SELECT count(*) FROM panel WHERE run = :run AND study = :study",
        soci::use(id), soci::use(name), soci::into(panels);
    return static_cast<std::uint64_t>(panels);
  });
}

void Store::for_each_panel(std::int64_t run, PanelRecord::Study study,
                           const std::function<void(const PanelRecord&)>& read) const {
  PanelReader reader =
      impl_->database.guarded([&] { return PanelReader(impl_->database, run, study); });
  for (std::vector<PanelRecord> page = reader.next(); !page.empty(); page = reader.next()) {
    for (const PanelRecord& panel : page) {
      read(panel);
    }
  }
}

}  // namespace gonio
