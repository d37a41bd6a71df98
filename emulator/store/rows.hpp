#pragma once

#include <fmt/format.h>
#include <soci/soci.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace gonio {

/// A number as it is bound, or NULL.
struct NullableNumber {
  double value = 0.0;
  soci::indicator indicator = soci::i_null;

  NullableNumber() = default;
  explicit NullableNumber(const std::optional<double>& number)
      : value(number.value_or(0.0)), indicator(number ? soci::i_ok : soci::i_null) {}
  [[nodiscard]] std::optional<double> optional() const {
    return indicator == soci::i_ok ? std::optional(value) : std::nullopt;
  }
};

namespace rows {

template <class Cell>
void use_cell(soci::statement& statement, Cell& cell) {
  statement.exchange(soci::use(cell));
}
inline void use_cell(soci::statement& statement, NullableNumber& cell) {
  statement.exchange(soci::use(cell.value, cell.indicator));
}
template <class Cell>
void into_cell(soci::statement& statement, Cell& cell) {
  statement.exchange(soci::into(cell));
}
inline void into_cell(soci::statement& statement, NullableNumber& cell) {
  statement.exchange(soci::into(cell.value, cell.indicator));
}

}  // namespace rows

/// A table as rows are written to it. Cells are long long, double, std::string or NullableNumber.
///
/// Many rows go in one statement: PostgreSQL needs a round trip for each, and both servers spend
/// less on a row so.
template <class... Cells>
class RowWriter {
 public:
  using Row = std::tuple<Cells...>;

  /// @param table  with its columns: "reading (run, value)".
  RowWriter(soci::session& session, std::string table)
      : session_(session), table_(std::move(table)) {}

  /// Writes what is there, or throws soci::soci_error; then the writer is of no use any more.
  void write(std::span<const Row> rows) {
    for (; rows.size() >= rows_at_once; rows = rows.subspan(rows_at_once)) {
      prepared(many_, rows_at_once).write(rows.first(rows_at_once));
    }
    for (; !rows.empty(); rows = rows.subspan(1)) {
      prepared(one_, 1).write(rows.first(1));
    }
  }

 private:
  static constexpr std::size_t rows_at_once = 50;

  class Block {
   public:
    Block(soci::session& session, const std::string& table, std::size_t n)
        : rows_(n), statement_(session) {
      for (Row& row : rows_) {
        std::apply([&](auto&... cell) { (rows::use_cell(statement_, cell), ...); }, row);
      }
      statement_.alloc();
      statement_.prepare(insertion(table, n));
      statement_.define_and_bind();
    }

    void write(std::span<const Row> rows) {
      std::copy(rows.begin(), rows.end(), rows_.begin());
      statement_.execute(true);
    }

   private:
    static std::string insertion(const std::string& table, std::size_t n) {
      std::string sql = fmt::format("INSERT INTO {} VALUES ", table);
      for (std::size_t row = 0; row < n; ++row) {
        sql += row == 0 ? "(" : ", (";
        for (std::size_t cell = 0; cell < sizeof...(Cells); ++cell) {
          sql += fmt::format("{}:c{}", cell == 0 ? "" : ", ", row * sizeof...(Cells) + cell);
        }
        sql += ')';
      }
      return sql;
    }

    std::vector<Row> rows_;  ///< bound to the statement: never moved
    soci::statement statement_;
  };

  Block& prepared(std::optional<Block>& block, std::size_t n) {
    if (!block) {
      block.emplace(session_, table_, n);
    }
    return *block;
  }

  soci::session& session_;
  std::string table_;
  std::optional<Block> many_, one_;
};

/// Writes rows by a writer for them alone.
template <class... Cells>
void write_rows(soci::session& session, const std::string& table,
                const std::vector<std::tuple<Cells...>>& rows) {
  RowWriter<Cells...>(session, table).write(rows);
}

/// Rows as a query gives them, one after the other. SOCI knows the type of a column in SQLite from
/// its declaration only if whole vectors are read, and then cuts an INTEGER to 32 bits; single
/// cells come as what they are asked for.
template <class... Cells>
class RowReader {
 public:
  /// @param parameters  of the query, in the order of their names in it; they must outlive this.
  template <class... Parameters>
  RowReader(soci::session& session, const std::string& sql, Parameters&... parameters)
      : statement_(session) {
    std::apply([&](auto&... cell) { (rows::into_cell(statement_, cell), ...); }, row_);
    (rows::use_cell(statement_, parameters), ...);
    statement_.alloc();
    statement_.prepare(sql);
    statement_.define_and_bind();
  }

  /// Calls `read(cell...)` for each row, with the parameters as they are now.
  template <class Read>
  void for_each(Read&& read) {
    statement_.execute();
    while (statement_.fetch()) {
      std::apply(read, row_);
    }
  }

 private:
  std::tuple<Cells...> row_;
  soci::statement statement_;
};

}  // namespace gonio
