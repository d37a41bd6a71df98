#pragma once

#include <kainjow/mustache.hpp>
#include <string>
#include <vector>

#include "reports/chart.hpp"

// What pages are made of. A template escapes what it shows, but for the charts; every key that a
// template asks for inside a list has to be set there, or the one of the list around it is taken.

namespace gonio {

using PageData = kainjow::mustache::data;
using PageList = kainjow::mustache::list;

/// Sets a text; an empty one is false, so that its section is left out.
void set_text(PageData& data, const std::string& key, const std::string& text);
/// Sets a list, and `has_<key>`, for what stands around the list.
void set_list(PageData& data, const std::string& key, const PageList& list);
/// A list of objects with the key `text`.
[[nodiscard]] PageList text_list(const std::vector<std::string>& texts);
/// Numbers as they are set in print: +- becomes one sign.
[[nodiscard]] std::string typeset(std::string text);
/// The end of a link, from any text: other texts have other ones.
[[nodiscard]] std::string anchor(FixedName kind, const std::string& text);

/// The charts of one page.
class Figures {
 public:
  /// @param caption  what the chart shows, in words; also for who cannot see it.
  /// @param keys     what the curves 1, 2, ... are.
  /// @throws std::system_error  if gnuplot cannot be run.
  [[nodiscard]] PageData figure(const Chart& chart, const std::string& caption,
                                const std::vector<std::string>& keys);

 private:
  std::size_t count_ = 0;
};

/// A whole page.
/// @param name  of a file <name>.mustache in reports/templates: what stands in the body.
[[nodiscard]] std::string render_page(FixedName name, const std::string& title, PageData data);

}  // namespace gonio
