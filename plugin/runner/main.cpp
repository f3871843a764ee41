// SPDX-License-Identifier: Apache-2.0
// The program `nscdd`. Exit codes: 0 fine; 2 bad input; 3 stopped because a step did not converge and the scene says to stop;
// 4 told to end by a signal, can be resumed; 1 anything that no input should cause, such as a solver that `extremes` finds
// wrong without a word.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <functional>

#include "command_line.h"
#include "commands/commands.h"
#include "mpi_session.h"
#include "nscdd/error.h"
#include "nscdd/host/validator.h"
#include "render/render.h"
#include "scene/text.h"

namespace {

using namespace nscdd;

/// An option whose text goes to the solver under `name`.
void AddSolverOption(CLI::App* command, SolverRequest* request, const std::string& flag, const std::string& name,
                     const std::string& help) {
  command->add_option_function<std::string>(
      flag, [request, name](const std::string& value) { request->options.emplace_back(name, value); }, help);
}

void AddSolverOptions(CLI::App* command, SolverRequest* request) {
  command->add_option("--solver", request->solver, "Solver: see `nscdd solvers`");
  command->add_option("--plugin", request->plugin, "Solver plugin (default: $NSCDD_PLUGIN, else the one beside this program)");
  AddSolverOption(command, request, "--subdomains", "subdomains", "Grid of subdomains, NXxNY (all but nscd and newton)");
  AddSolverOption(command, request, "--tolerance", "tolerance", "Tolerance of the criterion");
  AddSolverOption(command, request, "--criterion", "criterion", "nat, nat_max, quad, maxm or qm16");
  AddSolverOption(command, request, "--max-iterations", "max_iterations", "Sweeps, or interface updates, at most");
  AddSolverOption(command, request, "--test-every", "test_every", "Iterations between two tests of the criterion");
  AddSolverOption(command, request, "--acceleration", "acceleration", "none or anderson (nscd, nscdd, fea)");
  AddSolverOption(command, request, "--sweeps-per-stage", "sweeps_per_stage", "Sweeps per interface update (nscdd, fea, rea)");
  AddSolverOption(command, request, "--lambda", "lambda", "Search direction of the augmented interface (fea, rea, iea)");
  AddSolverOption(command, request, "--interface", "interface", "direct or cg (fea, rea, iea)");
  command->add_option_function<std::vector<std::string>>(
      "--option",
      [request](const std::vector<std::string>& pairs) {
        for (const std::string& pair : pairs) {
          const auto equals = pair.find('=');
          if (equals == std::string::npos) throw CLI::ValidationError("--option", "write NAME=VALUE, not '" + pair + "'");
          request->options.emplace_back(pair.substr(0, equals), pair.substr(equals + 1));
        }
      },
      "Any other option of the solver, NAME=VALUE; may be repeated");
}

class Program {
 public:
  explicit Program(const MpiSession& session) : session_(session) {
    app_.require_subcommand(1);
    app_.set_version_flag("--version", "nscdd " NSCDD_VERSION);
    app_.footer(
        "Exit codes: 0 fine, 2 bad input, 3 stopped at a step that did not converge (on_nonconvergence = \"stop\"), "
        "4 ended by a signal and ready for --resume, 1 a fault of the program or (extremes) of a solver.");
    AddRun();
    AddCheck();
    AddSolvers();
    AddSolve();
    AddExport();
    AddTradeoff();
    AddRender();
    AddValidate();
    AddExtremes();
  }

  int Main(int argc, char** argv) {
    CheckArguments(app_, {argv, static_cast<std::size_t>(argc)});
    try {
      app_.parse(argc, argv);
    } catch (const CLI::ParseError& e) {
      if (e.get_exit_code() != 0) throw Error(SentenceOf(e));
      if (session_.ranks().is_root()) app_.exit(e);  // prints the help
      return 0;
    }
    const int code = action_();
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
      throw Error("what was printed could not be written; mend the standard output");
    return code;
  }

 private:
  std::string SentenceOf(const CLI::ParseError& error) const {
    std::string command;
    for (const CLI::App* chosen : app_.get_subcommands()) command = chosen->get_name() + " ";
    return fmt::format("{}; see `nscdd {}--help`.", error.what(), command);
  }

  /// Commands other than run work on one rank.
  void OnRoot(CLI::App* command, std::function<int()> work) {
    command->callback([this, work] {
      action_ = [this, work] {
        int code = 0;
        session_.ranks().RunOnRoot([&] { code = work(); });
        return code;
      };
    });
  }

  void AddRun() {
    CLI::App* run = app_.add_subcommand("run", "Solve a scene step by step (also under mpirun)");
    run->add_option("scene", run_.scene, "Scene file (TOML)");
    run->add_option("--resume", run_.resume, "Go on with the run in this folder, instead of a scene");
    AddSolverOptions(run, &run_.solver);
    run->add_flag_callback(
        "--cold", [this] { run_.solver.options.emplace_back("warm_start", "false"); }, "Begin every step from zero impulses");
    run->add_option("--adapter", run_.adapter, "Platform: box2d or reference");
    AddWhole(run, "--steps", 1, &run_.steps, "Number of steps in all, those before --resume included");
    AddWhole(run, "--save-every", 1, &run_.save_every, "Save every K-th step in results.h5 (default: first and last)");
    AddWhole(run, "--checkpoint-every", 1, &run_.checkpoint_every, "Write a checkpoint every N-th step, for --resume");
    run->add_option("--out", run_.out, "Folder of the results (default: results/SCENE)");
    run->add_flag("--quiet", run_.quiet, "Print nothing but errors");
    run->callback([this] { action_ = [this] { return Run(run_, session_); }; });
  }

  void AddCheck() {
    CLI::App* check = app_.add_subcommand("check", "Read and build a scene without solving it");
    check->add_option("scene", run_.scene, "Scene file (TOML)")->required();
    check->add_option("--adapter", run_.adapter, "Platform: box2d or reference");
    AddSolverOptions(check, &run_.solver);
    OnRoot(check, [this] {
      Check(run_.scene, run_.adapter, run_.solver);
      return 0;
    });
  }

  void AddSolvers() {
    CLI::App* solvers = app_.add_subcommand("solvers", "List the solvers with their options, units and defaults");
    solvers->add_option("--plugin", run_.solver.plugin, "Solver plugin");
    OnRoot(solvers, [this] {
      ListSolvers(run_.solver.plugin);
      return 0;
    });
  }

  void AddSolve() {
    CLI::App* solve = app_.add_subcommand("solve", "Solve one contact problem (JSON) and print its solution (JSON)");
    solve->add_option("problem", run_.scene, "Problem file")->required();
    AddSolverOptions(solve, &run_.solver);
    solve->add_flag("--self-stress", self_stress_,
                    "Print the share of the impulses that changes no velocity, undetermined_share");
    OnRoot(solve, [this] {
      Solve(run_.scene, run_.solver, self_stress_);
      return 0;
    });
  }

  void AddExport() {
    CLI::App* command = app_.add_subcommand("export", "Write one step's contact problem and its answer for other programs");
    command->add_option("input", export_.input, "Scene file (TOML) or problem file (.json)")->required();
    AddWhole(command, "--step", 1, &export_.step, "Step of the scene")->default_str("1");
    command->add_option("--fclib", export_.fclib, "File to write in FCLib's HDF5 format");
    command->add_option("--json", export_.json, "File to write for `nscdd solve`");
    command->add_option("--adapter", export_.adapter, "Platform: box2d or reference");
    AddSolverOptions(command, &export_.solver);
    OnRoot(command, [this] {
      Export(export_);
      return 0;
    });
  }

  void AddTradeoff() {
    CLI::App* tradeoff = app_.add_subcommand("tradeoff", "Measure on a scene what each saved second costs in accuracy");
    tradeoff->add_option("scene", tradeoff_.scene, "Scene file (TOML)")->required();
    tradeoff->add_option("--plugin", tradeoff_.solver.plugin, "Solver plugin");
    tradeoff->add_option("--adapter", tradeoff_.adapter, "Platform: box2d or reference");
    tradeoff->add_option("--solvers", tradeoff_.solvers, "Only settings of these solvers, as nscd,nscdd,box2d")->delimiter(',');
    tradeoff->add_option("--settings", tradeoff_.settings, "File of [[settings]] instead of the built-in list");
    tradeoff
        ->add_option("--observable", tradeoff_.observable,
                     "Compared with the reference's: centre_of_mass_x, centre_of_mass_y, "
                     "kinetic_energy, wall_force, wall_force_x, wall_force_y or flow_rate")
        ->capture_default_str();
    tradeoff->add_option("--accuracy", tradeoff_.accuracy, "What whole runs are ranked by: nat, nat_max or interpenetration")
        ->capture_default_str();
    AddPositive(tradeoff, "--budget", &tradeoff_.budget, "Seconds a step that you can spend");
    AddWhole(tradeoff, "--steps", 1, &tradeoff_.steps, "Steps to measure, spread over the scene (default: all, at most 100)");
    AddWhole(tradeoff, "--problems", 1, &tradeoff_.problems, "Steps whose problems all settings solve (default 20)");
    AddWhole(tradeoff, "--repetitions", 0, &tradeoff_.repetitions, "Passes for the time (default 5)");
    AddPositive(tradeoff, "--time-limit", &tradeoff_.time_limit, "Seconds that the measurement may take (default 600)");
    tradeoff->add_option("--out", tradeoff_.out, "Folder of the results (default: results/SCENE_tradeoff)");
    tradeoff->add_flag("--cold", tradeoff_.cold, "Solve the recorded problems from zero impulses");
    tradeoff->add_flag("--quick", tradeoff_.quick, "A short list: 5 steps, 3 problems, 1 repetition, a minute at most");
    tradeoff->add_flag("--store", tradeoff_.store, "Also put the front beside the scene, where solver \"auto\" finds it");
    tradeoff->add_flag("--quiet", tradeoff_.quiet, "Print nothing but errors");
    OnRoot(tradeoff, [this] {
      Tradeoff(tradeoff_);
      return 0;
    });
  }

  void AddRender() {
    CLI::App* render = app_.add_subcommand("render", "Draw a saved step of a run");
    render->add_option("folder", render_.folder, "Folder of the results")->required();
    AddWhole(render, "--step", 0, &render_.step, "Step, 0: the initial state (default: the last one saved)");
    render->add_option("--show", show_, "grains, forces, multiplicity or overlap")->capture_default_str();
    render->add_option("-o,--output", render_.output, "Picture, .png or .svg (default: FOLDER/SHOW_STEP.png)");
    OnRoot(render, [this] {
      render_.show = ParseShow(show_);
      const RenderedPicture picture = Render(render_);
      fmt::print("{} (step {}, {} x {})\n", picture.file.string(), picture.step, picture.width, picture.height);
      return 0;
    });
  }

  void AddValidate() {
    CLI::App* validate = app_.add_subcommand("validate-plugin", "Check a solver plugin, each check in a process of its own");
    validate->add_option("file", validated_, "Shared library")->required();
    OnRoot(validate, [this] {
      ValidatorOptions options;
      options.print = [](const std::string& line) { fmt::print("{}\n", line); };
      const int failed = ValidatePlugin(validated_, options);
      fmt::print("{}\n", failed == 0 ? "The plugin is valid." : fmt::format("{} checks failed.", failed));
      return failed == 0 ? 0 : 2;
    });
  }

  void AddExtremes() {
    CLI::App* extremes =
        app_.add_subcommand("extremes", "Map where each solver holds: scenes at the edges, with a known truth");
    extremes->add_option("--plugin", extremes_.plugin, "Solver plugin");
    extremes->add_option("--solvers", extremes_.solvers, "Only these, such as nscd,nscdd/anderson,newton")->delimiter(',');
    extremes->add_option("--out", extremes_.out, "Folder of extremes.csv and extremes.png")->capture_default_str();
    extremes->add_flag("--quick", extremes_.quick, "Fewer cases and iterations");
    OnRoot(extremes, [this] { return Extremes(extremes_); });
  }

  const MpiSession& session_;
  CLI::App app_{"nscdd: contact dynamics of dense packings of disks, by domain decomposition"};
  RunRequest run_;
  bool self_stress_ = false;
  ExportRequest export_;
  TradeoffRequest tradeoff_;
  RenderRequest render_;
  std::string show_ = "forces";
  ExtremesRequest extremes_;
  std::string validated_;
  std::function<int()> action_;
};

}  // namespace

int main(int argc, char** argv) {
  const MpiSession session(&argc, &argv);
  try {
    return Program(session).Main(argc, argv);
  } catch (const Error& e) {  // the same on all ranks
    if (session.ranks().is_root()) fmt::print(stderr, "nscdd: {}\n", Printable(e.what()));
    return 2;
  } catch (const std::exception& e) {
    fmt::print(stderr, "nscdd: rank {}: unexpected: {}\n", session.ranks().rank(), e.what());
    session.Abort(1);
  }
}
