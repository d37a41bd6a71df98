#pragma once

#include <string>

#include "emulator/standard/clause.hpp"
#include "tests/unit/standard/shipped_standards.hpp"
#include "tests/unit/temporary_folder.hpp"

namespace gonio::test {

/// A standard of one's own with two geometries, its clauses and its cases, in a folder. The head of
/// the files is fixed, so that lines can be counted in messages: clauses begin in line 5 of
/// clauses.yaml, cases in line 3 of cases.yaml.
class ClauseFiles {
 public:
  explicit ClauseFiles(const std::string& clauses, const std::string& cases = "") {
    (void)folder_.file("standard.yaml", standard());
    (void)folder_.file("cases.yaml",
                       "schema: gonio/cases/1\ncases:\n" + (cases.empty() ? unused_case() : cases));
    (void)folder_.file(
        "clauses.yaml",
        "schema: gonio/clauses/1\nid: house/1\ncases: [cases.yaml]\nclauses:\n" + clauses);
  }

  [[nodiscard]] ClauseSet clauses() const {
    return load_clauses(folder_.path() / "clauses.yaml", shipped());
  }
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_.path(); }

 private:
  static std::string unused_case() {
    return "  - {id: none, clause: nowhere, intent: none, when: {measure: theta_i}, verdict: "
           "pass}\n";
  }

  static std::string geometry(const std::string& angle, const std::string& source_in_plane) {
    const std::string evidence = "evidence: {level: C2, sources: []}}\n";
    return "  - id: \"" + angle + "\"\n" + "    theta_i: {nominal: " + angle +
           " deg, tolerance: 0.1 deg, " + evidence + "    theta_r: {nominal: " + angle +
           " deg, tolerance: 0.1 deg, evidence: {level: memory, sources: []}}\n" +
           "    source:\n      in_plane: " + source_in_plane +
           "      perpendicular: {nominal: 2.5 deg, tolerance: 0.5 deg, " + evidence +
           "    receptor:\n      in_plane: {nominal: 4.4 deg, tolerance: 0.1 deg, " + evidence +
           "      perpendicular: {nominal: 11.7 deg, tolerance: 0.2 deg, " + evidence;
  }

  static std::string standard() {
    const std::string text = user_standard();
    return text.substr(0, text.find("geometries:\n")) + "geometries:\n" +
           geometry("20",
                    "{nominal: 0.75 deg, tolerance: 0.25 deg, evidence: {level: C2, sources: "
                    "[]}}\n") +
           geometry("60", "unknown\n");
  }

  TemporaryFolder folder_;
};

}  // namespace gonio::test
