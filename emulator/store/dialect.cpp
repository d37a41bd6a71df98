#include "emulator/store/dialect.hpp"

#include <fmt/format.h>

namespace gonio {
namespace {

constexpr Dialect sqlite{
    .counted_key = "INTEGER PRIMARY KEY AUTOINCREMENT",
    // By its rules of affinity SQLite keeps -0.0 in a column of type DOUBLE as the integer 0, and
    // what is called BLOB as it is; SOCI reads as a double what is called DOUBLE.
    .number = "DOUBLE BLOB",
    .clustered = "WITHOUT ROWID",
    .begin_read = "BEGIN",
    // At once, so that two writers wait for each other and none has to give up in the middle.
    .begin_write = "BEGIN IMMEDIATE",
    .begin_migration = "BEGIN IMMEDIATE",
    .locked = "",
    .count_tables = "SELECT count(*), coalesce(sum(name = 'gonio_schema'), 0) FROM sqlite_master"};

constexpr Dialect postgresql{.counted_key = "BIGINT GENERATED ALWAYS AS IDENTITY PRIMARY KEY",
                             .number = "DOUBLE PRECISION",
                             .clustered = "",
                             .begin_read = "BEGIN ISOLATION LEVEL REPEATABLE READ READ ONLY",
                             .begin_write = "BEGIN",
                             // The number is only ours: the letters of gonio.
                             .begin_migration = "BEGIN; SELECT pg_advisory_xact_lock(444251138415)",
                             .locked = " FOR UPDATE",
                             // A database with tables of others may hold a store as well.
                             .count_tables =
                                 "SELECT count(*), count(*) FROM pg_catalog.pg_class "
                                 "WHERE oid = to_regclass('gonio_schema')"};

}  // namespace

const Dialect& dialect_of(StoreUrl::Server server) {
  return server == StoreUrl::Server::sqlite ? sqlite : postgresql;
}

std::string in_dialect(const std::string& sql, const Dialect& dialect) {
  return fmt::format(fmt::runtime(sql), fmt::arg("counted_key", dialect.counted_key),
                     fmt::arg("number", dialect.number), fmt::arg("clustered", dialect.clustered));
}

}  // namespace gonio
