#include "emulator/surface/grey_image.hpp"

#include <fmt/format.h>
#include <png.h>

#include <array>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "emulator/core/input_error.hpp"
#include "emulator/core/text_file.hpp"

namespace gonio {

namespace {

constexpr std::uint64_t most_pixels = 4'000'000;
constexpr std::size_t signature_size = 8;

/// What libpng reads from, and what it says when it cannot go on.
struct PngInput {
  std::string_view left;
  std::array<char, 200> error = {};
};

struct PngHeader {
  png_uint_32 width = 0, height = 0;
  int bit_depth = 0, colour_type = 0;
};

void read_bytes(png_structp png, png_bytep to, png_size_t n) {
  auto& input = *static_cast<PngInput*>(png_get_io_ptr(png));
  if (n > input.left.size()) {
    png_error(png, "the file ends within the image");
  }
  std::memcpy(to, input.left.data(), n);
  input.left.remove_prefix(n);
}

[[noreturn]] void keep_error(png_structp png, png_const_charp message) {
  auto& input = *static_cast<PngInput*>(png_get_error_ptr(png));
  std::strncpy(input.error.data(), message, input.error.size() - 1);
  png_longjmp(png, 1);
}

void ignore_warning(png_structp, png_const_charp) {}

// libpng leaves these two by longjmp: nothing that has a destructor may live in them.

bool read_header(png_structp png, png_infop info, PngHeader& header) {
  if (setjmp(png_jmpbuf(png)) != 0) {
    return false;
  }
  png_read_info(png, info);
  png_get_IHDR(png, info, &header.width, &header.height, &header.bit_depth, &header.colour_type,
               nullptr, nullptr, nullptr);
  return true;
}

bool read_rows(png_structp png, png_infop info, png_bytepp rows) {
  if (setjmp(png_jmpbuf(png)) != 0) {
    return false;
  }
  png_set_interlace_handling(png);
  png_read_update_info(png, info);
  png_read_image(png, rows);
  png_read_end(png, nullptr);
  return true;
}

/// A PNG being read.
class PngReader {
 public:
  PngReader(const std::filesystem::path& path, std::string_view bytes)
      : mark_{.file = path.string(), .line = 0, .column = 0, .key = {}}, input_{.left = bytes} {
    const auto* begin = reinterpret_cast<png_const_bytep>(bytes.data());
    if (bytes.size() < signature_size || png_sig_cmp(begin, 0, signature_size) != 0) {
      throw InputError(mark_, "a PNG image", "something else");
    }
    png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, &input_, keep_error, ignore_warning);
    info_ = png_ == nullptr ? nullptr : png_create_info_struct(png_);
    if (info_ == nullptr) {
      png_destroy_read_struct(&png_, &info_, nullptr);
      throw std::bad_alloc();
    }
    png_set_read_fn(png_, &input_, read_bytes);
  }
  ~PngReader() { png_destroy_read_struct(&png_, &info_, nullptr); }
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;

  [[nodiscard]] PngHeader header() {
    PngHeader header;
    if (!read_header(png_, info_, header)) {
      fail();
    }
    if (header.colour_type != PNG_COLOR_TYPE_GRAY) {
      throw InputError(
          mark_,
          "a grey image without transparency: which number a colour stands for is "
          "not known",
          (header.colour_type & PNG_COLOR_MASK_COLOR) != 0 ? "colours" : "transparency");
    }
    if (header.bit_depth < 8) {
      throw InputError(mark_, "an image of 8 or 16 bits", fmt::format("{} bits", header.bit_depth));
    }
    if (std::uint64_t(header.width) * header.height > most_pixels) {
      throw InputError(mark_, fmt::format("an image of at most {} pixels", most_pixels),
                       fmt::format("{} x {}", header.width, header.height));
    }
    return header;
  }

  [[nodiscard]] Eigen::ArrayXXd pixels(const PngHeader& header) {
    const std::size_t bytes_per_pixel = header.bit_depth == 16 ? 2 : 1;
    const std::size_t row_size = header.width * bytes_per_pixel;
    std::vector<png_byte> bytes(row_size * header.height);
    std::vector<png_bytep> rows;
    for (std::size_t row = 0; row < header.height; ++row) {
      rows.push_back(bytes.data() + row * row_size);
    }
    if (!read_rows(png_, info_, rows.data())) {
      fail();
    }
    Eigen::ArrayXXd grey(header.height, header.width);
    for (Eigen::Index row = 0; row < grey.rows(); ++row) {
      for (Eigen::Index column = 0; column < grey.cols(); ++column) {
        const png_byte* pixel = rows[std::size_t(row)] + std::size_t(column) * bytes_per_pixel;
        grey(row, column) =
            bytes_per_pixel == 1 ? pixel[0] / 255.0 : (256.0 * pixel[0] + pixel[1]) / 65535.0;
      }
    }
    return grey;
  }

 private:
  [[noreturn]] void fail() const {
    throw InputError(mark_, "a PNG image that is whole", input_.error.data());
  }

  SourceMark mark_;
  PngInput input_;
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
};

}  // namespace

Eigen::ArrayXXd load_grey_image(const std::filesystem::path& path) {
  const std::string bytes = read_text_file(path);
  PngReader reader(path, bytes);
  const PngHeader header = reader.header();
  return reader.pixels(header);
}

}  // namespace gonio
