#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>

#include "emulator/core/input_error.hpp"
#include "emulator/core/text_file.hpp"
#include "tests/conformance/program.hpp"

int main(int argc, char** argv) {
  using namespace gonio::conformance;
  try {
    testing::InitGoogleTest(&argc, argv);
    return run_program(argc, argv);
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
