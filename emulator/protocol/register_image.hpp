#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "emulator/protocol/register_map.hpp"

namespace gonio {

/// The registers and bits of a map, as they are read: stretches without a hole, and where in them
/// each point lies. A bit takes a word, 0 or 1.
class RegisterImage {
 public:
  /// A point and where it is kept.
  struct Slot {
    const Point* point;
    std::size_t offset;  ///< in words()
  };

  /// @param map              outlives this.
  /// @param has_simulation   with the blocks of the simulation.
  RegisterImage(const RegisterMap& map, bool has_simulation);

  /// The slots in the order of table and address.
  [[nodiscard]] const std::vector<Slot>& slots() const { return slots_; }
  [[nodiscard]] std::span<std::uint16_t> words(const Slot& slot) {
    return std::span(words_).subspan(slot.offset, static_cast<std::size_t>(slot.point->registers));
  }
  /// What is kept for [address, address + count) of a table; empty if a part of it is not there.
  [[nodiscard]] std::span<const std::uint16_t> find(modbus::Table table, std::uint16_t address,
                                                    std::size_t count) const;
  /// First and last + 1 of the slots that share a word with such a range.
  [[nodiscard]] std::pair<std::size_t, std::size_t> slots_in(modbus::Table table,
                                                             std::uint16_t address,
                                                             std::size_t count) const;

 private:
  /// Words of consecutive addresses.
  struct Stretch {
    modbus::Table table;
    std::size_t first, end;  // addresses
    std::size_t offset;
  };

  std::vector<std::uint16_t> words_;
  std::vector<Slot> slots_;
  std::vector<Stretch> stretches_;
};

}  // namespace gonio
