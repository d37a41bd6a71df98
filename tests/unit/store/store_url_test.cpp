#include "emulator/store/store_url.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "emulator/store/store.hpp"
#include "tests/unit/message_of.hpp"
#include "tests/unit/temporary_folder.hpp"

namespace gonio {
namespace {

using test::message_of;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;
using Server = StoreUrl::Server;

TEST(StoreUrl, OfAFileIsItsPath) {
  for (const std::string path : {"qa.db", "runs/qa.db", "/abs/qa.db", "with blanks.db", "a:b"}) {
    const StoreUrl url = parse_store_url("sqlite:" + path);
    EXPECT_EQ(url.server, Server::sqlite);
    EXPECT_EQ(url.connection, path);
    EXPECT_EQ(url.shown, "sqlite:" + path);
  }
}

TEST(StoreUrl, OpensTheVeryFileItNames) {
  const test::TemporaryFolder folder;
  for (const std::string name :
       {"plain.db", "two words.db", "db=x.db", "a=b c = d.db", " =", "=", "quote\".db", "it's.db",
        "%41.db", "dbname=a timeout=1", "a?b#c", "file:x", "ä.db", "a=b "}) {
    EXPECT_NO_THROW(Store("sqlite:" + (folder.path() / name).string())) << name;
    EXPECT_TRUE(std::filesystem::exists(folder.path() / name)) << name;
  }
}

TEST(StoreUrl, IsHandedToLibpqWithWhatKeepsItFromWaitingForEver) {
  const StoreUrl url = parse_store_url("postgresql://ada@lab:5433/qa?sslmode=require");
  EXPECT_EQ(url.server, Server::postgresql);
  EXPECT_THAT(url.connection, StartsWith("postgresql://ada@lab:5433/qa?sslmode=require&"));
  EXPECT_THAT(url.connection, HasSubstr("&connect_timeout=10"));
  EXPECT_EQ(url.shown, "postgresql://ada@lab:5433/qa?sslmode=require");
  EXPECT_THAT(parse_store_url("postgres://lab/qa").connection,
              StartsWith("postgres://lab/qa?connect_timeout=10&"));
  EXPECT_THAT(parse_store_url("postgres://lab/qa?").connection,
              StartsWith("postgres://lab/qa?connect_timeout=10&"));
  EXPECT_THAT(parse_store_url("postgres://lab/qa?connect_timeout=3").connection,
              Not(HasSubstr("connect_timeout=10")));
}

TEST(StoreUrl, HidesPasswords) {
  for (const auto& [url, shown] : std::vector<std::pair<std::string, std::string>>{
           {"postgresql://ada:secret@lab/qa", "postgresql://ada:***@lab/qa"},
           {"postgresql://ada:se@cr:et@lab:5432/qa", "postgresql://ada:***@lab:5432/qa"},
           {"postgresql://:secret@/qa", "postgresql://:***@/qa"},
           {"postgresql://ada:secret@", "postgresql://ada:***@"},
           {"postgres://lab/qa?password=secret&x=y", "postgres://lab/qa?password=***&x=y"},
           {"postgres://lab/qa?sslpassword=secret", "postgres://lab/qa?sslpassword=***"},
           {"postgresql://lab:5432/a@b:c", "postgresql://lab:5432/a@b:c"}}) {
    EXPECT_EQ(parse_store_url(url).shown, shown);
  }
}

TEST(StoreUrl, IsNotShownWithItsPasswordWhereItIsWrong) {
  for (const std::string url :
       {"postgresql://ada:secret@[lab/qa", "postgresql://ada:secret@lab:port/qa",
        "postgresql://ada:secret@lab/qa?no_such_key=1", "postgresql://ada:sec%zzret@lab/qa"}) {
    EXPECT_THAT(message_of([&] { Store{url}; }), Not(HasSubstr("sec"))) << url;
    EXPECT_THROW(Store{url}, StoreError) << url;
  }
}

TEST(StoreUrl, OfAnythingElseIsRefused) {
  for (const std::string url : {"", "qa.db", "mysql://ada:secret@lab/qa", "SQLITE:qa.db", "sqlite",
                                "postgresql:qa", "sqlite:", "sqlite:a=\"b"}) {
    EXPECT_THROW(static_cast<void>(parse_store_url(url)), std::invalid_argument) << url;
    EXPECT_THAT(message_of([&] { static_cast<void>(parse_store_url(url)); }),
                Not(HasSubstr("secret")));
  }
  EXPECT_EQ(message_of([] { static_cast<void>(parse_store_url("qa.db")); }),
            "store: expected sqlite:PATH or "
            "postgresql://[user[:password]@][host][:port]/database[?...], found 'qa.db'");
}

}  // namespace
}  // namespace gonio
