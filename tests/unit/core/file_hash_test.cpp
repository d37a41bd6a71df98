#include "emulator/core/file_hash.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/unit/message_of.hpp"
#include "tests/unit/temporary_folder.hpp"

namespace gonio {
namespace {

namespace fs = std::filesystem;
using test::message_of;
using testing::ElementsAre;
using testing::EndsWith;

constexpr const char* yaml =
    "a: {file: one.csv}\nlist: [{file: sub/../two.csv}, {file: one.csv}]\nfile: {file: two.csv}\n";

/// A folder with a YAML file and two files that it names.
class FileHash : public testing::Test {
 private:
  const test::TemporaryFolder folder_;

 protected:
  fs::path main_ = folder_.file("main.yaml", yaml);
  fs::path one_ = folder_.file("one.csv", "1\n");
  fs::path two_ = folder_.file("two.csv", "2\n");
};

TEST_F(FileHash, FindsEachFileThatIsNamedOnce) {
  EXPECT_THAT(files_of(main_), ElementsAre(main_, one_, two_));
}

TEST_F(FileHash, ChangesWithAnyFileThatIsNamed) {
  const std::string before = hash_of_file(main_);
  EXPECT_EQ(before.size(), 64u);
  EXPECT_EQ(hash_of_file(main_), before);
  std::ofstream(two_) << "3\n";
  const std::string other_number = hash_of_file(main_);
  EXPECT_NE(other_number, before);
  std::ofstream(main_) << yaml << "# a comment\n";
  EXPECT_NE(hash_of_file(main_), other_number);
}

TEST_F(FileHash, ChangesWhenTwoFilesTradeTheirContents) {
  const std::string before = hash_of_file(main_);
  std::ofstream(one_) << "2\n";
  std::ofstream(two_) << "1\n";
  EXPECT_NE(hash_of_file(main_), before);
}

TEST_F(FileHash, DoesNotDependOnTheFolder) {
  const test::TemporaryFolder other;
  for (const fs::path& file : files_of(main_)) {
    fs::copy(file, other.path() / file.filename());
  }
  EXPECT_EQ(hash_of_file(other.path() / "main.yaml"), hash_of_file(main_));
}

TEST_F(FileHash, BlamesTheKeyForAFileThatIsNotThere) {
  fs::remove(one_);
  EXPECT_THAT(message_of([&] { (void)hash_of_file(main_); }),
              EndsWith("main.yaml:1:11: a.file: expected a file, found 'one.csv'"));
}

}  // namespace
}  // namespace gonio
