#include "emulator/store/database.hpp"

#include <fmt/format.h>
#include <soci/postgresql/soci-postgresql.h>
#include <soci/sqlite3/soci-sqlite3.h>

#include <string_view>

namespace gonio {
namespace {

constexpr int busy_timeout_s = 30;

/// The first line of what the server says, without what SOCI and the server put before it; may be
/// empty.
std::string detail(const soci::soci_error& error) {
  std::string text = error.get_error_message();
  for (const std::string_view prefix :
       {"sqlite3_statement_backend::prepare: ", "sqlite3_statement_backend::loadOne: ",
        "sqlite3_statement_backend::loadRS: ", "Cannot establish connection to the database.",
        "Cannot prepare statement.", "Cannot execute query.", "Fatal error.", "Connection failed.",
        "ERROR: ", "FATAL: "}) {
    if (text.starts_with(prefix)) {
      text.erase(0, prefix.size());
      text.erase(0, text.find_first_not_of(" \n"));
    }
  }
  text.erase(std::min(text.find('\n'), text.size()));
  return text;
}

std::string sentence(const soci::sqlite3_soci_error& error) {
  switch (error.result()) {
    case SQLITE_FULL:
      return "no room left on the disk";
    case SQLITE_IOERR:
      return "no room left, or the disk is broken";
    case SQLITE_NOTADB:
      return "not a database of SQLite, so no store of gonio";
    case SQLITE_CORRUPT:
      return "the file is damaged";
    case SQLITE_READONLY:
      return "no right to write";
    case SQLITE_CANTOPEN:
      return "the file cannot be opened or made";
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      return fmt::format("another program has kept it locked for {} s", busy_timeout_s);
    case SQLITE_CONSTRAINT:
      return "something of it is there already";
    default:
      return "the database refuses";
  }
}

/// @see PostgreSQL 15 documentation, appendix A: error codes.
std::string sentence(const soci::postgresql_soci_error& error) {
  const std::string state = error.sqlstate();
  if (state == "53100") {
    return "no room left on the disk of the server";
  }
  if (state == "23505") {
    return "something of it is there already";
  }
  if (state.starts_with("08") || state.starts_with("57P") || state == "     ") {
    return "the server closed the connection";
  }
  return "the server refuses";
}

std::string sentence(const soci::soci_error& error) {
  if (const auto* sqlite = dynamic_cast<const soci::sqlite3_soci_error*>(&error)) {
    return sentence(*sqlite);
  }
  if (const auto* postgresql = dynamic_cast<const soci::postgresql_soci_error*>(&error)) {
    return sentence(*postgresql);
  }
  return "no connection";
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size()) {
    text.replace(at, from.size(), to);
  }
  return text;
}

/// SQLite does not wait where two programs do this at a time: a write lock that it does wait for
/// lets the other one go first.
void use_write_ahead_log(soci::session& session) {
  constexpr int tries = 100;
  for (int i = 1;; ++i) {
    try {
      std::string mode;
      session << "PRAGMA journal_mode = WAL", soci::into(mode);
      return;
    } catch (const soci::sqlite3_soci_error& error) {
      if (error.result() != SQLITE_BUSY || i == tries) {
        throw;
      }
      session << "BEGIN IMMEDIATE";
      session << "COMMIT";
    }
  }
}

}  // namespace

Database::Database(const std::string& url) : url_(parse_store_url(url)) {
  guarded([&] {
    if (url_.server == StoreUrl::Server::postgresql) {
      session_.open(soci::postgresql, url_.connection);
      // What it warns of, libpq would print.
      session_ << "SET client_min_messages = error";
      return;
    }
    session_.open(soci::sqlite3, url_.connection);
    session_ << fmt::format("PRAGMA busy_timeout = {}", busy_timeout_s * 1000);
    session_ << "PRAGMA synchronous = FULL";
    session_ << "PRAGMA foreign_keys = ON";
  });
}

void Database::make_durable() {
  if (url_.server == StoreUrl::Server::sqlite) {
    guarded([&] { use_write_ahead_log(session_); });
  }
}

void Database::begin(Access access) {
  const Dialect& words = dialect();
  session_ << (access == Access::read    ? words.begin_read
               : access == Access::write ? words.begin_write
                                         : words.begin_migration);
}

void Database::commit(Rollback& rollback) {
  session_ << "COMMIT";
  rollback.armed = false;
}

Database::Rollback::~Rollback() {
  if (armed) {
    try {
      database.session_ << "ROLLBACK";
    } catch (const soci::soci_error&) {
      // SQLite has rolled back by itself where there was no room, and a server that is gone will.
    }
  }
}

StoreError Database::error(const std::string& what) const {
  return StoreError(fmt::format("{}: {}", url_.shown, what));
}

StoreError Database::translated(const soci::soci_error& error) const {
  // libpq quotes what it cannot read of an address, be it the password.
  std::string text = replaced(detail(error), url_.connection, url_.shown);
  for (const std::string& password : url_.passwords) {
    text = replaced(text, fmt::format("\"{}\"", password), "\"***\"");
  }
  return this->error(sentence(error) + (text.empty() ? "" : fmt::format(" ({})", text)));
}

}  // namespace gonio
