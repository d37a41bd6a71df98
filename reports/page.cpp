#include "reports/page.hpp"

#include <fmt/format.h>

#include <cctype>
#include <stdexcept>
#include <string_view>

#include "reports/escape.hpp"
#include "reports/templates.hpp"

namespace gonio {

namespace {

namespace mustache = kainjow::mustache;

mustache::partial part(std::string_view file) {
  return [file] { return std::string(template_text(file)); };
}

}  // namespace

void set_text(PageData& data, const std::string& key, const std::string& text) {
  data.set(key, text.empty() ? PageData(false) : PageData(text));
}

void set_list(PageData& data, const std::string& key, const PageList& list) {
  data.set("has_" + key, PageData(!list.empty()));
  data.set(key, PageData(list));
}

PageList text_list(const std::vector<std::string>& texts) {
  PageList list;
  for (const std::string& text : texts) {
    list.push_back(PageData("text", text));
  }
  return list;
}

std::string typeset(std::string text) {
  constexpr std::string_view typed = "+-";
  constexpr std::string_view set = "\u00B1";
  for (auto at = text.find(typed); at != std::string::npos; at = text.find(typed, at + 1)) {
    text.replace(at, typed.size(), set);
  }
  return text;
}

std::string anchor(FixedName kind, const std::string& text) {
  std::string id = fmt::format("{}-", kind.text());
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    const bool stays = (byte < 0x80 && std::isalnum(byte) != 0) || c == '_' || c == '/';
    id += stays ? std::string{c} : fmt::format(".{:02X}", byte);
  }
  return id;
}

PageData Figures::figure(const Chart& chart, const std::string& caption,
                         const std::vector<std::string>& keys) {
  ++count_;
  PageData data;
  data.set("svg", chart.svg(count_));
  data.set("caption", caption);
  set_list(data, "keys", text_list(keys));
  return data;
}

std::string render_page(FixedName name, const std::string& title, PageData data) {
  const std::string body = fmt::format("{}.mustache", name.text());
  data.set("title", title);
  data.set("body", part(body));
  data.set("page_style", part("page_style.mustache"));
  data.set("page_filter", part("page_filter.mustache"));
  data.set("mark", part("verdict.mustache"));
  data.set("figure", part("figure.mustache"));
  data.set("word_table", part("table.mustache"));
  mustache::mustache page{std::string(template_text("page.mustache"))};
  page.set_custom_escape([](const std::string& text) { return xml_text(text); });
  std::string html = page.render(data);
  if (!page.is_valid()) {
    throw std::logic_error(fmt::format("{}: {}", body, page.error_message()));
  }
  return html;
}

}  // namespace gonio
