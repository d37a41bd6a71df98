#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "emulator/app/bars.hpp"
#include "emulator/core/catalog.hpp"
#include "emulator/quality/batch.hpp"
#include "emulator/quality/product_optics.hpp"
#include "emulator/quality/reading_uncertainty.hpp"
#include "emulator/quality/records.hpp"

namespace gonio::app {

/// What panels of a batch are computed and judged with.
struct Workplace {
  Batch batch;
  Observer observer;
  ReadingUncertainties uncertainties = {};
  std::optional<std::filesystem::path> readings = {};
  std::vector<PanelRecord> measured = {};  ///< of the file of readings

  [[nodiscard]] std::uint64_t panels() const;
};

/// @param batch  a file or an id.   @param seed  in place of the batch's.
/// @throws InputError  also for a batch without a product.
[[nodiscard]] Workplace simulated_workplace(const std::string& batch,
                                            std::optional<std::uint64_t> seed,
                                            const Catalog& catalog);
[[nodiscard]] Workplace measured_workplace(const std::string& batch,
                                           const std::filesystem::path& readings,
                                           const Catalog& catalog);

[[nodiscard]] RunRecord run_record(const Workplace& place, const std::string& version);

/// The optics of the product, for all panels of the batch.
[[nodiscard]] ProductOptics product_optics(const Workplace& place, Bars& bars);

}  // namespace gonio::app
