#include "emulator/surface/sample_deviation.hpp"

namespace gonio {

double& SampleDeviation::operator[](SampleParameter parameter) {
  switch (parameter) {
    case SampleParameter::roughness:
      return roughness;
    case SampleParameter::refractive_index:
      return refractive_index;
    case SampleParameter::diffuse_reflectance:
      break;
  }
  return diffuse_reflectance;
}

double SampleDeviation::operator[](SampleParameter parameter) const {
  SampleDeviation copy = *this;
  return copy[parameter];
}

SampleDeviation operator+(const SampleDeviation& a, const SampleDeviation& b) {
  return {.roughness = a.roughness + b.roughness,
          .refractive_index = a.refractive_index + b.refractive_index,
          .diffuse_reflectance = a.diffuse_reflectance + b.diffuse_reflectance};
}

}  // namespace gonio
