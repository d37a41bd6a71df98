#pragma once

#include <string>

#include "emulator/store/store_url.hpp"

namespace gonio {

/// In what the SQL of the two servers differs.
struct Dialect {
  const char* counted_key;  ///< type of a primary key that the server counts
  const char* number;       ///< type of a double that is kept to the last bit
  const char* clustered;    ///< what follows a table that is kept in the order of its key
  const char* begin_read;   ///< a transaction that sees one state of the store
  const char* begin_write;
  const char* begin_migration;  ///< one that no other may run beside
  const char* locked;           ///< what follows SELECT if nobody may change the row meanwhile
  const char* count_tables;     ///< all tables, and those called gonio_schema
};

[[nodiscard]] const Dialect& dialect_of(StoreUrl::Server server);

/// SQL for the server: {counted_key}, {number} and {clustered} stand for the words of its dialect.
[[nodiscard]] std::string in_dialect(const std::string& sql, const Dialect& dialect);

}  // namespace gonio
