#pragma once

#include <string>

#include "emulator/quality/batch.hpp"
#include "tests/unit/message_of.hpp"
#include "tests/unit/standard/shipped_standards.hpp"
#include "tests/unit/temporary_folder.hpp"

namespace gonio::test {

/// A batch file that is right, for tests that change it.
inline const std::string batch_text =
    "schema: gonio/batch/1\n"                                                           // 1
    "id: made\n"                                                                        // 2
    "title: Made for a test\n"                                                          // 3
    "standard: iso_2813/2014\n"                                                         // 4
    "product:\n"                                                                        // 5
    "  sample: black_semi_gloss\n"                                                      // 6
    "  spread: {roughness: {panels: 0.01}, diffuse_reflectance: {lots: 0.001}}\n"       // 7
    "specification:\n"                                                                  // 8
    "  gloss: {60 deg: 52 +- 6 GU}\n"                                                   // 9
    "sampling: {lots: 2, panels: 5, positions: 3}\n"                                    // 10
    "measuring: {instruments: [triangle_gloss, pocket_gloss_60], operators: [anna]}\n"  // 11
    "decision: {rule: simple}\n";                                                       // 12

/// Of a text in a file batch.yaml.
inline Batch batch_of(const std::string& text) {
  const TemporaryFolder folder;
  return load_batch(folder.file("batch.yaml", text), shipped());
}

/// What loading it says, from the line on.
inline std::string batch_error(const std::string& text) {
  const std::string message = message_of([&] { (void)batch_of(text); });
  const std::size_t name = message.find("batch.yaml:");
  return name == std::string::npos ? message : message.substr(name + 11);
}

/// The same for the text above with `from` replaced.
inline std::string batch_error(const std::string& from, const std::string& to) {
  return batch_error(replaced(batch_text, from, to));
}
inline Batch batch_with(const std::string& from, const std::string& to) {
  return batch_of(replaced(batch_text, from, to));
}

}  // namespace gonio::test
