#include "emulator/core/text_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <memory>
#include <system_error>

#include "emulator/core/input_error.hpp"

namespace gonio {

namespace fs = std::filesystem;

namespace {

constexpr std::uintmax_t largest_input = 16u << 20;
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

std::string read_text_file(const fs::path& path) {
  const SourceMark mark{.file = path.string(), .line = 0, .column = 0, .key = {}};
  if (const std::string there = what_stands_at(path); there != "a file") {
    throw InputError(mark, "a file", there);
  }
  if (fs::file_size(path) > largest_input) {
    throw InputError(mark, "a file of at most 16 MiB",
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

void write_text_file(const fs::path& path, std::string_view text) {
  std::string temporary = path.string() + ".XXXXXX";
  const int descriptor = mkstemp(temporary.data());
  if (descriptor < 0) {
    fail(path);
  }
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(fdopen(descriptor, "wb"), std::fclose);
  const bool written = std::fwrite(text.data(), 1, text.size(), file.get()) == text.size() &&
                       std::fflush(file.get()) == 0 && fsync(descriptor) == 0 &&
                       fchmod(descriptor, 0644) == 0 &&
                       std::rename(temporary.c_str(), path.c_str()) == 0;
  if (!written) {
    const int cause = errno;
    unlink(temporary.c_str());
    errno = cause;
    fail(path);
  }
  if (!sync_folder_of(path)) {
    fail(path);
  }
}

}  // namespace gonio
