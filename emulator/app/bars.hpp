#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "emulator/core/progress.hpp"

namespace gonio::app {

/// A bar for each work that is done after another.
class Bars {
 public:
  void show(const std::string& work, std::size_t done, std::size_t total) {
    if (!bar_ || work != work_ || total != total_ || done < done_) {
      bar_.emplace(total, work);
      work_ = work;
      total_ = total;
      done_ = 0;
    }
    for (; done_ < done; ++done_) {
      bar_->advance();
    }
  }

 private:
  std::optional<Progress> bar_;
  std::string work_;
  std::size_t total_ = 0, done_ = 0;
};

}  // namespace gonio::app
