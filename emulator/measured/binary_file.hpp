#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <type_traits>

namespace gonio {

static_assert(std::endian::native == std::endian::little, "binary files are little endian");

/// The bytes of a whole file.
class BinaryFile {
 public:
  /// @throws InputError  if it is missing, not a regular file, empty, or larger than that.
  explicit BinaryFile(const std::filesystem::path& path, int largest_mib = 4096);

  [[nodiscard]] std::span<const std::byte> bytes() const { return {bytes_.get(), size_}; }

 private:
  std::size_t size_ = 0;
  std::unique_ptr<std::byte[]> bytes_;
};

/// Numbers of a binary input, none of which is read from beyond its end.
class ByteReader {
 public:
  /// @param file  its name, for messages.
  ByteReader(std::span<const std::byte> bytes, std::string file);

  [[nodiscard]] std::size_t size() const { return bytes_.size(); }

  /// @param what  names what stands there, for the message.
  /// @throws InputError  if it does not stand in the file as a whole.
  [[nodiscard]] std::span<const std::byte> bytes(std::size_t offset, std::size_t count,
                                                 const std::string& what) const;
  template <class Number>
  requires std::is_arithmetic_v<Number>
  [[nodiscard]] Number number(std::size_t offset, const std::string& what) const {
    Number value{};
    std::memcpy(&value, bytes(offset, sizeof value, what).data(), sizeof value);
    return value;
  }

  /// @throws InputError  always: `file: byte <offset>: <what>: expected ..., found '...'`.
  [[noreturn]] void fail(std::size_t offset, const std::string& what, const std::string& expected,
                         const std::string& found) const;

 private:
  std::span<const std::byte> bytes_;
  std::string file_;
};

}  // namespace gonio
