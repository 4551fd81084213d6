#include "tests/benchmark/program_log.h"

#include <epoxy/egl.h>

#include "engine/core/check.h"

namespace rowland::benchmark {

namespace {

/// OpenGL's functions are called through pointers that libepoxy fills at the first call; these are the driver's own.
struct DriverFunctions {
    decltype(epoxy_glShaderSource) shader_source;
    decltype(epoxy_glAttachShader) attach_shader;
    decltype(epoxy_glLinkProgram) link_program;
    decltype(epoxy_glDrawElements) draw_elements;
};

template <typename Function>
void load(Function& function, const char* name) {
    function = reinterpret_cast<Function>(eglGetProcAddress(name));
    ROWLAND_CHECK(function != nullptr, "a driver without functions of OpenGL 4.5");
}

const DriverFunctions& driver() {
    static const DriverFunctions functions = [] {
        DriverFunctions loaded;
        load(loaded.shader_source, "glShaderSource");
        load(loaded.attach_shader, "glAttachShader");
        load(loaded.link_program, "glLinkProgram");
        load(loaded.draw_elements, "glDrawElements");
        return loaded;
    }();
    return functions;
}

ProgramLog* active_log = nullptr;

std::string stage_of(GLuint shader) {
    GLint type = GL_NONE;
    glGetShaderiv(shader, GL_SHADER_TYPE, &type);
    return type == GL_VERTEX_SHADER ? "vert" : type == GL_FRAGMENT_SHADER ? "frag" : "comp";
}

}  // namespace

ProgramLog::ProgramLog() {
    ROWLAND_CHECK(active_log == nullptr, "a second log of programs");
    driver();
    active_log = this;
    epoxy_glShaderSource = shader_source;
    epoxy_glAttachShader = attach_shader;
    epoxy_glLinkProgram = link_program;
    epoxy_glDrawElements = draw_elements;
}

ProgramLog::~ProgramLog() {
    epoxy_glShaderSource = driver().shader_source;
    epoxy_glAttachShader = driver().attach_shader;
    epoxy_glLinkProgram = driver().link_program;
    epoxy_glDrawElements = driver().draw_elements;
    active_log = nullptr;
}

void ProgramLog::shader_source(GLuint shader, GLsizei count, const GLchar* const* strings, const GLint* lengths) {
    std::string text;
    for (GLsizei i = 0; i < count; ++i)
        text += lengths == nullptr ? std::string(strings[i])
                                   : std::string(strings[i], static_cast<std::size_t>(lengths[i]));
    active_log->shader_texts_[shader] = std::move(text);
    driver().shader_source(shader, count, strings, lengths);
}

void ProgramLog::attach_shader(GLuint program, GLuint shader) {
    active_log->attached_[program][stage_of(shader)] = active_log->shader_texts_[shader];
    driver().attach_shader(program, shader);
}

void ProgramLog::link_program(GLuint program) {
    active_log->record(program);
    driver().link_program(program);
}

void ProgramLog::draw_elements(GLenum mode, GLsizei count, GLenum type, const void* indices) {
    driver().draw_elements(mode, count, type, indices);
    GLint current = 0;
    glGetIntegerv(GL_CURRENT_PROGRAM, &current);
    const auto program = static_cast<GLuint>(current);
    const auto linked = active_log->linked_.find(program);
    if (linked == active_log->linked_.end()) return;  // linked before the log began
    active_log->last_mesh_ = MeshDraw{linked->second, loop_lengths(program)};
}

void ProgramLog::record(GLuint program) {
    ProgramTexts texts = std::move(attached_[program]);
    attached_.erase(program);
    const auto [known, is_new] = known_.try_emplace(texts, programs_.size());
    if (is_new) programs_.push_back(std::move(texts));
    linked_[program] = known->second;
}

}  // namespace rowland::benchmark
