#include "emulator/measured/binary_file.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "tests/unit/message_of.hpp"
#include "tests/unit/temporary_folder.hpp"

namespace gonio::test {
namespace {

TEST(BinaryFile, HoldsTheBytesOfAFile) {
  const TemporaryFolder folder;
  const BinaryFile file(folder.file("b", std::string_view("\0\1\xff", 3)));
  ASSERT_EQ(file.bytes().size(), 3U);
  EXPECT_EQ(file.bytes()[2], std::byte{0xff});
}

TEST(BinaryFile, IsRefusedIfItIsNone) {
  const TemporaryFolder folder;
  const auto refusal = [](const std::filesystem::path& path, int largest_mib = 1) {
    return message_of([&] { (void)BinaryFile(path, largest_mib); });
  };
  const std::string name = folder.path().string();
  EXPECT_EQ(refusal(folder.path()), name + ": expected a file, found 'a folder'");
  EXPECT_EQ(refusal(folder.path() / "x"), name + "/x: expected a file, found nothing");
  EXPECT_EQ(refusal(folder.file("empty", "")),
            name + "/empty: expected a measured BRDF, found nothing");
  EXPECT_EQ(refusal(folder.file("large", std::string(1024 * 1024 + 1, ' '))),
            name + "/large: expected at most 1 MiB, found '1048577 bytes'");
  EXPECT_EQ(refusal("/dev/null"), "/dev/null: expected a file, found 'something else'");
}

TEST(ByteReader, ReadsNumbersFromAnyByte) {
  const std::string bytes("\1\2\3\4\0\0\xc0\x3f", 8);
  const ByteReader in(std::as_bytes(std::span(bytes.data(), bytes.size())), "f");
  EXPECT_EQ(in.number<std::uint16_t>(1, "n"), 0x0302);
  EXPECT_EQ(in.number<float>(4, "n"), 1.5F);
}

TEST(ByteReader, ReadsNothingFromBeyondTheEnd) {
  const std::string bytes(8, '\0');
  const ByteReader in(std::as_bytes(std::span(bytes.data(), bytes.size())), "f");
  constexpr std::size_t huge = std::numeric_limits<std::size_t>::max();
  EXPECT_EQ(message_of([&] { (void)in.number<std::uint32_t>(6, "count"); }),
            "f: byte 6: count: expected 4 bytes, found '2 bytes up to the end of the file'");
  EXPECT_NE(message_of([&] { (void)in.bytes(huge, 1, "n"); }), "no error");
  EXPECT_NE(message_of([&] { (void)in.bytes(4, huge, "n"); }), "no error");
  EXPECT_NE(message_of([&] { (void)in.bytes(4, huge - 3, "n"); }), "no error");
  EXPECT_EQ(message_of([&] { (void)in.bytes(8, 0, "n"); }), "no error");
}

}  // namespace
}  // namespace gonio::test
