#include "tests/conformance/wire_cases.hpp"

#include <ostream>

#include "tests/conformance/case.hpp"

namespace gonio::conformance {

namespace {

const std::filesystem::path folder = "standards/modbus/v1_1b3";

}  // namespace

void PrintTo(const WireCase& wire_case, std::ostream* out) { *out << wire_case.exchange.note; }

std::vector<WireCase> wire_cases(const std::filesystem::path& root, modbus::Line line,
                                 const Profile& profile) {
  const Catalog catalog({root});
  const ClauseSet set = load_clauses(root / folder / "clauses.yaml", catalog);
  std::vector<WireCase> cases;
  for (const std::filesystem::path& file : set.case_files) {
    for (const Case& stated : load_cases(file, set, catalog)) {
      Exchange exchange = read_exchange(*stated.exchange, line, profile);
      if (exchange.is_for(line) && exchange.missing.empty()) {
        cases.push_back({stated.id, stated.clause_family, std::move(exchange)});
      }
    }
  }
  return cases;
}

Profile shipped_profile(const std::filesystem::path& root, const std::string& name) {
  return Profile::load(root / folder / "profiles" / (name + ".yaml"));
}

}  // namespace gonio::conformance
