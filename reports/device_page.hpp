#pragma once

#include <string>
#include <utility>
#include <vector>

#include "reports/page.hpp"
#include "reports/report_table.hpp"

// The page of a device's readings: facts, tables, notes, and a section with charts for each sample.

namespace gonio {

struct DevicePage {
  std::string title, subtitle;
  std::vector<std::pair<std::string, std::string>> facts = {};  ///< name, value
  std::vector<ReportTable> tables = {};
  std::vector<std::string> notes = {};
};

/// For device_page(). @param figures  of Figures.
[[nodiscard]] PageData device_section(const std::string& heading, const std::string& text,
                                      const PageList& figures);
[[nodiscard]] std::string device_page(const DevicePage& page, const PageList& sections);

}  // namespace gonio
