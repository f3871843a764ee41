// SPDX-License-Identifier: Apache-2.0
#include "results/hdf5_handle.h"

#include <fmt/format.h>

#include "nscdd/error.h"

namespace nscdd {
namespace {

/// What went wrong first, of HDF5's stack of errors.
std::string Hdf5Reason() {
  std::string reason;
  const auto keep_first = [](unsigned, const H5E_error2_t* error, void* text) -> herr_t {
    auto* first = static_cast<std::string*>(text);
    if (first->empty() && error->desc != nullptr) *first = error->desc;
    return 0;
  };
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, keep_first, &reason);
  return reason.empty() ? "no reason given" : reason;
}

[[noreturn]] void Throw(const std::string& what) { throw Error(fmt::format("cannot {} (HDF5: {}).", what, Hdf5Reason())); }

}  // namespace

Hdf5Handle::Hdf5Handle(hid_t id, Closer closer, const std::string& what) : id_(id), closer_(closer) {
  if (id < 0) Throw(what);
}

void Hdf5Handle::Close(const std::string& what) {
  const hid_t id = std::exchange(id_, H5I_INVALID_HID);
  if (id >= 0) CheckHdf5(closer_(id), what);
}

void CheckHdf5(herr_t status, const std::string& what) {
  if (status < 0) Throw(what);
}

Hdf5Silence::Hdf5Silence() {
  H5Eget_auto2(H5E_DEFAULT, &function_, &data_);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

Hdf5Silence::~Hdf5Silence() { H5Eset_auto2(H5E_DEFAULT, function_, data_); }

}  // namespace nscdd
