#pragma once

#include <soci/soci.h>

#include <string>
#include <utility>

#include "emulator/store/dialect.hpp"
#include "emulator/store/store.hpp"
#include "emulator/store/store_url.hpp"

namespace gonio {

/// A connection, in whose calls every error of SOCI becomes a StoreError.
class Database {
 public:
  enum class Access { read, write, migration };

  /// Opens or makes the database; changes nothing in one that is there.
  /// @throws StoreError  if that is not possible.
  explicit Database(const std::string& url);

  [[nodiscard]] const std::string& url() const { return url_.shown; }
  [[nodiscard]] const Dialect& dialect() const { return dialect_of(url_.server); }
  soci::session& session() { return session_; }

  /// For SQLite: a commit survives a loss of power, and readers do not wait for writers.
  void make_durable();

  /// Calls `work` in a transaction, which leaves nothing behind if it throws.
  template <class Work>
  auto transaction(Access access, Work&& work) {
    return guarded([&] {
      begin(access);
      Rollback rollback{*this};
      if constexpr (std::is_void_v<decltype(work())>) {
        work();
        commit(rollback);
      } else {
        auto result = work();
        commit(rollback);
        return result;
      }
    });
  }

  /// Calls `work` with errors of SOCI translated.
  template <class Work>
  auto guarded(Work&& work) {
    try {
      return work();
    } catch (const soci::soci_error& error) {
      throw translated(error);
    }
  }

  /// An error of the store, with its url.
  [[nodiscard]] StoreError error(const std::string& what) const;

 private:
  struct Rollback {
    Database& database;
    bool armed = true;
    ~Rollback();
  };
  void begin(Access access);
  void commit(Rollback& rollback);
  [[nodiscard]] StoreError translated(const soci::soci_error& error) const;

  StoreUrl url_;
  soci::session session_;
};

}  // namespace gonio
