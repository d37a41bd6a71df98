#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include "emulator/app/command.hpp"
#include "emulator/core/text_file.hpp"
#include "emulator/measured/astm_brdf.hpp"
#include "emulator/measured/brdf_resampling.hpp"
#include "emulator/measured/rgl_writer.hpp"
#include "reports/brdf_report.hpp"

namespace gonio::app {

namespace {

namespace fs = std::filesystem;

struct ConvertOptions {
  std::string input;
  std::optional<std::string> output, to;
  std::string format = "text";
  std::vector<double> theta_i_deg, phi_i_deg;
  std::optional<double> theta_step_deg, azimuth_step_deg;
  std::vector<std::string> channels;
};

std::vector<Angle> angles_of(std::vector<double> angles_deg, const char* option) {
  std::ranges::sort(angles_deg);
  if (std::ranges::adjacent_find(angles_deg) != angles_deg.end()) {
    throw std::invalid_argument(fmt::format("{}: expected each angle once", option));
  }
  std::vector<Angle> angles;
  for (const double angle_deg : angles_deg) {
    angles.push_back(degrees(angle_deg));
  }
  return angles;
}

BrdfSampling sampling_of(const ConvertOptions& options) {
  BrdfSampling sampling{.theta_i = angles_of(options.theta_i_deg, "--theta-i")};
  if (!options.phi_i_deg.empty()) {
    sampling.rotation = angles_of(options.phi_i_deg, "--phi-i");
  }
  if (options.theta_step_deg) {
    sampling.theta_step = degrees(*options.theta_step_deg);
  }
  if (options.azimuth_step_deg) {
    sampling.azimuth_step = degrees(*options.azimuth_step_deg);
  }
  return sampling;
}

bool has_sampling(const ConvertOptions& options) {
  return !options.theta_i_deg.empty() || !options.phi_i_deg.empty() || options.theta_step_deg ||
         options.azimuth_step_deg;
}

std::vector<BrdfChannel> channels_of(const ConvertOptions& options) {
  std::vector<BrdfChannel> channels;
  for (const std::string& name : options.channels) {
    const auto channel = channel_named(name);
    if (!channel) {
      throw std::invalid_argument(fmt::format(
          "--channels: expected Luminance, R, G, B, X, Y, Z or a wavelength such as 550nm, found "
          "'{}'",
          name));
    }
    channels.push_back(*channel);
  }
  std::ranges::sort(channels, comes_before);
  return channels;
}

/// What was measured, as it stands; or resampled, where the input is no list of samples or the
/// directions are given.
BrdfSamples samples_to_write(const ConvertOptions& options, const BrdfFile& file) {
  const std::vector<BrdfChannel> channels = channels_of(options);
  if (file.format == BrdfFormat::astm && !has_sampling(options)) {
    BrdfSamples samples = read_astm(file.file);
    if (!channels.empty()) {
      samples.f_r =
          (samples.f_r.matrix() * channel_conversion(samples.channels, channels)).array().eval();
      samples.channels = channels;
    }
    return samples;
  }
  const auto brdf = channels.empty() ? file.brdf : with_channels(file.brdf, channels);
  BrdfSamples samples = sample_brdf(*brdf, sampling_of(options));
  samples.notes = {{"SYSTEM_NAME", "gonio convert"},
                   {"FILE_NAME", file.file.filename().string()},
                   {"MEAS_NAME", fmt::format("resampled from {}", brdf_format_name(file.format))}};
  if (!file.description.empty()) {
    samples.notes["SAMPLE_NAME"] = file.description;
  }
  return samples;
}

void convert_to_rgl(const ConvertOptions& options, const BrdfFile& file) {
  if (options.theta_step_deg || options.azimuth_step_deg) {
    throw std::invalid_argument("--step and --azimuth-step are of --to astm");
  }
  const std::vector<BrdfChannel> channels = channels_of(options);
  write_rgl(*options.output, channels.empty() ? *file.brdf : *with_channels(file.brdf, channels),
            {.description = file.description,
             .theta_i = angles_of(options.theta_i_deg, "--theta-i"),
             .phi_i = angles_of(options.phi_i_deg, "--phi-i")});
}

void convert_file(const ConvertOptions& options, const BrdfFile& file) {
  std::error_code none;
  if (fs::equivalent(options.input, *options.output, none)) {
    throw std::invalid_argument(
        fmt::format("OUTPUT: expected another file than the input, found '{}'", *options.output));
  }
  for (const std::string& warning : file.warnings) {
    fmt::print(stderr, "warning: {}: {}\n", options.input, warning);
  }
  if (*options.to == "rgl") {
    convert_to_rgl(options, file);
    return;
  }
  const BrdfSamples samples = samples_to_write(options, file);
  write_file(*options.output, [&](std::ostream& out) { write_astm(samples, out); });
}

void convert(const ConvertOptions& options) {
  if (options.output.has_value() != options.to.has_value()) {
    throw std::invalid_argument(options.output ? "OUTPUT needs a format: --to astm or --to rgl"
                                               : "--to needs a file to write: OUTPUT");
  }
  if (!options.to && (has_sampling(options) || !options.channels.empty())) {
    throw std::invalid_argument(
        "--theta-i, --phi-i, --step, --azimuth-step and --channels are of --to");
  }
  const BrdfFile file = load_brdf(options.input);
  if (options.to) {
    convert_file(options, file);
    return;
  }
  const BrdfSummary summary = summarize(file);
  print(options.format == "json" ? brdf_json(summary) : brdf_text(summary));
}

}  // namespace

void add_convert_command(CLI::App& program) {
  CLI::App* command = program.add_subcommand(
      "convert", "Tell what a file of a measured BRDF is, or write it in another format");
  const auto options = std::make_shared<ConvertOptions>();
  command
      ->add_option("input", options->input,
                   "RGL .bsdf, MERL .binary, ASTM E1392 text, Zemax .bsdf or Integra .ddr; told "
                   "apart by content")
      ->required();
  command->add_option("output", options->output,
                      "File to write; without it the input is described");
  command->add_option("--to", options->to, "Format to write")
      ->check(CLI::IsMember({"astm", "rgl"}));
  command->add_option("--format", options->format, "How a description is printed")
      ->check(CLI::IsMember({"text", "json"}))
      ->capture_default_str();
  command
      ->add_option("--theta-i", options->theta_i_deg,
                   "Angles of incidence to write, deg; every 5 up to where it was measured, or as "
                   "an ASTM file has them, if not given")
      ->delimiter(',')
      ->check(number_in(Range::closed(0.0, 85.0)));
  command
      ->add_option("--phi-i", options->phi_i_deg,
                   "Azimuths of incidence to write, deg, for a sample that is not isotropic")
      ->delimiter(',')
      ->check(number_in(Range::closed(-180.0, 360.0)));
  command
      ->add_option("--step", options->theta_step_deg,
                   "Of polar angles of reflection, deg; 2.5, finer about the mirror direction")
      ->check(number_in(Range::closed(0.1, 30.0)));
  command
      ->add_option("--azimuth-step", options->azimuth_step_deg,
                   "Of azimuths of reflection, deg; 7.5, finer about the mirror direction")
      ->check(number_in(Range::closed(0.5, 90.0)));
  command
      ->add_option("--channels", options->channels,
                   "Those to write, such as Luminance, or 450nm,550nm; all if not given")
      ->delimiter(',');
  command->footer("Example: gonio convert fixtures/brdf/satin_rosaline.zemax.bsdf");
  command->callback([options] { convert(*options); });
}

}  // namespace gonio::app
