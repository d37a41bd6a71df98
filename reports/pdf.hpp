#pragma once

#include <string>

namespace gonio {

/// Prints a page on paper with a headless Chromium, which runs without a shell and without the
/// settings of its user, and has ended, with all that it wrote, when this returns or throws.
/// @param html  a page of its own, which needs nothing else.
/// @return      the bytes of a PDF file.
/// @throws std::system_error  if no Chromium is installed, if it cannot be run, or makes no PDF.
[[nodiscard]] std::string printed_pdf(const std::string& html);

/// The name of the Chromium that would print, for those who would rather know before long work.
/// @throws std::system_error  if none is installed.
[[nodiscard]] std::string pdf_printer();

}  // namespace gonio
