#include "reports/pdf.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <system_error>

#include "emulator/core/text_file.hpp"
#include "reports/process.hpp"

namespace gonio {

namespace fs = std::filesystem;

namespace {

const std::vector<std::string> browsers{"chromium", "chromium-browser", "google-chrome"};

/// Removed with all it holds at the end of its scope.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (fs::temp_directory_path() / "gonio_pdf_XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) {
      throw std::system_error(errno, std::generic_category(), name);
    }
    path_ = name;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  [[nodiscard]] const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

Command printing(const fs::path& folder, const fs::path& page, const fs::path& pdf) {
  std::vector<std::string> arguments{
      pdf_printer(),
      "--headless",
      "--disable-gpu",
      "--disable-dev-shm-usage",  // which is small in a container
      "--no-first-run",
      "--disable-background-networking",
      "--disable-component-update",
      "--no-pdf-header-footer",
      fmt::format("--user-data-dir={}", (folder / "profile").string()),
      fmt::format("--print-to-pdf={}", pdf.string())};
  if (geteuid() == 0) {
    arguments.emplace_back("--no-sandbox");  // root has none
  }
  arguments.push_back(fmt::format("file://{}", page.string()));
  return {.arguments = arguments,
          .purpose = "which prints the page",
          .environment = {fmt::format("HOME={}", folder.string())}};
}

std::string bytes_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

std::string pdf_printer() {
  std::string found = first_on_path(browsers);
  if (found.empty()) {
    throw std::system_error(
        ENOENT, std::generic_category(),
        fmt::format("cannot make a PDF: none of {} is installed", fmt::join(browsers, ", ")));
  }
  return found;
}

std::string printed_pdf(const std::string& html) {
  const TemporaryFolder folder;
  const fs::path page = folder.path() / "page.html";
  const fs::path printed = folder.path() / "page.pdf";
  const Command command = printing(folder.path(), page, printed);
  write_text_file(page, html);
  (void)run_to_end(command, "");
  std::string pdf = bytes_of(printed);
  if (!pdf.starts_with("%PDF")) {
    throw std::system_error(EIO, std::generic_category(),
                            fmt::format("{} made no PDF of the page", command.arguments.front()));
  }
  return pdf;
}

}  // namespace gonio
