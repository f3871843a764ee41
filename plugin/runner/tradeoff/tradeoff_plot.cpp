// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/tradeoff_output.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "results/written_file.h"
#include "tradeoff/tradeoff_row.h"

namespace nscdd {
namespace {

struct Panel {
  const char* view;
  Accuracy accuracy;
  const char* title;
};
constexpr Panel kPanels[] = {{"problems", Accuracy::kVelocityError, "same problems: velocity error, energy norm"},
                             {"problems", Accuracy::kNat, "same problems: nat"},
                             {"runs", Accuracy::kInterpenetration, "whole runs: largest interpenetration [mean radii]"},
                             {"runs", Accuracy::kNat, "whole runs: nat"}};

/// gnuplot's own colours repeat after eight.
constexpr const char* kColours[] = {"#9400d3", "#c994c7", "#56b4e9", "#0033cc", "#e6ab02", "#009e73",
                                    "#f4a582", "#b2182b", "#888888", "#80cdc1", "#01665e", "#000000"};

/// A colour and a mark each.
std::string FamilyOf(const Setting& setting) {
  if (setting.name == kSceneSetting) return setting.name;
  const std::string name = setting.is_box2d() ? "Box2D" : setting.solver;
  if (setting.substeps > 1) return name + ", substeps";
  return setting.Option("acceleration", "none") == "none" ? name : name + " " + setting.Option("acceleration");
}

/// gnuplot's strings in single quotes double them; enhanced text is off.
std::string Quoted(const std::string& text) {
  std::string quoted;
  for (const char c : text) quoted += c == '\'' ? "''" : std::string(1, c);
  return "'" + quoted + "'";
}

void AddPoint(const TradeoffRow& row, Accuracy accuracy, std::string* data) {
  const double error = ErrorOf(row, accuracy);
  if (row.is_sound() && std::isfinite(error) && error > 0.0 && row.seconds > 0.0)
    *data += fmt::format("{} {}\n", 1e3 * row.seconds, error);
}

std::string PanelScript(const Panel& panel, int number, const std::vector<TradeoffRow>& all) {
  const std::vector<TradeoffRow> rows = OfView(all, panel.view);
  std::map<std::string, std::string> points;
  for (const TradeoffRow& row : all) points[FamilyOf(row.setting)];  // the same marks in all panels
  for (const TradeoffRow& row : rows) AddPoint(row, panel.accuracy, &points[FamilyOf(row.setting)]);
  std::string front;
  for (const std::size_t i : ParetoFront(rows, panel.accuracy)) AddPoint(rows[i], panel.accuracy, &front);
  std::string script, plot;
  int family = 0;
  for (const auto& [name, data] : points) {
    ++family;
    if (data.empty()) continue;
    script += fmt::format("$d{}_{} << EOD\n{}EOD\n", number, family, data);
    plot += fmt::format("{}$d{}_{} with points pt {} lc rgb '{}' ps 1.1 title {}", plot.empty() ? "" : ", \\\n  ", number,
                        family, family + 3, kColours[(family - 1) % std::size(kColours)], Quoted(name));
  }
  script += fmt::format("set title {}\n", Quoted(panel.title));
  if (plot.empty()) return script + "set multiplot next\n";
  if (!front.empty()) {
    script += fmt::format("$f{} << EOD\n{}EOD\n", number, front);
    plot += fmt::format(", \\\n  $f{} with lines lw 2 lc rgb 'black' title 'front'", number);
  }
  return script + "plot " + plot + "\n";
}

/// Exit code of the program, 127 when there is none; its output is thrown away.
int RunQuietly(std::vector<std::string> words) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  for (const int stream : {1, 2}) posix_spawn_file_actions_addopen(&actions, stream, "/dev/null", O_WRONLY, 0);
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  pid_t child = 0;
  const int failed = posix_spawnp(&child, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failed != 0) return 127;
  int status = 0;
  if (::waitpid(child, &status, 0) != child || !WIFEXITED(status)) return 126;
  return WEXITSTATUS(status);
}

}  // namespace

std::string PlotScript(const std::string& title, const std::vector<TradeoffRow>& rows, const std::string& picture) {
  std::string script = fmt::format(
      "set terminal pngcairo size 1500,1100 noenhanced font 'sans,10'\nif (!exists('picture')) picture = {}\nset output "
      "picture\n"
      "set multiplot layout 2,2 title {}\nset logscale xy\nset format xy '%.0e'\nset grid\n"
      "set key outside right\nset xlabel 'ms a step'\n",
      Quoted(picture), Quoted(title));
  int number = 0;
  for (const Panel& panel : kPanels) script += PanelScript(panel, ++number, rows);
  return script + "unset multiplot\n";
}

std::string PlotTradeoff(const std::filesystem::path& folder, const std::string& title, const std::vector<TradeoffRow>& rows) {
  const std::filesystem::path script = folder / "tradeoff.gp", picture = folder / "tradeoff.png";
  ReplacedFile drawn(picture);
  ReplaceText(script, PlotScript(title, rows, picture.string()));
  const int code = RunQuietly({"gnuplot", "-e", "picture = " + Quoted(drawn.part().string()), script.string()});
  if (code == 127) return fmt::format("no plot: gnuplot is not installed; after installing it: gnuplot {}", script.string());
  if (code != 0) return fmt::format("no plot: gnuplot failed on {}", script.string());
  drawn.Commit();
  return picture.string();
}

}  // namespace nscdd
