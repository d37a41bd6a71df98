#include "emulator/measured/ddr_brdf.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "emulator/core/text_file.hpp"
#include "emulator/measured/brdf_reflectance.hpp"
#include "emulator/measured/text_brdf.hpp"

namespace gonio {

namespace {

using Band = BrdfChannel::Band;
using Eigen::Index;
using std::numbers::pi;

struct DdrHeader {
  SpecularTable::Grid grid;
  bool is_plane_symmetrical = false, is_intensity = false, is_relative = false;
  bool is_spectral = false;
  Index n_channels = 1;
};

void take_type_sym(WordReader& words, DdrHeader& header) {
  const Word word = words.take();
  header.is_plane_symmetrical = word.is("PlaneSymmetrical");
  if (word.is("ASymmetrical")) {
    if (words.peek().is("4D")) {
      words.take();
    }
  } else if (!header.is_plane_symmetrical && !word.is("AxiSymmetrical") &&
             !word.is("DirSymmetrical")) {
    words.fail(word, "AxiSymmetrical, DirSymmetrical, PlaneSymmetrical or ASymmetrical");
  }
}

void take_colour_model(WordReader& words, DdrHeader& header) {
  const Word word = words.take();
  if (word.is("RGB")) {
    header.n_channels = 3;
  } else if (word.is("spectral")) {
    header.is_spectral = true;
    header.n_channels = words.take_count("TypeColorModel");
  } else if (!word.is("BW")) {
    words.fail(word, "BW, RGB or spectral");
  }
}

void take_type_data(WordReader& words, DdrHeader& header) {
  const Word quantity = words.take();
  header.is_intensity = quantity.is("Intensity");
  if (!header.is_intensity && !quantity.is("Luminance")) {
    words.fail(quantity, "Luminance or Intensity");
  }
  const Word scale = words.take();
  header.is_relative = scale.is("Relative");
  if (!header.is_relative && !scale.is("Absolute")) {
    words.fail(scale, "Absolute or Relative");
  }
}

/// The angles at which lobes have their maximum; only those of a mirror are read.
void take_sigmat(WordReader& words, const DdrHeader& header) {
  const Eigen::ArrayXd& sigma = header.grid.theta_i;
  for (Index i = 0; i < sigma.size(); ++i) {
    const Word word = words.peek();
    if (std::abs(words.take_number("sigmat") * pi / 180.0 - sigma[i]) > 1e-9) {
      words.fail(word,
                 "the angle of incidence: lobes that are off the mirror direction are not read",
                 "sigmat");
    }
  }
}

void take_keyword(WordReader& words, const Word& keyword, DdrHeader& header) {
  if (keyword.is("Source")) {
    words.take_rest_of_line();
  } else if (keyword.is("TypeSym")) {
    take_type_sym(words, header);
  } else if (keyword.is("TypeColorModel")) {
    take_colour_model(words, header);
  } else if (keyword.is("TypeData")) {
    take_type_data(words, header);
  } else if (keyword.is("psi")) {
    header.grid.rotation = words.take_angles("psi", 360.0);
  } else if (keyword.is("sigma")) {
    header.grid.theta_i = words.take_angles("sigma", 90.0);
  } else if (keyword.is("sigmat")) {
    take_sigmat(words, header);
  } else if (keyword.is("phi")) {
    header.grid.azimuth = words.take_angles("phi", 360.0);
  } else if (keyword.is("theta")) {
    header.grid.radial = words.take_angles("theta", 180.0);
  } else {
    words.fail(keyword, "a keyword of the header");
  }
}

bool begins_channel(const Word& word) {
  return word.is("bw") || word.is("wl") || word.is("red") || word.is("gre") || word.is("green") ||
         word.is("blu") || word.is("blue") || word.is("kbdf") || word.is("def");
}

DdrHeader take_header(WordReader& words) {
  DdrHeader header;
  header.grid.rotation = Eigen::ArrayXd::Zero(1);
  KeywordsSeen seen;
  while (!words.at_end() && !begins_channel(words.peek())) {
    const Word keyword = words.take();
    seen.add(words, keyword);
    take_keyword(words, keyword, header);
  }
  for (const char* keyword : {"TypeSym", "TypeColorModel", "TypeData", "sigma", "phi", "theta"}) {
    if (!seen.has(keyword)) {
      words.fail(words.peek(), fmt::format("{} before the data", keyword));
    }
  }
  return header;
}

BrdfChannel take_channel_name(WordReader& words, const DdrHeader& header) {
  const Word word = words.peek();
  if (header.n_channels == 1 && !header.is_spectral) {
    if (word.is("bw")) {  // mostly left out
      words.take();
    } else if (!word.is("kbdf") && !word.is("def")) {
      words.fail(word, "bw, kbdf or def");
    }
    return {.band = Band::luminance};
  }
  words.take();
  if (header.is_spectral) {
    if (!word.is("wl")) {
      words.fail(word, "wl");
    }
    const Word value = words.peek();
    const double wavelength_nm = words.take_number("wl");
    if (wavelength_nm <= 0.0) {
      words.fail(value, "a wavelength in nm above 0", "wl");
    }
    return {.band = Band::wavelength, .wavelength = nanometres(wavelength_nm)};
  }
  if (word.is("red")) {
    return {.band = Band::red};
  }
  if (word.is("gre") || word.is("green")) {
    return {.band = Band::green};
  }
  if (!word.is("blu") && !word.is("blue")) {
    words.fail(word, "red, gre or blu");
  }
  return {.band = Band::blue};
}

struct DdrData {
  std::vector<BrdfChannel> channels;
  Eigen::ArrayXXd values, kbdf;  ///< of nodes, of incidences; by channels
  bool has_kbdf = false;
};

void take_channel(WordReader& words, const DdrHeader& header, DdrData& data) {
  const SpecularTable::Grid& grid = header.grid;
  const Index channel = Index(data.channels.size());
  const Word word = words.peek();
  const BrdfChannel name = take_channel_name(words, header);
  if (std::ranges::find(data.channels, name) != data.channels.end()) {
    words.fail(word, "each channel once");
  }
  data.channels.push_back(name);
  if (words.peek().is("kbdf")) {
    words.take();
    data.has_kbdf = true;
    for (double& factor : data.kbdf.col(channel)) {
      const Word place = words.peek();
      factor = words.take_number("kbdf");
      if (factor < 0.0) {
        words.fail(place, "a factor of at least 0", "kbdf");
      }
    }
  }
  words.expect("def");
  for (Index i = 0; i < data.kbdf.rows(); ++i) {
    take_table(words, grid, i * grid.azimuth.size() * grid.radial.size(), data.values.col(channel));
  }
  words.expect("enddef");
}

DdrData take_data(WordReader& words, const DdrHeader& header) {
  const SpecularTable::Grid& grid = header.grid;
  const double nodes = double(grid.rotation.size()) * double(grid.theta_i.size()) *
                       double(grid.azimuth.size()) * double(grid.radial.size());
  words.require_room(nodes * double(header.n_channels), "def");
  DdrData data;
  data.values.resize(grid.size(), header.n_channels);
  data.kbdf.setOnes(grid.rotation.size() * grid.theta_i.size(), header.n_channels);
  for (Index i = 0; i < header.n_channels; ++i) {
    take_channel(words, header, data);
  }
  if (!words.at_end()) {
    words.fail(words.peek(), "the end of the file after the last enddef");
  }
  return data;
}

/// Calls body(row of f_r, incidence, cos theta_r) for each node.
template <typename Body>
void for_each_node(const SpecularTable::Grid& grid, const Body& body) {
  const Index n_theta = grid.theta_i.size();
  for (Index incidence = 0; incidence < grid.rotation.size() * n_theta; ++incidence) {
    for (Index azimuth = 0; azimuth < grid.azimuth.size(); ++azimuth) {
      for (Index radial = 0; radial < grid.radial.size(); ++radial) {
        body(grid.row(0, incidence, azimuth, radial), incidence,
             grid.cos_theta_r(incidence % n_theta, azimuth, radial));
      }
    }
  }
}

/// f_r of luminance or intensity, but for factors of incidences.
void make_brdf(const DdrHeader& header, Eigen::ArrayXXd& values) {
  if (!header.is_intensity) {
    values /= pi;
    return;
  }
  constexpr double horizon = 1e-3;  // below it the quotient is of rounding errors
  for_each_node(header.grid, [&](Index row, Index, double cos_theta_r) {
    if (cos_theta_r >= horizon) {
      values.row(row) /= cos_theta_r;
    }
  });
}

/// Makes kbdf the reflectance of each incidence and channel.
void scale_to_reflectance(const DdrHeader& header, DdrData& data) {
  const SpecularTable::Grid& grid = header.grid;
  const SpecularTable relative(data.channels, grid, data.values);
  for (Index incidence = 0; incidence < data.kbdf.rows(); ++incidence) {
    const Eigen::ArrayXd rho = directional_hemispherical_reflectance(
        relative, radians(grid.theta_i[incidence % grid.theta_i.size()]),
        radians(grid.rotation[incidence / grid.theta_i.size()]));
    for (Index channel = 0; channel < rho.size(); ++channel) {
      constexpr double nothing = 1e-30;
      data.kbdf(incidence, channel) /= rho[channel] > nothing ? rho[channel] : 1.0;
    }
  }
}

/// Wavelengths in ascending order, whatever that of the file.
void sort_channels(DdrData& data) {
  std::vector<Index> order(data.channels.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    order[i] = Index(i);
  }
  const std::vector<BrdfChannel> channels = data.channels;
  std::ranges::sort(order, [&](Index a, Index b) {
    return comes_before(channels[std::size_t(a)], channels[std::size_t(b)]);
  });
  const Eigen::ArrayXXd values = data.values;
  for (std::size_t i = 0; i < order.size(); ++i) {
    data.channels[i] = channels[std::size_t(order[i])];
    data.values.col(Index(i)) = values.col(order[i]);
  }
}

}  // namespace

BrdfFile read_ddr(const std::filesystem::path& path) {
  return parse_ddr(read_text_file(path, largest_brdf_text_mib), path);
}

BrdfFile parse_ddr(std::string_view text, const std::filesystem::path& file) {
  WordReader words(text, file.string(), ';');
  const DdrHeader header = take_header(words);
  const double last_azimuth = header.grid.azimuth[header.grid.azimuth.size() - 1];
  if (header.is_plane_symmetrical && last_azimuth > pi + 1e-9) {
    words.fail(words.peek(), "azimuths to 180 degrees where TypeSym is PlaneSymmetrical", "phi");
  }
  DdrData data = take_data(words, header);
  BrdfFile result{.file = file, .format = BrdfFormat::ddr, .brdf = nullptr};
  result.description = words.first_comment();
  clip_negative(data.values, result.warnings);
  make_brdf(header, data.values);
  if (header.is_relative && data.has_kbdf) {
    scale_to_reflectance(header, data);
  } else if (header.is_relative) {
    result.warnings.push_back(
        "values are relative, and no kbdf tells to what: they are taken as absolute");
  }
  for_each_node(header.grid, [&](Index row, Index incidence, double) {
    data.values.row(row) *= data.kbdf.row(incidence);
  });
  sort_channels(data);
  result.brdf = std::make_shared<SpecularTable>(data.channels, header.grid, data.values);
  return result;
}

}  // namespace gonio
