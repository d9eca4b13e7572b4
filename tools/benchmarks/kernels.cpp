// Times the stages of smoothing one mesh and the machine's limits, with Google Benchmark.
//
//   kernels MESH OUT [BENCHMARK-OPTION...]      OUT is overwritten repeatedly
//
// Everything runs in one process, and with --benchmark_enable_random_interleaving in turn, so that
// the ratio of a stage to its limit is meaningful even if the machine has other work. Each
// benchmark is named NAME/THREADS and has a counter `bytes` or `flops`: for a limit, the amount
// moved or computed; for a stage, the least necessary amount.
#include <chrono>
#include <exception>
#include <functional>
#include <iostream>
#include <string>

#include <benchmark/benchmark.h>

#include "ibmfair/base/process_memory.h"
#include "ibmfair/base/threads.h"
#include "ibmfair/io/source_bytes.h"
#include "machine_limits.h"
#include "stages.h"

namespace ibmfair::benchmarks {
namespace {

struct Kernel {
  std::string name;
  int threads;
  std::function<void()> run;
  const char* unit;                     ///< "bytes" or "flops"
  double amount;                        ///< of that unit in one run
  std::function<void()> clear = [] {};  ///< after each run, not timed
};

void add(const Kernel& kernel) {
  const auto body = [=](benchmark::State& state) {
    set_thread_count(kernel.threads);
    for ([[maybe_unused]] auto _ : state) {
      const auto start = std::chrono::steady_clock::now();
      kernel.run();
      const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
      state.SetIterationTime(seconds.count());
      kernel.clear();
    }
    state.counters[kernel.unit] = kernel.amount;
  };
  const std::string full_name = kernel.name + "/" + std::to_string(kernel.threads);
#ifndef __clang_analyzer__  // the analyzer does not know that registered benchmarks are kept
  benchmark::RegisterBenchmark(full_name.c_str(), body)
      ->UseManualTime()
      ->MinTime(0.02)  // seconds, of one repetition
      ->Unit(benchmark::kSecond);
#endif
}

void add_limits(const StageInputs& inputs) {
  static const MemoryReading memory;
  static MatrixProduct<double> doubles;
  static MatrixProduct<float> floats;
  const auto sum = [](int threads) { benchmark::DoNotOptimize(memory.sum(threads)); };
  const auto read = [&] { read_bytes(inputs.path); };
  const auto write = [&] {
    write_bytes(inputs.output, static_cast<std::size_t>(inputs.written_bytes));
  };
  const auto input_bytes = static_cast<double>(inputs.file.bytes().size());
  add({"limit: memory", 1, [=] { sum(1); }, "bytes", memory.bytes()});
  add({"limit: memory", 2, [=] { sum(2); }, "bytes", memory.bytes()});
  add({"limit: dgemm", 1, [] { doubles.run(); }, "flops", doubles.flops()});
  add({"limit: sgemm", 1, [] { floats.run(); }, "flops", floats.flops()});
  add({"limit: read", 1, read, "bytes", input_bytes});
  add({"limit: write", 1, write, "bytes", inputs.written_bytes});
}

void add_stages(StageInputs& inputs) {
  for (const Stage& stage : stages()) {
    if (stage.possible != nullptr && !stage.possible(inputs)) continue;
    const bool computes = stage.flops != nullptr;
    for (const int threads : {1, 2}) {
      add({std::string(stage.name), threads, [&inputs, &stage] { stage.run(inputs); },
           computes ? "flops" : "bytes", computes ? stage.flops(inputs) : stage.bytes(inputs),
           [&inputs] { inputs.results = {}; }});
    }
  }
}

/// The counts by which a table divides the figures.
void add_sizes(const StageInputs& inputs) {
  const auto add_size = [](const char* name, std::int64_t size) {
    benchmark::AddCustomContext(name, std::to_string(size));
  };
  add_size("vertices", inputs.topology.vertex_count);
  add_size("triangles", inputs.topology.F.rows());
  add_size("hinges", inputs.topology.H.rows());
}

int run(int argc, char** argv) {
  if (argc < 3) {
    std::cerr << "usage: kernels MESH OUT [BENCHMARK-OPTION...]\n";
    return 2;
  }
  set_thread_count(1);
  StageInputs inputs(argv[1], argv[2]);
  add_limits(inputs);
  add_stages(inputs);
  add_sizes(inputs);
  int options = argc - 2;
  benchmark::Initialize(&options, argv + 2);
  if (benchmark::ReportUnrecognizedArguments(options, argv + 2)) {
    return 2;
  }
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}

}  // namespace
}  // namespace ibmfair::benchmarks

int main(int argc, char** argv) {
  // As the program does.
  ibmfair::keep_freed_memory();
  ibmfair::use_large_pages();
  try {
    return ibmfair::benchmarks::run(argc, argv);
  } catch (const std::exception& error) {
    std::cerr << "kernels: " << error.what() << "\n";
    return 1;
  }
}
