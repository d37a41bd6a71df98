#pragma once

#include <string>

#include "emulator/instrument/instrument.hpp"
#include "tests/unit/message_of.hpp"
#include "tests/unit/standard/shipped_standards.hpp"
#include "tests/unit/temporary_folder.hpp"

// Instrument files made up for a test.

namespace gonio::test {

inline std::string instrument_text(const std::string& as_built,
                                   const std::string& built_to = "iso_2813/2014") {
  return "schema: gonio/instrument/1\n"  // 1
         "id: mine\n"                    // 2
         "title: Mine\n"                 // 3
         "built_to: " +
         built_to + "\n" +  // 4
         as_built;          // 5 ...
}

inline Instrument load_text(const std::string& text) {
  const TemporaryFolder folder;
  return load_instrument(folder.file("mine.yaml", text), shipped());
}

/// The message for a file with this text, without the file's name.
inline std::string error_of(const std::string& text) {
  const TemporaryFolder folder;
  const auto file = folder.file("mine.yaml", text);
  const std::string message = message_of([&] { (void)load_instrument(file, shipped()); });
  return message.starts_with(file.string()) ? message.substr(file.string().size()) : message;
}

}  // namespace gonio::test
