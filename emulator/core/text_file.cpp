#include "emulator/core/text_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <fstream>
#include <functional>
#include <iterator>
#include <system_error>

#include "emulator/core/input_error.hpp"

namespace gonio {

namespace fs = std::filesystem;

namespace {

constexpr std::uintmax_t mib = 1u << 20;
constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";  // some editors begin UTF-8 with it

[[noreturn]] void fail(const fs::path& path) {
  throw std::system_error(errno, std::generic_category(), "cannot write " + path.string());
}

/// A rename is safe from power failure once its folder is on the disk.
/// A folder that may not be read cannot be opened for that, and some file systems cannot do it: the
/// rename is then as safe as they make it.
bool sync_folder_of(const fs::path& path) {
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  const int descriptor = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) {
    return true;
  }
  const bool synced = fsync(descriptor) == 0 || errno == EINVAL || errno == ENOTSUP;
  const int cause = errno;
  close(descriptor);
  errno = cause;
  return synced;
}

/// A temporary file, which is gone at the end unless it was renamed.
struct OpenFile {
  int descriptor;
  const std::string& name;
  ~OpenFile() {
    const int cause = errno;
    close(descriptor);
    unlink(name.c_str());
    errno = cause;
  }
};

}  // namespace

std::string what_stands_at(const fs::path& path) {
  std::error_code error;
  const auto status = fs::status(path, error);
  if (fs::is_regular_file(status)) {
    return "a file";
  }
  if (fs::is_directory(status)) {
    return "a folder";
  }
  return fs::exists(status) ? "something else" : "nothing";
}

std::string read_text_file(const fs::path& path, int largest_mib) {
  const SourceMark mark{.file = path.string(), .line = 0, .column = 0, .key = {}};
  if (const std::string there = what_stands_at(path); there != "a file") {
    throw InputError(mark, "a file", there);
  }
  if (fs::file_size(path) > std::uintmax_t(largest_mib) * mib) {
    throw InputError(mark, "a file of at most " + std::to_string(largest_mib) + " MiB",
                     std::to_string(fs::file_size(path)) + " bytes");
  }
  std::ifstream in(path, std::ios::binary);
  if (!in) {
    throw InputError(mark, "a file that may be read", "no permission");
  }
  std::string text{std::istreambuf_iterator<char>(in), {}};
  if (text.find_first_not_of(" \t\r\n") == std::string::npos) {
    throw InputError(mark, "a file with content", "an empty file");
  }
  if (text.starts_with(byte_order_mark)) {
    text.erase(0, byte_order_mark.size());
  }
  return text;
}

void write_file(const fs::path& path, const std::function<void(std::ostream&)>& write) {
  if (what_stands_at(path) == "something else") {
    // A rename would put a file in the place of a device or pipe, for everybody.
    std::ofstream out(path, std::ios::binary);
    if (!out) {
      fail(path);
    }
    write(out);
    if (!out.flush()) {
      fail(path);
    }
    return;
  }
  std::string temporary = path.string() + ".XXXXXX";
  const int descriptor = mkstemp(temporary.data());
  if (descriptor < 0) {
    fail(path);
  }
  const OpenFile file{descriptor, temporary};
  std::ofstream out(temporary, std::ios::binary);
  write(out);
  const bool written = out.flush() && fsync(descriptor) == 0 && fchmod(descriptor, 0644) == 0 &&
                       std::rename(temporary.c_str(), path.c_str()) == 0 && sync_folder_of(path);
  if (!written) {
    fail(path);
  }
}

void write_text_file(const fs::path& path, std::string_view text) {
  write_file(path,
             [&](std::ostream& out) { out.write(text.data(), std::streamsize(text.size())); });
}

}  // namespace gonio
