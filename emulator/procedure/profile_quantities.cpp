#include <fmt/format.h>

#include <cmath>

#include "emulator/procedure/profile.hpp"

namespace gonio {

namespace {

/// Angles closer than that are the same.
constexpr double same_angle_rad = 1e-9;

/// One rule at a profile.
class Evaluation {
 public:
  Evaluation(const Profile& sample, const Profile& reference, const ProfileAssumptions& assumptions)
      : sample_(sample), reference_(reference), assumptions_(assumptions) {}

  [[nodiscard]] ProfileQuantity haze(const ProfileRule& rule) const {
    ProfileQuantity quantity = begin(rule);
    quantity.unit = "GU";
    double sum = 0.0;
    for (const ProfileField& field : rule.fields) {
      const Angle width = field.width.value_or(assumptions_.haze_field);
      if (!field.width) {
        quantity.assumption = fmt::format("fields of {:g} deg", shown(width));
      }
      const auto share = of_reference(field.offset, width);
      if (!share) {
        quantity.missing = "a field lies beyond the profile";
        return quantity;
      }
      sum += *share;
    }
    quantity.value = 100.0 * sum / (rule.is_mean ? double(rule.fields.size()) : 1.0);
    return quantity;
  }

  [[nodiscard]] ProfileQuantity distinctness(const ProfileRule& rule) const {
    ProfileQuantity quantity = begin(rule);
    quantity.assumption = fmt::format("a receptor of {:g} deg", shown(assumptions_.doi_field));
    double off = 0.0;
    for (const ProfileField& field : rule.fields) {
      off += flux_in(field.offset, assumptions_.doi_field) / double(rule.fields.size());
    }
    const double on = flux_in(Angle(), assumptions_.doi_field);
    if (!(on > 0.0)) {
      quantity.missing = "no light at the mirror direction";
      return quantity;
    }
    quantity.value = 100.0 * (1.0 - off / on);
    return quantity;
  }

  [[nodiscard]] std::vector<ProfileQuantity> clarity(const ProfileRule& rule) const {
    std::vector<ProfileQuantity> quantities;
    for (const double comb : rule.comb_mm) {
      ProfileQuantity quantity = begin(rule);
      quantity.id = fmt::format("{}_{:g}mm", rule.id, comb);
      quantity.title = fmt::format("{}, comb of {:g} mm", rule.title, comb);
      quantity.assumption = fmt::format("a focal length of {:g} mm", assumptions_.comb_distance_mm);
      quantity.value = image_clarity(sample_, comb, assumptions_.comb_distance_mm);
      quantity.missing =
          quantity.value ? "" : "not one period of the comb fits into the profile, or no light";
      quantities.push_back(quantity);
    }
    return quantities;
  }

  [[nodiscard]] static ProfileQuantity logarithmic(const ProfileRule& rule,
                                                   const std::vector<ProfileQuantity>& before) {
    ProfileQuantity quantity = begin(rule);
    for (const ProfileQuantity& other : before) {
      if (other.standard == rule.standard && other.id == rule.of) {
        quantity.value =
            other.value ? std::optional(logarithmic_haze(rule, *other.value)) : std::nullopt;
        quantity.missing = other.missing;
        quantity.assumption = other.assumption;
      }
    }
    return quantity;
  }

  /// What the sample sends into a field over what the reference sends into one as wide at the
  /// mirror direction; nothing where the field lies beyond the profile.
  [[nodiscard]] std::optional<double> of_reference(Angle offset, Angle width) const {
    const double half = 0.5 * width.radians();
    const double all = reference_.between(-half, half);
    if (!sample_.covers(offset.radians() - half, offset.radians() + half) || !(all > 0.0)) {
      return std::nullopt;
    }
    return flux_in(offset, width) / all;
  }

 private:
  [[nodiscard]] static ProfileQuantity begin(const ProfileRule& rule) {
    return {
        .standard = rule.standard, .id = rule.id, .title = rule.title, .evidence = rule.evidence};
  }
  [[nodiscard]] static double shown(Angle angle) {
    return std::round(angle.degrees() * 1e9) * 1e-9;
  }
  [[nodiscard]] double flux_in(Angle offset, Angle width) const {
    const double half = 0.5 * width.radians();
    return sample_.between(offset.radians() - half, offset.radians() + half);
  }

  const Profile& sample_;
  const Profile& reference_;
  const ProfileAssumptions& assumptions_;
};

}  // namespace

ProfileQuantity profile_gloss(const Profile& sample, const Profile& reference,
                              const Standard& standard, const GeometryLimits& geometry) {
  const auto share = Evaluation(sample, reference, {})
                         .of_reference(Angle(), geometry.receptor.in_plane->known().nominal);
  return {.standard = standard.id,
          .id = fmt::format("gloss_{}", geometry.id),
          .title = "specular gloss",
          .value = share ? std::optional(standard.scale.value.nominal * *share) : std::nullopt,
          .unit = standard.scale.unit,
          .missing = share ? "" : "the receptor reaches beyond the profile",
          .evidence = geometry.evidence(),
          .assumption = "the slit in place of the source image"};
}

std::vector<ProfileQuantity> profile_quantities(const Profile& sample, const Profile& reference,
                                                Angle theta_i,
                                                const std::vector<ProfileRule>& rules,
                                                const ProfileAssumptions& assumptions) {
  const Evaluation evaluation(sample, reference, assumptions);
  std::vector<ProfileQuantity> quantities;
  for (const ProfileRule& rule : rules) {
    if (rule.theta_i && std::abs(rule.theta_i->radians() - theta_i.radians()) > same_angle_rad) {
      continue;
    }
    switch (rule.kind) {
      case ProfileRule::Kind::haze:
        quantities.push_back(evaluation.haze(rule));
        break;
      case ProfileRule::Kind::logarithmic:
        quantities.push_back(Evaluation::logarithmic(rule, quantities));
        break;
      case ProfileRule::Kind::doi:
        quantities.push_back(evaluation.distinctness(rule));
        break;
      case ProfileRule::Kind::clarity:
        for (const ProfileQuantity& quantity : evaluation.clarity(rule)) {
          quantities.push_back(quantity);
        }
        break;
    }
  }
  return quantities;
}

}  // namespace gonio
