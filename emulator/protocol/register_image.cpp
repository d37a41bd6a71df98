#include "emulator/protocol/register_image.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

namespace gonio {

RegisterImage::RegisterImage(const RegisterMap& map, bool has_simulation) {
  for (const Block& block : map.blocks) {
    for (const Point& point : block.points) {
      if (has_simulation || !block.is_simulation) {
        slots_.push_back({&point, 0});
      }
    }
  }
  std::ranges::sort(slots_, {}, [](const Slot& slot) {
    return std::pair(slot.point->table, slot.point->address);
  });
  std::size_t size = 0;
  for (Slot& slot : slots_) {
    const Point& point = *slot.point;
    const auto registers = static_cast<std::size_t>(point.registers);
    if (stretches_.empty() || stretches_.back().table != point.table ||
        stretches_.back().end != point.address) {
      stretches_.push_back({point.table, point.address, point.address, size});
    }
    stretches_.back().end += registers;
    slot.offset = size;
    size += registers;
  }
  words_.resize(size);
}

std::span<const std::uint16_t> RegisterImage::find(modbus::Table table, std::uint16_t address,
                                                   std::size_t count) const {
  for (const Stretch& stretch : stretches_) {
    if (stretch.table == table && stretch.first <= address && address + count <= stretch.end) {
      return std::span(words_).subspan(stretch.offset + address - stretch.first, count);
    }
  }
  return {};
}

std::pair<std::size_t, std::size_t> RegisterImage::slots_in(modbus::Table table,
                                                            std::uint16_t address,
                                                            std::size_t count) const {
  const auto is_before = [&](const Slot& slot) {
    return std::pair(slot.point->table, slot.point->last_address()) <
           std::pair(table, int{address});
  };
  const auto is_in = [&](const Slot& slot) {
    return slot.point->table == table && slot.point->address < address + count;
  };
  const auto first = std::ranges::partition_point(slots_, is_before);
  const auto end = std::find_if_not(first, slots_.end(), is_in);
  return {static_cast<std::size_t>(first - slots_.begin()),
          static_cast<std::size_t>(end - slots_.begin())};
}

}  // namespace gonio
