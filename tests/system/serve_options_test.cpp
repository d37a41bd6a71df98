#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/system/program.hpp"

// What `gonio serve` refuses before it listens.

namespace gonio {
namespace {

using test::Outcome;
using test::Program;
using testing::HasSubstr;

struct BadOption {
  std::string name;                    ///< of the test
  std::vector<std::string> arguments;  ///< after those of a server that would run
  std::string message;                 ///< part of what it says
};

void PrintTo(const BadOption& option, std::ostream* out) { *out << option.name; }

class BadServeOption : public testing::TestWithParam<BadOption> {};

TEST_P(BadServeOption, IsRefusedWithItsReason) {
  std::vector<std::string> arguments{"serve", "triangle_gloss", "--tcp", "127.0.0.1:0"};
  if (!GetParam().arguments.empty() && GetParam().arguments[0] == "--tcp") {
    arguments.resize(2);
  }
  arguments.insert(arguments.end(), GetParam().arguments.begin(), GetParam().arguments.end());
  const Outcome outcome = Program().run(arguments);
  EXPECT_EQ(outcome.status, 2);
  EXPECT_EQ(outcome.out, "");
  EXPECT_THAT(outcome.err, HasSubstr(GetParam().message));
}

std::string name_of(const testing::TestParamInfo<BadOption>& info) { return info.param.name; }

const std::string expected_place = "--tcp: expected HOST:PORT with a port in [0, 65535]";

INSTANTIATE_TEST_SUITE_P(
    Place, BadServeOption,
    testing::Values(BadOption{"NoPort", {"--tcp", "127.0.0.1"}, expected_place},
                    BadOption{"NoHost", {"--tcp", ":1502"}, expected_place},
                    BadOption{"Nothing", {"--tcp", ""}, expected_place},
                    BadOption{
                        "PortTooHigh", {"--tcp", "127.0.0.1:65536"}, "found '127.0.0.1:65536'"},
                    BadOption{"PortNegative", {"--tcp", "127.0.0.1:-1"}, expected_place},
                    BadOption{"PortNotWhole", {"--tcp", "127.0.0.1:1.5"}, expected_place},
                    BadOption{"SpaceAtTheEnd", {"--tcp", "127.0.0.1:0 "}, expected_place},
                    BadOption{"BareIpVersion6", {"--tcp", "::1:0"}, "IPv6 host in brackets"},
                    BadOption{"OpenBracket", {"--tcp", "[::1:0"}, expected_place},
                    BadOption{"LinkWithoutTerminal", {"--rtu-link", "link"}, "only together with"},
                    BadOption{"Baud", {"--baud", "1234"}, "--baud: 1234 not in"},
                    BadOption{"Parity", {"--parity", "mark"}, "--parity: mark not in"}),
    name_of);

const std::string expected_address = "--allow: expected an address or a network such as 10.0.0.0/8";

INSTANTIATE_TEST_SUITE_P(
    Allow, BadServeOption,
    testing::Values(BadOption{"LongPrefix", {"--allow", "10.0.0.0/33"}, "found '10.0.0.0/33'"},
                    BadOption{"LongPrefix6", {"--allow", "fe80::/129"}, expected_address},
                    BadOption{"Name", {"--allow", "localhost"}, expected_address},
                    BadOption{"SecondIsBad", {"--allow", "10.0.0.0/8", "--allow", ""}, "found ''"}),
    name_of);

INSTANTIATE_TEST_SUITE_P(
    Units, BadServeOption,
    testing::Values(
        BadOption{"Broadcast", {"--unit", "0"}, "--unit: Value 0 not in range 1 to 247"},
        BadOption{"TooHigh", {"--unit", "248"}, "not in range 1 to 247"},
        BadOption{"TooMany",
                  {"--unit", "1", "--unit", "2"},
                  "--unit: expected one for each instrument, 1 in all, found 2"},
        BadOption{"Twice",
                  {"triangle_gloss", "--unit", "5", "--unit", "5"},
                  "expected different ones in [1, 247], found '5'"}),
    name_of);

INSTANTIATE_TEST_SUITE_P(
    Instrument, BadServeOption,
    testing::Values(
        BadOption{"PlaceUnknown",
                  {"--place", "desk"},
                  "--place: expected one of nothing, tile, black_trap, black_matt,"},
        BadOption{"PlaceOfNoSampleOfIts", {"--place", "steel_brushed"}, "found 'steel_brushed'"},
        BadOption{"Sample", {"--sample", "desk"}, "desk: expected a sample file"},
        BadOption{"SecondInstrument", {"desk"}, "desk: expected an instrument file"},
        BadOption{"Speed", {"--speed", "0"}, "--speed: expected a number"},
        BadOption{"Seed", {"--seed", "-1"}, "--seed: expected a number"}),
    name_of);

INSTANTIATE_TEST_SUITE_P(
    Faults, BadServeOption,
    testing::Values(BadOption{"Unknown",
                              {"--fault", "{fault: fire}"},
                              "--fault:1:9: fault: expected one of delay, no_reply,"},
                    BadOption{"NoMap",
                              {"--fault", "delay"},
                              "--fault:1:1: expected a map of keys and values, found 'delay'"},
                    BadOption{"NoCode",
                              {"--fault", "{fault: exception}"},
                              "--fault:1:1: code: expected the key 'code'"},
                    BadOption{"WrongCode",
                              {"--fault", "{fault: exception, code: 3}"},
                              "--fault:1:26: code: expected one of 4, 6, 10, 11, found '3'"},
                    BadOption{"AddressesBackwards",
                              {"--fault", "{fault: close, addresses: 9-0}"},
                              "addresses: expected an address or a range of them"},
                    BadOption{"UnknownKey", {"--fault", "{fault: close, often: true}"}, "often"},
                    BadOption{"Nothing", {"--fault", ""}, "--fault:1:1: expected YAML"}),
    name_of);

INSTANTIATE_TEST_SUITE_P(
    Other, BadServeOption,
    testing::Values(
        BadOption{"IdleTimeoutZero",
                  {"--idle-timeout", "0 s"},
                  "--idle-timeout: expected a time (s, ms, min, h) > 0 and <= 24 h"},
        BadOption{"TimeWithoutUnit", {"--stall-timeout", "5"}, "--stall-timeout: expected a time"},
        BadOption{"NoConnections", {"--max-connections", "0"}, "--max-connections"},
        BadOption{"Format", {"--format", "csv"}, "--format: csv not in {text,json}"},
        BadOption{"LogLevel", {"--log-level", "loud"}, "--log-level: loud not in"},
        BadOption{"LogSize", {"--log-size", "0"}, "--log-size"}),
    name_of);

TEST(ServeInstrument, IsRequired) {
  const Outcome outcome = Program().run({"serve", "--tcp", "127.0.0.1:0"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("INSTRUMENT is required"));
}

TEST(ServeInstrument, OfAFileOfAnotherKindIsRefusedAtItsPlace) {
  const auto sample = test::source_tree / "fixtures/samples/black_matt.yaml";
  const Outcome outcome = Program().run({"serve", sample.string(), "--tcp", "127.0.0.1:0"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_EQ(outcome.err, sample.string() +
                             ":1:9: schema: expected gonio/instrument/1, found 'gonio/sample/1'\n");
}

}  // namespace
}  // namespace gonio
