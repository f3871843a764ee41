// SPDX-License-Identifier: Apache-2.0
#include "results/hdf5_file.h"

#include <fmt/format.h>
#include <array>
#include <memory>

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

namespace {

Hdf5Handle TextType() {
  Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "make a text type");
  CheckHdf5(H5Tset_size(type.id(), H5T_VARIABLE), "make a text type");
  CheckHdf5(H5Tset_cset(type.id(), H5T_CSET_UTF8), "make a text type");
  return type;
}

}  // namespace

RowRange::RowRange(const RankGroup& ranks, std::size_t rows)
    : first(static_cast<hsize_t>(ranks.SumOfLowerRanks(static_cast<std::int64_t>(rows)))),
      count(rows),
      total(static_cast<hsize_t>(ranks.Sum(static_cast<std::int64_t>(rows)))) {}

Hdf5File::Hdf5File(const std::filesystem::path& path, const RankGroup& ranks)
    : path_(path), ranks_(ranks), parallel_(!ranks.is_serial()) {}

Hdf5File Hdf5File::Create(const std::filesystem::path& path, const RankGroup& ranks, hsize_t user_block) {
  Hdf5File file(path, ranks);
  const Hdf5Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose, file.Writing());
  CheckHdf5(H5Pset_userblock(creation.id(), user_block), file.Writing());
  Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, file.Writing());
  if (file.parallel_) CheckHdf5(H5Pset_fapl_mpio(access.id(), ranks.communicator(), MPI_INFO_NULL), file.Writing());
  file.file_ = Hdf5Handle(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation.id(), access.id()), H5Fclose, file.Writing());
  return file;
}

Hdf5File Hdf5File::Open(const std::filesystem::path& path) {
  Hdf5File file(path, RankGroup());
  file.file_ = Hdf5Handle(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose, "read " + path.string());
  return file;
}

Hdf5Handle Hdf5File::CreateGroup(const std::string& name) {
  return {H5Gcreate2(file_.id(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose, Writing()};
}

Hdf5Handle Hdf5File::OpenGroup(const std::string& name) const {
  return {H5Gopen2(file_.id(), name.c_str(), H5P_DEFAULT), H5Gclose, Reading(name)};
}

std::vector<std::string> Hdf5File::Names(const Hdf5Handle& group) const {
  std::vector<std::string> names;
  const auto append = [](hid_t, const char* name, const H5L_info_t*, void* list) -> herr_t {
    static_cast<std::vector<std::string>*>(list)->emplace_back(name);
    return 0;
  };
  CheckHdf5(H5Literate(group.id(), H5_INDEX_NAME, H5_ITER_INC, nullptr, append, &names), Reading("the list of steps"));
  return names;
}

void Hdf5File::WriteTable(const Hdf5Handle& group, const char* name, const char* unit, hid_t type, const void* data,
                          const RowRange& rows, hsize_t width) {
  const int rank = width > 1 ? 2 : 1;
  const hsize_t first[] = {rows.first, 0}, count[] = {rows.count, width}, total[] = {rows.total, width};
  const Hdf5Handle space(H5Screate_simple(rank, total, nullptr), H5Sclose, Writing());
  const Hdf5Handle column(H5Dcreate2(group.id(), name, type, space.id(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Dclose,
                          Writing());
  if (*unit != '\0') WriteAttribute(column, "unit", unit);
  if (rows.total == 0) return;

  const Hdf5Handle memory(H5Screate_simple(rank, count, nullptr), H5Sclose, Writing());
  const Hdf5Handle transfer(H5Pcreate(H5P_DATASET_XFER), H5Pclose, Writing());
  if (parallel_) CheckHdf5(H5Pset_dxpl_mpio(transfer.id(), H5FD_MPIO_COLLECTIVE), Writing());
  if (rows.count == 0) {
    CheckHdf5(H5Sselect_none(space.id()), Writing());
  } else {
    CheckHdf5(H5Sselect_hyperslab(space.id(), H5S_SELECT_SET, first, nullptr, count, nullptr), Writing());
  }
  // A write may fail on one rank alone, and then none may go on to the next collective call.
  ranks_.RunTogether([&] { CheckHdf5(H5Dwrite(column.id(), type, memory.id(), space.id(), transfer.id(), data), Writing()); });
}

void Hdf5File::WriteVectors(const Hdf5Handle& group, const char* name, const char* unit, const std::vector<double>& x,
                            const std::vector<double>& y, const RowRange& rows) {
  std::vector<std::array<double, 3>> vectors(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) vectors[i] = {x[i], y[i], 0.0};
  WriteTable(group, name, unit, H5T_NATIVE_DOUBLE, vectors.data(), rows, 3);
}

void Hdf5File::ReadVectors(const Hdf5Handle& group, const char* name, std::vector<double>* x, std::vector<double>* y) const {
  const Hdf5Handle data = OpenColumn(group, name);
  const Hdf5Handle space(H5Dget_space(data.id()), H5Sclose, Reading(name));
  hsize_t extent[2] = {0, 0};
  if (H5Sget_simple_extent_ndims(space.id()) == 2) H5Sget_simple_extent_dims(space.id(), extent, nullptr);
  if (extent[1] != 3) {
    throw Error(fmt::format("{} is damaged: {} must have three components a row; run the scene again.", path_.string(), name));
  }
  std::vector<std::array<double, 3>> vectors(extent[0]);
  Read(data, H5T_NATIVE_DOUBLE, vectors.data());
  x->clear();
  y->clear();
  for (const auto& vector : vectors) {
    x->push_back(vector[0]);
    y->push_back(vector[1]);
  }
}

bool Hdf5File::Has(const Hdf5Handle& group, const char* name) const { return H5Lexists(group.id(), name, H5P_DEFAULT) > 0; }

void Hdf5File::Copy(const Hdf5File& from, const std::string& name) {
  CheckHdf5(H5Ocopy(from.file_.id(), name.c_str(), file_.id(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), Writing());
}

void Hdf5File::WriteText(const Hdf5Handle& group, const char* name, const std::string& text) {
  const Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose, Writing());
  CheckHdf5(H5Tset_size(type.id(), text.size() + 1), Writing());
  const Hdf5Handle space(H5Screate(H5S_SCALAR), H5Sclose, Writing());
  const Hdf5Handle data(H5Dcreate2(group.id(), name, type.id(), space.id(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Dclose,
                        Writing());
  CheckHdf5(H5Dwrite(data.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, text.c_str()), Writing());
}

Hdf5Handle Hdf5File::OpenColumn(const Hdf5Handle& group, const char* name) const {
  return {H5Dopen2(group.id(), name, H5P_DEFAULT), H5Dclose, Reading(name)};
}

std::size_t Hdf5File::RowsOf(const Hdf5Handle& column) const {
  const Hdf5Handle space(H5Dget_space(column.id()), H5Sclose, Reading("a column"));
  return static_cast<std::size_t>(H5Sget_simple_extent_npoints(space.id()));
}

void Hdf5File::Read(const Hdf5Handle& column, hid_t type, void* data) const {
  CheckHdf5(H5Dread(column.id(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data), Reading("a column"));
}

void Hdf5File::CheckRows(const Hdf5Handle& column, const char* name, std::int64_t first, std::int64_t count) const {
  const Hdf5Handle space(H5Dget_space(column.id()), H5Sclose, Reading(name));
  const bool fits = H5Sget_simple_extent_ndims(space.id()) == 1 && first >= 0 && count >= 0 &&
                    first <= H5Sget_simple_extent_npoints(space.id()) - count;
  if (!fits) throw Error("the column " + std::string(name) + " in " + path_.string() + " has another number of rows.");
}

void Hdf5File::ReadRows(const Hdf5Handle& column, hid_t type, std::int64_t first, std::int64_t count, void* data) const {
  if (count == 0) return;
  const auto from = static_cast<hsize_t>(first), rows = static_cast<hsize_t>(count);
  const Hdf5Handle space(H5Dget_space(column.id()), H5Sclose, Reading("a column"));
  const Hdf5Handle memory(H5Screate_simple(1, &rows, nullptr), H5Sclose, Reading("a column"));
  CheckHdf5(H5Sselect_hyperslab(space.id(), H5S_SELECT_SET, &from, nullptr, &rows, nullptr), Reading("a column"));
  CheckHdf5(H5Dread(column.id(), type, memory.id(), space.id(), H5P_DEFAULT, data), Reading("a column"));
}

void Hdf5File::WriteScalar(const Hdf5Handle& object, const char* name, hid_t type, const void* value) {
  const Hdf5Handle space(H5Screate(H5S_SCALAR), H5Sclose, Writing());
  const Hdf5Handle attribute(H5Acreate2(object.id(), name, type, space.id(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose, Writing());
  CheckHdf5(H5Awrite(attribute.id(), type, value), Writing());
}

void Hdf5File::ReadScalar(const Hdf5Handle& object, const char* name, hid_t type, void* value) const {
  const Hdf5Handle attribute(H5Aopen(object.id(), name, H5P_DEFAULT), H5Aclose, Reading(name));
  CheckHdf5(H5Aread(attribute.id(), type, value), Reading(name));
}

void Hdf5File::WriteAttribute(const Hdf5Handle& object, const char* name, const std::string& text) {
  const char* characters = text.c_str();
  WriteScalar(object, name, TextType().id(), &characters);
}

void Hdf5File::WriteAttribute(const Hdf5Handle& object, const char* name, double value) {
  WriteScalar(object, name, H5T_NATIVE_DOUBLE, &value);
}

void Hdf5File::WriteAttribute(const Hdf5Handle& object, const char* name, std::int64_t value) {
  WriteScalar(object, name, H5T_NATIVE_INT64, &value);
}

void Hdf5File::ReadAttribute(const Hdf5Handle& object, const char* name, std::string* text) const {
  char* characters = nullptr;
  ReadScalar(object, name, TextType().id(), &characters);
  const std::unique_ptr<char, herr_t (*)(void*)> owner(characters, H5free_memory);
  *text = characters == nullptr ? "" : characters;
}

void Hdf5File::ReadAttribute(const Hdf5Handle& object, const char* name, double* value) const {
  ReadScalar(object, name, H5T_NATIVE_DOUBLE, value);
}

void Hdf5File::ReadAttribute(const Hdf5Handle& object, const char* name, std::int64_t* value) const {
  ReadScalar(object, name, H5T_NATIVE_INT64, value);
}

void Hdf5File::Flush() { CheckHdf5(H5Fflush(file_.id(), H5F_SCOPE_GLOBAL), Writing()); }

void Hdf5File::Close() { file_.Close(Writing()); }

}  // namespace nscdd
