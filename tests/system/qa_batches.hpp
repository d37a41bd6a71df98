#pragma once

#include <string>

namespace gonio::test {

/// What a made-up batch file says; the lines of its keys do not depend on it.
struct BatchText {
  std::string spread = "{roughness: {lots: 0.01, panels: 0.01, within_panel: 0.005}}";  ///< line 7
  std::string sampling = "{lots: 4, panels: 5, positions: 3}";
};

/// A batch of a semi-gloss paint at 60 deg, judged by the nominal instrument.
inline std::string batch_text(const BatchText& text) {
  return "schema: gonio/batch/1\nid: mine\ntitle: Mine\nstandard: iso_2813/2014\nproduct:\n"
         "  sample: black_semi_gloss\n" +
         (text.spread.empty() ? "\n" : "  spread: " + text.spread + "\n") +
         "specification: {gloss: {60 deg: 52 +- 6 GU}}\nsampling: " + text.sampling +
         "\ndecision: {rule: simple}\n";
}

}  // namespace gonio::test
