#include "emulator/instrument/overlay.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "emulator/core/text_file.hpp"
#include "emulator/instrument/setup.hpp"
#include "tests/unit/message_of.hpp"
#include "tests/unit/standard/shipped_standards.hpp"
#include "tests/unit/temporary_folder.hpp"

namespace gonio {
namespace {

using test::message_of;
using test::replaced;
using test::shipped;
using test::shipped_standard;
using test::source_tree;
using test::TemporaryFolder;
using enum SetupQuantity;

Instrument shipped_instrument(const std::string& id) {
  return load_instrument(shipped().find(Catalog::Kind::instrument, id), shipped());
}

Instrument laid_over(const Instrument& instrument, const std::string& text) {
  return with_overlay(instrument, YamlNode::parse(text, "case.yaml"), shipped());
}

std::string error_of(const std::string& text) {
  return message_of(
      [&] { (void)laid_over(nominal_instrument(shipped_standard("iso_2813/2014")), text); });
}

void expect_same_spectrum(const SpectralTable& a, const SpectralTable& b) {
  for (int nm = 380; nm <= 780; nm += 5) {
    ASSERT_EQ(a.at(nanometres(nm)), b.at(nanometres(nm))) << nm << " nm";
  }
}

/// All that an overlay can change.
void expect_same(const Instrument& a, const Instrument& b) {
  EXPECT_EQ(a.geometries, b.geometries);
  for (const std::string& id : a.geometries) {
    for (std::size_t i = 0; i < setup_quantity_count; ++i) {
      EXPECT_EQ(as_built(a, id, SetupQuantity(i)), as_built(b, id, SetupQuantity(i)))
          << id << ' ' << setup_quantity_names[i];
    }
  }
  EXPECT_EQ(a.setup_uncertainty, b.setup_uncertainty);
  EXPECT_EQ(a.polarization, b.polarization);
  EXPECT_EQ(a.beam, b.beam);
  expect_same_spectrum(a.source, b.source);
  expect_same_spectrum(a.responsivity, b.responsivity);
  EXPECT_EQ(a.behaviour, b.behaviour);
  EXPECT_EQ(a.samples, b.samples);
}

std::optional<StatedAngle> stated(double value_deg, double uncertainty_deg) {
  return StatedAngle{.value = degrees(value_deg), .expanded_uncertainty = degrees(uncertainty_deg)};
}

TEST(Overlay, OfNothingIsTheIdentity) {
  for (const char* id : {"triangle_gloss", "paper_setup", "pocket_gloss_60"}) {
    const Instrument instrument = shipped_instrument(id);
    expect_same(laid_over(instrument, "{}"), instrument);
  }
}

TEST(Overlay, EqualToAFileGivesItsInstrument) {
  const std::string file = read_text_file(source_tree / "fixtures/instruments/triangle_gloss.yaml");
  const std::size_t as_built = file.find("as_built:");
  const std::size_t identity = file.find("identity:");
  const std::size_t behaviour = file.find("behaviour:");
  const TemporaryFolder folder;
  const std::string fixtures = (source_tree / "fixtures").string();
  std::string text = file.substr(as_built, identity - as_built) + file.substr(behaviour);
  text = replaced(text, "../illuminants", "'" + fixtures + "/illuminants");
  text = replaced(text, "led_b5.csv", "led_b5.csv'");
  text = replaced(text, "../observers", "'" + fixtures + "/observers");
  text = replaced(text, "v_lambda.csv", "v_lambda.csv'");
  const YamlNode overlay = YamlNode::load(folder.file("overlay.yaml", text));
  const Instrument triangle = shipped_instrument("triangle_gloss");
  expect_same(with_overlay(nominal_instrument(triangle.standard), overlay, shipped()), triangle);
  expect_same(with_overlay(triangle, overlay, shipped()), triangle);
}

TEST(Overlay, KeepsWhatTheInstrumentIs) {
  const Instrument triangle = shipped_instrument("triangle_gloss");
  const Instrument changed = laid_over(triangle, "repeatability: 1 GU");
  EXPECT_EQ(changed.id, "triangle_gloss");
  EXPECT_EQ(changed.file, triangle.file);
  EXPECT_EQ(changed.identity.model, "Triangle Gloss");
  EXPECT_EQ(changed.standard.id, "iso_2813/2014");
}

TEST(Overlay, MergesAsBuiltByGeometryAndQuantity) {
  const Instrument changed =
      laid_over(shipped_instrument("triangle_gloss"),
                "as_built: {\"60\": {theta_i: {value: 60.2 deg, expanded_uncertainty: 0.03 deg},\n"
                "                    receptor: {in_plane: 4.6 deg}}}\n");
  EXPECT_EQ(as_built(changed, "60", theta_i), stated(60.2, 0.03));
  EXPECT_EQ(as_built(changed, "60", theta_r), stated(59.97, 0.01));
  EXPECT_EQ(as_built(changed, "60", receptor_in_plane), stated(4.6, 0.01));
  EXPECT_EQ(as_built(changed, "60", receptor_perpendicular), stated(11.62, 0.01));
  EXPECT_EQ(as_built(changed, "60", source_in_plane), stated(0.8, 0.01));
  EXPECT_EQ(as_built(changed, "20", theta_i), stated(19.97, 0.01));
}

TEST(Overlay, TakesTheUncertaintyAwayWithTheValueThatItReplaces) {
  const Instrument known =
      laid_over(nominal_instrument(shipped_standard("iso_2813/2014")),
                "as_built: {\"60\": {theta_i: {value: 60.1 deg, expanded_uncertainty: 0.03 deg}}}");
  EXPECT_EQ(as_built(laid_over(known, "as_built: {\"60\": {theta_i: 60.2 deg}}"), "60", theta_i),
            stated(60.2, 0.0));
}

TEST(Overlay, OfAnotherShapeTakesThePlaceOfAllSizes) {
  const Instrument nominal = nominal_instrument(shipped_standard("iso_2813/2014"));
  const Instrument round = laid_over(shipped_instrument("triangle_gloss"),
                                     "as_built: {\"60\": {receptor: {diameter: 5 deg}}}");
  EXPECT_EQ(as_built(round, "60", receptor_diameter), stated(5.0, 0.01));
  EXPECT_EQ(as_built(round, "60", receptor_in_plane), std::nullopt);
  const Instrument again =
      laid_over(round, "as_built: {\"60\": {receptor: {perpendicular: 11 deg}}}");
  EXPECT_EQ(as_built(again, "60", receptor_diameter), std::nullopt);
  EXPECT_EQ(as_built(again, "60", receptor_perpendicular), stated(11.0, 0.01));
  EXPECT_EQ(as_built(again, "60", receptor_in_plane), as_built(nominal, "60", receptor_in_plane));
}

TEST(Overlay, MergesTheUncertaintyOfTheSetUp) {
  const Instrument changed =
      laid_over(shipped_instrument("triangle_gloss"), "setup_uncertainty: {angles: 0.05 deg}");
  EXPECT_EQ(as_built(changed, "60", theta_i), stated(60.04, 0.05));
  EXPECT_EQ(as_built(changed, "60", source_in_plane), stated(0.8, 0.01));
}

TEST(Overlay, MergesTheUncertaintyOfComponents) {
  const auto u_of = [](const Instrument& instrument, UncertaintyComponent component) {
    return instrument.uncertainty->components.at(component).at("60").standard_uncertainty;
  };
  const Instrument one = laid_over(nominal_instrument(shipped_standard("iso_2813/2014")),
                                   "uncertainty: {zero: {standard_uncertainty: 0.1 GU}}");
  const Instrument two = laid_over(one, "uncertainty: {drift: {standard_uncertainty: 0.002}}");
  EXPECT_EQ(u_of(two, UncertaintyComponent::zero), 0.1);
  EXPECT_EQ(u_of(two, UncertaintyComponent::drift), 0.002);
  EXPECT_EQ(u_of(laid_over(two, "uncertainty: {zero: {standard_uncertainty: 0 GU}}"),
                 UncertaintyComponent::zero),
            0.0);
}

TEST(Overlay, SetsThePolarizationOfAllGeometriesOrOfThoseNamed) {
  using Polarization = std::map<std::string, double>;
  const Instrument pocket = laid_over(shipped_instrument("pocket_gloss_60"), "polarization: 0.01");
  EXPECT_EQ(pocket.polarization, (Polarization{{"60", 0.01}}));
  const Instrument triangle =
      laid_over(shipped_instrument("triangle_gloss"), "polarization: {\"60\": 0.02, \"85\": -1}");
  EXPECT_EQ(triangle.polarization, (Polarization{{"60", 0.02}, {"85", -1.0}}));
  const Instrument changed = laid_over(triangle, "polarization: {\"60\": 0.03}");
  EXPECT_EQ(changed.polarization, (Polarization{{"60", 0.03}, {"85", -1.0}}));
}

TEST(Overlay, ReplacesASpectrumByAFileBesideItself) {
  const TemporaryFolder folder;
  (void)folder.file("lamp.csv", "wavelength_nm,value\n380,1\n580,3\n780,1\n");
  const auto file = folder.file("case.yaml", "source_spectrum: {file: lamp.csv}\n");
  const Instrument triangle = shipped_instrument("triangle_gloss");
  const Instrument changed = with_overlay(triangle, YamlNode::load(file), shipped());
  EXPECT_EQ(changed.source.at(nanometres(580)), 3.0);
  expect_same_spectrum(changed.responsivity, triangle.responsivity);
  const auto other = folder.file("other.yaml", "responsivity: {file: lamp.csv}\n");
  EXPECT_EQ(
      with_overlay(triangle, YamlNode::load(other), shipped()).responsivity.at(nanometres(580)),
      3.0);
}

TEST(Overlay, MergesBehaviourAndKeepsTheRepeatabilityBesideIt) {
  const Instrument triangle = shipped_instrument("triangle_gloss");
  const Instrument changed =
      laid_over(triangle, "behaviour: {linearity: 0.02, tile: {contamination: 0.1}}");
  Behaviour expected = triangle.behaviour;
  expected.linearity = 0.02;
  expected.tile_contamination = 0.1;
  EXPECT_EQ(changed.behaviour, expected);
  EXPECT_EQ(changed.behaviour.repeatability_gu, 0.05);
  expected = triangle.behaviour;
  expected.repeatability_gu = 1.0;
  EXPECT_EQ(laid_over(triangle, "repeatability: 1 GU").behaviour, expected);
}

TEST(Overlay, GivesASpotToAllGeometriesOrToSome) {
  const Instrument triangle = shipped_instrument("triangle_gloss");
  const Instrument all = laid_over(triangle, "spot: {in_plane: 2 mm, perpendicular: 3 mm}");
  for (const std::string& id : all.geometries) {
    EXPECT_EQ(all.beam.at(id), (BeamSection{.in_plane_mm = 2, .perpendicular_mm = 3})) << id;
  }
  const Instrument one = laid_over(triangle, "spot: {\"20\": {diameter: 4 mm}}");
  EXPECT_EQ(one.beam.at("20"), (BeamSection{.in_plane_mm = 4, .perpendicular_mm = 4}));
  EXPECT_EQ(one.beam.at("60"), triangle.beam.at("60"));
}

TEST(Overlay, ReplacesTheSamples) {
  const Instrument changed =
      laid_over(shipped_instrument("triangle_gloss"), "samples: [pmma, n_bk7]");
  EXPECT_THAT(changed.samples,
              testing::ElementsAre(shipped().find(Catalog::Kind::sample, "pmma"),
                                   shipped().find(Catalog::Kind::sample, "n_bk7")));
}

TEST(OverlayErrors, NameThePlaceInTheOverlaysFile) {
  EXPECT_EQ(error_of("as_built:\n  \"60\": {theta_i: 60}\n"),
            "case.yaml:2:19: as_built.60.theta_i: expected an angle (deg, rad, mrad) in [0, 90), "
            "found '60'");
  EXPECT_EQ(error_of("behaviour: {linearity: 0.02}"),
            "case.yaml:1:24: behaviour.linearity: expected the key 'full_scale' beside it, found "
            "'none'");
  EXPECT_EQ(error_of("behaviour: {full_scale: {\"60\": 9 GU}}"),
            "case.yaml:1:25: behaviour.full_scale.20: expected the key '20', found 'only 60'");
  EXPECT_EQ(error_of("polarization: 1.01"),
            "case.yaml:1:15: polarization: expected a number in [-1, 1], found '1.01'");
  EXPECT_EQ(error_of("polarization: {\"60\": -2}"),
            "case.yaml:1:22: polarization.60: expected a number in [-1, 1], found '-2'");
  EXPECT_EQ(error_of("polarization: {\"45\": 0.1}"),
            "case.yaml:1:22: polarization.45: expected a geometry of iso_2813/2014, found '45'");
  EXPECT_EQ(error_of("spot: {\"45\": {diameter: 9 mm}}"),
            "case.yaml:1:14: spot.45: expected a geometry of iso_2813/2014, found '45'");
  EXPECT_EQ(error_of("spot: {diameter: 0 mm}"),
            "case.yaml:1:18: spot.diameter: expected a length (nm, um, mm) > 0, found '0 mm'");
  EXPECT_EQ(error_of("spot: {in_plane: 9 mm}"),
            "case.yaml:1:7: spot.perpendicular: expected the key 'perpendicular', found 'only "
            "in_plane'");
  EXPECT_EQ(error_of("repeatability: -1 GU"),
            "case.yaml:1:16: repeatability: expected a gloss value (GU) >= 0, found '-1 GU'");
}

TEST(OverlayErrors, NameThePlaceWithinALargerFile) {
  const YamlNode file = YamlNode::parse(
      "given:\n"
      "  set: {as_built: {\"45\": {theta_i: 45 deg}}}\n",
      "case.yaml");
  const std::string message = message_of([&] {
    file.read_map([](YamlMap& map) {
      return map.required("given").read_map([](YamlMap& given) {
        return with_overlay(nominal_instrument(shipped_standard("iso_2813/2014")),
                            given.required("set"), shipped());
      });
    });
  });
  EXPECT_EQ(message,
            "case.yaml:2:26: given.set.as_built.45: expected a geometry of iso_2813/2014, found "
            "'45'");
}

TEST(OverlayErrors, OfWhatCannotBeLaidOver) {
  for (const std::string key : {"geometries: [\"60\"]", "identity: {model: X}", "wire: {port: 1}",
                                "built_to: iso_2813/2014", "id: x"}) {
    const std::string name = key.substr(0, key.find(':'));
    EXPECT_EQ(
        error_of(key),
        "case.yaml:1:1: " + name +
            ": expected one of the keys as_built, behaviour, polarization, repeatability, "
            "responsivity, samples, setup_uncertainty, source_spectrum, spot, uncertainty, found "
            "'" +
            name + "'");
  }
  EXPECT_EQ(error_of("[]"), "case.yaml:1:1: expected a map of keys and values, found 'a list'");
}

}  // namespace
}  // namespace gonio
