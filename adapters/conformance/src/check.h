// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "broken_adapter.h"
#include "nscdd/conformance/hooks.h"

namespace nscdd::conformance {

struct CheckFailed : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct CheckSkipped : std::runtime_error {
  using std::runtime_error::runtime_error;
};

template <typename... Args>
void Require(bool holds, fmt::format_string<Args...> sentence, Args&&... args) {
  if (!holds) throw CheckFailed(fmt::format(sentence, std::forward<Args>(args)...));
}

/// A host and its adapter, possibly broken on purpose. Tables that come out have consistent columns.
class Session {
 public:
  Session(std::unique_ptr<Host> host, const Fault* fault);

  Host& host() { return *host_; }
  PlatformAdapter& adapter() { return *adapter_; }
  /// Sorted by id.
  BodyTable Read();
  /// At the poses of `bodies`, sorted by id.
  ContactTable Detect(const BodyTable& bodies, double alert);
  /// Poses and velocities of `bodies`, no contacts.
  void Commit(const BodyTable& bodies);

 private:
  std::unique_ptr<Host> host_;
  std::unique_ptr<BrokenAdapter> broken_;
  PlatformAdapter* adapter_;
};

/// What a check gets: new hosts, and random numbers.
class Trial {
 public:
  Trial(HostFactory factory, std::uint64_t seed, const Fault* fault)
      : random(seed), factory_(std::move(factory)), fault_(fault) {}

  /// Throws CheckSkipped if the platform has no such period.
  Session NewSession(double period = 0.0);

  std::mt19937_64 random;

 private:
  HostFactory factory_;
  const Fault* fault_;
};

struct Check {
  std::string name;
  std::string claim;  ///< what it shows, for people
  std::function<void(Trial*)> run;
  std::vector<Fault> faults;  ///< each must make it fail
};

std::vector<Check> BodyChecks();
std::vector<Check> PairChecks();
std::vector<Check> GeometryChecks();
std::vector<Check> SweepChecks();
std::vector<Check> HostChecks();
std::vector<Check> RefusalChecks();
std::vector<Check> DistributionChecks();
std::vector<Check> ClosedFormChecks();
std::vector<Check> AllChecks();

/// Row of the body in a table sorted by id; throws CheckFailed if it is not there.
std::size_t RowOf(const BodyTable& bodies, std::int64_t id);

}  // namespace nscdd::conformance
