#include "emulator/measured/text_brdf.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace gonio {

void KeywordsSeen::add(const WordReader& words, const Word& keyword) {
  if (has(keyword.text)) {
    words.fail(keyword, "each keyword once");
  }
  seen_.push_back(keyword);
}

bool KeywordsSeen::has(std::string_view keyword) const {
  return std::ranges::any_of(seen_, [&](const Word& word) { return word.is(keyword); });
}

void take_table(WordReader& words, const SpecularTable::Grid& grid, Eigen::Index row,
                Eigen::Ref<Eigen::ArrayXd> channel) {
  const Eigen::Index end = row + grid.azimuth.size() * grid.radial.size();
  for (Eigen::Index i = row; i < end; ++i) {
    channel[i] = words.take_number("");
  }
}

void clip_negative(Eigen::ArrayXXd& f_r, std::vector<std::string>& warnings) {
  const Eigen::Index n = (f_r < 0.0).count();
  if (n > 0) {
    warnings.push_back(
        fmt::format("{} of {} values are negative: 0 stands for them", n, f_r.size()));
    f_r = f_r.max(0.0);
  }
}

}  // namespace gonio
