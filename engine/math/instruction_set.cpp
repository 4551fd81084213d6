#include "engine/math/instruction_set.h"

namespace rowland::math {

const char* instruction_set_name(InstructionSet set) {
    return set == InstructionSet::Avx2 ? "avx2" : "baseline";
}

bool is_supported(InstructionSet set) {
    if (set == InstructionSet::Baseline) return true;
#ifdef ROWLAND_MATH_AVX2
    return __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0;
#else
    return false;
#endif
}

InstructionSet best_instruction_set() {
    return is_supported(InstructionSet::Avx2) ? InstructionSet::Avx2 : InstructionSet::Baseline;
}

}  // namespace rowland::math
