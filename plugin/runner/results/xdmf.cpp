// SPDX-License-Identifier: Apache-2.0
#include "results/xdmf.h"

#include <fmt/format.h>

#include <string_view>

#include "results/result_columns.h"

namespace nscdd {
namespace {

std::string_view NumberType(double) { return R"(NumberType="Float" Precision="8")"; }
std::string_view NumberType(std::int64_t) { return R"(NumberType="Int" Precision="8")"; }
std::string_view NumberType(std::int32_t) { return R"(NumberType="Int" Precision="4")"; }
std::string_view NumberType(std::uint8_t) { return R"(NumberType="UChar" Precision="1")"; }

template <class T>
std::string Item(const std::string& table, const char* name, std::uint64_t rows) {
  return fmt::format(R"(<DataItem Format="HDF" Dimensions="{}" {}>results.h5:{}/{}</DataItem>)", rows, NumberType(T{}), table,
                     name);
}

/// One set of points at one time; `columns(visit)` lists the table's columns.
template <class Columns>
std::string Points(const XdmfStep& step, const char* table, std::uint64_t rows, const char* x, const char* y, Columns columns) {
  const std::string path = step.group + "/" + table;
  std::string text = fmt::format(
      "   <Grid Name=\"{0}\" GridType=\"Uniform\">\n"
      "    <Time Value=\"{1}\"/>\n"
      "    <Topology TopologyType=\"Polyvertex\" NumberOfElements=\"{2}\" NodesPerElement=\"1\"/>\n"
      "    <Geometry GeometryType=\"X_Y\">\n     {3}\n     {4}\n    </Geometry>\n",
      table, step.time, rows, Item<double>(path, x, rows), Item<double>(path, y, rows));
  columns([&]<class T>(const char* name, const char*, const std::vector<T>&) {
    text += fmt::format("    <Attribute Name=\"{}\" AttributeType=\"Scalar\" Center=\"Node\">{}</Attribute>\n", name,
                        Item<T>(path, name, rows));
  });
  return text + "   </Grid>\n";
}

// Only their column types are of interest.
const GrainTable kNoGrains;
const ContactRows kNoContacts;

std::string GrainPoints(const XdmfStep& step) {
  return Points(step, "grains", step.grains, "x", "y", [](auto visit) { ForEachGrainColumn(kNoGrains, visit); });
}

std::string ContactPoints(const XdmfStep& step) {
  return Points(step, "contacts", step.contacts, "point_x", "point_y",
                [](auto visit) { ForEachContactColumn(kNoContacts, visit); });
}

std::string Collection(const char* name, const std::string& grids) {
  return fmt::format("  <Grid Name=\"{}\" GridType=\"Collection\" CollectionType=\"Temporal\">\n{}  </Grid>\n", name, grids);
}

}  // namespace

std::string FormatXdmf(const std::vector<XdmfStep>& steps) {
  std::string grains, contacts;
  for (const XdmfStep& step : steps) {
    if (step.grains > 0) grains += GrainPoints(step);
    if (step.contacts > 0) contacts += ContactPoints(step);
  }
  std::string text = "<?xml version=\"1.0\"?>\n<Xdmf Version=\"2.0\">\n <Domain>\n";
  if (!grains.empty()) text += Collection("grains", grains);
  if (!contacts.empty()) text += Collection("contacts", contacts);
  return text + " </Domain>\n</Xdmf>\n";
}

}  // namespace nscdd
