#include "tests/benchmark/program_log.h"

#include <algorithm>

#include "engine/core/check.h"
#include "tests/support/replaced_function.h"

namespace rowland::benchmark {

namespace {

ProgramLog* active_log = nullptr;

std::string stage_of(GLuint shader) {
    GLint type = GL_NONE;
    glGetShaderiv(shader, GL_SHADER_TYPE, &type);
    return type == GL_VERTEX_SHADER ? "vert" : type == GL_FRAGMENT_SHADER ? "frag" : "comp";
}

GLuint current_program() {
    GLint program = 0;
    glGetIntegerv(GL_CURRENT_PROGRAM, &program);
    return static_cast<GLuint>(program);
}

}  // namespace

struct ProgramLog::Replaced {
    test::ReplacedFunction<&epoxy_glShaderSource> of_shader_source{"glShaderSource", shader_source};
    test::ReplacedFunction<&epoxy_glAttachShader> of_attach_shader{"glAttachShader", attach_shader};
    test::ReplacedFunction<&epoxy_glLinkProgram> of_link_program{"glLinkProgram", link_program};
    test::ReplacedFunction<&epoxy_glDrawArraysInstanced> of_draw_arrays{"glDrawArraysInstanced", draw_arrays};
    test::ReplacedFunction<&epoxy_glDrawElements> of_draw_elements{"glDrawElements", draw_elements};
};

ProgramLog::ProgramLog() {
    ROWLAND_CHECK(active_log == nullptr, "a second log of programs");
    active_log = this;
    replaced_ = std::make_unique<Replaced>();
}

ProgramLog::~ProgramLog() {
    active_log = nullptr;
}

void ProgramLog::shader_source(GLuint shader, GLsizei count, const GLchar* const* strings, const GLint* lengths) {
    active_log->shader_texts_[shader] = test::whole_source(count, strings, lengths);
    active_log->replaced_->of_shader_source.driver(shader, count, strings, lengths);
}

void ProgramLog::attach_shader(GLuint program, GLuint shader) {
    active_log->attached_[program][stage_of(shader)] = active_log->shader_texts_[shader];
    active_log->replaced_->of_attach_shader.driver(program, shader);
}

void ProgramLog::link_program(GLuint program) {
    active_log->record(program);
    active_log->replaced_->of_link_program.driver(program);
}

void ProgramLog::draw_arrays(GLenum mode, GLint first, GLsizei count, GLsizei instances) {
    active_log->replaced_->of_draw_arrays.driver(mode, first, count, instances);
    std::vector<std::size_t>& passes = active_log->passes_;
    const auto program = active_log->current();
    if (program && std::ranges::find(passes, *program) == passes.end()) passes.push_back(*program);
}

void ProgramLog::draw_elements(GLenum mode, GLsizei count, GLenum type, const void* indices) {
    active_log->replaced_->of_draw_elements.driver(mode, count, type, indices);
    if (const auto program = active_log->current())
        active_log->last_mesh_ = MeshDraw{*program, loop_lengths(current_program())};
}

std::optional<std::size_t> ProgramLog::current() const {
    const auto linked = linked_.find(current_program());
    return linked == linked_.end() ? std::nullopt : std::optional(linked->second);
}

void ProgramLog::record(GLuint program) {
    ProgramTexts texts = std::move(attached_[program]);
    attached_.erase(program);
    const auto [known, is_new] = known_.try_emplace(texts, programs_.size());
    if (is_new) programs_.push_back(std::move(texts));
    linked_[program] = known->second;
}

}  // namespace rowland::benchmark
