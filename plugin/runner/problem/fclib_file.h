// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "nscdd/contact_problem.h"

namespace nscdd {

/// Writes a contact problem with the answer of a solver in FCLib's HDF5 format (fclib.h of libfclib-dev): /fclib_global with M,
/// H, f, w, mu and /fclib_local with W, q, mu (contact_operators.h says the order of rows and the signs; mu is per contact,
/// spacedim 2, matrices in compressed columns), and (v, u, r) as /solution if the solver converged, else as /guesses/1. A file
/// that is there is replaced by the complete new one. Throws Error when there is no contact and when the file cannot be
/// written.
void WriteFclibFile(const std::filesystem::path& path, const std::string& title, const std::string& description,
                    const ContactProblem& problem, const ContactSolution& answer);

}  // namespace nscdd
