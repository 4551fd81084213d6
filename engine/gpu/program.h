#pragma once

#include <cstddef>
#include <functional>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/gpu/handle.h"
#include "engine/gpu/shader_library.h"

namespace rowland::gpu {

/// One message of a GLSL compiler, mapped to its source file.
struct CompileMessage {
    std::string file;  ///< empty if the driver named no position
    std::size_t line = 0;
    std::string text;
};

/// Splits a driver's log into messages, errors first. Lines are numbered as in ShaderText, whose files are `files`.
/// Reads the positions of Mesa "0:12(5): error: …", NVIDIA "0(12) : error …" and others "ERROR: 0:12: …"; any other
/// line becomes a message without a position.
std::vector<CompileMessage> parse_compile_log(std::string_view log, std::span<const std::string> files);

/// What a program is built from: a file of the library for each stage, empty for a stage that it lacks.
struct ProgramDesc {
    std::string vertex = {};
    std::string fragment = {};
    std::string compute = {};
    std::vector<Define> defines = {};
};

class Program {
 public:
    Program() = default;
    /// Throws Error (system) with the file, the line in it and the driver's message if it does not compile or link.
    Program(const ShaderLibrary& library, const ProgramDesc& desc);
    /// The same from texts assembled elsewhere, such as code that a library generated.
    Program(const ShaderText& vertex, const ShaderText& fragment);

    /// Draws use it from now on.
    void use() const;
    /// use(), then runs a compute program on so many groups, and waits for its writes before later reads.
    void dispatch(unsigned groups_x, unsigned groups_y = 1, unsigned groups_z = 1) const;

    /// Sets a uniform, unless it has the value. An unknown name is ignored: compilers remove uniforms that nothing
    /// reads, and which ones differs by driver.
    void set(std::string_view name, int value) const;
    void set(std::string_view name, float value) const;
    void set(std::string_view name, const glm::ivec2& value) const;
    void set(std::string_view name, const glm::vec2& value) const;
    void set(std::string_view name, const glm::vec3& value) const;
    void set(std::string_view name, const glm::vec4& value) const;
    void set(std::string_view name, const glm::mat3& value) const;
    void set(std::string_view name, const glm::mat4& value) const;
    void set(std::string_view name, std::span<const int> values) const;
    void set(std::string_view name, std::span<const float> values) const;
    void set(std::string_view name, std::span<const glm::vec3> values) const;
    void set(std::string_view name, std::span<const glm::vec4> values) const;

    /// Whether the linked program reads such a uniform outside of blocks.
    bool has_uniform(std::string_view name) const;
    GLuint id() const { return handle_.get(); }

 private:
    struct Release {
        void operator()(GLuint name) const;
    };
    void link(std::span<const GLuint> shaders, const std::string& names);
    void find_uniforms();
    /// Records the value and returns the uniform's location; null if there is no such uniform or it has the value.
    std::optional<GLint> changed(std::string_view name, std::span<const std::byte> value) const;

    struct Uniform {
        GLint location = -1;
        std::vector<std::byte> value = {};  ///< last set; empty before
    };
    Handle<Release> handle_;
    mutable std::map<std::string, Uniform, std::less<>> uniforms_;
};

}  // namespace rowland::gpu
