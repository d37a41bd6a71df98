#include "emulator/protocol/device_view.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <span>
#include <stdexcept>
#include <tuple>

#include "emulator/core/quantity.hpp"
#include "emulator/protocol/point_text.hpp"
#include "emulator/protocol/register_codec.hpp"

namespace gonio {

namespace {

using modbus::Table;

constexpr int channels = 3;
constexpr double angle_tolerance_deg = 0.5;  // people name angles by whole degrees

bool is_bit_table(Table table) { return table == Table::coils || table == Table::discrete_inputs; }

/// Points that one request reads.
struct Request {
  std::vector<const Point*> points;  // by address

  [[nodiscard]] Table table() const { return points.front()->table; }
  [[nodiscard]] int address() const { return points.front()->address; }
  [[nodiscard]] int count() const { return points.back()->last_address() + 1 - address(); }
};

using Place = std::pair<Table, int>;

std::set<Place> places_of_the_map() {
  std::set<Place> places;
  for (const Block& block : RegisterMap::standard().blocks) {
    for (const Point& point : block.points) {
      for (int address = point.address; address <= point.last_address(); ++address) {
        places.emplace(point.table, address);
      }
    }
  }
  return places;
}

/// Whether a request can go on to a point: near enough, and no hole on the way.
bool reaches(const Request& request, const Point& next) {
  static const std::set<Place> places = places_of_the_map();
  const int most = is_bit_table(next.table) ? modbus::max_read_bits : modbus::max_read_registers;
  if (request.table() != next.table || next.last_address() - request.address() >= most) {
    return false;
  }
  for (int address = request.points.back()->last_address() + 1; address < next.address; ++address) {
    if (!places.contains({next.table, address})) {
      return false;
    }
  }
  return true;
}

/// float32 has no mark for over range: the state of the reading tells.
/// @return  that point for a reading as float32, else null.
const Point* reading_state_of(const Point& point) {
  return point.value == "gloss" && point.type == PointType::float32
             ? RegisterMap::standard().find(
                   fmt::format("reading_state_{}", point.channel.value_or(0) + 1))
             : nullptr;
}

std::vector<const Point*> with_reading_states(const std::vector<const Point*>& points) {
  std::set<const Point*> all(points.begin(), points.end());
  for (const Point* point : points) {
    if (const Point* state = reading_state_of(*point)) {
      all.insert(state);
    }
  }
  return {all.begin(), all.end()};
}

std::vector<Request> plan(std::vector<const Point*> points) {
  std::sort(points.begin(), points.end(), [](const Point* a, const Point* b) {
    return std::tie(a->table, a->address) < std::tie(b->table, b->address);
  });
  std::vector<Request> requests;
  for (const Point* point : points) {
    if (requests.empty() || !reaches(requests.back(), *point)) {
      requests.emplace_back();
    }
    requests.back().points.push_back(point);
  }
  return requests;
}

std::vector<std::uint16_t> read(ModbusClient& client, const Request& request) {
  const auto address = static_cast<std::uint16_t>(request.address());
  if (is_bit_table(request.table())) {
    const auto bits = client.read_bits(request.table(), address, request.count());
    return {bits.begin(), bits.end()};
  }
  return client.read_registers(request.table(), address, request.count());
}

/// The number in the decimals that people write it with: 92.3, where float32 holds
/// 92.30000305175781 and 923 tenths are 92.30000000000001.
double decimal(const Point& point, double value) {
  const std::string text = point.type == PointType::float32
                               ? fmt::format("{}", static_cast<float>(value))
                               : fmt::format("{:.12g}", value);
  return parse_quantity(text, Dimension::number).value_or(value);
}

}  // namespace

std::vector<const Point*> points_of_blocks(const std::vector<std::string>& ids) {
  const std::vector<Block>& blocks = RegisterMap::standard().blocks;
  std::vector<const Point*> points;
  for (const std::string& id : ids) {
    const auto block = std::find_if(blocks.begin(), blocks.end(),
                                    [&](const Block& other) { return other.id == id; });
    if (block == blocks.end()) {
      throw std::out_of_range(fmt::format("the register map has no block '{}'", id));
    }
    for (const Point& point : block->points) {
      points.push_back(&point);
    }
  }
  return points;
}

PointName PointName::parse(const std::string& text) {
  const RegisterMap& map = RegisterMap::standard();
  if (const Point* point = map.find(text)) {
    return {.point = point, .text = text};
  }
  const auto underscore = text.rfind('_');
  if (underscore != std::string::npos) {
    const auto angle = parse_quantity(text.substr(underscore + 1), Dimension::number);
    const Point* point = map.find(text.substr(0, underscore) + "_1");
    if (angle && point != nullptr) {
      return {.point = point, .angle_deg = angle, .text = text};
    }
  }
  throw std::invalid_argument(
      fmt::format("expected the id of a point, see `gonio registers`, found '{}'", text));
}

const Point& PointName::resolve(ModbusClient& client) const {
  if (!angle_deg) {
    return *point;
  }
  const RegisterMap& map = RegisterMap::standard();
  std::vector<const Point*> angles;
  for (int channel = 1; channel <= channels; ++channel) {
    angles.push_back(map.find(fmt::format("angle_{}", channel)));
  }
  const DeviceView view(client, angles);
  std::vector<double> there;
  for (int channel = 1; channel <= channels; ++channel) {
    const double angle = view.number(fmt::format("angle_{}", channel));
    if (std::abs(angle - *angle_deg) < angle_tolerance_deg) {
      return *map.find(point->id.substr(0, point->id.size() - 1) + std::to_string(channel));
    }
    if (std::isfinite(angle)) {
      there.push_back(angle);
    }
  }
  throw std::invalid_argument(fmt::format("{}: expected one of the angles {}, found '{}'", text,
                                          fmt::join(there, ", "), *angle_deg));
}

DeviceView::DeviceView(ModbusClient& client, const std::vector<const Point*>& points) {
  for (const Request& request : plan(with_reading_states(points))) {
    const std::vector<std::uint16_t> words = read(client, request);
    for (const Point* point : request.points) {
      const auto registers =
          std::span(words).subspan(static_cast<std::size_t>(point->address - request.address()),
                                   static_cast<std::size_t>(point->registers));
      Value& value = values_[point->id];
      value.point = point;
      if (point->type == PointType::text) {
        value.text = decode_text(registers);
      } else {
        value.number = decimal(*point, decode_number(*point, registers));
      }
    }
  }
  for (auto& [id, value] : values_) {
    const Point* state = reading_state_of(*value.point);
    if (state != nullptr && std::isnan(value.number) && text(state->id) == "over_range") {
      value.number = std::numeric_limits<double>::infinity();
    }
  }
}

const DeviceView::Value& DeviceView::value(const std::string& id) const {
  const auto found = values_.find(id);
  if (found == values_.end()) {
    throw std::out_of_range(fmt::format("the point '{}' was not read", id));
  }
  return found->second;
}

double DeviceView::number(const std::string& id) const {
  const Value& found = value(id);
  if (found.point->type == PointType::text) {
    throw std::out_of_range(fmt::format("the point '{}' is text", id));
  }
  return found.number;
}

bool DeviceView::bit(const std::string& id, const std::string& name) const {
  const auto on = symbols_on(*value(id).point, value(id).number);
  return std::any_of(on.begin(), on.end(), [&](const Symbol& bit) { return bit.name == name; });
}

std::string DeviceView::text(const std::string& id) const {
  const Value& found = value(id);
  return found.point->type == PointType::text ? found.text
                                              : number_text(*found.point, found.number);
}

std::string DeviceView::meaning(const std::string& id) const {
  const Symbol* symbol = find_symbol(*value(id).point, value(id).number);
  return symbol == nullptr ? text(id) : symbol->meaning;
}

std::vector<std::string> DeviceView::meanings(const std::string& id) const {
  std::vector<std::string> words;
  for (const Symbol& bit : symbols_on(*value(id).point, value(id).number)) {
    words.push_back(bit.meaning);
  }
  return words;
}

}  // namespace gonio
