// Tensor files as a reader of the RGL's BRDFs gets them: right, cut off, changed, and lying.

#include <gmock/gmock.h>

#include <fstream>
#include <limits>
#include <sstream>

#include "emulator/core/input_error.hpp"
#include "emulator/measured/rgl_brdf.hpp"
#include "emulator/measured/tensor_file.hpp"
#include "tests/unit/measured/brdf_at.hpp"
#include "tests/unit/measured/largest_allocation.hpp"
#include "tests/unit/message_of.hpp"

namespace gonio::test {
namespace {

using testing::AnyOf;
using testing::HasSubstr;
using testing::StartsWith;

const std::filesystem::path seeds = std::filesystem::path(GONIO_SOURCE_DIR) / "tests/fuzz/corpus";

std::string bytes_of(const std::filesystem::path& path) {
  std::ostringstream bytes;
  bytes << std::ifstream(path, std::ios::binary).rdbuf();
  return bytes.str();
}

BrdfFile parsed(const std::string& bytes) {
  return parse_rgl(std::as_bytes(std::span(bytes.data(), bytes.size())), "m.bsdf");
}
std::string refusal(const std::string& bytes) {
  return message_of([&] { (void)parsed(bytes); });
}

/// A file of a surface whose f_r cos theta_r is 0.5 everywhere, in parts to be spoilt.
class RglFile : public testing::Test {
 protected:
  RglFile() {
    const auto constant = [](std::size_t n, float value) { return std::vector<float>(n, value); };
    const std::vector<float> angles{0.0F, 1.0F};
    const std::vector<float> azimuth{0.0F};
    const std::string version("\1\0\0\0\0\0\0\0", 8);
    fields = {{"version", TensorType::u32, {2}, version},
              {"description", TensorType::u8, {4}, "grey"},
              tensor_output("phi_i", {1}, azimuth),
              tensor_output("theta_i", {2}, angles),
              tensor_output("sigma", {2, 2}, constant(4, 0.25F)),
              tensor_output("ndf", {2, 2}, constant(4, 1.0F)),
              tensor_output("vndf", {1, 2, 2, 2}, constant(8, 1.0F)),
              tensor_output("rgb", {1, 2, 3, 2, 2}, constant(24, 0.5F)),
              {"jacobian", TensorType::u8, {1}, "\1"}};
  }

  TensorOutput& field(const std::string& name) {
    return *std::ranges::find(fields, name, &TensorOutput::name);
  }
  void put(const std::string& name, std::size_t index, float value) {
    std::memcpy(field(name).bytes.data() + index * sizeof value, &value, sizeof value);
  }
  [[nodiscard]] std::string bytes() const {
    std::ostringstream out;
    write_tensors(out, fields);
    return out.str();
  }

  std::vector<TensorOutput> fields;
};

TEST_F(RglFile, IsReadAsItWasWritten) {
  const BrdfFile file = parsed(bytes());
  EXPECT_EQ(file.format, BrdfFormat::rgl);
  EXPECT_EQ(file.description, "grey");
  EXPECT_TRUE(file.warnings.empty());
  EXPECT_NEAR(f_r_at(*file.brdf, direction(30, 180), direction(60, 20))(1), 0.5 / 0.5, 1e-6);
  EXPECT_NEAR(file.brdf->largest_theta().radians(), 1.0, 1e-6);
}

TEST_F(RglFile, IsFoundByItsContent) {
  const std::string whole = bytes();
  const auto span = std::as_bytes(std::span(whole.data(), whole.size()));
  EXPECT_TRUE(is_rgl(span));
  EXPECT_TRUE(is_rgl(span.first(12)));
  EXPECT_FALSE(is_rgl(span.first(11)));
  EXPECT_FALSE(is_rgl(span.subspan(1)));
}

/// Colours out of gamut are negative; the database's own reader takes them as 0, too.
TEST_F(RglFile, CountsNegativeNumbersAsNothing) {
  for (std::size_t i = 0; i < 4; ++i) {
    put("rgb", i, -0.1F);
  }
  const BrdfFile file = parsed(bytes());
  const Eigen::ArrayXd f_r = f_r_at(*file.brdf, direction(0, 0), direction(60, 0));
  EXPECT_EQ(f_r(0), 0.0);
  EXPECT_NEAR(f_r(1), 1.0, 1e-6);
}

TEST_F(RglFile, NamesWhatIsMissingOrThereTwice) {
  for (const std::string name :
       {"version", "description", "phi_i", "theta_i", "sigma", "ndf", "vndf", "rgb", "jacobian"}) {
    const auto all = fields;
    field(name).name = "other";
    EXPECT_THAT(refusal(bytes()), HasSubstr("expected one named " + name + ", found nothing"));
    fields = all;
    fields.push_back(field(name));
    EXPECT_THAT(refusal(bytes()),
                HasSubstr("name of a field: expected each name once, found '" + name));
    fields = all;
  }
}

TEST_F(RglFile, IsRefusedForAnotherTypeOrShape) {
  const auto all = fields;
  field("theta_i").type = TensorType::i32;
  EXPECT_THAT(refusal(bytes()), HasSubstr("theta_i: expected f32 any, found 'i32 2'"));
  fields = all;
  field("vndf").shape = {2, 1, 2, 2};
  EXPECT_THAT(refusal(bytes()),
              HasSubstr("vndf: expected f32 1 x 2 x any x any, found 'f32 2 x 1 x 2 x 2'"));
  fields = all;
  field("rgb").shape = {1, 2, 3, 4};
  EXPECT_THAT(refusal(bytes()), HasSubstr("rgb: expected f32 1 x 2 x 3 x any x any"));
  fields = all;
  field("ndf").shape = {1, 4};
  EXPECT_THAT(refusal(bytes()),
              HasSubstr("ndf[0]: expected a grid of at least 2 x 2, found '1 x 4'"));
}

TEST_F(RglFile, IsRefusedForAnotherVersionOrKind) {
  const auto all = fields;
  field("version").bytes[0] = 2;
  EXPECT_THAT(refusal(bytes()), HasSubstr("version[0]: expected 1, found '2'"));
  fields = all;
  field("jacobian").bytes[0] = 0;
  EXPECT_THAT(refusal(bytes()), HasSubstr("jacobian[0]: expected 1, found '0'"));
  fields = all;
  std::string other = bytes();
  other[12] = 2;
  EXPECT_EQ(refusal(other), "m.bsdf: byte 12: version of the container: expected 1.0, found '2.0'");
}

TEST_F(RglFile, IsRefusedForNumbersThatCannotBe) {
  const auto all = fields;
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  constexpr float inf = std::numeric_limits<float>::infinity();
  const auto refused = [&](const std::string& name, float value, const std::string& message) {
    fields = all;
    put(name, 1 % (field(name).bytes.size() / 4), value);
    EXPECT_THAT(refusal(bytes()), HasSubstr(message)) << name << " " << value;
  };
  for (const char* name : {"phi_i", "theta_i", "sigma", "ndf", "vndf", "rgb"}) {
    refused(name, nan, "found 'nan'");
    refused(name, inf, "found 'inf'");
    refused(name, -inf, "found '-inf'");
  }
  refused("sigma", 0.0F, "sigma[1]: expected 1e-06 to");
  refused("ndf", -1.0F, "ndf[1]: expected 0 to");
  refused("vndf", -1.0F, "vndf[1]: expected 0 to");
  refused("theta_i", 0.0F, "theta_i[1]: expected more than 0, found '0'");
  refused("theta_i", 1.6F, "theta_i[1]: expected 0 to 1.57");
  fields = all;
  for (std::size_t i = 4; i < 8; ++i) {
    put("vndf", i, 0.0F);
  }
  EXPECT_THAT(refusal(bytes()), HasSubstr("vndf[4]: expected a density that is not 0 everywhere"));
}

TEST_F(RglFile, TellsTheByteOfANumber) {
  put("rgb", 7, std::numeric_limits<float>::quiet_NaN());
  const std::string whole = bytes();
  const std::size_t jacobian = whole.size() - 1;  // the last field, and rgb of 96 bytes before it
  EXPECT_THAT(refusal(whole), StartsWith("m.bsdf: byte " + std::to_string(jacobian - 96 + 28) +
                                         ": rgb[7]: expected "));
}

TEST_F(RglFile, IsRefusedAtEveryShorterLength) {
  const std::string whole = bytes();
  for (std::size_t length = 0; length < whole.size(); ++length) {
    EXPECT_THAT(refusal(whole.substr(0, length)), HasSubstr("m.bsdf: byte ")) << length;
  }
}

TEST(RglFiles, OfTheFuzzersCorpusAreRead) {
  int n = 0;
  for (const auto& entry : std::filesystem::directory_iterator(seeds / "rgl")) {
    EXPECT_NO_THROW((void)read_rgl(entry.path())) << entry.path();
    ++n;
  }
  EXPECT_GE(n, 3);
}

TEST(RglFiles, OfHalfATurnAreMirroredAtTheirPlane) {
  const BrdfFile file = read_rgl(seeds / "rgl/half_turn");
  const Vector3 omega_i = direction(30, 70);
  const Vector3 omega_r = direction(50, 20);
  const auto mirror = [](const Vector3& v) { return Vector3(v.x(), -v.y(), v.z()); };
  EXPECT_EQ(f_r_at(*file.brdf, omega_i, omega_r)(0),
            f_r_at(*file.brdf, mirror(omega_i), mirror(omega_r))(0));
}

TEST(RglFiles, OfAnisotropicSpectraInterpolateInTheAzimuthOfTheLight) {
  const BrdfFile file = read_rgl(seeds / "rgl/anisotropic_spectral");
  ASSERT_EQ(file.brdf->channels().size(), 2U);
  EXPECT_EQ(channel_name(file.brdf->channels()[1]), "550nm");
  const auto at = [&](double phi_deg) {
    return f_r_at(*file.brdf, direction(40, phi_deg), direction(30, 20))(1);
  };
  EXPECT_NE(at(10), at(100));
}

TEST(RglFiles, WithAnyByteChangedAreReadOrRefusedWithoutALargeAllocation) {
  // The largest array is as large as the file; strings of messages are small.
  constexpr std::size_t allowance = 4096;
  for (const char* name : {"rgl/isotropic_rgb", "rgl/anisotropic_spectral"}) {
    const std::string whole = bytes_of(seeds / name);
    ASSERT_GT(whole.size(), 500U);
    for (std::size_t at = 0; at < whole.size(); ++at) {
      for (const unsigned flip : {0x01U, 0x80U, 0xFFU}) {
        std::string changed = whole;
        changed[at] = char(static_cast<unsigned char>(changed[at]) ^ flip);
        const LargestAllocation largest;
        const std::string message = refusal(changed);
        ASSERT_LE(largest.bytes(), whole.size() + allowance) << at;
        ASSERT_THAT(message, AnyOf("no error", StartsWith("m.bsdf: byte "))) << at;
      }
    }
  }
}

TEST_F(RglFile, ThatClaimsTooMuchIsRefusedWithoutALargeAllocation) {
  constexpr std::size_t allowance = 4096;
  const auto all = fields;
  const std::size_t huge = std::size_t{1} << 63U;
  for (const std::vector<std::size_t>& lie :
       {std::vector<std::size_t>{huge, 2, 3, 2, 2},
        {1, huge, 3, 2, 2},
        {1, 2, 3, huge, 2},
        {1, 2, 3, std::size_t{1} << 32U, std::size_t{1} << 32U},
        {1, 2, 3, 2, SIZE_MAX},
        {1, 2, 3, 1000, 1000},
        {1, 2, 0, 2, 2}}) {
    fields = all;
    field("rgb").shape = lie;
    const std::string whole = bytes();
    const LargestAllocation largest;
    EXPECT_THAT(refusal(whole), HasSubstr("rgb: shape: expected 1 to "));
    EXPECT_LE(largest.bytes(), whole.size() + allowance);
  }
  fields = all;
  std::string whole = bytes();
  std::memset(whole.data() + 14, 0xFF, 4);
  const LargestAllocation largest;
  EXPECT_THAT(refusal(whole), HasSubstr("byte 14: number of fields: expected at most "));
  EXPECT_LE(largest.bytes(), whole.size() + allowance);
}

}  // namespace
}  // namespace gonio::test
