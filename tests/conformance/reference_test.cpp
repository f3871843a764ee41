// SPDX-License-Identifier: Apache-2.0
#include "reference_host.h"

int main(int argc, char** argv) {
  return nscdd::conformance::Main(argc, argv, [](double period) { return std::make_unique<nscdd::ReferenceHost>(period); });
}
