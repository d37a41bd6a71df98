#pragma once

#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/measured/binary_file.hpp"

namespace gonio {

/// Types of the numbers of a tensor, as the format numbers them.
enum class TensorType : std::uint8_t { u8 = 1, i8, u16, i16, u32, i32, u64, i64, f16, f32, f64 };

/// The container of the RGL's BRDFs: named arrays of numbers.
///
///   "tensor_file\0", u8 1, u8 0, u32 number of fields; per field: u16 length of the name, name,
///   u16 number of dimensions, u8 type, u64 offset in the file, u64 per dimension; C order.
class TensorFile {
 public:
  struct Field {
    std::string name = {};
    std::size_t header = 0;  ///< where the file tells of it
    TensorType type = TensorType::u8;
    std::size_t offset = 0;
    std::vector<std::size_t> shape = {};
    std::size_t count = 1;  ///< product of the shape
  };
  /// What a field is to be: a dimension of nothing may be any.
  using Shape = std::vector<std::optional<std::size_t>>;

  struct Range {
    float least, most;
  };

  /// Reads what the file says of its fields, and sees that all of them stand in it.
  /// @param bytes  must outlive the object.
  /// @throws InputError  with the byte offset, for anything else.
  TensorFile(std::span<const std::byte> bytes, const std::string& file);

  [[nodiscard]] static bool begins(std::span<const std::byte> head);
  [[nodiscard]] bool has(std::string_view name) const;
  /// @throws InputError  if it is missing or is not of that type and shape.
  [[nodiscard]] const Field& field(std::string_view name, TensorType type,
                                   const Shape& shape) const;
  /// The numbers of a field of f32.
  /// @throws InputError  like field(), and for numbers that are outside the range, or none.
  [[nodiscard]] std::vector<float> floats(std::string_view name, const Shape& shape,
                                          Range range) const;
  /// One after the other, from the first.
  template <class Number>
  [[nodiscard]] Number number(const Field& field, std::size_t index) const {
    return in_.number<Number>(field.offset + index * sizeof(Number), field.name);
  }
  [[nodiscard]] std::string text(const Field& field) const;

  /// @throws InputError  always, at number `index` of a field.
  [[noreturn]] void fail(const Field& field, std::size_t index, const std::string& expected,
                         const std::string& found) const;

 private:
  Field read_field(std::size_t& at) const;
  [[nodiscard]] const Field* find(std::string_view name) const;

  ByteReader in_;
  std::vector<Field> fields_;
};

/// A field to be written.
struct TensorOutput {
  std::string name;
  TensorType type;
  std::vector<std::size_t> shape;
  std::string bytes;
};

/// @param values  as many as the shape says.
[[nodiscard]] TensorOutput tensor_output(std::string name, std::vector<std::size_t> shape,
                                         std::span<const float> values);
/// Writes a tensor file; each field begins at a multiple of 8 bytes, as in the RGL's own files.
void write_tensors(std::ostream& out, std::span<const TensorOutput> fields);

}  // namespace gonio
