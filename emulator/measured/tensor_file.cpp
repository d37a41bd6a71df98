#include "emulator/measured/tensor_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <ostream>
#include <utility>

namespace gonio {

namespace {

constexpr std::string_view magic("tensor_file\0", 12);
constexpr std::size_t head_size = 18;
constexpr std::size_t shortest_field = 2 + 2 + 1 + 8;
constexpr std::size_t most_dimensions = 8;

struct TypeForm {
  std::string_view name;
  std::size_t width;
};
constexpr std::array<TypeForm, 12> forms{{{"none", 0},
                                          {"u8", 1},
                                          {"i8", 1},
                                          {"u16", 2},
                                          {"i16", 2},
                                          {"u32", 4},
                                          {"i32", 4},
                                          {"u64", 8},
                                          {"i64", 8},
                                          {"f16", 2},
                                          {"f32", 4},
                                          {"f64", 8}}};

const TypeForm& form(TensorType type) { return forms.at(std::size_t(type)); }

std::string shape_text(const TensorFile::Shape& shape) {
  std::string text;
  for (const auto& size : shape) {
    text += (text.empty() ? "" : " x ") + (size ? fmt::format("{}", *size) : std::string("any"));
  }
  return text;
}

bool fits(const std::vector<std::size_t>& found, const TensorFile::Shape& expected) {
  return std::ranges::equal(found, expected, [](std::size_t size, const auto& wanted) {
    return !wanted || size == *wanted;
  });
}

}  // namespace

bool TensorFile::begins(std::span<const std::byte> head) {
  return head.size() >= magic.size() && std::memcmp(head.data(), magic.data(), magic.size()) == 0;
}

TensorFile::TensorFile(std::span<const std::byte> bytes, const std::string& file)
    : in_(bytes, file) {
  if (!begins(bytes)) {
    in_.fail(0, "identification", "tensor_file", "something else");
  }
  const int major = in_.number<std::uint8_t>(12, "version of the container");
  const int minor = in_.number<std::uint8_t>(13, "version of the container");
  if (major != 1 || minor != 0) {
    in_.fail(12, "version of the container", "1.0", fmt::format("{}.{}", major, minor));
  }
  const std::size_t n = in_.number<std::uint32_t>(14, "number of fields");
  const std::size_t most = (bytes.size() - head_size) / shortest_field;
  if (n > most) {
    in_.fail(14, "number of fields", fmt::format("at most {} in a file of this size", most),
             fmt::format("{}", n));
  }
  std::size_t at = head_size;
  for (std::size_t i = 0; i < n; ++i) {
    Field field = read_field(at);
    if (has(field.name)) {
      in_.fail(field.header, "name of a field", "each name once", field.name);
    }
    fields_.push_back(std::move(field));
  }
}

TensorFile::Field TensorFile::read_field(std::size_t& at) const {
  Field field{.header = at};
  const std::size_t length = in_.number<std::uint16_t>(at, "length of the name of a field");
  const auto name = in_.bytes(at + 2, length, "name of a field");
  field.name.assign(reinterpret_cast<const char*>(name.data()), length);
  at += 2 + length;
  const std::size_t dimensions = in_.number<std::uint16_t>(at, field.name + ": dimensions");
  if (dimensions == 0 || dimensions > most_dimensions) {
    in_.fail(at, field.name + ": dimensions", fmt::format("1 to {}", most_dimensions),
             fmt::format("{}", dimensions));
  }
  const auto type = in_.number<std::uint8_t>(at + 2, field.name + ": type");
  if (type == 0 || type >= forms.size()) {
    in_.fail(at + 2, field.name + ": type", fmt::format("1 to {}", forms.size() - 1),
             fmt::format("{}", type));
  }
  field.type = TensorType(type);
  field.offset = in_.number<std::uint64_t>(at + 3, field.name + ": offset");
  if (field.offset < head_size || field.offset > in_.size()) {
    in_.fail(at + 3, field.name + ": offset", fmt::format("{} to {}", head_size, in_.size()),
             fmt::format("{}", field.offset));
  }
  at += 11;
  // Divided, not multiplied: the product of what a file says may be anything.
  std::size_t room = (in_.size() - field.offset) / form(field.type).width;
  for (std::size_t i = 0; i < dimensions; ++i, at += 8) {
    const std::uint64_t size = in_.number<std::uint64_t>(at, field.name + ": shape");
    if (size == 0 || size > room) {
      in_.fail(at, field.name + ": shape",
               fmt::format("1 to {} {} up to the end of the file", room, form(field.type).name),
               fmt::format("{}", size));
    }
    room /= size;
    field.shape.push_back(size);
    field.count *= size;
  }
  return field;
}

const TensorFile::Field* TensorFile::find(std::string_view name) const {
  const auto found = std::ranges::find(fields_, name, &Field::name);
  return found == fields_.end() ? nullptr : &*found;
}

bool TensorFile::has(std::string_view name) const { return find(name) != nullptr; }

const TensorFile::Field& TensorFile::field(std::string_view name, TensorType type,
                                           const Shape& shape) const {
  const Field* const found = find(name);
  if (found == nullptr) {
    in_.fail(head_size, "fields", fmt::format("one named {}", name), "nothing");
  }
  if (found->type != type || !fits(found->shape, shape)) {
    in_.fail(found->header, found->name, fmt::format("{} {}", form(type).name, shape_text(shape)),
             fmt::format("{} {}", form(found->type).name,
                         shape_text({found->shape.begin(), found->shape.end()})));
  }
  return *found;
}

std::vector<float> TensorFile::floats(std::string_view name, const Shape& shape,
                                      Range range) const {
  const Field& found = field(name, TensorType::f32, shape);
  std::vector<float> values(found.count);
  const auto bytes = in_.bytes(found.offset, found.count * sizeof(float), found.name);
  std::memcpy(values.data(), bytes.data(), bytes.size());
  const auto wrong = std::ranges::find_if(
      values, [&](float value) { return !(value >= range.least && value <= range.most); });
  if (wrong != values.end()) {
    fail(found, std::size_t(wrong - values.begin()),
         fmt::format("{} to {}", range.least, range.most), fmt::format("{}", *wrong));
  }
  return values;
}

std::string TensorFile::text(const Field& field) const {
  const auto bytes = in_.bytes(field.offset, field.count, field.name);
  std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  text.erase(text.find_last_not_of('\0') + 1);
  return text;
}

void TensorFile::fail(const Field& field, std::size_t index, const std::string& expected,
                      const std::string& found) const {
  in_.fail(field.offset + index * form(field.type).width, fmt::format("{}[{}]", field.name, index),
           expected, found);
}

TensorOutput tensor_output(std::string name, std::vector<std::size_t> shape,
                           std::span<const float> values) {
  return {std::move(name),
          TensorType::f32,
          std::move(shape),
          {reinterpret_cast<const char*>(values.data()), values.size_bytes()}};
}

void write_tensors(std::ostream& out, std::span<const TensorOutput> fields) {
  const auto put = [&out](auto number) {
    out.write(reinterpret_cast<const char*>(&number), sizeof number);
  };
  const auto rounded_up = [](std::size_t at) { return (at + 7) / 8 * 8; };
  std::size_t end = head_size;
  for (const TensorOutput& field : fields) {
    end += shortest_field + field.name.size() + 8 * field.shape.size();
  }
  out.write(magic.data(), std::streamsize(magic.size()));
  put(std::uint8_t{1});
  put(std::uint8_t{0});
  put(std::uint32_t(fields.size()));
  std::size_t offset = rounded_up(end);
  for (const TensorOutput& field : fields) {
    put(std::uint16_t(field.name.size()));
    out << field.name;
    put(std::uint16_t(field.shape.size()));
    put(std::uint8_t(field.type));
    put(std::uint64_t(offset));
    for (const std::size_t size : field.shape) {
      put(std::uint64_t(size));
    }
    offset = rounded_up(offset + field.bytes.size());
  }
  for (const TensorOutput& field : fields) {
    out << std::string(rounded_up(end) - end, '\0') << field.bytes;
    end = rounded_up(end) + field.bytes.size();
  }
}

}  // namespace gonio
