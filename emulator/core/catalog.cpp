#include "emulator/core/catalog.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdlib>
#include <map>

#include "emulator/core/input_error.hpp"

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

/// Entries of one root: standards are <family>/<edition>/standard.yaml, the others <id>.yaml.
void collect(Catalog::Kind kind, const fs::path& root, std::map<std::string, fs::path>& found) {
  if (kind == Catalog::Kind::standard) {
    for (const auto& family : fs::directory_iterator(root / "standards")) {
      if (!family.is_directory()) {
        continue;
      }
      for (const auto& edition : fs::directory_iterator(family)) {
        const fs::path file = edition.path() / "standard.yaml";
        if (fs::is_regular_file(file)) {
          found.emplace((family.path().filename() / edition.path().filename()).string(), file);
        }
      }
    }
    return;
  }
  const fs::path folder =
      root / "fixtures" / (kind == Catalog::Kind::sample ? "samples" : "instruments");
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
      return "standard";
    case Catalog::Kind::sample:
      return "sample";
    case Catalog::Kind::instrument:
      return "instrument";
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
  if (fs::is_regular_file(id_or_path)) {
    return id_or_path;
  }
  std::vector<std::string> ids;
  for (const Entry& entry : list(kind)) {
    if (entry.id == id_or_path) {
      return entry.file;
    }
    ids.push_back(entry.id);
  }
  throw InputError({.file = id_or_path},
                   fmt::format("a {} file, or one of the ids {}", noun(kind), fmt::join(ids, ", ")),
                   "nothing");
}

std::vector<Catalog::Entry> Catalog::list(Kind kind) const {
  std::map<std::string, fs::path> found;
  for (const fs::path& root : roots_) {
    collect(kind, root, found);
  }
  std::vector<Entry> entries;
  for (const auto& [id, file] : found) {
    entries.push_back({id, file});
  }
  return entries;
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
