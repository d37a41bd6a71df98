#pragma once

#include <string>

#include "tests/conformance/mutation/mutation_run.hpp"
#include "tests/unit/message_of.hpp"
#include "tests/unit/standard/shipped_standards.hpp"
#include "tests/unit/temporary_folder.hpp"

namespace gonio::test {

/// A file of defects; what they begin with has four lines.
class DefectFile {
 public:
  explicit DefectFile(const std::string& defects,
                      const std::string& healthy = "{repeatability: 0 GU}")
      : file_(folder_.file("defects.yaml",
                           "schema: gonio/defects/1\nstandards: [iso_2813/2014]\nhealthy: " +
                               healthy + "\ndefects:\n" + defects)) {}

  [[nodiscard]] conformance::Defects read() const {
    return conformance::load_defects(file_, shipped());
  }
  [[nodiscard]] conformance::MutationTable run() const {
    return conformance::run_mutations(read(), shipped());
  }
  /// What is wrong with it, without the folder.
  [[nodiscard]] std::string error() const {
    const std::string message = message_of([&] { (void)read(); });
    return message.substr(message.find("defects.yaml"));
  }

 private:
  TemporaryFolder folder_;
  std::filesystem::path file_;
};

inline std::string defect(const std::string& what,
                          const std::string& clauses = "[geometry/incidence]") {
  return "  - {id: tried, wrong: Something, clauses: " + clauses + ", " + what + "}\n";
}
inline const std::string incidence_off = defect("set: {as_built: {\"60\": {theta_i: 60.2 deg}}}");
inline const std::string harmless = defect("set: {behaviour: {seed: 7}}");

}  // namespace gonio::test
