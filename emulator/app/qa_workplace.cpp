#include "emulator/app/qa_workplace.hpp"

#include "emulator/quality/measured_readings.hpp"
#include "emulator/quality/run_record.hpp"
#include "emulator/surface/sample.hpp"

namespace gonio::app {

namespace {

Workplace with_batch(const std::string& batch, const Catalog& catalog) {
  return {.batch = load_batch(catalog.find(Catalog::Kind::batch, batch), catalog),
          .observer = Observer::load(catalog.fixture("observers/cie_1931_2deg.csv"),
                                     WavelengthGrid::visible())};
}

void add_uncertainties(Workplace& place) {
  std::optional<Sample> sample;
  if (place.batch.product) {
    sample = load_sample(place.batch.product->sample, WavelengthGrid::visible());
  }
  place.uncertainties = reading_uncertainties(place.batch, sample);
}

}  // namespace

std::uint64_t Workplace::panels() const {
  return readings ? measured.size() : batch.plan.lots * batch.plan.panels;
}

Workplace simulated_workplace(const std::string& batch, std::optional<std::uint64_t> seed,
                              const Catalog& catalog) {
  Workplace place = with_batch(batch, catalog);
  if (!place.batch.product) {
    throw InputError({.file = place.batch.file.string(), .key = "product"},
                     "a product to simulate, or --readings", "nothing");
  }
  place.batch.seed = seed.value_or(place.batch.seed);
  add_uncertainties(place);
  return place;
}

Workplace measured_workplace(const std::string& batch, const std::filesystem::path& readings,
                             const Catalog& catalog) {
  Workplace place = with_batch(batch, catalog);
  place.readings = readings;
  place.measured = load_measured_readings(readings, place.batch);
  add_uncertainties(place);
  return place;
}

RunRecord run_record(const Workplace& place, const std::string& version) {
  return gonio::run_record(place.batch, place.readings, place.panels(), version);
}

ProductOptics product_optics(const Workplace& place, Bars& bars) {
  return {place.batch, reach(place.batch), place.observer,
          [&bars](std::size_t done, std::size_t total) { bars.show("optics", done, total); }};
}

}  // namespace gonio::app
