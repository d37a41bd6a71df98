#include "emulator/core/catalog.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "emulator/core/input_error.hpp"
#include "tests/unit/message_of.hpp"
#include "tests/unit/temporary_folder.hpp"

namespace gonio {
namespace {

namespace fs = std::filesystem;
using test::message_of;
using test::TemporaryFolder;
using Kind = Catalog::Kind;

/// Sets $GONIO_DATA for a scope, or takes it away.
class GonioData {
 public:
  explicit GonioData(const std::optional<std::string>& value) {
    if (const char* old = std::getenv("GONIO_DATA")) {
      old_ = old;
    }
    set(value);
  }
  ~GonioData() { set(old_); }
  GonioData(const GonioData&) = delete;
  GonioData& operator=(const GonioData&) = delete;

 private:
  static void set(const std::optional<std::string>& value) {
    if (value) {
      setenv("GONIO_DATA", value->c_str(), 1);
    } else {
      unsetenv("GONIO_DATA");
    }
  }
  std::optional<std::string> old_;
};

/// A folder with standards and fixtures, and in it the samples named.
fs::path make_root(const fs::path& root, const std::vector<std::string>& samples) {
  fs::create_directories(root / "standards");
  fs::create_directories(root / "fixtures/samples");
  for (const std::string& id : samples) {
    std::ofstream(root / "fixtures/samples" / (id + ".yaml")) << "in " << root.filename().string();
  }
  return root;
}

std::vector<std::string> ids_of(const Catalog& catalog, Kind kind) {
  std::vector<std::string> ids;
  for (const Catalog::Entry& entry : catalog.list(kind)) {
    ids.push_back(entry.id);
  }
  return ids;
}

// Ids.

TEST(CatalogFind, TakesTheFirstRootThatHasTheId) {
  const TemporaryFolder folder;
  const fs::path one = make_root(folder.path() / "one", {"a"});
  const fs::path two = make_root(folder.path() / "two", {"a", "b"});
  const Catalog catalog({one, two});
  EXPECT_EQ(catalog.find(Kind::sample, "a"), one / "fixtures/samples/a.yaml");
  EXPECT_EQ(catalog.find(Kind::sample, "b"), two / "fixtures/samples/b.yaml");
  EXPECT_EQ(Catalog({two, one}).find(Kind::sample, "a"), two / "fixtures/samples/a.yaml");
}

TEST(CatalogFind, LetsAPathStandForItself) {
  const TemporaryFolder folder;
  const Catalog catalog({make_root(folder.path() / "root", {"a"})});
  const fs::path file = folder.file("mine.yaml", "x");
  EXPECT_EQ(catalog.find(Kind::sample, file.string()), file);
}

TEST(CatalogFind, ListsTheIdsThereAreWhenThereIsNone) {
  const TemporaryFolder folder;
  const Catalog catalog({make_root(folder.path() / "root", {"copper", "brass"})});
  EXPECT_EQ(message_of([&] { (void)catalog.find(Kind::sample, "gold"); }),
            "gold: expected a sample file, or one of the ids brass, copper, found nothing");
  EXPECT_EQ(message_of([&] { (void)catalog.find(Kind::sample, "samples/copper.yaml"); }),
            "samples/copper.yaml: expected a sample file, or one of the ids brass, copper, found "
            "nothing");
  EXPECT_THROW((void)catalog.find(Kind::instrument, "copper"), InputError);
  EXPECT_THROW((void)catalog.find(Kind::standard, "copper"), InputError);
}

TEST(CatalogFind, SaysThatAFolderIsNoFile) {
  const TemporaryFolder folder;
  const Catalog catalog({make_root(folder.path() / "root", {"copper"})});
  EXPECT_THAT(message_of([&] { (void)catalog.find(Kind::sample, folder.path().string()); }),
              testing::EndsWith("found 'a folder'"));
}

TEST(CatalogFind, BlamesThePlaceInAYamlFileThatNamesWhatIsNotThere) {
  const TemporaryFolder folder;
  const fs::path root = make_root(folder.path() / "root", {"copper"});
  const fs::path mine = folder.file("mine.yaml", "x");
  const auto found = [&](const Catalog& catalog, const std::string& text) {
    const YamlNode file = YamlNode::parse("x: " + text + "\n", folder.path() / "a.yaml");
    return catalog.find(Kind::sample, YamlMap(file).required("x"));
  };
  EXPECT_EQ(found(Catalog({root}), "copper"), root / "fixtures/samples/copper.yaml");
  EXPECT_EQ(found(Catalog({root}), "mine.yaml"), mine);
  EXPECT_THAT(message_of([&] { (void)found(Catalog({root}), "gold"); }),
              testing::EndsWith("/a.yaml:1:4: x: expected a sample file, or one of the ids copper, "
                                "found 'gold'"));
  EXPECT_THAT(message_of([&] { (void)found(Catalog(), "gold"); }),
              testing::EndsWith("/a.yaml:1:4: x: expected a sample file, found 'gold'"));
}

TEST(CatalogList, IsOrderedByIdAndHasEachOnce) {
  const TemporaryFolder folder;
  const Catalog catalog(
      {make_root(folder.path() / "one", {"c", "a"}), make_root(folder.path() / "two", {"b", "a"})});
  EXPECT_EQ(ids_of(catalog, Kind::sample), (std::vector<std::string>{"a", "b", "c"}));
  EXPECT_TRUE(catalog.list(Kind::instrument).empty());
}

TEST(CatalogList, TakesOnlyYamlFiles) {
  const TemporaryFolder folder;
  const fs::path root = make_root(folder.path() / "root", {"a"});
  std::ofstream(root / "fixtures/samples/README.md") << "text";
  EXPECT_EQ(ids_of(Catalog({root}), Kind::sample), std::vector<std::string>{"a"});
}

TEST(Catalog, HasAFolderForEachKind) {
  const TemporaryFolder folder;
  const fs::path root = make_root(folder.path() / "root", {});
  for (const char* name : {"instruments", "batches"}) {
    fs::create_directories(root / "fixtures" / name);
    std::ofstream(root / "fixtures" / name / (std::string("of_") + name + ".yaml")) << "text";
  }
  EXPECT_EQ(ids_of(Catalog({root}), Kind::instrument), std::vector<std::string>{"of_instruments"});
  EXPECT_EQ(ids_of(Catalog({root}), Kind::batch), std::vector<std::string>{"of_batches"});
  EXPECT_TRUE(ids_of(Catalog({root}), Kind::sample).empty());
}

TEST(CatalogList, FindsStandardsByFamilyAndEdition) {
  const TemporaryFolder folder;
  const fs::path root = make_root(folder.path() / "root", {});
  fs::create_directories(root / "standards/iso_2813/2014");
  fs::create_directories(root / "standards/iso_2813/draft");  // holds no standard.yaml
  fs::create_directories(root / "standards/schema");
  std::ofstream(root / "standards/README.md") << "text";
  std::ofstream(root / "standards/iso_2813/2014/standard.yaml") << "x";
  EXPECT_EQ(ids_of(Catalog({root}), Kind::standard), std::vector<std::string>{"iso_2813/2014"});
  EXPECT_EQ(Catalog({root}).find(Kind::standard, "iso_2813/2014"),
            root / "standards/iso_2813/2014/standard.yaml");
}

TEST(CatalogFixture, IsFoundInTheFirstRootThatHasIt) {
  const TemporaryFolder folder;
  const fs::path one = make_root(folder.path() / "one", {});
  const fs::path two = make_root(folder.path() / "two", {"a"});
  EXPECT_EQ(Catalog({one, two}).fixture("samples/a.yaml"), two / "fixtures/samples/a.yaml");
  EXPECT_EQ(message_of([&] { (void)Catalog({one}).fixture("observers/x.csv"); }),
            "fixtures/observers/x.csv: expected a file in a data folder, found nothing");
}

// Places. The source tree is the last of them, if it holds this test program.

bool is_built_in_the_source_tree() {
  const std::string program = fs::read_symlink("/proc/self/exe").string();
  return program.starts_with(fs::canonical(GONIO_SOURCE_DIR).string() + "/");
}

TEST(CatalogStandardPlaces, HaveTheSourceTreeThatHoldsTheProgram) {
  if (!is_built_in_the_source_tree()) {
    GTEST_SKIP() << "built elsewhere";
  }
  const GonioData none(std::nullopt);
  EXPECT_EQ(Catalog::standard_places().find(Kind::standard, "iso_2813/2014"),
            fs::path(GONIO_SOURCE_DIR) / "standards/iso_2813/2014/standard.yaml");
}

TEST(CatalogStandardPlaces, HaveGonioDataBeforeTheSourceTree) {
  if (!is_built_in_the_source_tree()) {
    GTEST_SKIP() << "built elsewhere";
  }
  const TemporaryFolder folder;
  const fs::path root = make_root(folder.path() / "root", {"copper_polished"});
  const GonioData data(root.string());
  const Catalog catalog = Catalog::standard_places();
  EXPECT_EQ(catalog.find(Kind::sample, "copper_polished"),
            root / "fixtures/samples/copper_polished.yaml");
  EXPECT_EQ(catalog.find(Kind::sample, "pmma"),
            fs::path(GONIO_SOURCE_DIR) / "fixtures/samples/pmma.yaml");
}

TEST(CatalogStandardPlaces, HaveTheFolderGivenBeforeGonioData) {
  const TemporaryFolder folder;
  const fs::path given = make_root(folder.path() / "given", {"a"});
  const fs::path set = make_root(folder.path() / "set", {"a", "b"});
  const GonioData data(set.string());
  const Catalog catalog = Catalog::standard_places(given);
  EXPECT_EQ(catalog.find(Kind::sample, "a"), given / "fixtures/samples/a.yaml");
  EXPECT_EQ(catalog.find(Kind::sample, "b"), set / "fixtures/samples/b.yaml");
}

TEST(Catalog, NamesFilesBelowItsFolders) {
  const Catalog catalog({"/data"});
  EXPECT_EQ(catalog.name_of("/data/standards/iso/1/cases/../clauses.yaml"),
            "standards/iso/1/clauses.yaml");
  EXPECT_EQ(catalog.name_of("/elsewhere/mine.yaml"), "/elsewhere/mine.yaml");
  EXPECT_EQ(catalog.name_of("modbus://127.0.0.1:502"), "modbus://127.0.0.1:502");
}

TEST(CatalogStandardPlaces, TakeAnEmptyGonioDataForNone) {
  const GonioData empty("");
  EXPECT_NO_THROW((void)Catalog::standard_places());
}

TEST(CatalogStandardPlaces, RefuseAFolderWithoutData) {
  const TemporaryFolder folder;
  const std::string path = folder.path().string();
  const GonioData none(std::nullopt);
  EXPECT_EQ(message_of([&] { (void)Catalog::standard_places(path); }),
            path + ": expected a folder with standards and fixtures, found 'something else'");
  EXPECT_EQ(message_of([&] { (void)Catalog::standard_places(path + "/no"); }),
            path + "/no: expected a folder with standards and fixtures, found nothing");
  const GonioData wrong(path);
  EXPECT_THROW((void)Catalog::standard_places(), InputError);
}

}  // namespace
}  // namespace gonio
