#include "emulator/measured/zemax_brdf.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "emulator/core/text_file.hpp"
#include "emulator/measured/brdf_reflectance.hpp"
#include "emulator/measured/text_brdf.hpp"

namespace gonio {

namespace {

using Eigen::Index;
using Band = BrdfChannel::Band;

struct ZemaxHeader {
  SpecularTable::Grid grid;
  bool is_plane_symmetrical = false, is_colour = false;
};

constexpr std::array<std::pair<const char*, Band>, 4> zemax_channels{
    {{"Monochrome", Band::luminance},
     {"TristimulusX", Band::x},
     {"TristimulusY", Band::y},
     {"TristimulusZ", Band::z}}};

bool begins_channel(const Word& word) {
  return std::ranges::any_of(zemax_channels,
                             [&](const auto& channel) { return word.is(channel.first); });
}

bool is_of_lighttools(const Word& word) {
  return word.is("AOI") || word.is("POI") || word.is("Side") || word.is("Wavelength") ||
         word.is("Asymmetric");
}

[[noreturn]] void refuse_keyword(const WordReader& words, const Word& word,
                                 const std::string& expected) {
  words.fail(word, is_of_lighttools(word)
                       ? expected + " of Zemax (this is a BSDF of LightTools, which is not read)"
                       : expected);
}

void take_symmetry(WordReader& words, ZemaxHeader& header) {
  const Word word = words.take();
  header.is_plane_symmetrical = word.is("PlaneSymmetrical");
  if (!header.is_plane_symmetrical && !word.is("Asymmetrical") && !word.is("Asymmetrical4D")) {
    refuse_keyword(words, word, "PlaneSymmetrical, Asymmetrical or ASymmetrical4D");
  }
}

void take_choice(WordReader& words, const char* first, const char* second, bool& is_second) {
  const Word word = words.take();
  is_second = word.is(second);
  if (!is_second && !word.is(first)) {
    words.fail(word, fmt::format("{} or {}", first, second));
  }
}

void take_scatter_type(WordReader& words) {
  const Word word = words.take();
  if (!word.is("BRDF")) {
    words.fail(word, "BRDF: transmitted light is not read", "ScatterType");
  }
}

void take_keyword(WordReader& words, const Word& keyword, ZemaxHeader& header) {
  if (keyword.is("Source")) {
    words.take_rest_of_line();
  } else if (keyword.is("Symmetry")) {
    take_symmetry(words, header);
  } else if (keyword.is("SpectralContent")) {
    take_choice(words, "Monochrome", "XYZ", header.is_colour);
  } else if (keyword.is("ScatterType")) {
    take_scatter_type(words);
  } else if (keyword.is("SampleRotation")) {
    header.grid.rotation = words.take_angles("SampleRotation", 360.0);
  } else if (keyword.is("AngleOfIncidence")) {
    header.grid.theta_i = words.take_angles("AngleOfIncidence", 90.0);
  } else if (keyword.is("ScatterAzimuth")) {
    header.grid.azimuth = words.take_angles("ScatterAzimuth", 360.0);
  } else if (keyword.is("ScatterRadial")) {
    header.grid.radial = words.take_angles("ScatterRadial", 180.0);
  } else {
    refuse_keyword(words, keyword, "a keyword of the header");
  }
}

ZemaxHeader take_header(WordReader& words) {
  ZemaxHeader header;
  header.grid.rotation = Eigen::ArrayXd::Zero(1);
  KeywordsSeen seen;
  while (!words.at_end() && !begins_channel(words.peek()) && !words.peek().is("DataBegin")) {
    const Word keyword = words.take();
    seen.add(words, keyword);
    take_keyword(words, keyword, header);
  }
  for (const char* keyword : {"Symmetry", "SpectralContent", "ScatterType", "AngleOfIncidence",
                              "ScatterAzimuth", "ScatterRadial"}) {
    if (!seen.has(keyword)) {
      words.fail(words.peek(), fmt::format("{} before the data", keyword));
    }
  }
  return header;
}

/// The channels of a file with their values, and the TIS that it tells of each incidence.
struct ZemaxData {
  std::vector<BrdfChannel> channels;
  Eigen::ArrayXXd f_r, tis;  ///< of nodes, of incidences; by channels
};

void take_channel(WordReader& words, const ZemaxHeader& header, Index channel, ZemaxData& data) {
  const SpecularTable::Grid& grid = header.grid;
  words.expect("DataBegin");
  const Index incidences = grid.rotation.size() * grid.theta_i.size();
  for (Index i = 0; i < incidences; ++i) {
    if (is_of_lighttools(words.peek())) {
      refuse_keyword(words, words.peek(), "TIS");
    }
    words.expect("TIS");
    data.tis(i, channel) = words.take_number("TIS");
    take_table(words, grid, i * grid.azimuth.size() * grid.radial.size(), data.f_r.col(channel));
  }
  words.expect("DataEnd");
}

ZemaxData take_data(WordReader& words, const ZemaxHeader& header) {
  const SpecularTable::Grid& grid = header.grid;
  ZemaxData data;
  for (std::size_t i = 0; i < zemax_channels.size(); ++i) {
    if ((zemax_channels[i].second != Band::luminance) == header.is_colour) {
      data.channels.push_back({.band = zemax_channels[i].second});
    }
  }
  const double nodes = double(grid.rotation.size()) * double(grid.theta_i.size()) *
                       double(grid.azimuth.size()) * double(grid.radial.size());
  words.require_room(nodes * double(data.channels.size()), "DataBegin");
  data.f_r.resize(grid.size(), Index(data.channels.size()));
  data.tis.resize(grid.rotation.size() * grid.theta_i.size(), Index(data.channels.size()));
  KeywordsSeen seen;
  for (std::size_t i = 0; i < data.channels.size(); ++i) {
    const Word word = words.take();
    const auto found = std::ranges::find_if(
        zemax_channels, [&](const auto& channel) { return word.is(channel.first); });
    const auto of_file = found == zemax_channels.end()
                             ? data.channels.end()
                             : std::ranges::find(data.channels, found->second, &BrdfChannel::band);
    if (of_file == data.channels.end()) {
      words.fail(word,
                 header.is_colour ? "TristimulusX, TristimulusY or TristimulusZ" : "Monochrome");
    }
    seen.add(words, word);
    take_channel(words, header, of_file - data.channels.begin(), data);
  }
  if (!words.at_end()) {
    words.fail(words.peek(), "the end of the file after the last DataEnd");
  }
  return data;
}

/// Tells of the TIS that is farthest from the integral of its table.
void check_tis(const SpecularTable& table, const Eigen::ArrayXXd& tis,
               std::vector<std::string>& warnings) {
  constexpr double tolerated = 0.1;  // coarse tables miss some per cent by interpolation alone
  double worst = tolerated;
  std::string warning;
  for (Index i = 0; i < table.grid().theta_i.size(); ++i) {
    const Angle theta_i = radians(table.grid().theta_i[i]);
    const Eigen::ArrayXd rho = directional_hemispherical_reflectance(table, theta_i);
    for (Index channel = 0; channel < rho.size(); ++channel) {
      const double said = tis(i, channel);
      const double error = std::abs(rho[channel] - said) / std::max({said, rho[channel], 1e-3});
      if (error > worst) {
        worst = error;
        warning =
            fmt::format("the TIS at {:.4g} deg is given as {:.3g}, but its table gives {:.3g}",
                        theta_i.degrees(), said, rho[channel]);
      }
    }
  }
  if (!warning.empty()) {
    warnings.push_back(warning);
  }
}

}  // namespace

BrdfFile read_zemax(const std::filesystem::path& path) {
  return parse_zemax(read_text_file(path, largest_brdf_text_mib), path);
}

BrdfFile parse_zemax(std::string_view text, const std::filesystem::path& file) {
  WordReader words(text, file.string(), '#');
  ZemaxHeader header = take_header(words);
  const double last_azimuth = header.grid.azimuth[header.grid.azimuth.size() - 1];
  if (header.is_plane_symmetrical && last_azimuth > std::numbers::pi + 1e-9) {
    words.fail(words.peek(), "azimuths to 180 degrees where the symmetry is PlaneSymmetrical",
               "ScatterAzimuth");
  }
  BrdfFile result{.file = file, .format = BrdfFormat::zemax, .brdf = nullptr};
  ZemaxData data = take_data(words, header);
  result.description = words.first_comment();
  if (!header.is_plane_symmetrical && header.grid.azimuth.size() > 1 &&
      last_azimuth <= std::numbers::pi + 1e-9) {
    result.warnings.push_back(
        "the table is of one side of the plane of incidence: the other mirrors it");
  }
  clip_negative(data.f_r, result.warnings);
  const auto table = std::make_shared<SpecularTable>(data.channels, header.grid, data.f_r);
  check_tis(*table, data.tis, result.warnings);
  result.brdf = table;
  return result;
}

}  // namespace gonio
