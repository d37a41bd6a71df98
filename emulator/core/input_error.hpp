#pragma once

#include <stdexcept>
#include <string>

namespace gonio {

/// A place in an input file. Lines and columns count from 1; 0 where there is none.
struct SourceMark {
  std::string file;
  int line = 0;
  int column = 0;
  std::string key = {};  ///< path of keys, e.g. "surface.rms_slope"; empty at the top of a file

  /// "file:line:column: key", without the parts that are not there.
  [[nodiscard]] std::string text() const;
};

/// An input file is wrong: `file:line:column: key: expected ..., found '...'`.
class InputError : public std::runtime_error {
 public:
  /// @param found  what stands there; quoted in the message unless it is "nothing".
  InputError(SourceMark mark, const std::string& expected, const std::string& found);

  [[nodiscard]] const SourceMark& mark() const { return mark_; }

 private:
  SourceMark mark_;
};

}  // namespace gonio
