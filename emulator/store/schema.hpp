#pragma once

#include <span>
#include <string>
#include <vector>

#include "emulator/store/database.hpp"

namespace gonio {

/// What makes a store of one version from one of the version before: statements in the SQL that
/// both servers know, with the words of Dialect for the rest. Never changed once it is released.
using Migration = std::vector<std::string>;

/// All there are, from version 1 on.
[[nodiscard]] std::span<const Migration> migrations();

/// Brings a store to the version that the last migration makes, each in one transaction; an empty
/// database becomes a store.
/// @throws StoreError  if it is newer, or an SQLite file with tables of others.
void migrate(Database& database, std::span<const Migration> migrations);

}  // namespace gonio
