#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "emulator/measured/brdf_file.hpp"
#include "emulator/measured/specular_table.hpp"
#include "emulator/measured/word_reader.hpp"

namespace gonio {

// What the formats of ray tracers have in common: keywords in any order, then tables of numbers.

/// The largest text file of a BRDF that is read.
inline constexpr int largest_brdf_text_mib = 256;

/// What a keyword was given.
class KeywordsSeen {
 public:
  /// @throws InputError  if it was there before.
  void add(const WordReader& words, const Word& keyword);
  [[nodiscard]] bool has(std::string_view keyword) const;

 private:
  std::vector<Word> seen_;
};

/// Reads one table: azimuths of one incidence by radial angles, into rows of f_r from `row` on.
void take_table(WordReader& words, const SpecularTable::Grid& grid, Eigen::Index row,
                Eigen::Ref<Eigen::ArrayXd> channel);

/// Says how many values were negative, and makes 0 of them.
void clip_negative(Eigen::ArrayXXd& f_r, std::vector<std::string>& warnings);

}  // namespace gonio
