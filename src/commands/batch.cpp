#include <memory>

#include <CLI/CLI.hpp>

#include "commands/argument_roles.h"
#include "commands/batch/batch_options.h"
#include "commands/batch/job_file.h"
#include "commands/batch/run_batch.h"
#include "commands/command.h"
#include "commands/documentation.h"
#include "commands/shared_options.h"

namespace ibmfair::commands {

namespace {

struct BatchArguments {
  std::string jobs;
  BatchOptions options;
};

std::string default_journal(const std::string& jobs) {
  return jobs == "-" ? ".ibmfair-batch.journal" : jobs + ".journal";
}

constexpr const char* format_text =
    R"({"defaults": {"command": "smooth", "options": {"cutoff": "2%"}},
 "jobs": [{"input": "scans/*.ply", "output": "fair/"},
          {"input": ["a.obj", "b.obj"], "output": "fair/{stem}.ply",
           "options": {"steps": 32}},
          {"command": "make", "shape": "torus", "output": "torus.off"}]}
`ibmfair COMMAND ... --dump-config` prints a run in this format.
)";

}  // namespace

Runner declare_batch(CLI::App& app) {
  auto arguments = std::make_shared<BatchArguments>();
  BatchOptions& options = arguments->options;
  CLI::Option* jobs =
      app.add_option("JOBS", arguments->jobs, "job file to read; - is standard input")
          ->type_name(file_to_read)
          ->required();
  note_of(app, *jobs).extensions = {"json"};
  begin_group(app, groups::many_files);
  add_batch_options(app, options);
  begin_group(app, groups::every_command);
  app.add_flag("--dump-config", options.dump_config,
               "print the list file by file with all defaults, run nothing");
  begin_group(app, groups::reports_and_pictures);
  app.add_flag("--json", options.report.json, "write the summary as JSON to standard output");
  add_overwrite_option(app, options.overwrite);
  documentation_of(app).sections = {{"A job file", format_text}};
  documentation_of(app).examples = {
      {"ibmfair batch jobs.json --jobs 4 --summary summary.csv",
       "runs four jobs at a time, and writes what became of each"},
      {"ibmfair batch jobs.json --resume", "runs only what is not done, or has changed"},
      {"ibmfair batch jobs.json --shared", "runs it together with all that are started so"},
  };
  return [arguments, &app](Console& console) {
    BatchOptions options = arguments->options;
    options.threads = app["--threads"]->empty() ? 0 : app["--threads"]->as<int>();
    return run_batch(app, read_jobs(arguments->jobs), options, default_journal(arguments->jobs),
                     console);
  };
}

}  // namespace ibmfair::commands
