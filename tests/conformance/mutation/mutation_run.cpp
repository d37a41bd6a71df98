#include "tests/conformance/mutation/mutation_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "emulator/core/parallel_for.hpp"
#include "emulator/instrument/glossmeter.hpp"
#include "emulator/instrument/overlay.hpp"
#include "tests/conformance/in_process_port.hpp"
#include "tests/conformance/run.hpp"

namespace gonio::conformance {

namespace {

constexpr std::size_t most_addresses = 3;

using Suites = std::map<std::string, ConformanceSuite>;

/// The same device with a tile that it takes for another.
Device with_certificate(const Device& device, double index, const Scale& scale) {
  std::vector<Channel> channels = device.channels();
  for (Channel& channel : channels) {
    channel.tile_assigned_gu = assigned_gloss(index, channel.theta_i, scale);
  }
  return {device.identity(), device.behaviour(), std::move(channels), device.samples()};
}

/// Assembles the device with its defect, once: every case gets one as new.
InProcessPort::Assemble assemble_defective(const Defect& defect, const Catalog& catalog) {
  const auto made = std::make_shared<std::optional<Device>>();
  return [=](const Instrument& stated, const std::vector<std::string>& samples) {
    if (!*made) {
      const Instrument built =
          defect.unstated ? with_overlay(stated, *defect.unstated, catalog) : stated;
      *made = assemble_with(catalog, defect.optics ? defect.optics() : nullptr)(built, samples);
      if (defect.certificate_index) {
        *made = with_certificate(**made, *defect.certificate_index, built.standard.scale);
      }
    }
    return **made;
  };
}

DeviceUnderTest defective_device(const Defect& defect, Instrument instrument,
                                 const ConformanceSuite& suite, const Catalog& catalog) {
  if (defect.set) {
    instrument = with_overlay(std::move(instrument), *defect.set, catalog);
  }
  const auto standard = std::make_shared<Standard>(instrument.standard);
  return {.bench = [=, assemble = assemble_defective(defect, catalog),
                    samples = suite.device_samples(), change = defect.device] {
    std::shared_ptr<DevicePort> port =
        std::make_shared<InProcessPort>(instrument, samples, assemble);
    if (change != nullptr) {
      port = change(port);
    }
    return std::make_shared<Bench>(standard.get(),
                                   [port, standard]() -> DevicePort& { return *port; });
  }};
}

struct TriedCase {
  CaseResult result;
  bool counts;
};

/// The cases of one suite that speak about the device, by address.
std::map<std::string, TriedCase> try_defect(const Defect& defect, ConformanceSuite suite,
                                            const Defects& all, const Catalog& catalog) {
  const Instrument healthy = all.healthy_instrument(*suite.set.standard, catalog);
  const DeviceUnderTest device = defective_device(defect, healthy, suite, catalog);
  if (defect.standard) {
    defect.standard(*suite.set.standard);
  }
  ConformanceRun run(std::move(suite), device, {}, catalog);
  std::map<std::string, TriedCase> results;
  for (const SuiteCase& entry : run.suite().cases) {
    if (run.suite().case_of(entry).role != CaseRole::control) {
      results.emplace(entry.address,
                      TriedCase{run.run(entry), run.counts(run.suite().clause_of(entry))});
    }
  }
  return results;
}

bool was_tried(ConformanceVerdict verdict) {
  return verdict != ConformanceVerdict::skipped && verdict != ConformanceVerdict::not_applicable;
}

/// Whether an address is of one of these families of clauses, e.g. geometry/receptor_60 of
/// geometry/receptor.
bool is_of(const std::string& address, const std::string& standard,
           const std::vector<std::string>& families) {
  return std::any_of(families.begin(), families.end(), [&](const std::string& family) {
    return address.starts_with(standard + "/" + family + "/") ||
           address.starts_with(standard + "/" + family + "_");
  });
}

class Mutations {
 public:
  Mutations(const Defects& defects, const Catalog& catalog) : defects_(defects), catalog_(catalog) {
    for (const std::string& id : defects.standards) {
      add_suite(id);
    }
    for (const Defect& defect : defects.defects) {
      for (const std::string& id : defect.standards) {
        add_suite(id);
      }
    }
  }

  MutationTable run() {
    MutationTable table;
    table.rows.resize(defects_.defects.size());
    for (const auto& [id, suite] : suites_) {
      healthy_[id] = try_defect({}, suite, defects_, catalog_);
      for (const auto& [address, tried] : healthy_[id]) {
        ++table.tried;
        if (was_tried(tried.result.verdict) && !tried.result.is_as_expected()) {
          table.healthy_caught_by.push_back(address + ": " + words_on(tried.result));
        }
      }
    }
    parallel_for(table.rows.size(),
                 [&](std::size_t j) { table.rows[j] = row_of(defects_.defects[j]); });
    return table;
  }

 private:
  void add_suite(const std::string& id) {
    if (!suites_.contains(id)) {
      suites_.emplace(id, load_suite(catalog_.find(Catalog::Kind::clauses, id), catalog_));
    }
  }

  static std::string words_on(const CaseResult& result) {
    std::string words = verdict_name(result.verdict);
    for (const Observation& seen : result.observations) {
      if (seen.value && seen.verdict != ConformanceVerdict::pass) {
        words += fmt::format(" ({} {:g} {})", seen.geometry, *seen.value, seen.unit);
      }
    }
    return result.message.empty() ? words : words + " " + result.message;
  }

  [[nodiscard]] MutationRow row_of(const Defect& defect) const {
    MutationRow row{.id = defect.id, .wrong = defect.wrong};
    for (const std::string& id : defect.standards) {
      for (const auto& [address, tried] : try_defect(defect, suites_.at(id), defects_, catalog_)) {
        const CaseResult& healthy = healthy_.at(id).at(address).result;
        if (!healthy.is_as_expected() || tried.result.is_as_expected() ||
            !was_tried(healthy.verdict) || !was_tried(tried.result.verdict)) {
          continue;
        }
        row.caught_by.push_back({.address = address, .counts = tried.counts});
        row.is_caught = row.is_caught || is_of(address, id, defect.clauses);
      }
    }
    return row;
  }

  const Defects& defects_;
  const Catalog& catalog_;
  Suites suites_;
  std::map<std::string, std::map<std::string, TriedCase>> healthy_;
};

std::string row_text(const MutationRow& row) {
  std::string by;
  for (std::size_t j = 0; j < std::min(row.caught_by.size(), most_addresses); ++j) {
    by += fmt::format("{}`{}`", j == 0 ? "" : ", ", row.caught_by[j].address);
  }
  if (row.caught_by.size() > most_addresses) {
    by += fmt::format(" and {} more", row.caught_by.size() - most_addresses);
  }
  const auto counted = std::count_if(row.caught_by.begin(), row.caught_by.end(),
                                     [](const Catch& one) { return one.counts; });
  return fmt::format("| `{}` | {} | {} | {} | {} |\n", row.id, row.wrong, row.caught_by.size(),
                     counted, by);
}

}  // namespace

bool MutationTable::is_sound() const {
  return healthy_caught_by.empty() &&
         std::all_of(rows.begin(), rows.end(),
                     [](const MutationRow& row) { return row.is_caught; });
}

MutationTable run_mutations(const Defects& defects, const Catalog& catalog) {
  return Mutations(defects, catalog).run();
}

std::string mutation_text(const MutationTable& table) {
  std::string text =
      "| defect | what is wrong | cases that caught it | of them counted | which |\n"
      "|---|---|---|---|---|\n";
  for (const MutationRow& row : table.rows) {
    text += row_text(row);
  }
  const auto caught = std::count_if(table.rows.begin(), table.rows.end(),
                                    [](const MutationRow& row) { return row.is_caught; });
  text +=
      fmt::format("\n{} of {} defects caught; {} cases on the healthy instrument, {} against it\n",
                  caught, table.rows.size(), table.tried, table.healthy_caught_by.size());
  for (const std::string& address : table.healthy_caught_by) {
    text += fmt::format("against the healthy instrument: {}\n", address);
  }
  for (const MutationRow& row : table.rows) {
    if (!row.is_caught) {
      text += fmt::format("not caught by the clauses meant to: {}\n", row.id);
    }
  }
  return text;
}

}  // namespace gonio::conformance
