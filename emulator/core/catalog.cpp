#include "emulator/core/catalog.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdlib>
#include <map>

#include "emulator/core/input_error.hpp"
#include "emulator/core/text_file.hpp"

namespace gonio {

namespace fs = std::filesystem;

namespace {

bool is_root(const fs::path& folder) {
  return fs::is_directory(folder / "standards") && fs::is_directory(folder / "fixtures");
}

fs::path named_root(const fs::path& folder) {
  if (!is_root(folder)) {
    throw InputError({.file = folder.string()}, "a folder with standards and fixtures",
                     fs::exists(folder) ? "something else" : "nothing");
  }
  return folder;
}

/// Entries of one root: standards are <family>/<edition>/standard.yaml or clauses.yaml, the others
/// <id>.yaml.
void collect(Catalog::Kind kind, const fs::path& root, std::map<std::string, fs::path>& found) {
  if (kind == Catalog::Kind::standard || kind == Catalog::Kind::clauses ||
      kind == Catalog::Kind::profile) {
    const char* name = kind == Catalog::Kind::standard  ? "standard.yaml"
                       : kind == Catalog::Kind::clauses ? "clauses.yaml"
                                                        : "profile.yaml";
    for (const auto& family : fs::directory_iterator(root / "standards")) {
      if (!family.is_directory()) {
        continue;
      }
      for (const auto& edition : fs::directory_iterator(family)) {
        const fs::path file = edition.path() / name;
        if (fs::is_regular_file(file)) {
          found.emplace((family.path().filename() / edition.path().filename()).string(), file);
        }
      }
    }
    return;
  }
  const char* name = kind == Catalog::Kind::sample       ? "samples"
                     : kind == Catalog::Kind::instrument ? "instruments"
                                                         : "batches";
  const fs::path folder = root / "fixtures" / name;
  if (!fs::is_directory(folder)) {
    return;
  }
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == ".yaml") {
      found.emplace(entry.path().stem().string(), entry.path());
    }
  }
}

std::string noun(Catalog::Kind kind) {
  switch (kind) {
    case Catalog::Kind::standard:
      return "a standard file";
    case Catalog::Kind::clauses:
      return "a file of clauses";
    case Catalog::Kind::profile:
      return "a file of profile rules";
    case Catalog::Kind::sample:
      return "a sample file";
    case Catalog::Kind::instrument:
      return "an instrument file";
    case Catalog::Kind::batch:
      return "a batch file";
  }
  return {};
}

}  // namespace

Catalog Catalog::standard_places(const std::optional<fs::path>& data_dir) {
  std::vector<fs::path> roots;
  if (data_dir) {
    roots.push_back(named_root(*data_dir));
  }
  if (const char* set = std::getenv("GONIO_DATA"); set != nullptr && *set != '\0') {
    roots.push_back(named_root(set));
  }
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  if (const fs::path share = program.parent_path().parent_path() / "share" / "gonio";
      is_root(share)) {
    roots.push_back(share);
  }
  for (fs::path folder = program.parent_path(); folder.has_relative_path();
       folder = folder.parent_path()) {
    if (is_root(folder)) {
      roots.push_back(folder);
      break;
    }
  }
  return Catalog(std::move(roots));
}

fs::path Catalog::find(Kind kind, const std::string& id_or_path) const {
  const std::string there = what_stands_at(id_or_path);
  if (there == "a file") {
    return id_or_path;
  }
  if (const auto file = file_of(kind, id_or_path)) {
    return *file;
  }
  throw InputError({.file = id_or_path}, expected(kind), there);
}

fs::path Catalog::find(Kind kind, const YamlNode& node) const {
  if (what_stands_at(node.file_path()) == "a file") {
    return node.file_path();
  }
  if (const auto file = file_of(kind, node.text())) {
    return *file;
  }
  node.fail(expected(kind));
}

std::optional<fs::path> Catalog::file_of(Kind kind, const std::string& id) const {
  for (const Entry& entry : list(kind)) {
    if (entry.id == id) {
      return entry.file;
    }
  }
  return std::nullopt;
}

std::string Catalog::expected(Kind kind) const {
  std::vector<std::string> ids;
  for (const Entry& entry : list(kind)) {
    ids.push_back(entry.id);
  }
  return ids.empty() ? noun(kind)
                     : fmt::format("{}, or one of the ids {}", noun(kind), fmt::join(ids, ", "));
}

std::vector<Catalog::Entry> Catalog::list(Kind kind) const {
  std::map<std::string, fs::path> found;
  for (const fs::path& root : roots_) {
    collect(kind, root, found);
  }
  std::vector<Entry> entries;
  entries.reserve(found.size());
  for (const auto& [id, file] : found) {
    entries.push_back({id, file});
  }
  return entries;
}

std::string Catalog::name_of(const std::string& file) const {
  for (const fs::path& root : roots_) {
    const std::string below = fs::path(file).lexically_normal().lexically_relative(root).string();
    if (!below.empty() && !below.starts_with("..")) {
      return below;
    }
  }
  return file;
}

fs::path Catalog::fixture(const fs::path& below) const {
  for (const fs::path& root : roots_) {
    if (fs::is_regular_file(root / "fixtures" / below)) {
      return root / "fixtures" / below;
    }
  }
  throw InputError({.file = (fs::path("fixtures") / below).string()}, "a file in a data folder",
                   "nothing");
}

}  // namespace gonio
