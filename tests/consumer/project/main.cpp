// A program that uses the installed library, as a reader of the README would write it.
#include <cstdio>

#include "emulator/core/angle.hpp"

int main() {
  const gonio::Angle theta_i = gonio::degrees(60.0);
  std::printf("%.4f rad\n", theta_i.radians());
  return theta_i.radians() > 1.0 && theta_i.radians() < 1.1 ? 0 : 1;
}
