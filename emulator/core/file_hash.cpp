#include "emulator/core/file_hash.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "emulator/core/sha256.hpp"
#include "emulator/core/text_file.hpp"
#include "emulator/core/yaml_map.hpp"

namespace gonio {

namespace {

/// Adds what `node` and all below it name; nesting is at most 64 deep.
void collect_files(const YamlNode& node, std::vector<std::filesystem::path>& files) {
  if (node.is_list()) {
    for (const YamlNode& item : node.list_or_empty()) {
      collect_files(item, files);
    }
  } else if (node.is_map()) {
    node.for_each_entry([&](const std::string& key, const YamlNode& value) {
      if (key != "file" || !value.is_scalar()) {
        collect_files(value, files);
      } else if (const auto path = value.file(); std::ranges::find(files, path) == files.end()) {
        files.push_back(path);
      }
    });
  }
}

}  // namespace

std::vector<std::filesystem::path> files_of(const std::filesystem::path& yaml) {
  std::vector<std::filesystem::path> files{yaml};
  collect_files(YamlNode::load(yaml), files);
  return files;
}

std::string hash_of_file(const std::filesystem::path& yaml) {
  // The names need not be hashed: they stand in the text of the first file.
  std::string hashes;
  for (const std::filesystem::path& file : files_of(yaml)) {
    hashes += sha256(read_text_file(file)) + "\n";
  }
  return sha256(hashes);
}

}  // namespace gonio
