// Times of the parts that run on the processor, without a frame around them. Google Benchmark's own options apply, such
// as --benchmark_filter=sh_ and --benchmark_format=json.
#include "engine/math/instruction_set.h"
#include "tests/benchmark/microbenchmarks.h"
#include "tests/benchmark/processor.h"

int main(int argc, char** argv) {
    using namespace rowland::microbenchmark;
    ::benchmark::Initialize(&argc, argv);
    if (::benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
    ::benchmark::AddCustomContext("processor", rowland::processor_name());
    ::benchmark::AddCustomContext("instruction set", instruction_set_name(rowland::math::best_instruction_set()));
    register_sh_evaluation();
    register_sh_rotation();
    register_frame_rotation();
    register_projection();
    register_spike_table();
    register_entities();
    ::benchmark::RunSpecifiedBenchmarks();
    ::benchmark::Shutdown();
    return 0;
}
