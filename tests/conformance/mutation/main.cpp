#include <fmt/format.h>

#include <cstdio>
#include <exception>

#include "tests/conformance/mutation/mutation_run.hpp"
#include "tests/conformance/program.hpp"

// gonio-mutation [DEFECTS]: tries the conformance suite on seeded defects; exit status 1 if one of
// them is not caught, or if the healthy instrument is.
int main(int argc, char** argv) {
  using namespace gonio;
  using namespace gonio::conformance;
  try {
    if (argc > 2) {
      fmt::print(stderr, "usage: gonio-mutation [DEFECTS]\n");
      return bad_input;
    }
    const Catalog catalog = Catalog::standard_places();
    const Defects defects = load_defects(argc == 2 ? argv[1] : GONIO_DEFECTS, catalog);
    const MutationTable table = run_mutations(defects, catalog);
    fmt::print("{}", mutation_text(table));
    return table.is_sound() ? conforms : does_not_conform;
  } catch (const InputError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return bad_input;
  } catch (const std::exception& error) {
    fmt::print(stderr, "gonio-mutation: {}\n", error.what());
    return environment_failed;
  }
}
