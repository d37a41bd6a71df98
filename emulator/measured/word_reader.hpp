#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <string_view>

#include "emulator/core/input_error.hpp"

namespace gonio {

/// A word of a text, and where it stands.
struct Word {
  std::string_view text;  ///< empty at the end of the text
  int line = 1, column = 1;

  [[nodiscard]] bool is(std::string_view other) const;  ///< in any case
};

/// A number of at most 1e30 in size that is all of a text; nothing else.
[[nodiscard]] std::optional<double> number_of(std::string_view text);

/// Goes through the words of a text, which blanks and line ends separate and a sign of comment
/// ends.
class WordReader {
 public:
  /// @param comment  begins a comment, up to the end of its line.
  WordReader(std::string_view text, std::string file, char comment);

  [[nodiscard]] const Word& peek() const { return word_; }
  [[nodiscard]] bool at_end() const { return word_.text.empty(); }
  Word take();
  /// The rest of the line the last word taken stands in, which is taken too.
  std::string_view take_rest_of_line();

  /// @throws InputError  if the next word is another one, in any case.
  void expect(std::string_view word);
  /// @param key  stands in the message.   @throws InputError  if the next word is no number.
  double take_number(const std::string& key);
  /// A number of things that the rest of the text must hold, two bytes each at least.
  /// @throws InputError  if it is none, or cannot hold them.
  Eigen::Index take_count(const std::string& key);
  /// A number n, then n angles in degrees. @return  [rad]
  /// @throws InputError  if they do not ascend, or leave [0, largest].
  Eigen::ArrayXd take_angles(const std::string& key, double largest_deg);
  Eigen::ArrayXd take_angles(const std::string& key, double largest_deg, Eigen::Index count);

  /// @throws InputError  if the rest of the text cannot hold so many numbers.
  void require_room(double numbers, const std::string& key) const;
  [[noreturn]] void fail(const Word& word, const std::string& expected,
                         const std::string& key = {}) const;

  /// The first comment of the text that says something.
  [[nodiscard]] const std::string& first_comment() const { return first_comment_; }

 private:
  void advance();
  void skip_line();
  void keep_comment(std::string_view comment);

  std::string_view text_;
  std::string file_;
  char comment_;
  std::size_t place_ = 0, line_begin_ = 0, end_of_last_ = 0;
  int line_ = 1;
  Word word_;
  std::string first_comment_;
};

}  // namespace gonio
