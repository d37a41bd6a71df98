#include "reports/page_verdict.hpp"

#include "reports/conformance_words.hpp"

namespace gonio {

namespace {

const char* symbol_of(ConformanceVerdict verdict) {
  switch (verdict) {
    case ConformanceVerdict::pass:
      return "\u2713";
    case ConformanceVerdict::fail:
      return "\u2717";
    case ConformanceVerdict::inconclusive:
      return "\u2248";
    case ConformanceVerdict::not_applicable:
      return "\u2013";
    case ConformanceVerdict::skipped:
      return "\u25CB";
    case ConformanceVerdict::error:
      break;
  }
  return "!";
}

}  // namespace

PageData verdict_data(ConformanceVerdict verdict) {
  PageData data;
  data.set("name", verdict_name(verdict));
  data.set("words", verdict_words(verdict));
  data.set("symbol", symbol_of(verdict));
  return data;
}

}  // namespace gonio
