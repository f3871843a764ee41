// SPDX-License-Identifier: Apache-2.0
#include "interface/direct_interface.h"

#include <algorithm>
#include <bit>

namespace nscdd {

AugmentedInterface::Direct::Direct(const PartitionedProblem& problem, const std::vector<AugmentedSubdomain>& parts,
                                   Communicator* communicator, KeptSolver* solver)
    : parts_(parts), communicator_(communicator), solver_(solver), dofs_(parts.front().dofs()) {
  NumberNodes(problem);
  GatherPattern();
}

std::vector<double> AugmentedInterface::Direct::Gather(const std::vector<double>& mine) const {
  return communicator_->size() == 1 ? mine : communicator_->AllGather(mine);
}

/// Bodies with a contact are numbered by their ids, which travel as bits: not every id is a double.
void AugmentedInterface::Direct::NumberNodes(const PartitionedProblem& problem) {
  std::vector<double> mine;
  for (std::size_t e = 0; e < parts_.size(); ++e) {
    for (int i = 0; i < parts_[e].nodes(); ++i) {
      mine.push_back(std::bit_cast<double>((*problem.body_id)[problem.subdomains[e].body[parts_[e].CopyOf(i)]]));
    }
  }
  std::vector<std::int64_t> all;
  for (const double bits : Gather(mine)) all.push_back(std::bit_cast<std::int64_t>(bits));
  // Every rank numbers all bodies alike.
  std::vector<std::int64_t> ids = all;
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  unknowns_ = dofs_ * static_cast<int>(ids.size());
  const auto number = [&](std::int64_t id) {
    return static_cast<std::int32_t>(std::lower_bound(ids.begin(), ids.end(), id) - ids.begin());
  };
  for (const std::int64_t id : all) all_numbers_.push_back(number(id));
  auto next = mine.begin();
  for (const AugmentedSubdomain& part : parts_) {
    auto& list = number_.emplace_back();
    for (int i = 0; i < part.nodes(); ++i) list.push_back(number(std::bit_cast<std::int64_t>(*next++)));
  }
}

void AugmentedInterface::Direct::GatherPattern() {
  for (std::size_t e = 0; e < parts_.size(); ++e) parts_[e].AppendPattern(number_[e], &row_, &column_);
  if (communicator_->size() == 1 || solver_->is_distributed()) return;
  std::vector<double> pairs;
  for (std::size_t k = 0; k < row_.size(); ++k) pairs.insert(pairs.end(), {double(row_[k]), double(column_[k])});
  const std::vector<double> all = communicator_->AllGather(pairs);
  row_.clear();
  column_.clear();
  for (std::size_t k = 0; k < all.size(); k += 2) {
    row_.push_back(static_cast<std::int32_t>(all[k]));
    column_.push_back(static_cast<std::int32_t>(all[k + 1]));
  }
}

void AugmentedInterface::Direct::SetMatrix() {
  std::vector<double> values;
  values.reserve(row_.size());
  for (std::size_t e = 0; e < parts_.size(); ++e) parts_[e].AppendValues(number_[e], &values);
  if (!solver_->is_distributed()) values = Gather(values);
  if (pattern_is_set_) {
    solver_->SetValues(std::move(values));
  } else {
    solver_->Set(unknowns_, row_, column_, std::move(values));
    pattern_is_set_ = true;
  }
}

std::vector<std::vector<double>> AugmentedInterface::Direct::Solve(const std::vector<std::vector<double>>& y) {
  SetMatrix();
  std::vector<double> mine;
  for (const auto& part : y) mine.insert(mine.end(), part.begin(), part.end());
  const std::vector<double> all = Gather(mine);
  std::vector<double> x(unknowns_);
  // Copies of one body have one number: their right-hand sides are added, in the order of the subdomains.
  for (std::size_t i = 0; i < all_numbers_.size(); ++i) {
    for (int d = 0; d < dofs_; ++d) x[dofs_ * all_numbers_[i] + d] += all[dofs_ * i + d];
  }
  if (unknowns_ > 0) solver_->Solve(x);
  std::vector<std::vector<double>> solution;
  for (const auto& numbers : number_) {
    auto& part = solution.emplace_back();
    for (const std::int32_t n : numbers) part.insert(part.end(), &x[dofs_ * n], &x[dofs_ * n] + dofs_);
  }
  return solution;
}

}  // namespace nscdd
