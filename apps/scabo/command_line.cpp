// The command line of Scabo: the options of every command, and what is said about mistakes in them.
#include "command_line.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <new>
#include <sstream>
#include <string>
#include <vector>

#include "cluster.hpp"
#include "command_description.hpp"
#include "command_texts.hpp"
#include "commands.hpp"
#include "compare/solvers.hpp"
#include "new_model.hpp"
#include "number_checks.hpp"
#include "scabo/result/version.hpp"
#include "scabo/run/failures.hpp"
#include "startup.hpp"
#include "terminal.hpp"

namespace scabo::app {

namespace {

constexpr const char* model_help = "Model file (YAML or JSON)";
constexpr const char* set_help =
    "Replaces or adds a value of the model file, as in\ncontacts.joint.friction=0.5; may be repeated";

/// `--set a=1 b=2` becomes `--set a=1 --set b=2`, so that a model file may also follow the settings.
std::vector<std::string> spread_settings(const std::vector<std::string>& words) {
  std::vector<std::string> spread;
  bool in_settings = false;  // the last word was the value of a --set
  for (size_t i = 0; i < words.size(); ++i) {
    if (words[i] == "--set") {
      spread.push_back(words[i]);
      if (++i < words.size()) spread.push_back(words[i]);
      in_settings = true;
    } else {
      in_settings = in_settings && !words[i].starts_with("-") && words[i].find('=') != std::string::npos;
      if (in_settings) spread.push_back("--set");
      spread.push_back(words[i]);
    }
  }
  return spread;
}

/// A name or value that is given but empty, as by a variable of a shell script that is not set.
void refuse_empty_words(const CLI::App& command) {
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_items_expected_min() == 0) continue;  // flags, and values that may be left out
    for (const std::string& word : option->results())
      if (word.empty())
        throw CLI::ValidationError(
            option->get_positional()
                ? fmt::format("{}: is empty: name one", option->get_name())
                : fmt::format("{}: is empty: give a value, or leave the option out", option->get_name()));
  }
}

/// Reads the command line; throws CLI::ParseError for help, version and mistakes.
class CommandLine {
 public:
  explicit CommandLine(Cluster* cluster) : cluster_(cluster) {
    if (cluster_) run_options_.threads = cluster_->threads_of_a_rank();
    app_.set_version_flag("-V,--version", fmt::format("scabo {}", result::version()), "Prints the version");
    app_.set_help_flag("-h,--help", "Prints help; `scabo run --help` prints the help of `run`");
    app_.require_subcommand(1);
    app_.footer(exit_statuses);
    app_.get_formatter()->column_width(24);
    add_run();
    add_resume();
    add_sweep();
    add_check();
    add_exponents();
    add_contact();
    schema_->footer(schema_example);
    add_plot();
    add_report();
    add_new();
    add_convert();
    add_completion();
    manual_->footer("Example:\n  scabo manual | man -l -");
  }

  void parse(std::vector<std::string> words) {
    if (!words.empty() && words.front() == "help") {  // `scabo help run` is `scabo run --help`
      words.erase(words.begin());
      words.emplace_back("--help");
    }
    words_ = words;
    std::reverse(words.begin(), words.end());  // the order that CLI11 expects
    app_.parse(std::move(words));
    for (const CLI::App* command : app_.get_subcommands()) refuse_empty_words(*command);
    for (const CLI::App* command : {run_, resume_})
      if (!cluster_ && *command && command->get_option("--divide-from")->count() > 0)
        throw CLI::ValidationError("--divide-from is for runs by mpirun: start it so, or leave the option out");
    if (!*contact_) return;
    contact_options_.write_trace = trace_->count() > 0;
    // In `--trace problem.hdf5` the file is the problem, not the trace.
    if (contact_options_.file.empty()) std::swap(contact_options_.file, contact_options_.trace);
    if (contact_options_.file.empty()) throw CLI::RequiredError("FILE");
  }

  ExitStatus execute() const {
    if (*run_) return run(run_options_, cluster_);
    if (*resume_) return resume(resume_options_, cluster_);
    if (*sweep_) return sweep(sweep_options_);
    if (*check_) return check(check_options_);
    if (*exponents_) return print_exponents(exponents_options_);
    if (*contact_) return solve_contact(contact_options_);
    if (*plot_) return plot(plot_options_.directory, {words_.begin() + 1, words_.end()});
    if (*report_) return report({words_.begin() + 1, words_.end()});
    if (*new_) return write_new_model(new_options_);
    if (*convert_) return convert_deck(convert_options_);
    if (*completion_) return print(completion_script(describe_commands(app_), shell_));
    if (*manual_) return print(manual_page(describe_commands(app_)));
    return print_schema();
  }

  /// Prints the requested help or version, or a mistake in one line with its remedy.
  ExitStatus explain(const CLI::ParseError& error, const std::vector<std::string>& words) const {
    if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) {
      std::ostringstream text, nothing;
      app_.exit(error, text, nothing);
      return print(text.str());
    }
    const auto chosen = app_.get_subcommands();
    const std::string command = chosen.empty() ? "scabo" : "scabo " + chosen.front()->get_name();
    std::string message = error.what();
    if (chosen.empty() && error.get_name() == "RequiredError") {
      const bool named = !words.empty() && !words.front().starts_with("-");
      std::string available;
      for (const CLI::App* known : app_.get_subcommands([](const CLI::App*) { return true; }))
        available += (available.empty() ? "" : ", ") + known->get_name();
      message = (named ? fmt::format("there is no command '{}'", words.front()) : "no command given") +
                ": available are " + available;
    }
    print_error(fmt::format("{} (see `{} --help`)", message, command));
    return ExitStatus::wrong_input;
  }

 private:
  static std::string solver_help() {
    std::string names;
    for (const std::string& name : compare::method_names()) names += (names.empty() ? "" : ", ") + name;
    return "Default b_differentiable; there are " + names;
  }

  static void add_settings(CLI::App& command, std::vector<std::string>& settings) {
    command.add_option("--set", settings, set_help)
        ->type_name("PATH=VALUE")
        ->option_text("PATH=VALUE ...")
        ->allow_extra_args(false);
  }

  static void add_division(CLI::App& command, double& divide_from) {
    command
        .add_option("--divide-from", divide_from,
                    fmt::format("Under mpirun: bodies of at least so many degrees of freedom are divided among the "
                                "processes; default: {:.0f}",
                                divide_from))
        ->option_text("DOFS")
        ->check(number_from_zero());
  }

  /// Accepts only these words.
  static CLI::Validator one_of(const std::vector<std::string>& words) {
    const std::string all = fmt::format("{}", fmt::join(words, ","));
    return {[words](const std::string& word) {
              const bool known = std::find(words.begin(), words.end(), word) != words.end();
              return known ? std::string() : fmt::format("'{}' is none of {}", word, fmt::join(words, ", "));
            },
            "{" + all + "}"};
  }

  void add_run() {
    run_->add_option("MODEL", run_options_.model, model_help)->required()->option_text(" ");
    run_->add_option("-o,--output", run_options_.output, "Results directory; default: model.results, beside model.yaml")
        ->type_name("DIR")
        ->option_text("DIR");
    add_settings(*run_, run_options_.settings);
    run_->add_option("--threads", run_options_.threads,
                     "Largest number of threads, 1 or more; default: one for each processor. Small models use one")
        ->option_text("N")
        ->check(whole_number(1, 1024));
    run_->add_flag("-q,--quiet", run_options_.quiet, "Prints only errors and warnings");
    run_->add_flag("--json-lines", run_options_.json_lines,
                   "Prints what happens as JSON, one object a line, for other programs; text goes to standard error");
    run_->add_flag("--ignore-memory", run_options_.ignore_memory,
                   "Starts even if less memory is available than the analysis is expected to need");
    add_division(*run_, run_options_.divide_from);
    run_->add_flag("--report", run_options_.report, "Writes a page for the browser at the end, as `scabo report` does");
    run_->footer(run_example);
  }

  void add_resume() {
    resume_->add_option("DIR", resume_options_.directory, "Results directory of the run")->required()->option_text(" ");
    resume_->add_option("--model", resume_options_.model, "The model file, if it was moved")->option_text("MODEL");
    resume_
        ->add_option("--threads", resume_options_.threads,
                     "Largest number of threads; default: as before. Another number may change the last digits")
        ->option_text("N")
        ->check(whole_number(1, 1024));
    resume_->add_flag("-q,--quiet", resume_options_.quiet, "Prints only errors and warnings");
    add_division(*resume_, resume_options_.divide_from);
    resume_->add_flag(
        "--json-lines", resume_options_.json_lines,
        "Prints what happens as JSON, one object a line, for other programs; text goes to standard error");
    resume_->footer(resume_example);
  }

  void add_sweep() {
    sweep_->add_option("MODEL", sweep_options_.model, model_help)->required()->option_text(" ");
    sweep_->add_option("--vary", sweep_options_.vary, "Values to run; may be repeated")
        ->required()
        ->type_name("PATH=VALUES")
        ->option_text("PATH=VALUES ...")
        ->allow_extra_args(false);
    add_settings(*sweep_, sweep_options_.settings);
    sweep_->add_option("-o,--output", sweep_options_.output, "Directory; default: model.sweep, beside model.yaml")
        ->option_text("DIR");
    sweep_->add_option("-j,--jobs", sweep_options_.jobs, "Runs at a time; default: one for each processor")
        ->option_text("N")
        ->check(whole_number(1, 1024));
    sweep_
        ->add_option("--threads", sweep_options_.threads,
                     "Threads of each run; default: processors over runs at a time")
        ->option_text("N")
        ->check(whole_number(1, 1024));
    sweep_->add_flag("--anew", sweep_options_.anew, "Replaces what DIR holds of another sweep, and runs all points");
    sweep_->add_flag("-q,--quiet", sweep_options_.quiet, "Prints only errors");
    sweep_->footer(sweep_example);
  }

  void add_check() {
    check_->add_option("MODEL", check_options_.model, model_help)->required()->option_text(" ");
    add_settings(*check_, check_options_.settings);
    check_->add_flag("--plot", check_options_.plot, "Draws the model, as `scabo plot MODEL` does");
    check_->footer(check_example);
  }

  void add_exponents() {
    exponents_->add_option("MODEL", exponents_options_.model, model_help)->required()->option_text(" ");
    add_settings(*exponents_, exponents_options_.settings);
    exponents_->add_flag("--json", exponents_options_.json, "Prints JSON instead of tables");
    exponents_->footer(exponents_example);
  }

  void add_contact() {
    contact_->add_option("FILE", contact_options_.file, "Discrete contact problem")->option_text(" ");
    contact_->add_option("--solver", contact_options_.solver, solver_help())->option_text("NAME");
    contact_
        ->add_option("--tolerance", contact_options_.tolerance,
                     "Limit of the natural-map residual or the certificate; default 1e-10")
        ->option_text("X")
        ->check(number_from(1e-15, 0.1));
    contact_->add_option("--iterations", contact_options_.iterations, "Largest number of iterations of one attempt")
        ->option_text("N")
        ->check(whole_number(1, 100'000'000));
    contact_
        ->add_option("--time-limit", contact_options_.time_limit,
                     "Ends the solve after this time and reports the best iterate")
        ->option_text("SECONDS")
        ->check(positive_number());
    contact_->add_flag("--json", contact_options_.json, "Prints the solution as JSON");
    contact_->add_flag("--uniqueness", contact_options_.uniqueness, "Looks for other solutions and reports them");
    trace_ = contact_
                 ->add_option("--trace", contact_options_.trace,
                              "Writes every iteration as CSV, and a plot (.svg) beside it; default: "
                              "FILE.trace.csv")
                 ->option_text("[=CSV]")
                 ->expected(0, 1);
    contact_
        ->add_option("--save", contact_options_.save,
                     "Writes the problem and its solution as HDF5; if the name ends in .dat, the problem as text")
        ->option_text("NEW");
    contact_->footer(contact_example);
  }

  void add_new() {
    std::vector<std::string> kinds;
    for (const StarterModel& model : starter_models()) kinds.emplace_back(model.name);
    new_->add_option("KIND", new_options_.kind, fmt::format("Subject of the model: {}", fmt::join(kinds, ", ")))
        ->required()
        ->option_text(" ")
        ->check(one_of(kinds));
    new_->add_option("-o,--output", new_options_.output, "Name of the file; default: KIND.yaml")->option_text("FILE");
    new_->footer(new_example);
  }

  void add_convert() {
    convert_->add_option("DECK", convert_options_.deck, "Input file (.inp)")->required()->option_text(" ");
    convert_
        ->add_option("-o,--output", convert_options_.output,
                     "Name of the model file; default: part.yaml, beside part.inp")
        ->option_text("FILE");
    convert_->add_flag("--rigid-contact", convert_options_.rigid_contact,
                       "Leaves out the stiffness that the deck gives to contact and sticking, however small");
    convert_->add_flag("--incomplete", convert_options_.incomplete,
                       "Writes a model even if something essential is missing in it");
    convert_->add_flag("--force", convert_options_.force, "Replaces the files that there are");
    convert_->footer(convert_example);
  }

  void add_completion() {
    completion_->add_option("SHELL", shell_, "Shell")
        ->required()
        ->option_text(" ")
        ->check(one_of({"bash", "zsh", "fish"}));
    completion_->footer(completion_example);
  }

  /// The options themselves are passed on to the program for pictures; here they are only checked.
  void add_plot() {
    plot_->add_option("DIR", plot_options_.directory, "Results directory of a run; or a model file, drawn unsolved")
        ->required()
        ->option_text(" ");
    const std::vector<std::string> kinds = {"stress", "contact",   "convergence", "mesh",     "history", "lines",
                                            "cracks", "mechanism", "envelope",    "spectrum", "all"};
    plot_
        ->add_option("--what", plot_options_.what,
                     fmt::format("What is drawn: {}; default: all that the results have, but envelope and spectrum",
                                 fmt::join(kinds, ", ")))
        ->option_text("KIND")
        ->check(one_of(kinds));
    plot_
        ->add_option("--increment", plot_options_.increment,
                     "Number from 1 over all steps, or of the mode; default: -1, the last one")
        ->option_text("N");
    plot_
        ->add_option("--component", plot_options_.text,
                     "Part of stress, contact, history, lines or spectrum; a wrong name lists them")
        ->option_text("NAME");
    plot_->add_option("--contact", plot_options_.contacts, "Only this contact; may be repeated")
        ->option_text("NAME")
        ->allow_extra_args(false);
    plot_->add_option("--scale", plot_options_.scale, "Magnification of displacements; default: one that shows them")
        ->option_text("S");
    plot_
        ->add_option("--window", plot_options_.text,
                     "Only this part of the plane, in stress, mesh, cracks and mechanism")
        ->option_text("X0,X1,Y0,Y1");
    plot_->add_flag("--mirror", plot_options_.mirror, "Bodies of revolution: both halves of the section");
    plot_
        ->add_option("--turned", plot_options_.turned,
                     "Bodies of revolution: no picture, but a .vtu of the fields turned about the axis in N parts")
        ->option_text("N");
    plot_->add_option("--view", plot_options_.text, "From where bodies in space are seen, in degrees; default: -60,25")
        ->option_text("AZIMUTH,ELEVATION");
    plot_
        ->add_option("--cut", plot_options_.text,
                     "Stress of bodies in space: a point of a plane and its normal; what this points to is taken away")
        ->option_text("X,Y,Z,NX,NY,NZ");
    plot_->add_option("--along", plot_options_.text, "Lines and contact of bodies in space: values along this line")
        ->option_text("X0,Y0,Z0,X1,Y1,Z1");
    plot_->add_option("--units", plot_options_.text, "Units of the model, as in --units m,N")
        ->option_text("LENGTH,FORCE");
    plot_
        ->add_option("-o,--output", plot_options_.text,
                     "A .png, .svg or .pdf, of lines a .csv too; default: .png files beside DIR, one for each picture")
        ->option_text("FILE");
    plot_->footer(plot_example);
  }

  /// Likewise passed on.
  void add_report() {
    report_->add_option("DIR", report_options_.directory, "Results directory of a run")->required()->option_text(" ");
    report_->add_option("-o,--output", report_options_.text, "Name of the page; default: model.report.html beside DIR")
        ->option_text("FILE");
    report_->add_flag("--mirror", report_options_.mirror, "Bodies of revolution: both halves of the section");
    report_
        ->add_option("--units", report_options_.text, "Units of the model, as in --units m,N; the page can change them")
        ->option_text("LENGTH,FORCE");
    report_
        ->add_option(
            "--size", report_options_.size,
            "Largest size of the page in megabytes; default: 25. Of long runs it leaves out fields of increments")
        ->option_text("MB")
        ->check(positive_number());
    report_
        ->add_option("--fields", report_options_.text,
                     "Fields that the page has, of displacement, stress, principal, von_mises; default: all")
        ->option_text("NAMES");
    report_->add_flag("-q,--quiet", report_options_.quiet, "Does not print the name of the page");
    report_->footer(report_example);
  }

  static ExitStatus print(const std::string& text) {
    print_output(text);
    return ExitStatus::solved;
  }

  Cluster* cluster_;
  CLI::App app_{"Scabo: frictional contact by the scaled boundary finite element method", "scabo"};
  CLI::App* run_ = app_.add_subcommand("run", "Solves a model and writes its results");
  CLI::App* resume_ = app_.add_subcommand("resume", "Continues a run that was interrupted or killed");
  CLI::App* sweep_ = app_.add_subcommand("sweep", "Runs a model with varied values and makes a table of the results");
  CLI::App* check_ = app_.add_subcommand("check", "Reads and meshes a model and reports its size, without solving it");
  CLI::App* exponents_ = app_.add_subcommand("exponents", "Prints the exponents of every super-element");
  CLI::App* contact_ = app_.add_subcommand("contact", "Solves and certifies a discrete contact problem from a file");
  CLI::Option* trace_ = nullptr;
  CLI::App* schema_ = app_.add_subcommand("schema", "Prints the JSON Schema of the model file");
  CLI::App* plot_ = app_.add_subcommand("plot", "Draws pictures of results");
  CLI::App* report_ = app_.add_subcommand("report", "Writes results as one page for the browser");
  CLI::App* new_ = app_.add_subcommand("new", "Writes a commented model to begin with");
  CLI::App* convert_ = app_.add_subcommand("convert", "Makes a model from an Abaqus or CalculiX deck");
  CLI::App* completion_ = app_.add_subcommand("completion", "Prints completion of commands and options for a shell");
  CLI::App* manual_ = app_.add_subcommand("manual", "Prints the manual page");
  /// Values of the options of `plot` that are only checked.
  struct {
    std::string directory, what, text;
    std::vector<std::string> contacts;
    int increment = 0, turned = 0;
    double scale = 0.0;
    bool mirror = false;
  } plot_options_;
  /// The same of `report`.
  struct {
    std::string directory, text;
    double size = 0.0;
    bool quiet = false, mirror = false;
  } report_options_;
  NewOptions new_options_;
  ConvertOptions convert_options_;
  std::string shell_;
  std::vector<std::string> words_;  ///< the command line as given
  RunOptions run_options_;
  ResumeOptions resume_options_;
  SweepOptions sweep_options_;
  CheckOptions check_options_;
  ExponentsOptions exponents_options_;
  ContactOptions contact_options_;
};

}  // namespace

ExitStatus main_program(const std::vector<std::string>& words, Cluster* cluster) {
  try {
    CommandLine command_line(cluster);
    try {
      command_line.parse(spread_settings(words));
    } catch (const CLI::ParseError& error) {
      return command_line.explain(error, words);
    }
    return command_line.execute();
  } catch (const InputError& error) {
    print_mistakes(error);
    return ExitStatus::wrong_input;
  } catch (const std::bad_alloc&) {
    print_error(run::not_enough_memory);
  } catch (const std::exception& error) {
    print_error(error.what());
  }
  return ExitStatus::failure;
}

}  // namespace scabo::app
