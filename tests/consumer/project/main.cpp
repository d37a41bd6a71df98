// A program that uses the installed library, as a reader of the README would write it.
#include <cstdio>

#include "emulator/core/angle.hpp"
#include "emulator/store/store.hpp"

int main() {
  const gonio::Angle theta_i = gonio::degrees(60.0);
  std::printf("%.4f rad\n", theta_i.radians());
  gonio::Store store("sqlite::memory:");
  const bool stores = store.begin({}) == 1 && store.runs().size() == 1;
  return stores && theta_i.radians() > 1.0 && theta_i.radians() < 1.1 ? 0 : 1;
}
