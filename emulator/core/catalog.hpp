#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "emulator/core/yaml_map.hpp"

namespace gonio {

/// The folders with gonio's data, in the order in which they are searched.
class Catalog {
 public:
  /// `clauses` is what a standard demands, beside its numbers, or instead of them; `profile` is what
  /// it makes of in-plane profiles.
  enum class Kind { standard, clauses, profile, sample, instrument, batch };

  struct Entry {
    std::string id;
    std::filesystem::path file;
  };

  Catalog() = default;  ///< of no folders
  /// @param roots  each has folders `standards` and `fixtures`.
  explicit Catalog(std::vector<std::filesystem::path> roots) : roots_(std::move(roots)) {}

  /// `data_dir` if given, $GONIO_DATA if set, share/gonio beside the folder of the running program,
  /// and the source tree that holds the running program, as far as they exist.
  /// @throws InputError  if `data_dir` or $GONIO_DATA is not such a folder.
  [[nodiscard]] static Catalog standard_places(
      const std::optional<std::filesystem::path>& data_dir = {});

  /// The file of an id, e.g. "iso_2813/2014" or "copper_polished"; an existing path stands for
  /// itself.
  /// @throws InputError  that lists the ids there are, if there is none.
  [[nodiscard]] std::filesystem::path find(Kind kind, const std::string& id_or_path) const;
  /// The file that a YAML file names there: by an id, or by a path relative to itself.
  /// @throws InputError  at that place, with the ids there are, if there is none.
  [[nodiscard]] std::filesystem::path find(Kind kind, const YamlNode& node) const;
  /// All entries, by id; the first root that has an id wins.
  [[nodiscard]] std::vector<Entry> list(Kind kind) const;
  /// A file of the fixtures, e.g. "observers/cie_1931_2deg.csv".
  /// @throws InputError  if no root has it.
  [[nodiscard]] std::filesystem::path fixture(const std::filesystem::path& below) const;
  /// A file as a report names it: below its data folder, wherever that is; others as they are.
  [[nodiscard]] std::string name_of(const std::string& file) const;

 private:
  [[nodiscard]] std::optional<std::filesystem::path> file_of(Kind kind,
                                                             const std::string& id) const;
  [[nodiscard]] std::string expected(Kind kind) const;

  std::vector<std::filesystem::path> roots_;
};

}  // namespace gonio
