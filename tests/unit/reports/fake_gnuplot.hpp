#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>

#include "tests/unit/temporary_folder.hpp"

namespace gonio::test {

/// The search path for programs, for the time of a scope.
class SearchPath {
 public:
  explicit SearchPath(const std::string& path) {
    if (const char* before = std::getenv("PATH")) {
      before_ = before;
    }
    setenv("PATH", path.c_str(), 1);
  }
  ~SearchPath() {
    if (before_) {
      setenv("PATH", before_->c_str(), 1);
    } else {
      unsetenv("PATH");
    }
  }
  SearchPath(const SearchPath&) = delete;
  SearchPath& operator=(const SearchPath&) = delete;

 private:
  std::optional<std::string> before_;
};

/// A program that is found before the real one.
class FakeProgram {
 public:
  /// @param commands  of a shell; their folder is $here.
  FakeProgram(const std::string& name, const std::string& commands) {
    const auto file =
        folder_.file(name, "#!/bin/sh\nhere=" + folder_.path().string() + "\n" + commands + "\n");
    std::filesystem::permissions(file, std::filesystem::perms::owner_all);
  }

  [[nodiscard]] const std::filesystem::path& folder() const { return folder_.path(); }

 private:
  TemporaryFolder folder_;
  SearchPath path_{folder_.path().string() + ":/usr/bin:/bin"};
};

class FakeGnuplot : public FakeProgram {
 public:
  explicit FakeGnuplot(const std::string& commands) : FakeProgram("gnuplot", commands) {}
};

}  // namespace gonio::test
