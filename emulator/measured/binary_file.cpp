#include "emulator/measured/binary_file.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <fstream>
#include <system_error>
#include <utility>

#include "emulator/core/input_error.hpp"
#include "emulator/core/text_file.hpp"

namespace gonio {

BinaryFile::BinaryFile(const std::filesystem::path& path, int largest_mib) {
  const std::string name = path.string();
  if (const std::string found = what_stands_at(path); found != "a file") {
    throw InputError({.file = name}, "a file", found);
  }
  const std::uintmax_t size = std::filesystem::file_size(path);
  if (size == 0) {
    throw InputError({.file = name}, "a measured BRDF", "nothing");
  }
  if (size > std::uintmax_t(largest_mib) * 1024 * 1024) {
    throw InputError({.file = name}, fmt::format("at most {} MiB", largest_mib),
                     fmt::format("{} bytes", size));
  }
  size_ = std::size_t(size);
  bytes_ = std::make_unique_for_overwrite<std::byte[]>(size_);
  std::ifstream in(path, std::ios::binary);
  if (!in) {
    throw std::system_error(errno, std::generic_category(), name);
  }
  in.read(reinterpret_cast<char*>(bytes_.get()), std::streamsize(size_));
  if (std::size_t(in.gcount()) != size_) {
    throw InputError({.file = name}, fmt::format("{} bytes", size_),
                     fmt::format("{} bytes", in.gcount()));
  }
}

ByteReader::ByteReader(std::span<const std::byte> bytes, std::string file)
    : bytes_(bytes), file_(std::move(file)) {}

std::span<const std::byte> ByteReader::bytes(std::size_t offset, std::size_t count,
                                             const std::string& what) const {
  if (offset > size() || count > size() - offset) {
    fail(offset, what, fmt::format("{} bytes", count),
         fmt::format("{} bytes up to the end of the file", offset > size() ? 0 : size() - offset));
  }
  return bytes_.subspan(offset, count);
}

void ByteReader::fail(std::size_t offset, const std::string& what, const std::string& expected,
                      const std::string& found) const {
  throw InputError({.file = file_, .key = fmt::format("byte {}: {}", offset, what)}, expected,
                   found);
}

}  // namespace gonio
