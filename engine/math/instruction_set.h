#pragma once

namespace rowland::math {

/// Instruction sets that the fast single-precision paths are compiled for. Bake code never uses them: cooked bytes must
/// not depend on the machine.
enum class InstructionSet {
    Baseline,  ///< what every processor of the target architecture has; on x86-64 that is SSE2, four lanes
    Avx2,      ///< x86-64 with AVX2 and FMA, eight lanes
};

/// "baseline" or "avx2".
const char* instruction_set_name(InstructionSet set);

/// Whether this build has the path and this processor and operating system can run it.
bool is_supported(InstructionSet set);

/// The widest supported set.
InstructionSet best_instruction_set();

}  // namespace rowland::math
