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
           "options": {"steps": 32, "weld": true}},
          {"command": "make", "shape": "torus", "output": "torus.off"}]}

A job has a command, its arguments (`input` is IN, `output` is OUT) and its
options. Names of files may hold {name}, {stem}, {ext} and {dir} of the input.
`ibmfair COMMAND ... --dump-config` prints any command line in this format.
All arguments are checked before the first job runs.
)";

constexpr const char* record_text =
    R"(Each file is a process of its own. A file that fails or runs out of memory
does not stop the others; the exit code is 1 then. --summary writes what
became of each file as .csv, .json or .html.

A journal (JOBS.journal, or .ibmfair-batch.journal in the output folder)
records what each result was made from. --resume skips a file whose options,
inputs and outputs are unchanged and were made by this version, and runs all
other files again. An input is unchanged if its size and times are the same,
or else if its contents have the same hash. After Ctrl-C or kill -9 every
output is complete or absent.

One run at a time records in a journal. A second run is refused (exit code 2);
the message names the machine, the process and the start of the first. --merge
and --dry-run only read, and are always allowed. The lock ends with the
process, also after kill -9, so that --resume can go on at once. It is a lock
of flock(). On NFS it holds between machines, except on mounts with `nolock`
or `local_lock`; on sshfs it holds between processes of one machine only. If a
machine crashes, NFS version 4 releases its locks after a minute or two, and
version 3 when the machine has started again. To go on earlier, make the
journal a new file: `cp JOURNAL new && mv new JOURNAL`.
)";

constexpr const char* cluster_text =
    R"(Machines that see the same files can each run a part of a list of jobs. For
Slurm, write this script to the file fair.sbatch:

    #!/bin/bash
    #SBATCH --array=1-8 --cpus-per-task=1 --requeue
    srun ibmfair batch jobs.json --shard "$SLURM_ARRAY_TASK_ID/8" \
      --threads 1 --resume

and submit it, followed by a job that writes the summary:

    fair=$(sbatch --parsable fair.sbatch)
    sbatch --dependency="afterany:$fair" \
      --wrap "ibmfair batch jobs.json --merge --summary summary.csv"

With GNU parallel, on this machine:

    parallel ibmfair batch jobs.json --shard {}/8 --threads 1 --resume \
      ::: {1..8}

or on several machines, and then the summary:

    parallel --sshlogin node1,node2 --workdir . \
      ibmfair batch jobs.json --shard {}/8 --resume ::: {1..8}
    ibmfair batch jobs.json --merge --summary summary.csv

For Snakemake, the source of ibmfair has a Snakefile in tools/cluster.

--shard divides the list beforehand, and each part keeps a record of its own.
A part that was killed is started again with the same command: --resume runs
only what is still to be done. The parts of one division can run at the same
time. Parts of two divisions would do the same files; this is not noticed.

--merge runs nothing. It writes the summary that a single run of the whole
list would have written, with `not run` for what is still to be done. The exit
code is 1 unless everything is done.
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
               "print the list file by file with all defaults, without running it");
  begin_group(app, groups::reports_and_pictures);
  app.add_flag("--json", options.report.json, "write the summary as JSON to standard output");
  add_overwrite_option(app, options.overwrite);
  documentation_of(app).sections = {{"A job file", format_text},
                                    {"Records and resuming", record_text},
                                    {"On a cluster", cluster_text}};
  documentation_of(app).examples = {
      {"ibmfair batch jobs.json --jobs 4 --summary summary.csv",
       "runs four jobs at a time, and writes the result of each to a table"},
      {"ibmfair batch jobs.json --resume",
       "runs only the jobs that are not done, or whose files have changed"},
      {"ibmfair batch jobs.json --shard 3/8 --resume",
       "runs the third of eight parts of the list, of which other machines run the others"},
  };
  return [arguments, &app](Host& host) {
    BatchOptions options = arguments->options;
    options.threads = app["--threads"]->empty() ? 0 : app["--threads"]->as<int>();
    return run_batch(app, read_jobs(arguments->jobs), options, default_journal(arguments->jobs),
                     host.console());
  };
}

}  // namespace ibmfair::commands
