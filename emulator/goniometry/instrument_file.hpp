#pragma once

#include <string>

#include "emulator/instrument/instrument.hpp"

namespace gonio {

/// An instrument as text of schema gonio/instrument/1, with its set-up and how well that is known.
/// What else a file may state, such as behaviour or spectra, is not written.
/// @param notes  one paragraph: where the set-up comes from.
[[nodiscard]] std::string instrument_yaml(const Instrument& instrument, const std::string& id,
                                          const std::string& notes);

}  // namespace gonio
