#include "emulator/core/text_file.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <iterator>
#include <string>
#include <system_error>

#include "emulator/core/input_error.hpp"
#include "tests/unit/message_of.hpp"
#include "tests/unit/temporary_folder.hpp"

namespace gonio {
namespace {

namespace fs = std::filesystem;
using test::message_of;
using test::TemporaryFolder;
using testing::HasSubstr;

std::size_t files_in(const fs::path& folder) {
  return std::size_t(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

TEST(ReadTextFile, GivesBackWhatWasWritten) {
  const TemporaryFolder folder;
  const std::string text("line\r\n\tlambda \xCE\xBB\0 end", 20);
  write_text_file(folder.path() / "a.txt", text);
  EXPECT_EQ(read_text_file(folder.path() / "a.txt"), text);
}

TEST(ReadTextFile, LeavesOutAByteOrderMark) {
  const TemporaryFolder folder;
  EXPECT_EQ(read_text_file(folder.file("a.csv",
                                       "\xEF\xBB\xBF"
                                       "380,1\n")),
            "380,1\n");
}

TEST(ReadTextFile, RefusesAMissingFile) {
  EXPECT_EQ(message_of([] { (void)read_text_file("no/such.yaml"); }),
            "no/such.yaml: expected a file, found nothing");
}

TEST(ReadTextFile, RefusesWhatIsNotARegularFile) {
  const TemporaryFolder folder;
  EXPECT_EQ(message_of([&] { (void)read_text_file(folder.path()); }),
            folder.path().string() + ": expected a file, found 'a folder'");
  EXPECT_EQ(message_of([] { (void)read_text_file("/dev/zero"); }),
            "/dev/zero: expected a file, found 'something else'");
  EXPECT_THROW((void)read_text_file(folder.path() / std::string(5000, 'x')), InputError);
}

TEST(ReadTextFile, RefusesAnEmptyFile) {
  const TemporaryFolder folder;
  for (const char* text : {"", "\n", " \t\r\n\n"}) {
    const fs::path path = folder.file("empty", text);
    EXPECT_EQ(message_of([&] { (void)read_text_file(path); }),
              path.string() + ": expected a file with content, found 'an empty file'");
  }
}

TEST(ReadTextFile, RefusesAFileOfMoreThan16MiB) {
  const TemporaryFolder folder;
  const fs::path path = folder.file("large", "x");
  fs::resize_file(path, 16u << 20);
  EXPECT_EQ(read_text_file(path).size(), 16u << 20);
  fs::resize_file(path, (16u << 20) + 1);
  EXPECT_EQ(message_of([&] { (void)read_text_file(path); }),
            path.string() + ": expected a file of at most 16 MiB, found '16777217 bytes'");
  EXPECT_EQ(read_text_file(path, 17).size(), (16u << 20) + 1);
}

TEST(WriteTextFile, ReplacesAnOlderFileAndLeavesNothingElseBehind) {
  const TemporaryFolder folder;
  const fs::path path = folder.file("a.txt", "old and longer than the new one");
  write_text_file(path, "new");
  EXPECT_EQ(read_text_file(path), "new");
  EXPECT_EQ(files_in(folder.path()), 1U);
}

TEST(WriteTextFile, LetsAReaderOfTheOlderFileReadOn) {
  const TemporaryFolder folder;
  const fs::path path = folder.file("a.txt", "old");
  std::ifstream reader(path);  // the older file stays whole: it is not written over
  write_text_file(path, "new");
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(reader), {}), "old");
}

TEST(WriteTextFile, WritesIntoAPipeAndLeavesItThere) {
  const TemporaryFolder folder;
  const std::filesystem::path pipe = folder.path() / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const int reader = open(pipe.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  ASSERT_GE(reader, 0);
  write_text_file(pipe, "text");
  std::string text(10, ' ');
  const auto n = read(reader, text.data(), text.size());
  close(reader);
  ASSERT_EQ(n, 4);
  EXPECT_EQ(text.substr(0, 4), "text");
  EXPECT_TRUE(std::filesystem::is_fifo(pipe));
}

TEST(WriteTextFile, FailsInAMissingFolderAndNamesThePath) {
  const TemporaryFolder folder;
  const fs::path path = folder.path() / "missing" / "a.txt";
  EXPECT_THROW(write_text_file(path, "new"), std::system_error);
  EXPECT_THAT(message_of([&] { write_text_file(path, "new"); }),
              HasSubstr("cannot write " + path.string() + ": No such file or directory"));
  EXPECT_FALSE(fs::exists(folder.path() / "missing"));
}

TEST(WriteTextFile, LeavesNothingBehindWhenTheLastStepFails) {
  const TemporaryFolder folder;
  const fs::path path = folder.path() / "taken";
  fs::create_directory(path);  // no file can be renamed to the name of a folder
  EXPECT_THROW(write_text_file(path, "new"), std::system_error);
  EXPECT_TRUE(fs::is_directory(path));
  EXPECT_EQ(files_in(folder.path()), 1U);
}

}  // namespace
}  // namespace gonio
