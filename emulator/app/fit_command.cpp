#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "emulator/app/bars.hpp"
#include "emulator/app/command.hpp"
#include "emulator/core/text_file.hpp"
#include "emulator/goniometry/fit_comparison.hpp"
#include "emulator/instrument/instrument.hpp"
#include "emulator/measured/astm_brdf.hpp"
#include "emulator/measured/brdf_file.hpp"
#include "emulator/optics/refractive_index.hpp"
#include "reports/fit_report.hpp"

namespace gonio::app {

namespace {

namespace fs = std::filesystem;

struct FitOptions {
  std::string data;
  std::vector<std::string> models{"cook_torrance"};
  std::string index = "1.5";
  std::vector<std::string> fixed;
  std::vector<std::string> free;
  std::string instrument = "paper_setup";
  std::string format = "text";
  std::optional<std::string> report;
  std::optional<std::string> sample;
};

/// `--fix name=value`, each of a parameter that one of the models has.
FitValues fixed_values(const std::vector<std::string>& texts,
                       const std::vector<FittableModel>& models) {
  FitValues fixed;
  for (const std::string& text : texts) {
    const auto sign = text.find('=');
    const std::string name = text.substr(0, sign);
    std::vector<std::string> names;
    for (const FittableModel& model : models) {
      for (const FitParameter& parameter : model.parameters) {
        names.push_back(parameter.name);
      }
    }
    if (std::ranges::count(names, name) == 0) {
      std::string list;
      std::ranges::sort(names);
      names.erase(std::unique(names.begin(), names.end()), names.end());
      for (const std::string& known : names) {
        list += (list.empty() ? "" : ", ") + known;
      }
      throw std::invalid_argument(fmt::format("--fix: expected one of {}, found '{}'", list, name));
    }
    const auto value = sign == std::string::npos
                           ? std::nullopt
                           : parse_quantity(text.substr(sign + 1), Dimension::number);
    if (!value) {
      throw std::invalid_argument(
          fmt::format("--fix: expected a parameter and a number, as specular=1, found '{}'", text));
    }
    fixed[name] = *value;
  }
  return fixed;
}

std::vector<FittableModel> models_of(const FitOptions& options) {
  for (const std::string& name : options.free) {
    if (name != index_parameter) {
      throw std::invalid_argument(
          fmt::format("--free: expected {}, found '{}'", index_parameter, name));
    }
  }
  std::vector<FittableModel> models;
  for (const std::string& name : options.models) {
    if (std::ranges::count(models, name, &FittableModel::name) > 0) {
      continue;
    }
    const FittableModel& model = fittable_model(name);
    models.push_back(options.free.empty() ? model : with_free_index(model));
  }
  return models;
}

/// A number, or a file of the refractiveindex.info database; `index` becomes what a sample file is
/// to say.
RefractiveIndex index_of(std::string& index) {
  constexpr double highest = 1000.0;
  if (const auto n = parse_quantity(index, Dimension::number)) {
    if (!(*n > 0.0 && *n <= highest)) {
      throw std::invalid_argument(
          fmt::format("--refractive-index: expected a number in (0, {:g}], found {}", highest, *n));
    }
    return RefractiveIndex::constant(*n);
  }
  const RefractiveIndex loaded = RefractiveIndex::load(index);
  std::string quoted;
  for (const char c : fs::absolute(index).lexically_normal().string()) {
    quoted += c;
    if (c == '\'') {
      quoted += c;
    }
  }
  index = fmt::format("{{file: '{}'}}", quoted);
  return loaded;
}

/// Whether a file holds a BRDF; else it is to hold spectra.
bool holds_brdf(const fs::path& path) {
  constexpr std::size_t enough = 4096;
  std::error_code no_size;
  const auto size = fs::file_size(path, no_size);
  std::ifstream in(path, std::ios::binary);
  std::string beginning(enough, '\0');
  in.read(beginning.data(), enough);
  beginning.resize(std::size_t(in.gcount()));
  return !no_size && brdf_format_of(beginning, size).has_value();
}

/// @param instrument  what measured spectra; becomes empty for a BRDF.
FitObservations observations_in(const fs::path& path, std::string& instrument,
                                const Catalog& catalog) {
  FitObservations observations;
  if (holds_brdf(path)) {
    instrument.clear();
    observations = observations_of(brdf_format(path) == BrdfFormat::astm
                                       ? read_astm(path)
                                       : sampled_for_fit(*load_brdf(path).brdf));
  } else {
    const Instrument built =
        load_instrument(catalog.find(Catalog::Kind::instrument, instrument), catalog);
    instrument = built.id;
    observations = observations_of(load_reflectance_spectra(path), built);
  }
  observations.file = path.string();
  return observations;
}

FitReport fit_all(FitOptions options, const Catalog& catalog) {
  const std::vector<FittableModel> models = models_of(options);
  const FitValues fixed = fixed_values(options.fixed, models);
  FitObservations observations = observations_in(options.data, options.instrument, catalog);
  FitReport report{.title = fmt::format("Fit of {}", fs::path(options.data).filename().string()),
                   .instrument = options.instrument,
                   .observations = std::move(observations)};
  const Eigen::ArrayXcd n_hat = index_of(options.index).sample(report.observations.grid);
  report.index = options.index;
  Bars bars;
  for (const FittableModel& model : models) {
    bars.show("models", report.fits.size(), models.size());
    report.fits.push_back(fit_surface(report.observations, model, n_hat, fixed));
  }
  report.comparison = compare_fits(report.fits, report.observations.is_u_known);
  return report;
}

/// Everything is made before anything is written: who interrupts finds nothing half done.
void write_fit(const fs::path& folder, const FitReport& report) {
  const std::string page = fit_page(report);
  fs::create_directories(folder);
  write_text_file(folder / "fit.html", page);
  write_text_file(folder / "fit.json", fit_json(report));
  write_text_file(folder / "fit.csv", fit_csv(report));
  write_text_file(folder / "fit.txt", fit_text(report, false));
}

void fit_by(const FitOptions& options, const CommonOptions& common, ExitStatus& status) {
  const FitReport report = fit_all(options, common.catalog());
  if (options.report) {
    write_fit(*options.report, report);
  }
  if (options.sample) {
    write_text_file(*options.sample, fit_sample(report));
  }
  if (options.format == "json") {
    print(fit_json(report));
  } else if (options.format == "csv") {
    print(fit_csv(report));
  } else {
    print(fit_text(report, isatty(STDOUT_FILENO) != 0));
  }
  // A search that finds nothing is a result, and the input was good.
  if (std::ranges::none_of(report.fits, &SurfaceFit::has_converged)) {
    status = does_not_conform;
  }
}

}  // namespace

void add_fit_command(CLI::App& program, const CommonOptions& common, ExitStatus& status) {
  CLI::App* command =
      program.add_subcommand("fit", "Fit reflection models to measured spectra or a measured BRDF");
  const auto options = std::make_shared<FitOptions>();
  command
      ->add_option("data", options->data,
                   "CSV file of spectra relative to a perfect mirror, or a measured BRDF")
      ->required();
  command
      ->add_option("--model", options->models,
                   "lambertian, coated, coherent_roughness, cook_torrance, ggx, ward or hazy; "
                   "given several times, models are compared")
      ->allow_extra_args(false)
      ->capture_default_str();
  command
      ->add_option("--refractive-index", options->index,
                   "A number, or a file of the refractiveindex.info database")
      ->capture_default_str();
  command->add_option("--fix", options->fixed, "A parameter that keeps its value, as specular=1")
      ->allow_extra_args(false);
  command
      ->add_option("--free", options->free, "refractive_index: search for it, too, as a constant")
      ->allow_extra_args(false);
  command
      ->add_option("--instrument", options->instrument,
                   "Instrument that measured: its id, or its file")
      ->capture_default_str();
  add_format_option(*command, options->format);
  command->add_option("--report", options->report,
                      "Folder for fit.html, .json, .csv and .txt; needs gnuplot");
  command->add_option("--write-sample", options->sample,
                      "Sample file with the parameters of the best model");
  command->footer(
      "Example: gonio fit fixtures/measured/copper_simulated.csv --model cook_torrance --model ggx "
      "--refractive-index fixtures/nk/main/Cu/Johnson.yml\n"
      "Exit status 1: no search converged");
  command->callback([options, &common, &status] { fit_by(*options, common, status); });
}

}  // namespace gonio::app
