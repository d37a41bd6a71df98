#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace gonio {

/// A pair of a master, which a server reads and writes, and a terminal device that any program may
/// open as a serial line. The device stays while this lives, whoever opens and closes it.
///
/// The kernel keeps what nobody reads, and would hand it to the next program as the answer to its
/// first request. So what is left behind is dropped when somebody opens or closes the device.
class PseudoTerminal {
 public:
  /// @param link  a symbolic link to make to the device; it goes with this.
  /// @throws std::system_error  if there is none to be had, or the link exists as something else
  ///                            than a symbolic link.
  explicit PseudoTerminal(const std::optional<std::string>& link);
  ~PseudoTerminal();
  PseudoTerminal(const PseudoTerminal&) = delete;
  PseudoTerminal& operator=(const PseudoTerminal&) = delete;

  [[nodiscard]] const std::string& path() const { return path_; }
  /// A descriptor of the master. The caller closes it, as the next one.
  [[nodiscard]] int duplicate_master() const;
  /// One that can be read when users have come or gone; negative if the system has none left.
  [[nodiscard]] int duplicate_watch() const;

  /// To be called when users came or went: drops what is unread.
  void note_users() const;
  /// Whether what was written lately has been read, by and large.
  [[nodiscard]] bool is_read() const;

 private:
  /// Closed with this; none if negative.
  struct Descriptor {
    Descriptor() = default;
    ~Descriptor();
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    [[nodiscard]] int duplicate() const;

    int number = -1;
  };

  Descriptor master_, device_, watch_;
  std::string path_;
  std::optional<std::filesystem::path> link_;
};

}  // namespace gonio
