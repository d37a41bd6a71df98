#include "emulator/core/yaml_map.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/unit/message_of.hpp"
#include "tests/unit/temporary_folder.hpp"

namespace gonio {
namespace {

using test::message_of;
using test::TemporaryFolder;
using testing::EndsWith;
using testing::StartsWith;

YamlNode parse(const std::string& text) { return YamlNode::parse(text, "a.yaml"); }
std::string parse_error(const std::string& text) {
  return message_of([&] { (void)parse(text); });
}

/// The message of `read(node)` for the value of the key `x` in a file that holds only it.
template <class Read>
std::string value_error(const std::string& value, Read read) {
  const YamlNode root = parse("x: " + value + "\n");
  return message_of([&] {
    (void)YamlMap(root).required("x");
    read(YamlMap(root).required("x"));
  });
}

YamlNode value(const std::string& text) {
  const YamlNode root = parse("x: " + text + "\n");
  return YamlMap(root).required("x");
}

// The dialect: what is refused when the file is loaded.

TEST(YamlNodeLoad, RefusesADoubledKeyAtItsSecondPlace) {
  EXPECT_EQ(parse_error("a: 1\nb:\n  c: 1\n  c: 2\n"),
            "a.yaml:4:3: b.c: expected each key once, found 'the key 'c' a second time'");
  EXPECT_EQ(parse_error("\"a\": 1\na: 2\n"),
            "a.yaml:2:1: a: expected each key once, found 'the key 'a' a second time'");
}

TEST(YamlNodeLoad, RefusesAnchorsAndAliases) {
  EXPECT_EQ(parse_error("a: &x 1\n"),
            "a.yaml:1:4: expected a value without an anchor, found 'an anchor'");
  EXPECT_EQ(parse_error("a: &x [1]\n"),
            "a.yaml:1:4: expected a value without an anchor, found 'an anchor'");
  EXPECT_THAT(parse_error("a: *x\n"), StartsWith("a.yaml:1:4: expected"));
}

TEST(YamlNodeLoad, RefusesABillionLaughsAtTheFirstOne) {
  std::string text = "a: &a [lol,lol,lol,lol,lol,lol,lol,lol,lol]\n";
  for (char c = 'b'; c < 'k'; ++c) {
    const std::string alias = std::string("*") + char(c - 1);
    text += std::string(1, c) + ": &" + c + " [" + alias;
    for (int i = 0; i < 8; ++i) {
      text += "," + alias;
    }
    text += "]\n";
  }
  EXPECT_EQ(parse_error(text), "a.yaml:1:4: expected a value without an anchor, found 'an anchor'");
}

TEST(YamlNodeLoad, RefusesTags) {
  EXPECT_EQ(parse_error("a: !secret 1\n"),
            "a.yaml:1:4: expected a value without a tag, found '!secret'");
  EXPECT_EQ(parse_error("a: !!float 1\n"),
            "a.yaml:1:4: expected a value without a tag, found 'tag:yaml.org,2002:float'");
  EXPECT_EQ(parse_error("a: !!set {b: 1}\n"),
            "a.yaml:1:4: expected a value without a tag, found 'tag:yaml.org,2002:set'");
}

TEST(YamlNodeLoad, TakesQuotedTextForUntagged) { EXPECT_EQ(value("'1.5'").number(), 1.5); }

TEST(YamlNodeLoad, RefusesNestingDeeperThan64Levels) {
  const auto nested = [](int levels) {
    return std::string(std::size_t(levels), '[') + "1" + std::string(std::size_t(levels), ']');
  };
  EXPECT_EQ(parse_error(nested(64)), "no error");
  EXPECT_EQ(parse_error(nested(65)),
            "a.yaml:1:65: expected nesting of at most 64 levels, found 'more'");
  EXPECT_EQ(parse_error(nested(100'000)),
            "a.yaml:1:65: expected nesting of at most 64 levels, found 'more'");
}

TEST(YamlNodeLoad, RefusesDeepNestingOfEveryKind) {
  std::string blocks;
  std::string maps;
  for (int i = 0; i < 2000; ++i) {
    blocks += "- ";
    maps += "{a: ";
  }
  EXPECT_THAT(parse_error(blocks), StartsWith("a.yaml:1:129: expected nesting of at most 64"));
  EXPECT_THAT(parse_error(maps + "1" + std::string(2000, '}')),
              StartsWith("a.yaml:1:257: expected nesting of at most 64"));
}

TEST(YamlNodeLoad, RefusesMoreThanAMillionValues) {
  std::string text = "[";
  for (int i = 0; i < 1'000'000; ++i) {
    text += "0,";
  }
  EXPECT_EQ(parse_error(text + "0]"),
            "a.yaml:1:2000000: expected at most 1000000 values, found 'more'");
}

TEST(YamlNodeLoad, RefusesASecondDocument) {
  EXPECT_EQ(parse_error("a: 1\n---\nb: 2\n"),
            "a.yaml:2:1: expected one document in the file, found 'a second document'");
}

TEST(YamlNodeLoad, RefusesAKeyThatIsNotText) {
  EXPECT_EQ(parse_error("? [1, 2]\n: 3\n"),
            "a.yaml:1:3: expected a key that is text, found 'a list or a map'");
}

TEST(YamlNodeLoad, RefusesTextThatIsNotYaml) {
  EXPECT_EQ(parse_error("a: {b: 1, c: 2\n"),
            "a.yaml:2:1: expected YAML, found 'end of map flow not found'");
  EXPECT_EQ(parse_error("a: [1, 2\n"),
            "a.yaml:2:1: expected YAML, found 'end of sequence flow not found'");
  EXPECT_THAT(parse_error("a: 1\n b: 2\n"), StartsWith("a.yaml:2:3: expected YAML, found '"));
  EXPECT_EQ(parse_error("a: {b: 1}}\n"), "a.yaml:1:10: expected YAML, found 'illegal flow end'");
}

TEST(YamlNodeLoad, RefusesAQuotationThatNobodyClosed) {
  for (const std::string quote : {"'", "\""}) {
    for (const std::string end : {"", "\n", "\n\n", "\nb: 2\n", "\r\n"}) {
      const std::string text = fmt::format("a: {}open{}", quote, end);
      EXPECT_THAT(parse_error(text), EndsWith("expected YAML, found 'illegal EOF in scalar'"))
          << text;
    }
  }
}

TEST(YamlNodeLoad, RefusesAFileWithoutValues) {
  EXPECT_EQ(parse_error("# only a comment\n"),
            "a.yaml:1:1: expected YAML with content, found nothing");
  EXPECT_EQ(parse_error(""), "a.yaml:1:1: expected YAML with content, found nothing");
}

TEST(YamlNodeLoad, RefusesAMissingAndAnEmptyFile) {
  EXPECT_EQ(message_of([] { (void)YamlNode::load("no/such.yaml"); }),
            "no/such.yaml: expected a file, found nothing");
  const TemporaryFolder folder;
  const auto path = folder.file("empty.yaml", "\n");
  EXPECT_EQ(message_of([&] { (void)YamlNode::load(path); }),
            path.string() + ": expected a file with content, found 'an empty file'");
}

TEST(YamlNodeLoad, NamesTheFileInItsMessages) {
  const TemporaryFolder folder;
  const auto path = folder.file("s.yaml",
                                "\xEF\xBB\xBF"
                                "a: many\n");
  const YamlNode root = YamlNode::load(path);
  EXPECT_EQ(message_of([&] { (void)YamlMap(root).required("a").number(); }),
            path.string() + ":1:4: a: expected a number, found 'many'");
}

TEST(YamlNodeLoad, RefusesBytesThatAreNoText) {
  const std::string expected = "expected UTF-8 text without control characters, found 'the ";
  EXPECT_EQ(parse_error("a: 1\nb: \xff\n"), "a.yaml:2:4: " + expected + "byte 0xFF'");
  EXPECT_EQ(parse_error("# \xe9\na: 1\n"), "a.yaml:1:3: " + expected + "byte 0xE9'");
  EXPECT_EQ(parse_error("a: \x07\n"), "a.yaml:1:4: " + expected + "control character U+0007'");
  EXPECT_EQ(parse_error("a: 1\nb: \"\\a\"\n"),
            "a.yaml:2:4: " + expected + "control character U+0007'");
  EXPECT_EQ(parse_error("a: \"\u010e, a tab\\t and a line\\n\"\r\n"), "no error");
}

// Scalars.

TEST(YamlNodeNumber, ReadsNumbersInRange) {
  EXPECT_EQ(value("1.567").number(), 1.567);
  EXPECT_EQ(value("-2e-3").number(), -2e-3);
  EXPECT_EQ(value("+2").number(), 2.0);
  EXPECT_EQ(value("0").number(Range::not_negative()), 0.0);
}

TEST(YamlNodeNumber, SaysWhatItExpectedAndWhatItFound) {
  const auto positive = [](const YamlNode& node) { (void)node.number(Range::positive()); };
  EXPECT_EQ(value_error("-0.1", positive), "a.yaml:1:4: x: expected a number > 0, found '-0.1'");
  EXPECT_EQ(value_error(".nan", positive), "a.yaml:1:4: x: expected a number > 0, found '.nan'");
  EXPECT_EQ(value_error("NaN", positive), "a.yaml:1:4: x: expected a number > 0, found 'NaN'");
  EXPECT_EQ(value_error("inf", positive), "a.yaml:1:4: x: expected a number > 0, found 'inf'");
  EXPECT_EQ(value_error("0,5", positive), "a.yaml:1:4: x: expected a number > 0, found '0,5'");
  EXPECT_EQ(value_error("1 deg", positive), "a.yaml:1:4: x: expected a number > 0, found '1 deg'");
  EXPECT_EQ(value_error("", positive), "a.yaml:1:1: x: expected a number > 0, found nothing");
  EXPECT_EQ(value_error("[1]", positive), "a.yaml:1:4: x: expected a number > 0, found 'a list'");
  EXPECT_EQ(value_error("{a: 1}", positive), "a.yaml:1:4: x: expected a number > 0, found 'a map'");
}

TEST(YamlNodeNumber, PlacesAMissingValueAtItsKey) {
  const YamlNode root = parse("a:\nb:\n  c:\n\n  d: 1\n");
  EXPECT_EQ(message_of([&] { (void)YamlMap(root).required("a").number(); }),
            "a.yaml:1:1: a: expected a number, found nothing");
  EXPECT_EQ(message_of([&] { (void)YamlMap(YamlMap(root).required("b")).required("c").number(); }),
            "a.yaml:3:3: b.c: expected a number, found nothing");
}

TEST(YamlNodeQuantity, ReadsEachDimension) {
  EXPECT_DOUBLE_EQ(value("60 deg").angle().degrees(), 60.0);
  EXPECT_DOUBLE_EQ(value("1 rad").angle().radians(), 1.0);
  EXPECT_EQ(value("550 nm").length(), nanometres(550));
  EXPECT_EQ(value("2 um").length(), micrometres(2));
  EXPECT_EQ(value("0.1 GU").gloss_gu(), 0.1);
  EXPECT_EQ(value("10 ms").time_s(), 0.01);
  EXPECT_EQ(value("23.5 degC").temperature_c(), 23.5);
  EXPECT_EQ(value("6 K").temperature_difference_k(), 6.0);
}

TEST(YamlNodeQuantity, RefusesAWrongUnitAndAMissingOne) {
  const auto angle = [](const YamlNode& node) { (void)node.angle(); };
  EXPECT_EQ(value_error("60 nm", angle),
            "a.yaml:1:4: x: expected an angle (deg, rad, mrad), found '60 nm'");
  EXPECT_EQ(value_error("60", angle),
            "a.yaml:1:4: x: expected an angle (deg, rad, mrad), found '60'");
  EXPECT_EQ(value_error("0.05", [](const YamlNode& node) { (void)node.gloss_gu(); }),
            "a.yaml:1:4: x: expected a gloss value (GU), found '0.05'");
}

TEST(YamlNodeQuantity, TakesRangesInTheUnitThatIsShown) {
  const Range quarter = Range::closed(0, 90);
  EXPECT_DOUBLE_EQ(value("90 deg").angle(quarter).degrees(), 90.0);
  EXPECT_EQ(value_error("91 deg", [&](const YamlNode& node) { (void)node.angle(quarter); }),
            "a.yaml:1:4: x: expected an angle (deg, rad, mrad) in [0, 90], found '91 deg'");
  EXPECT_EQ(value_error("2 um", [](const YamlNode& n) { (void)n.length(Range::closed(0, 1000)); }),
            "a.yaml:1:4: x: expected a length (nm, um, mm) in [0, 1000], found '2 um'");
}

TEST(YamlNodeInteger, ReadsWholeNumbersInRange) {
  EXPECT_EQ(value("502").integer(1, 65535), 502);
  const auto port = [](const YamlNode& node) { (void)node.integer(1, 65535); };
  for (const std::string text : {"0", "65536", "1.5", "1e99", "-1", "many"}) {
    EXPECT_EQ(value_error(text, port),
              "a.yaml:1:4: x: expected a whole number in [1, 65535], found '" + text + "'");
  }
}

TEST(YamlNodeBoolean, IsTrueOrFalseAndNothingElse) {
  EXPECT_TRUE(value("true").boolean());
  EXPECT_FALSE(value("false").boolean());
  const auto boolean = [](const YamlNode& node) { (void)node.boolean(); };
  for (const std::string text : {"yes", "True", "1", "on"}) {
    EXPECT_EQ(value_error(text, boolean),
              "a.yaml:1:4: x: expected one of true, false, found '" + text + "'");
  }
}

TEST(YamlNodeChoice, ListsTheChoices) {
  EXPECT_EQ(value("ggx").choice({"ward", "ggx"}), "ggx");
  EXPECT_EQ(value_error("phong",
                        [](const YamlNode& n) {
                          (void)n.choice({"ward", "ggx"});
                        }),
            "a.yaml:1:4: x: expected one of ward, ggx, found 'phong'");
}

TEST(YamlNodeText, IsAScalarThatIsNotEmpty) {
  EXPECT_EQ(value("Polished copper").text(), "Polished copper");
  EXPECT_EQ(value("'5.10'").text(), "5.10");
  const auto text = [](const YamlNode& node) { (void)node.text(); };
  EXPECT_EQ(value_error("''", text), "a.yaml:1:4: x: expected text, found nothing");
  EXPECT_EQ(value_error("[a]", text), "a.yaml:1:4: x: expected text, found 'a list'");
}

TEST(YamlNodeLine, IsTextWithoutTabsAndLineBreaks) {
  EXPECT_EQ(value("Polished copper, Ďurikovič").line(), "Polished copper, Ďurikovič");
  const auto line = [](const YamlNode& node) { (void)node.line(); };
  for (const std::string text : {"\"a\\tb\"", "\"a\\nb\"", "\"a\\rb\""}) {
    EXPECT_EQ(value_error(text, line),
              "a.yaml:1:4: x: expected text in one line, without tabs, found 'a b'");
  }
}

TEST(YamlNodeId, IsOfLettersDigitsAndThreeSigns) {
  for (const std::string text : {"copper_polished", "my-paint", "0.001000", "RAL9005"}) {
    EXPECT_EQ(value("'" + text + "'").id(), text);
  }
  EXPECT_EQ(value(std::string(64, 'a')).id().size(), 64u);
  const auto id = [](const YamlNode& node) { (void)node.id(); };
  const std::string too_long(65, 'a');
  for (const std::string& text :
       {std::string("my paint"), std::string("a,b"), std::string("ä"), too_long}) {
    EXPECT_THAT(value_error(text, id),
                StartsWith("a.yaml:1:4: x: expected an id of letters, digits, '_', '-' and '.', "))
        << text;
  }
}

TEST(YamlNodeFile, IsThereOrBlamesThePlaceThatNamesIt) {
  const TemporaryFolder folder;
  const auto file = folder.file("b.csv", "1\n");
  const auto error = [&](const std::string& named) {
    const YamlNode root = YamlNode::parse("x: " + named + "\n", folder.path() / "a.yaml");
    const std::string message = message_of([&] { (void)YamlMap(root).required("x").file(); });
    return message.substr(message.find(":1:"));
  };
  EXPECT_EQ(value(file.string()).file(), file);
  EXPECT_EQ(error("c.csv"), ":1:4: x: expected a file, found 'c.csv'");
  EXPECT_EQ(error("."), ":1:4: x: expected a file, found 'a folder'");
}

TEST(YamlNodeFilePath, IsRelativeToTheFolderOfTheFileThatNamesIt) {
  const YamlNode root = YamlNode::parse("x: ../nk/Cu.yml\ny: /abs/a.csv\n", "data/samples/a.yaml");
  YamlMap map(root);
  EXPECT_EQ(map.required("x").file_path(), "data/nk/Cu.yml");
  EXPECT_EQ(map.required("y").file_path(), "/abs/a.csv");
}

// Lists and maps.

TEST(YamlNodeList, GivesItsItemsWithTheirPlaces) {
  const std::vector<YamlNode> items = value("[1, two, 3]").list();
  ASSERT_EQ(items.size(), 3U);
  EXPECT_EQ(items[0].number(), 1.0);
  EXPECT_EQ(message_of([&] { (void)items[1].number(); }),
            "a.yaml:1:8: x[1]: expected a number, found 'two'");
}

TEST(YamlNodeList, RefusesWhatIsNoListAndAnEmptyOne) {
  const auto list = [](const YamlNode& node) { (void)node.list(); };
  EXPECT_EQ(value_error("1", list),
            "a.yaml:1:4: x: expected a list of at least one item, found '1'");
  EXPECT_EQ(value_error("[]", list),
            "a.yaml:1:4: x: expected a list of at least one item, found 'a list'");
}

TEST(YamlNodeList, MayBeEmptyWhereThatIsAskedFor) {
  EXPECT_TRUE(value("[]").list_or_empty().empty());
  EXPECT_EQ(value("[1, 2]").list_or_empty().size(), 2U);
  EXPECT_EQ(value_error("1", [](const YamlNode& node) { (void)node.list_or_empty(); }),
            "a.yaml:1:4: x: expected a list, found '1'");
}

TEST(YamlNodeEntries, ComeInTheOrderOfTheFileWithTheirKeys) {
  std::vector<std::string> keys;
  parse("'60': 1\n'20': 2\n'85': 3\n")
      .for_each_entry([&](const std::string& key, const YamlNode& node) {
        keys.push_back(key + "=" + node.text());
      });
  EXPECT_EQ(keys, (std::vector<std::string>{"60=1", "20=2", "85=3"}));
}

TEST(YamlNode, KeepsItsFileAlive) {
  const YamlNode node = [] { return value("{deep: [1, {er: 7}]}"); }();
  const YamlNode list = YamlMap(node).required("deep");
  EXPECT_EQ(YamlMap(list.list()[1]).required("er").number(), 7.0);
}

TEST(YamlMap, PlacesAnUnknownKeyAndListsTheKnownOnes) {
  const YamlNode root = parse("surface:\n  model: ggx\n  alfa: 0.1\n");
  const auto read = [](const YamlNode& node) {
    return node.read_map([](YamlMap& map) {
      (void)map.optional("alpha");
      return map.required("model").text();
    });
  };
  EXPECT_EQ(message_of([&] { (void)read(YamlMap(root).required("surface")); }),
            "a.yaml:3:3: surface.alfa: expected one of the keys alpha, model, found 'alfa'");
}

TEST(YamlMap, PlacesAMissingKeyAndListsThoseThatAreThere) {
  const YamlNode root = parse("surface:\n  model: ggx\n  k: 1\n");
  EXPECT_EQ(message_of([&] { (void)YamlMap(YamlMap(root).required("surface")).required("alpha"); }),
            "a.yaml:2:3: surface.alpha: expected the key 'alpha', found 'only model, k'");
}

TEST(YamlMap, RefusesAListAndAScalar) {
  EXPECT_EQ(message_of([] { YamlMap(parse("- a\n- b\n")); }),
            "a.yaml:1:1: expected a map of keys and values, found 'a list'");
  EXPECT_EQ(message_of([] { YamlMap(value("5")); }),
            "a.yaml:1:4: x: expected a map of keys and values, found '5'");
  EXPECT_EQ(message_of([] { parse("x").for_each_entry([](const auto&, const auto&) {}); }),
            "a.yaml:1:1: expected a map of keys and values, found 'x'");
}

TEST(YamlMap, CountsAKeyAsAskedForWhetherItIsThereOrNot) {
  const auto read = [](YamlMap& map) {
    EXPECT_TRUE(map.has("a"));
    EXPECT_FALSE(map.has("b"));
    EXPECT_EQ(map.optional("b"), std::nullopt);
    return true;
  };
  EXPECT_TRUE(parse("a: 1\n").read_map(read));
}

TEST(YamlMap, IgnoresTheKeysOfOthersWhenTold) {
  const auto read = [](YamlMap& map) {
    map.ignore_others();
    return map.required("DATA").number();
  };
  EXPECT_EQ(parse("REFERENCES: text\nDATA: 3\n").read_map(read), 3.0);
}

TEST(YamlMap, ExpectsTheSchemaFirst) {
  const auto error = [](const std::string& text) {
    const YamlNode root = parse(text);
    return message_of([&] { YamlMap(root).expect_schema("gonio/sample/1"); });
  };
  EXPECT_EQ(error("schema: gonio/sample/1\nid: a\n"), "no error");
  EXPECT_EQ(error("schema: gonio/sample/2\nid: a\n"),
            "a.yaml:1:9: schema: expected gonio/sample/1, found 'gonio/sample/2'");
  EXPECT_EQ(error("id: a\nschema: gonio/sample/1\n"),
            "a.yaml:1:1: id: expected the key 'schema' first, found 'id'");
  EXPECT_EQ(error("id: a\n"), "a.yaml:1:1: schema: expected the key 'schema', found 'only id'");
}

TEST(YamlMap, GivesThePathOfKeysThroughListsAndMaps) {
  const YamlNode root = parse("clauses:\n  - id: a\n    limits:\n      - {tolerance: x}\n");
  const YamlNode clause = YamlMap(root).required("clauses").list().front();
  const YamlNode limit = YamlMap(clause).required("limits").list().front();
  EXPECT_EQ(message_of([&] { (void)YamlMap(limit).required("tolerance").number(); }),
            "a.yaml:4:21: clauses[0].limits[0].tolerance: expected a number, found 'x'");
}

}  // namespace
}  // namespace gonio
