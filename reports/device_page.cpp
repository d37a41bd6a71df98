#include "reports/device_page.hpp"

namespace gonio {

PageData device_section(const std::string& heading, const std::string& text,
                        const PageList& figures) {
  PageData data("heading", heading);
  data.set("text", text);
  data.set("figures", PageData(figures));
  return data;
}

std::string device_page(const DevicePage& page, const PageList& sections) {
  PageList facts;
  for (const auto& [name, value] : page.facts) {
    PageData fact("name", name);
    fact.set("value", value);
    facts.push_back(fact);
  }
  PageList tables;
  for (const ReportTable& table : page.tables) {
    tables.push_back(table_data(table));
  }
  PageData data("title", page.title);
  data.set("subtitle", page.subtitle);
  data.set("facts", PageData(facts));
  data.set("tables", PageData(tables));
  set_list(data, "notes", text_list(page.notes));
  data.set("sections", PageData(sections));
  return render_page("device", page.title, data);
}

}  // namespace gonio
