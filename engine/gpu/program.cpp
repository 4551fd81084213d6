#include "engine/gpu/program.h"

#include <fmt/format.h>
#include <algorithm>
#include <glm/gtc/type_ptr.hpp>
#include <regex>

#include "engine/core/error.h"
#include "engine/gpu/pipeline_state.h"
#include "engine/gpu/shader_library.h"

namespace rowland::gpu {

namespace {

/// A line's position up to its message: NVIDIA's, Mesa's and others'. The number before the line's is the source
/// string's, always 0 here.
const std::regex& position_pattern() {
    static const std::regex pattern(
        R"(\d{1,9}\((\d{1,9})\) : |\d{1,9}:(\d{1,9})\(\d{1,9}\): |(?:ERROR|WARNING): \d{1,9}:(\d{1,9}): )");
    return pattern;
}

CompileMessage parse_line(std::string_view line, std::span<const std::string> files) {
    std::cmatch match;
    if (std::regex_search(line.data(), line.data() + line.size(), match, position_pattern(),
                          std::regex_constants::match_continuous)) {
        std::size_t number = 0;
        for (std::size_t i = 1; i < match.size(); ++i)
            if (match[i].matched) number = std::stoul(match[i].str());
        if (number / lines_per_file < files.size())
            return {files[number / lines_per_file], number % lines_per_file, match.suffix().str()};
    }
    return {"", 0, std::string(line)};
}

bool is_error(const CompileMessage& message) {
    return message.text.find("warning") == std::string::npos && message.text.find("WARNING") == std::string::npos;
}

}  // namespace

std::vector<CompileMessage> parse_compile_log(std::string_view log, std::span<const std::string> files) {
    std::vector<CompileMessage> messages;
    for (std::size_t start = 0; start < log.size();) {
        const std::size_t end = std::min(log.find('\n', start), log.size());
        const std::string_view line = log.substr(start, end - start);
        if (line.find_first_not_of(" \t\r") != std::string_view::npos) messages.push_back(parse_line(line, files));
        start = end + 1;
    }
    std::stable_partition(messages.begin(), messages.end(), is_error);
    return messages;
}

namespace {

struct ReleaseShader {
    void operator()(GLuint name) const { glDeleteShader(name); }
};
using Shader = Handle<ReleaseShader>;

std::string info_log(GLuint name, bool is_program) {
    GLint length = 0;
    (is_program ? glGetProgramiv : glGetShaderiv)(name, GL_INFO_LOG_LENGTH, &length);
    std::string log(static_cast<std::size_t>(length), '\0');
    (is_program ? glGetProgramInfoLog : glGetShaderInfoLog)(name, length, &length, log.data());
    log.resize(static_cast<std::size_t>(length));
    return log;
}

[[noreturn]] void fail_to_compile(const ShaderText& source, const std::string& log) {
    const std::vector<CompileMessage> messages = parse_compile_log(log, source.files);
    ErrorInfo info{.file = source.files.front(),
                   .location = {},
                   .found = "a shader the driver refuses without saying why",
                   .expected = {},
                   .remedy = {},
                   .fault = Fault::System};
    if (!messages.empty()) {
        const CompileMessage& first = messages.front();
        if (!first.file.empty()) info.file = first.file;
        if (first.line > 0) info.location = fmt::format("line {}", first.line);
        info.found = first.text;
        for (std::size_t i = 1; i < messages.size(); ++i) {
            info.found += fmt::format(" | {}:{}: {}", messages[i].file, messages[i].line, messages[i].text);
        }
    }
    throw Error(std::move(info));
}

Shader compile(GLenum stage, const ShaderText& source) {
    Shader shader(glCreateShader(stage));
    const char* text = source.text.c_str();
    glShaderSource(shader.get(), 1, &text, nullptr);
    glCompileShader(shader.get());
    GLint compiled = GL_FALSE;
    glGetShaderiv(shader.get(), GL_COMPILE_STATUS, &compiled);
    if (compiled != GL_TRUE) fail_to_compile(source, info_log(shader.get(), false));
    return shader;
}

template <typename T>
std::span<const std::byte> bytes_of(const T& value) {
    return std::as_bytes(std::span(&value, 1));
}

}  // namespace

void Program::Release::operator()(GLuint name) const {
    glDeleteProgram(name);
    bound_state().forget(BoundState::Slot::Program, name);
}

Program::Program(const ShaderLibrary& library, const ProgramDesc& desc) {
    std::vector<Shader> shaders;
    std::vector<GLuint> names;
    std::string files;
    const auto add = [&](GLenum stage, const std::string& file) {
        if (file.empty()) return;
        shaders.push_back(compile(stage, library.assemble(file, desc.defines)));
        names.push_back(shaders.back().get());
        files += (files.empty() ? "" : " + ") + file;
    };
    add(GL_VERTEX_SHADER, desc.vertex);
    add(GL_FRAGMENT_SHADER, desc.fragment);
    add(GL_COMPUTE_SHADER, desc.compute);
    link(names, files);
}

Program::Program(const ShaderText& vertex, const ShaderText& fragment) {
    const Shader vertex_shader = compile(GL_VERTEX_SHADER, vertex);
    const Shader fragment_shader = compile(GL_FRAGMENT_SHADER, fragment);
    const std::vector<GLuint> names{vertex_shader.get(), fragment_shader.get()};
    link(names, vertex.files.front() + " + " + fragment.files.front());
}

void Program::link(std::span<const GLuint> shaders, const std::string& names) {
    handle_ = Handle<Release>(glCreateProgram());
    for (const GLuint shader : shaders) glAttachShader(id(), shader);
    glLinkProgram(id());
    for (const GLuint shader : shaders) glDetachShader(id(), shader);
    GLint linked = GL_FALSE;
    glGetProgramiv(id(), GL_LINK_STATUS, &linked);
    if (linked != GL_TRUE) {
        throw Error({.file = names,
                     .location = "linking",
                     .found = info_log(id(), true),
                     .expected = {},
                     .remedy = {},
                     .fault = Fault::System});
    }
    find_uniforms();
}

void Program::find_uniforms() {
    GLint count = 0;
    GLint longest = 0;
    glGetProgramiv(id(), GL_ACTIVE_UNIFORMS, &count);
    glGetProgramiv(id(), GL_ACTIVE_UNIFORM_MAX_LENGTH, &longest);
    std::string name;
    for (GLint i = 0; i < count; ++i) {
        name.resize(static_cast<std::size_t>(longest));
        GLsizei length = 0;
        GLint size = 0;
        GLenum type = GL_NONE;
        glGetActiveUniform(id(), static_cast<GLuint>(i), longest, &length, &size, &type, name.data());
        name.resize(static_cast<std::size_t>(length));
        const GLint location = glGetUniformLocation(id(), name.c_str());
        if (location < 0) continue;  // a member of a block
        if (name.ends_with("[0]")) name.resize(name.size() - 3);
        uniforms_[name].location = location;
    }
}

std::optional<GLint> Program::changed(std::string_view name, std::span<const std::byte> value) const {
    const auto found = uniforms_.find(name);
    if (found == uniforms_.end()) return std::nullopt;
    std::vector<std::byte>& known = found->second.value;
    if (std::ranges::equal(known, value)) return std::nullopt;
    known.assign(value.begin(), value.end());
    return found->second.location;
}

bool Program::has_uniform(std::string_view name) const {
    return uniforms_.find(name) != uniforms_.end();
}

void Program::use() const {
    if (bound_state().changes(BoundState::Slot::Program, 0, {id()})) glUseProgram(id());
}

void Program::dispatch(unsigned groups_x, unsigned groups_y, unsigned groups_z) const {
    use();
    glDispatchCompute(groups_x, groups_y, groups_z);
    glMemoryBarrier(GL_ALL_BARRIER_BITS);
}

void Program::set(std::string_view name, int value) const {
    if (const auto at = changed(name, bytes_of(value))) glProgramUniform1i(id(), *at, value);
}

void Program::set(std::string_view name, float value) const {
    if (const auto at = changed(name, bytes_of(value))) glProgramUniform1f(id(), *at, value);
}

void Program::set(std::string_view name, const glm::ivec2& value) const {
    if (const auto at = changed(name, bytes_of(value))) glProgramUniform2iv(id(), *at, 1, glm::value_ptr(value));
}

void Program::set(std::string_view name, const glm::vec2& value) const {
    if (const auto at = changed(name, bytes_of(value))) glProgramUniform2fv(id(), *at, 1, glm::value_ptr(value));
}

void Program::set(std::string_view name, const glm::vec3& value) const {
    set(name, std::span(&value, 1));
}

void Program::set(std::string_view name, const glm::vec4& value) const {
    set(name, std::span(&value, 1));
}

void Program::set(std::string_view name, const glm::mat3& value) const {
    if (const auto at = changed(name, bytes_of(value)))
        glProgramUniformMatrix3fv(id(), *at, 1, GL_FALSE, glm::value_ptr(value));
}

void Program::set(std::string_view name, const glm::mat4& value) const {
    if (const auto at = changed(name, bytes_of(value)))
        glProgramUniformMatrix4fv(id(), *at, 1, GL_FALSE, glm::value_ptr(value));
}

void Program::set(std::string_view name, std::span<const int> values) const {
    if (const auto at = changed(name, std::as_bytes(values)))
        glProgramUniform1iv(id(), *at, static_cast<GLsizei>(values.size()), values.data());
}

void Program::set(std::string_view name, std::span<const float> values) const {
    if (const auto at = changed(name, std::as_bytes(values)))
        glProgramUniform1fv(id(), *at, static_cast<GLsizei>(values.size()), values.data());
}

void Program::set(std::string_view name, std::span<const glm::vec3> values) const {
    if (const auto at = changed(name, std::as_bytes(values)))
        glProgramUniform3fv(id(), *at, static_cast<GLsizei>(values.size()), glm::value_ptr(values.front()));
}

void Program::set(std::string_view name, std::span<const glm::vec4> values) const {
    if (const auto at = changed(name, std::as_bytes(values)))
        glProgramUniform4fv(id(), *at, static_cast<GLsizei>(values.size()), glm::value_ptr(values.front()));
}

}  // namespace rowland::gpu
