// SPDX-License-Identifier: Apache-2.0
#include "newton/library_lu.h"

#include <vector>

#include "newton/block_lu.h"
#include "nscdd/error.h"

namespace nscdd {

template <int B>
void LibraryLu<B>::Analyse(const BlockMatrix<B>& matrix) {
  row_.clear();
  column_.clear();
  for (int i = 0; i < matrix.rows(); ++i) {
    for (std::int32_t k = matrix.begin[i]; k < matrix.begin[i + 1]; ++k) {
      for (int r = 0; r < B; ++r) {
        for (int c = 0; c < B; ++c) {
          row_.push_back(B * i + r);
          column_.push_back(B * matrix.column[k] + c);
        }
      }
    }
  }
  size_ = B * static_cast<std::size_t>(matrix.rows());
}

template <int B>
bool LibraryLu<B>::Factorise(const BlockMatrix<B>& matrix) {
  try {
    solver_.Set(static_cast<int>(size_), row_, column_, matrix.values);
  } catch (const Error&) {
    return false;  // singular: the caller regularises more
  }
  return true;
}

template <int B>
void LibraryLu<B>::Solve(double* x) {
  solver_.Solve({x, size_});
}

template <int B>
std::unique_ptr<BlockFactor<B>> MakeBlockFactor(LinearLibrary library) {
  if (library == LinearLibrary::kAuto) return std::make_unique<BlockLu<B>>();
  return std::make_unique<LibraryLu<B>>(MakeLocalSolver(library, Symmetry::kGeneral));
}

template class LibraryLu<2>;
template class LibraryLu<3>;
template std::unique_ptr<BlockFactor<2>> MakeBlockFactor<2>(LinearLibrary);
template std::unique_ptr<BlockFactor<3>> MakeBlockFactor<3>(LinearLibrary);

}  // namespace nscdd
