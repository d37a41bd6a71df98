#include "emulator/measured/word_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <numbers>
#include <utility>

namespace gonio {

namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

}  // namespace

bool Word::is(std::string_view other) const {
  return std::ranges::equal(text, other, [](unsigned char a, unsigned char b) {
    return std::tolower(a) == std::tolower(b);
  });
}

std::optional<double> number_of(std::string_view text) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') {
    text.remove_prefix(1);
  }
  double value = 0.0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, value);
  constexpr double largest = 1e30;  // so that sums and products of some of them stay finite
  if (error != std::errc{} || rest != end || !(std::abs(value) <= largest)) {
    return std::nullopt;
  }
  return value;
}

WordReader::WordReader(std::string_view text, std::string file, char comment)
    : text_(text), file_(std::move(file)), comment_(comment) {
  advance();
}

Word WordReader::take() {
  const Word word = word_;
  end_of_last_ = place_;
  advance();
  return word;
}

std::string_view WordReader::take_rest_of_line() {
  const std::size_t begin = end_of_last_;
  const std::size_t end = std::min(text_.find('\n', begin), text_.size());
  while (!at_end() && word_.text.data() < text_.data() + end) {
    take();
  }
  std::string_view rest = text_.substr(begin, end - begin);
  rest = rest.substr(0, rest.find(comment_));
  while (!rest.empty() && is_blank(rest.front())) {
    rest.remove_prefix(1);
  }
  while (!rest.empty() && is_blank(rest.back())) {
    rest.remove_suffix(1);
  }
  return rest;
}

void WordReader::advance() {
  while (place_ < text_.size() && (is_blank(text_[place_]) || text_[place_] == comment_)) {
    if (text_[place_] == comment_) {
      skip_line();
    } else if (text_[place_++] == '\n') {
      ++line_;
      line_begin_ = place_;
    }
  }
  const std::size_t begin = place_;
  while (place_ < text_.size() && !is_blank(text_[place_]) && text_[place_] != comment_) {
    ++place_;
  }
  word_ = {.text = text_.substr(begin, place_ - begin),
           .line = line_,
           .column = int(begin - line_begin_) + 1};
}

void WordReader::skip_line() {
  const std::size_t end = std::min(text_.find('\n', place_), text_.size());
  keep_comment(text_.substr(place_, end - place_));
  place_ = end;
}

void WordReader::keep_comment(std::string_view comment) {
  const auto says = [&](char c) { return !is_blank(c) && c != comment_; };
  const auto first = std::ranges::find_if(comment, says);
  if (first_comment_.empty() && first != comment.end()) {
    first_comment_.assign(first, comment.end());
    while (is_blank(first_comment_.back())) {
      first_comment_.pop_back();
    }
  }
}

void WordReader::expect(std::string_view word) {
  if (!word_.is(word)) {
    fail(word_, std::string(word));
  }
  take();
}

double WordReader::take_number(const std::string& key) {
  const auto value = number_of(word_.text);
  if (!value) {
    fail(word_, "a number", key);
  }
  take();
  return *value;
}

Eigen::Index WordReader::take_count(const std::string& key) {
  const Word word = word_;
  const double count = take_number(key);
  if (!(count >= 1.0) || count != std::floor(count) || count > double(text_.size())) {
    fail(word, "a number of values, from 1 to what the file can hold", key);
  }
  require_room(count, key);
  return Eigen::Index(count);
}

Eigen::ArrayXd WordReader::take_angles(const std::string& key, double largest_deg) {
  return take_angles(key, largest_deg, take_count(key));
}

Eigen::ArrayXd WordReader::take_angles(const std::string& key, double largest_deg,
                                       Eigen::Index count) {
  Eigen::ArrayXd angles(count);
  double last = 0.0;
  for (Eigen::Index i = 0; i < count; ++i) {
    const Word word = word_;
    const double degrees = take_number(key);
    if (degrees < 0.0 || degrees > largest_deg) {
      fail(word, fmt::format("an angle in [0, {}] degrees", largest_deg), key);
    }
    if (i > 0 && degrees <= last) {
      fail(word, fmt::format("an angle above {}: they ascend", last), key);
    }
    last = degrees;
    angles[i] = degrees * (std::numbers::pi / 180.0);
  }
  return angles;
}

void WordReader::require_room(double numbers, const std::string& key) const {
  const double left = double(text_.data() + text_.size() - word_.text.data());
  if (2.0 * numbers > left + 1.0) {  // the last one needs no blank after it
    fail(word_, fmt::format("{:.0f} numbers", numbers), key);
  }
}

void WordReader::fail(const Word& word, const std::string& expected, const std::string& key) const {
  const std::string found = word.text.empty() ? "the end of the file" : std::string(word.text);
  throw InputError({.file = file_, .line = word.line, .column = word.column, .key = key}, expected,
                   found);
}

}  // namespace gonio
