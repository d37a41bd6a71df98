#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "emulator/app/command.hpp"
#include "emulator/core/csv_cell.hpp"
#include "emulator/instrument/glossmeter.hpp"

namespace gonio::app {

namespace {

struct GlassArguments {
  std::vector<double> indices;
  std::string standard = "iso_2813/2014";
  std::string format = "text";
};

/// 1.400 to 1.800 in steps of 0.010, and the reference itself: the rows of such tables in print.
std::vector<double> printed_indices(double reference) {
  std::vector<double> indices;
  for (int thousandth = 1400; thousandth <= 1800; thousandth += 10) {
    const double n = thousandth / 1000.0;
    if (!indices.empty() && indices.back() < reference && reference < n) {
      indices.push_back(reference);
    }
    indices.push_back(n);
  }
  return indices;
}

std::string table(const Standard& standard, const std::vector<double>& indices,
                  const std::string& format) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  std::string text = format == "csv" ? "n" : fmt::format("{:>6}", "n");
  for (const GeometryLimits& geometry : standard.geometries) {
    text += format == "csv" ? "," + csv_cell(geometry.id) : fmt::format("  {:>10}", geometry.id);
  }
  text += "\n";
  for (const double n : indices) {
    nlohmann::ordered_json row{{"n", n}};
    text += format == "csv" ? fmt::format("{}", n) : fmt::format("{:>6.3f}", n);
    for (const GeometryLimits& geometry : standard.geometries) {
      const double gloss = assigned_gloss(n, geometry.theta_i.nominal, standard.scale);
      row["gloss_gu"][geometry.id] = gloss;
      text += format == "csv" ? fmt::format(",{}", gloss) : fmt::format("  {:>10.2f}", gloss);
    }
    text += "\n";
    rows.push_back(row);
  }
  if (format == "json") {
    return nlohmann::ordered_json{
               {"schema", "gonio/glass/1"}, {"standard", standard.id}, {"glasses", rows}}
               .dump(1) +
           "\n";
  }
  return text;
}

void run_glass(const GlassArguments& options, const CommonOptions& common) {
  const Catalog catalog = common.catalog();
  const Standard standard =
      load_standard(catalog.find(Catalog::Kind::standard, options.standard), catalog);
  if (!standard.scale.refractive_index) {
    throw std::invalid_argument(fmt::format(
        "{} has no reference glass: its scale is relative to the incident flux", standard.id));
  }
  print(table(standard,
              options.indices.empty() ? printed_indices(standard.scale.refractive_index->nominal)
                                      : options.indices,
              options.format));
}

}  // namespace

void add_glass_command(CLI::App& program, const CommonOptions& common) {
  CLI::App* command = program.add_subcommand(
      "glass", "Gloss values of polished glass by refractive index: what a primary standard reads");
  const auto options = std::make_shared<GlassArguments>();
  command
      ->add_option("--index", options->indices, "Refractive indices; 1.400 to 1.800 if not given")
      ->check(number_in(Range::closed(1.0, 10.0)));
  command->add_option("--standard", options->standard, "Whose scale and angles")
      ->capture_default_str();
  add_format_option(*command, options->format);
  command->footer("Example: gonio glass --index 1.527 --standard astm_d523/14");
  command->callback([options, &common] { run_glass(*options, common); });
}

}  // namespace gonio::app
