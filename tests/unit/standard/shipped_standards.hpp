#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "emulator/core/catalog.hpp"
#include "emulator/standard/standard.hpp"

namespace gonio::test {

inline const std::filesystem::path source_tree(GONIO_SOURCE_DIR);

/// What ships, as it stands in the source tree.
inline Catalog shipped() { return Catalog({source_tree}); }

inline Standard shipped_standard(const std::string& id) {
  return load_standard(shipped().find(Catalog::Kind::standard, id));
}

inline std::vector<std::string> ids_of_shipped(Catalog::Kind kind) {
  std::vector<std::string> ids;
  for (const Catalog::Entry& entry : shipped().list(kind)) {
    ids.push_back(entry.id);
  }
  return ids;
}

/// A standard of one's own, with one geometry: the lines are counted in messages.
inline std::string user_standard() {
  const std::string fixtures = (source_tree / "fixtures").string();
  return "schema: gonio/standard/1\n"                                                  // 1
         "id: house/1\n"                                                               // 2
         "title: House method\n"                                                       // 3
         "edition: first\n"                                                            // 4
         "transcription: complete\n"                                                   // 5
         "scale:\n"                                                                    // 6
         "  unit: GU\n"                                                                // 7
         "  relative_to: reference_glass\n"                                            // 8
         "  value: {nominal: 100, evidence: {level: C2, sources: []}}\n"               // 9
         "  refractive_index: {nominal: 1.567, evidence: {level: C2, sources: []}}\n"  // 10
         "spectral:\n"                                                                 // 11
         "  source:\n"                                                                 // 12
         "    file: '" +
         fixtures +
         "/illuminants/c.csv'\n"                     // 13
         "    evidence: {level: C2, sources: []}\n"  // 14
         "  responsivity:\n"                         // 15
         "    file: '" +
         fixtures +
         "/observers/v_lambda.csv'\n"                                                       // 16
         "    evidence: {level: C2, sources: []}\n"                                         // 17
         "geometries:\n"                                                                    // 18
         "  - id: \"60\"\n"                                                                 // 19
         "    theta_i: {nominal: 60 deg, evidence: {level: C2, sources: []}}\n"             // 20
         "    source:\n"                                                                    // 21
         "      in_plane: {nominal: 0.75 deg, evidence: {level: C2, sources: []}}\n"        // 22
         "      perpendicular: {nominal: 2.5 deg, evidence: {level: C2, sources: []}}\n"    // 23
         "    receptor:\n"                                                                  // 24
         "      in_plane: {nominal: 4.4 deg, evidence: {level: C2, sources: []}}\n"         // 25
         "      perpendicular: {nominal: 11.7 deg, evidence: {level: C2, sources: []}}\n";  // 26
}

/// `text` with the first `from` replaced. @throws std::invalid_argument  if there is none.
inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t place = text.find(from);
  if (place == std::string::npos) {
    throw std::invalid_argument("replaced: no '" + from + "'");
  }
  return text.replace(place, from.size(), to);
}

}  // namespace gonio::test
