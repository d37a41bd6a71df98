#include <fmt/format.h>
#include <gtest/gtest.h>

#include <exception>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "emulator/core/input_error.hpp"
#include "tests/conformance/program.hpp"

namespace {

/// GoogleTest gets its own options alone: it would answer --help before we can.
/// @return  the others, with the program's name.
std::vector<char*> give_options_to_googletest(int argc, char** argv) {
  std::vector<char*> theirs{argv[0]};
  std::vector<char*> ours{argv[0]};
  for (int j = 1; j < argc; ++j) {
    (std::string_view(argv[j]).starts_with("--gtest_") ? theirs : ours).push_back(argv[j]);
  }
  int count = int(theirs.size());
  theirs.push_back(nullptr);
  testing::InitGoogleTest(&count, theirs.data());
  if (count > 1) {
    throw std::invalid_argument(
        fmt::format("expected an option of GoogleTest, found '{}'", theirs[1]));
  }
  return ours;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace gonio::conformance;
  try {
    std::vector<char*> arguments = give_options_to_googletest(argc, argv);
    return run_program(int(arguments.size()), arguments.data());
  } catch (const gonio::InputError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return bad_input;
  } catch (const std::invalid_argument& error) {
    fmt::print(stderr, "gonio-conformance: {}\n", error.what());
    return bad_input;
  } catch (const std::exception& error) {
    fmt::print(stderr, "gonio-conformance: {}\n", error.what());
    return environment_failed;
  }
}
