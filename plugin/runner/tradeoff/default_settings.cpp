// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "tradeoff/plan.h"

namespace nscdd {
namespace {

using Options = std::vector<std::pair<std::string, std::string>>;

const char* const kAccelerations[] = {"none", "anderson"};

/// A list under construction.
class List {
 public:
  void Add(std::string name, std::string solver, Options options, bool quick = false, int substeps = 1) {
    settings_.push_back({std::move(name), std::move(solver), std::move(options), substeps, quick});
  }
  std::vector<Setting> Take() { return std::move(settings_); }

 private:
  std::vector<Setting> settings_;
};

/// `count` iterations and no test before the last.
Options Fixed(int count, Options options) {
  const std::string text = fmt::format("{}", count);
  options.insert(options.end(), {{"tolerance", "0"}, {"max_iterations", text}, {"test_every", text}});
  return options;
}

std::string Suffix(const std::string& acceleration) { return acceleration == "none" ? "" : fmt::format(" {}", acceleration); }

void AddOneDomain(List* list) {
  for (const std::string acceleration : kAccelerations) {
    for (int decade = 1; decade <= 6; ++decade) {
      list->Add(fmt::format("nscd{} nat 1e-{}", Suffix(acceleration), decade), "nscd",
                {{"acceleration", acceleration}, {"tolerance", fmt::format("1e-{}", decade)}}, decade % 2 == 0);
    }
    for (const int count : {5, 10, 20, 50, 100}) {
      list->Add(fmt::format("nscd{} {} its", Suffix(acceleration), count), "nscd",
                Fixed(count, {{"acceleration", acceleration}}), count == 20);
    }
  }
}

/// Extrapolating every iteration is not always worth its memory traffic.
void AddSparseAnderson(List* list) {
  for (const int decade : {2, 3, 4, 5}) {
    list->Add(fmt::format("nscd anderson/4 nat 1e-{}", decade), "nscd",
              {{"acceleration", "anderson"}, {"anderson_every", "4"}, {"tolerance", fmt::format("1e-{}", decade)}});
  }
}

void AddDecomposed(List* list) {
  for (const std::string grid : {"2x2", "4x4"}) {
    for (const std::string acceleration : kAccelerations) {
      const Options base = {{"subdomains", grid}, {"acceleration", acceleration}};
      const std::string name = fmt::format("nscdd {}{}", grid, Suffix(acceleration));
      for (const int decade : {2, 4}) {
        Options options = base;
        options.emplace_back("tolerance", fmt::format("1e-{}", decade));
        list->Add(fmt::format("{} nat 1e-{}", name, decade), "nscdd", options, decade == 4 && grid == "2x2");
      }
      for (const int count : {10, 20, 50, 100}) list->Add(fmt::format("{} {} its", name, count), "nscdd", Fixed(count, base));
    }
  }
}

void AddEnriched(List* list) {
  const std::pair<const char*, const char*> kPairs[] = {{"10", "5"}, {"1000", "25"}};  // lambda and the n_GS that it needs
  for (const std::string grid : {"2x2", "4x4"}) {
    for (const auto& [lambda, sweeps] : kPairs) {
      for (const std::string acceleration : kAccelerations) {
        const Options base = {
            {"subdomains", grid}, {"lambda", lambda}, {"sweeps_per_stage", sweeps}, {"acceleration", acceleration}};
        const std::string name = fmt::format("fea {} L{} n{}{}", grid, lambda, sweeps, Suffix(acceleration));
        Options options = base;
        options.emplace_back("tolerance", "1e-4");
        list->Add(name + " nat 1e-4", "fea", options, grid == "2x2" && acceleration == "none" && std::string(lambda) == "10");
        list->Add(name + " 4 its", "fea", Fixed(4, base));
      }
    }
  }
}

void AddIncomplete(List* list) {
  for (const std::string grid : {"2x2", "4x4"}) {
    for (const std::string lambda : {"100", "1e4"}) {
      for (const int cap : {20, 600}) {
        Options options = Fixed(cap, {{"subdomains", grid}, {"lambda", lambda}});
        const std::string name = fmt::format("iea {} L{} cap {}", grid, lambda, cap);
        list->Add(name, "iea", options, grid == "2x2" && cap == 20 && lambda == "1e4");
        options.emplace_back("closing_updates", "20");
        list->Add(name + " hybrid 20", "iea", options);
      }
    }
  }
}

void AddNewton(List* list) {
  for (const int decade : {4, 6, 8}) {
    list->Add(fmt::format("newton nat 1e-{}", decade), "newton", {{"tolerance", fmt::format("1e-{}", decade)}}, decade == 4);
  }
}

/// Few iterations in each of many small steps.
void AddSubsteps(List* list) {
  for (const int substeps : {2, 4, 8}) {
    for (const int count : {5, 10, 20}) {
      list->Add(fmt::format("nscd {} its x {} substeps", count, substeps), "nscd", Fixed(count, {{"acceleration", "none"}}),
                substeps == 4 && count == 5, substeps);
    }
  }
}

void AddBox2d(List* list) {
  const std::pair<int, int> kIterations[] = {{4, 2}, {8, 3}, {20, 10}, {50, 20}, {200, 50}};
  for (const auto& [velocity, position] : kIterations) {
    list->Add(fmt::format("Box2D {}/{}", velocity, position), "box2d",
              {{"velocity_iterations", fmt::format("{}", velocity)}, {"position_iterations", fmt::format("{}", position)}},
              velocity == 8 || velocity == 50);
  }
  list->Add("Box2D 4/2 x 4 substeps", "box2d", {{"velocity_iterations", "4"}, {"position_iterations", "2"}}, false, 4);
}

}  // namespace

std::vector<Setting> DefaultSettings() {
  List list;
  AddOneDomain(&list);
  AddSparseAnderson(&list);
  AddDecomposed(&list);
  AddEnriched(&list);
  AddIncomplete(&list);
  AddNewton(&list);
  AddSubsteps(&list);
  AddBox2d(&list);
  return list.Take();
}

}  // namespace nscdd
