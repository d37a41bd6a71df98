#pragma once

#include <cstdint>

#include "emulator/protocol/modbus.hpp"
#include "emulator/protocol/pdu.hpp"

namespace gonio::modbus {

/// Appends what follows the MEI type of an answer to function code 43/14: the objects of a stream
/// as far as they fit, and where to go on, or one object.
///
/// @param read_code  1 basic, 2 regular, 3 extended stream from `object` on, each with the objects
///                   of those before it; from the first again if there is no such object; 4 one
///                   object. Texts are cut to 244 bytes.
/// @return  illegal_data_value for another code, illegal_data_address for one object that is not
///          there.
/// @see  Modbus Application Protocol V1.1b3, section 6.21
[[nodiscard]] Exception append_device_identification(const Identification& identification,
                                                     std::uint8_t read_code, std::uint8_t object,
                                                     Pdu& reply);

/// Appends what follows the function code of an answer to function code 17: the id 47h, that the
/// unit runs (FFh), and vendor, product code and revision as text.
void append_server_id(const Identification& identification, Pdu& reply);

}  // namespace gonio::modbus
