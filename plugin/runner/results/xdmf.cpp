// SPDX-License-Identifier: Apache-2.0
#include "results/results_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "results/result_tables.h"

// What all readers of ParaView take (tests/paraview/README.md): coordinates in one data set, topologies that name their points,
// and collections with a grid at every time, empty or not; where one lacks a time, another time is shown.

namespace nscdd {
namespace {

std::string_view NumberType(double) { return R"(NumberType="Float" Precision="8")"; }
std::string_view NumberType(std::int64_t) { return R"(NumberType="Int" Precision="8")"; }
std::string_view NumberType(std::int32_t) { return R"(NumberType="Int" Precision="4")"; }
std::string_view NumberType(std::uint8_t) { return R"(NumberType="UChar" Precision="1")"; }

template <class T>
std::string Item(const std::string& path, std::string_view name, std::uint64_t rows, int width = 1) {
  const std::string extent = width == 1 ? fmt::format("{}", rows) : fmt::format("{} {}", rows, width);
  return fmt::format(R"(<DataItem Format="HDF" Dimensions="{}" {}>results.h5:{}/{}</DataItem>)", extent, NumberType(T{}), path,
                     name);
}

/// One grid at one time: `rows` points, or lines between `point_count` of them.
struct Grid {
  const char* name;
  bool is_lines;
  std::string path;  ///< group of `points` and "connectivity"
  const char* points;
  std::uint64_t rows;
  std::uint64_t point_count;

  std::string Head(double time) const {
    const int width = is_lines ? 2 : 1;
    return fmt::format(
        "   <Grid Name=\"{}\" GridType=\"Uniform\">\n"
        "    <Time Value=\"{}\"/>\n"
        "    <Topology TopologyType=\"{}\" NumberOfElements=\"{}\" NodesPerElement=\"{}\">{}</Topology>\n"
        "    <Geometry GeometryType=\"XYZ\">{}</Geometry>\n",
        name, time, is_lines ? "Polyline" : "Polyvertex", rows, width, Item<std::int32_t>(path, "connectivity", rows, width),
        Item<double>(path, points, point_count, 3));
  }
};

/// Lists the columns that it is shown as attributes of a grid.
struct AttributeWriter {
  const Grid& grid;
  const std::string& path;  ///< group of the columns
  std::string* text;

  template <class T>
  void operator()(const char* name, const char*, const std::vector<T>&) const {
    Add(name, "Scalar", Item<T>(path, name, grid.rows));
  }
  void operator()(const char* name, const char*, const std::vector<double>&, const std::vector<double>&) const {
    const bool is_place = std::string_view(name) == "position" || std::string_view(name) == "point";
    if (!is_place) Add(name, "Vector", Item<double>(path, name, grid.rows, 3));
  }
  void Add(const char* name, const char* type, const std::string& item) const {
    *text += fmt::format("    <Attribute Name=\"{}\" AttributeType=\"{}\" Center=\"{}\">{}</Attribute>\n", name, type,
                         grid.is_lines ? "Cell" : "Node", item);
  }
};

constexpr const char* kEnd = "   </Grid>\n";

// Only their column types are of interest.
const GrainTable kNoGrains;
const ContactRows kNoContacts;

std::string Grains(const XdmfStep& step) {
  const std::string path = step.group + (step.has_disks ? "/disks" : "/grains");
  const Grid grid{"grains", false, path, "position", step.grains, step.grains};
  std::string text = grid.Head(step.time);
  ForEachGrainColumn(kNoGrains, AttributeWriter{grid, path, &text});
  return text + kEnd;
}

/// Points of contact, or the lines between the centres.
std::string Contacts(const XdmfStep& step, bool is_lines) {
  const std::string path = step.group + "/contacts";
  const Grid grid = is_lines ? Grid{"chains", true, step.group + "/chains", "position", step.contacts, 2 * step.contacts}
                             : Grid{"contacts", false, path, "point", step.contacts, step.contacts};
  std::string text = grid.Head(step.time);
  ForEachContactColumn(kNoContacts, AttributeWriter{grid, path, &text});
  return text + kEnd;
}

std::string Walls(const XdmfStep& step) {
  const std::string path = step.group + "/walls";
  const Grid grid{"walls", true, path, "position", step.walls, step.wall_points};
  std::string text = grid.Head(step.time);
  AttributeWriter{grid, path, &text}("body", "", LineTable().body);
  return text + kEnd;
}

/// `format` of all steps, unless all grids are empty.
template <class Count, class Format>
std::string Collection(const char* name, const std::vector<XdmfStep>& steps, Count count, Format format) {
  if (std::none_of(steps.begin(), steps.end(), [&](const XdmfStep& step) { return step.*count > 0; })) return "";
  std::string text = fmt::format("  <Grid Name=\"{}\" GridType=\"Collection\" CollectionType=\"Temporal\">\n", name);
  for (const XdmfStep& step : steps) text += format(step);
  return text + "  </Grid>\n";
}

}  // namespace

std::string FormatXdmf(const std::vector<XdmfStep>& steps) {
  return "<?xml version=\"1.0\"?>\n<Xdmf Version=\"2.0\">\n <Domain>\n" +
         Collection("grains", steps, &XdmfStep::grains, Grains) +
         Collection("contacts", steps, &XdmfStep::contacts, [](const XdmfStep& step) { return Contacts(step, false); }) +
         Collection("chains", steps, &XdmfStep::contacts, [](const XdmfStep& step) { return Contacts(step, true); }) +
         Collection("walls", steps, &XdmfStep::walls, Walls) + " </Domain>\n</Xdmf>\n";
}

}  // namespace nscdd
