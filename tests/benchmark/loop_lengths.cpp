#include "tests/benchmark/loop_lengths.h"

#include <array>
#include <optional>

namespace rowland::benchmark {

namespace {

/// A component of a uniform block's member.
struct Component {
    const char* expression;
    const char* member;
    GLint index;
};

constexpr Component kCounts[] = {
    {"light_counts.x", "light_counts", 0},
    {"light_counts.y", "light_counts", 1},
    {"key_lobe_count.x", "key_lobe_count", 0},
};

GLint property(GLuint program, GLenum interface, GLuint index, GLenum name) {
    GLint value = -1;
    glGetProgramResourceiv(program, interface, index, 1, &name, 1, nullptr, &value);
    return value;
}

std::optional<int> value_of(GLuint program, const Component& component) {
    const GLuint member = glGetProgramResourceIndex(program, GL_UNIFORM, component.member);
    if (member == GL_INVALID_INDEX) return std::nullopt;
    const GLint block = property(program, GL_UNIFORM, member, GL_BLOCK_INDEX);
    const auto binding =
        static_cast<GLuint>(property(program, GL_UNIFORM_BLOCK, static_cast<GLuint>(block), GL_BUFFER_BINDING));
    GLint buffer = 0;
    GLint64 start = 0;
    glGetIntegeri_v(GL_UNIFORM_BUFFER_BINDING, binding, &buffer);
    glGetInteger64i_v(GL_UNIFORM_BUFFER_START, binding, &start);
    const GLint offset = property(program, GL_UNIFORM, member, GL_OFFSET);
    float value = 0.0F;
    glGetNamedBufferSubData(static_cast<GLuint>(buffer),
                            static_cast<GLintptr>(start) + offset + GLintptr{4} * component.index, sizeof(value),
                            &value);
    return static_cast<int>(value);
}

/// The number of elements of an array of structures that ends a storage block. `member`: one of the first element.
std::optional<int> array_length(GLuint program, const char* block_name, const char* member) {
    const GLuint block = glGetProgramResourceIndex(program, GL_SHADER_STORAGE_BLOCK, block_name);
    const GLuint variable = glGetProgramResourceIndex(program, GL_BUFFER_VARIABLE, member);
    if (block == GL_INVALID_INDEX || variable == GL_INVALID_INDEX) return std::nullopt;
    const auto binding = static_cast<GLuint>(property(program, GL_SHADER_STORAGE_BLOCK, block, GL_BUFFER_BINDING));
    GLint buffer = 0;
    GLint64 size = 0;
    glGetIntegeri_v(GL_SHADER_STORAGE_BUFFER_BINDING, binding, &buffer);
    glGetInteger64i_v(GL_SHADER_STORAGE_BUFFER_SIZE, binding, &size);  // 0: the whole buffer
    if (size == 0) glGetNamedBufferParameteri64v(static_cast<GLuint>(buffer), GL_BUFFER_SIZE, &size);
    return static_cast<int>(size / property(program, GL_BUFFER_VARIABLE, variable, GL_TOP_LEVEL_ARRAY_STRIDE));
}

}  // namespace

LoopLengths loop_lengths(GLuint program) {
    LoopLengths lengths;
    for (const Component& component : kCounts)
        if (const std::optional<int> value = value_of(program, component)) lengths[component.expression] = *value;
    if (const std::optional<int> segments = array_length(program, "StreakSegments", "streak_segments[0].first_step"))
        lengths["streak_segments.length()"] = *segments;
    return lengths;
}

}  // namespace rowland::benchmark
