// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "extremes/extreme_case.h"
#include "extremes/scenes.h"

namespace nscdd {
namespace {

ExtremeCase Stack(const std::string& family, const std::string& name, const std::vector<Grain>& grains, bool quick) {
  ExtremeCase c{.family = family, .name = name, .build = [grains](reference::World* w) { BuildStack(grains, 0.0, {}, w); }};
  c.subdomains = "1x4";
  c.quick = quick;
  for (const Grain& grain : grains) c.extent += 2.0 * grain.radius;
  return c;
}

/// Five equal disks but for one, `ratio` times as heavy.
std::vector<Grain> OneHeavy(std::size_t which, double ratio) {
  std::vector<Grain> grains(5);
  grains[which].density *= ratio;
  return grains;
}

void AddMasses(std::vector<ExtremeCase>* cases) {
  for (const double ratio : {1.0, 1e2, 1e4, 1e6, 1e8}) {
    const bool quick = ratio == 1e2 || ratio == 1e8;
    cases->push_back(Stack("mass ratio", fmt::format("heavy on light {:g}", ratio), OneHeavy(4, ratio), quick));
    cases->push_back(Stack("mass ratio", fmt::format("light on heavy {:g}", ratio), OneHeavy(0, ratio), quick));
  }
  for (const double ratio : {1e2, 1e4, 1e8}) {
    ExtremeCase c = Stack("mass ratio", fmt::format("heavy on light {:g}, nat 1e-4", ratio), OneHeavy(4, ratio), ratio == 1e8);
    c.criterion = "nat";
    c.tolerance = 1e-4;
    cases->push_back(c);
  }
}

void AddRadii(std::vector<ExtremeCase>* cases) {
  for (const double ratio : {1.0, 10.0, 100.0, 1000.0}) {
    const Grain small{}, large{0.5 * ratio};
    cases->push_back(Stack("radius ratio", fmt::format("large on small {:g}", ratio), {small, large}, ratio == 100.0));
    cases->push_back(Stack("radius ratio", fmt::format("small on large {:g}", ratio), {large, small}, ratio == 1000.0));
  }
}

}  // namespace

std::vector<ExtremeCase> StackCases() {
  std::vector<ExtremeCase> cases;
  AddMasses(&cases);
  AddRadii(&cases);
  for (const std::size_t count : {5, 10, 20, 40, 80, 160, 320, 640}) {
    cases.push_back(Stack("column", fmt::format("{} disks", count), std::vector<Grain>(count), count == 5 || count == 40));
  }
  // The criterion alone is content before the floor carries the weight.
  for (const std::size_t count : {5, 20, 80, 200}) {
    ExtremeCase c = Stack("load", fmt::format("column of {} disks, nat 1e-4", count), std::vector<Grain>(count), count == 20);
    c.criterion = "nat";
    c.tolerance = 1e-4;
    c.by_weight = true;
    cases.push_back(c);
  }
  return cases;
}

}  // namespace nscdd
