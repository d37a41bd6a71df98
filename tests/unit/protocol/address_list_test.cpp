#include "emulator/protocol/address_list.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/unit/message_of.hpp"

namespace gonio::test {
namespace {

bool contains(const AddressList& list, const char* address) {
  return list.contains(asio::ip::make_address(address));
}

TEST(AddressList, AllowsAllIfEmpty) {
  const AddressList all({});
  EXPECT_TRUE(contains(all, "192.0.2.1"));
  EXPECT_TRUE(contains(all, "2001:db8::1"));
}

TEST(AddressList, AllowsSingleAddresses) {
  const AddressList list({"192.0.2.1", "2001:db8::1"});
  EXPECT_TRUE(contains(list, "192.0.2.1"));
  EXPECT_FALSE(contains(list, "192.0.2.2"));
  EXPECT_TRUE(contains(list, "2001:db8::1"));
  EXPECT_FALSE(contains(list, "2001:db8::2"));
}

TEST(AddressList, AllowsNetworksFromTheirFirstToTheirLastAddress) {
  const AddressList list({"10.1.16.0/20", "fd00:1::/32"});
  EXPECT_FALSE(contains(list, "10.1.15.255"));
  EXPECT_TRUE(contains(list, "10.1.16.0"));
  EXPECT_TRUE(contains(list, "10.1.31.255"));
  EXPECT_FALSE(contains(list, "10.1.32.0"));
  EXPECT_TRUE(contains(list, "fd00:1:ffff::1"));
  EXPECT_FALSE(contains(list, "fd00:2::1"));
}

TEST(AddressList, TakesTheNetworkOfAnAddressWithinIt) {
  EXPECT_TRUE(contains(AddressList({"10.1.2.3/8"}), "10.200.0.1"));
}

TEST(AddressList, AllowsEverythingWithAPrefixOfNothing) {
  EXPECT_TRUE(contains(AddressList({"0.0.0.0/0"}), "198.51.100.7"));
  EXPECT_FALSE(contains(AddressList({"0.0.0.0/0"}), "2001:db8::1"));
}

/// What a socket of both families sees of an IPv4 client.
TEST(AddressList, TakesMappedAddressesForThoseOfIPv4) {
  const AddressList list({"192.0.2.0/24"});
  EXPECT_TRUE(contains(list, "::ffff:192.0.2.9"));
  EXPECT_FALSE(contains(list, "::ffff:192.0.3.9"));
}

TEST(AddressList, AllowsNobodyOfTheFamilyThatItDoesNotName) {
  EXPECT_FALSE(contains(AddressList({"127.0.0.1"}), "::1"));
  EXPECT_FALSE(contains(AddressList({"::1"}), "127.0.0.1"));
}

TEST(AddressList, RefusesOtherText) {
  for (const char* text : {"", "lab", "10.0.0", "10.0.0.0/33", "10.0.0.0/", "10.0.0.0/-1",
                           "fd00::/129", "fd00::zz", "10.0.0.1 "}) {
    EXPECT_EQ(
        message_of([&] { AddressList({text}); }),
        fmt::format("--allow: expected an address or a network such as 10.0.0.0/8, found '{}'",
                    text));
  }
}

}  // namespace
}  // namespace gonio::test
