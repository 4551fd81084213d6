#include "tests/gpu_cost/spirv.h"

#include <gmock/gmock.h>

namespace rowland::gpu_cost {
namespace {

using testing::HasSubstr;

TEST(ProgramText, StagesMeetByNameAndArraysComeLast) {
    const ProgramText text =
        for_vulkan({"#version 450 core\n"
                    "layout(location = 0) in vec3 vertex_position;\n"
                    "out vec4 products[3 * LAYERS];\n"
                    "#ifdef HAS_UV\n"
                    "out vec2 uv;  // a comment\n"
                    "#endif\n"
                    "flat out int count;\n",
                    "#version 450 core\n"
                    "flat in int count;\n"
                    "in vec2 uv;\n"
                    "in vec4 products[PRODUCTS];\n"
                    "layout(location = 0) out vec4 radiance;\n"});
    EXPECT_THAT(text.vertex, HasSubstr("\nlayout(location = 0) in vec3 vertex_position;"));
    EXPECT_THAT(text.vertex, HasSubstr("\nlayout(location = 2) out vec4 products[3 * LAYERS];"));
    EXPECT_THAT(text.vertex, HasSubstr("\nlayout(location = 0) out vec2 uv;  // a comment\n#endif\n"));
    EXPECT_THAT(text.fragment,
                HasSubstr("\nlayout(location = 1) flat in int count;\nlayout(location = 0) in vec2 uv;"));
    EXPECT_THAT(text.fragment, HasSubstr("\nlayout(location = 2) in vec4 products[PRODUCTS];\n"));
    EXPECT_THAT(text.fragment, HasSubstr("\nlayout(location = 0) out vec4 radiance;\n"));
}

TEST(ProgramText, LoopsGetTheirLengths) {
    const ProgramText text = with_loops_unrolled(
        {"#version 450 core\nfor (int i = 0; i < int(light_counts.x); ++i) a();\n",
         "#version 450 core\nfor (int k = 0; k < nodes.length(); ++k) b();\nfor (int i = 0; i < parts; ++i) c();\n"},
        {{"light_counts.x", 0}, {"nodes.length()", 16}});
    EXPECT_THAT(text.vertex,
                HasSubstr("if ((0) < (int(float(0)))) [[unroll]] for (int i = 0; i < int(float(0)); ++i) a();"));
    EXPECT_THAT(text.fragment, HasSubstr("[[unroll]] for (int k = 0; k < 16; ++k) b();"));
    EXPECT_THAT(text.fragment, HasSubstr("[[unroll]] for (int i = 0; i < 1; ++i) c();\n"));
    for (const std::string& stage : {text.vertex, text.fragment})
        EXPECT_THAT(stage, testing::StartsWith("#version 450 core\n#extension GL_EXT_control_flow_attributes"));
}

}  // namespace
}  // namespace rowland::gpu_cost
