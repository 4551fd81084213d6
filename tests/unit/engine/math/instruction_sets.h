#pragma once

#include <gtest/gtest.h>

#include <string>

#include "engine/math/instruction_set.h"

namespace rowland::test {

/// A test that runs once per instruction set, and is skipped where the processor lacks it.
class OnInstructionSet : public testing::TestWithParam<math::InstructionSet> {
 protected:
    void SetUp() override {
        if (!math::is_supported(GetParam())) GTEST_SKIP() << "this processor lacks it";
    }
};

inline const auto kInstructionSets = testing::Values(math::InstructionSet::Baseline, math::InstructionSet::Avx2);

inline std::string name_of_instruction_set(const testing::TestParamInfo<math::InstructionSet>& info) {
    return math::instruction_set_name(info.param);
}

}  // namespace rowland::test
