// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "solver_settings.h"

namespace nscdd {

/// `nscdd export`; empty paths and strings: not asked for, or as the scene says.
struct ExportRequest {
  std::filesystem::path input;  ///< a scene, or a problem file (.json)
  SolverRequest solver;
  std::string adapter;
  std::int64_t step = 1;        ///< of the scene, from 1
  std::filesystem::path fclib;  ///< file to write in FCLib's HDF5 format
  std::filesystem::path json;   ///< file to write that `nscdd solve` reads
};

/// Solves the scene up to the step, or the problem, and writes that contact problem with the answer. Prints what it wrote and
/// how good the answer is. Throws Error on bad input.
void Export(const ExportRequest& request);

}  // namespace nscdd
