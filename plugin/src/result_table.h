// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "nscdd/report.h"
#include "nscdd/time_stepper.h"
#include "nscdd_plugin.h"

namespace nscdd {

/// A table of numbers in columns, kept for the C interface.
class ResultTable {
 public:
  void FillBodies(const BodyResults& results);
  void FillContacts(const ContactResults& results);
  void FillIterations(std::span<const IterationRecord> records);

  /// Points into this object; the header is left alone.
  void Show(nscdd_table* table) const;

 private:
  template <class Results, class Columns>
  void Fill(const Results& results, const Columns& columns);

  std::uint64_t rows_ = 0;
  std::vector<std::uint64_t> numbers_;  // column after column; bits of a double or of an int64_t
  std::vector<nscdd_column> columns_;
};

}  // namespace nscdd
