#include "engine/math/instruction_set.h"

#include "engine/core/check.h"

namespace rowland::math {

const char* instruction_set_name(InstructionSet set) {
    switch (set) {
        case InstructionSet::Baseline:
            return "baseline";
        case InstructionSet::Avx2:
            return "avx2";
    }
    ROWLAND_CHECK(false, "unknown instruction set");
    return "";
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
