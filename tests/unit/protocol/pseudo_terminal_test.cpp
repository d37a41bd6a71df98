#include "emulator/protocol/pseudo_terminal.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <string>
#include <system_error>

#include "tests/unit/message_of.hpp"
#include "tests/unit/temporary_folder.hpp"

namespace gonio::test {
namespace {

namespace fs = std::filesystem;

/// A descriptor that is closed in the end.
class File {
 public:
  explicit File(int file) : file_(file) { EXPECT_GE(file, 0); }
  explicit File(const std::string& path) : File(open(path.c_str(), O_RDWR | O_NOCTTY)) {}
  ~File() { close(file_); }
  File(const File&) = delete;
  File& operator=(const File&) = delete;

  void send(const std::string& text) const {
    EXPECT_EQ(write(file_, text.data(), text.size()), ssize_t(text.size()));
  }
  /// @return  what can be read now, or is there before long.
  [[nodiscard]] std::string receive(int within_ms = 1000) const {
    std::array<char, 256> buffer{};
    pollfd entry{file_, POLLIN, 0};
    const bool is_there = poll(&entry, 1, within_ms) > 0;
    const ssize_t size = is_there ? read(file_, buffer.data(), buffer.size()) : 0;
    return {buffer.data(), std::size_t(std::max<ssize_t>(size, 0))};
  }

 private:
  int file_;
};

TEST(PseudoTerminal, CarriesBytesAsTheyAreBothWays) {
  const PseudoTerminal terminal(std::nullopt);
  const File master(terminal.duplicate_master()), device(terminal.path());
  const std::string bytes("\x00\x03\x04\r\n\x11\x13\xFF", 8);
  device.send(bytes);
  EXPECT_EQ(master.receive(), bytes);
  EXPECT_EQ(device.receive(0), "") << "an echo";
  master.send(bytes);
  EXPECT_EQ(device.receive(), bytes);
}

TEST(PseudoTerminal, StaysWhenItsUserLeaves) {
  const PseudoTerminal terminal(std::nullopt);
  const File master(terminal.duplicate_master());
  for (const char* text : {"first", "second"}) {
    const File device(terminal.path());
    device.send(text);
    EXPECT_EQ(master.receive(), text);
  }
}

TEST(PseudoTerminal, TellsWhenUsersComeAndGoAndDropsWhatTheyDidNotRead) {
  const PseudoTerminal terminal(std::nullopt);
  const File master(terminal.duplicate_master());
  const int watch = terminal.duplicate_watch();
  const File watch_file(watch);
  pollfd entry{watch, POLLIN, 0};
  EXPECT_EQ(poll(&entry, 1, 0), 0);
  {
    const File device(terminal.path());
    EXPECT_EQ(poll(&entry, 1, 0), 1);
    terminal.note_users();
    EXPECT_EQ(poll(&entry, 1, 0), 0);
    master.send("answer");
  }
  EXPECT_EQ(poll(&entry, 1, 0), 1);
  terminal.note_users();
  const File device(terminal.path());
  EXPECT_EQ(device.receive(50), "");
}

TEST(PseudoTerminal, IsNotReadWhenManyRepliesWait) {
  const PseudoTerminal terminal(std::nullopt);
  const File master(terminal.duplicate_master()), device(terminal.path());
  EXPECT_TRUE(terminal.is_read());
  master.send(std::string(2000, 'x'));
  pollfd entry{-1, 0, 0};
  for (int i = 0; i < 1000 && terminal.is_read(); ++i) {
    poll(&entry, 1, 1);  // the kernel hands it over in its own time
  }
  EXPECT_FALSE(terminal.is_read());
}

TEST(PseudoTerminal, MakesALinkThatGoesWithIt) {
  const TemporaryFolder folder;
  const fs::path link = folder.path() / "glossmeter";
  {
    const PseudoTerminal terminal(link);
    EXPECT_EQ(fs::read_symlink(link), terminal.path());
  }
  EXPECT_FALSE(fs::is_symlink(fs::symlink_status(link)));
}

TEST(PseudoTerminal, ReplacesALinkThatWasLeftBehind) {
  const TemporaryFolder folder;
  const fs::path link = folder.path() / "glossmeter";
  fs::create_symlink("/dev/pts/gone", link);
  const PseudoTerminal terminal(link);
  EXPECT_EQ(fs::read_symlink(link), terminal.path());
}

TEST(PseudoTerminal, LeavesALinkThatIsAnothersByNow) {
  const TemporaryFolder folder;
  const fs::path link = folder.path() / "glossmeter";
  {
    const PseudoTerminal terminal(link);
    fs::remove(link);
    fs::create_symlink("/dev/pts/another", link);
  }
  EXPECT_EQ(fs::read_symlink(link), "/dev/pts/another");
}

TEST(PseudoTerminal, LeavesAFileInThePlaceOfItsLink) {
  const TemporaryFolder folder;
  const fs::path file = folder.file("glossmeter", "precious");
  EXPECT_NE(message_of([&] { PseudoTerminal{file}; }).find("cannot make the link " + file.string()),
            std::string::npos);
  EXPECT_TRUE(fs::is_regular_file(file));
}

TEST(PseudoTerminal, FailsWithoutAFolderForItsLink) {
  const TemporaryFolder folder;
  EXPECT_THROW(PseudoTerminal{folder.path() / "nowhere" / "link"}, std::system_error);
}

/// Or a server that tries again and again would have none left in the end.
TEST(PseudoTerminal, KeepsNoDescriptorsWhenItFails) {
  const TemporaryFolder folder;
  const auto count = [] {
    const fs::directory_iterator files("/proc/self/fd");
    return std::distance(begin(files), end(files));
  };
  const auto before = count();
  EXPECT_THROW(PseudoTerminal{folder.path() / "nowhere" / "link"}, std::system_error);
  EXPECT_EQ(count(), before);
}

}  // namespace
}  // namespace gonio::test
