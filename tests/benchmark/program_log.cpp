#include "tests/benchmark/program_log.h"

#include "engine/core/log.h"
#include "tests/benchmark/frame_stage.h"
#include "tests/support/replaced_function.h"

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
    if (const std::optional<int> lights = array_length(program, "PeerLights", "peer_lights[0].direction"))
        lengths["peer_lights.length()"] = *lights;
    return lengths;
}

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
    test::ReplacedFunction<&epoxy_glDrawElementsInstanced> of_draw_instances{"glDrawElementsInstanced", draw_instances};
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
    note_mesh();
}

void ProgramLog::draw_instances(GLenum mode, GLsizei count, GLenum type, const void* indices, GLsizei instances) {
    active_log->replaced_->of_draw_instances.driver(mode, count, type, indices, instances);
    note_mesh();
}

void ProgramLog::note_mesh() {
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

void write_programs(const std::filesystem::path& folder, const std::vector<FrameVariant>& variants, glm::ivec2 size,
                    bool software) {
    const ProgramLog log;
    FrameStage stage(size, diffraction::MapPace::Incremental);
    nlohmann::ordered_json frames = nlohmann::ordered_json::array();
    Progress progress("programs", variants.size());
    const auto add = [&](const std::string& name, std::size_t program, const LoopLengths& lengths) {
        frames.push_back({{"name", name}, {"program", std::to_string(program)}, {"lengths", lengths}});
    };
    for (const FrameVariant& variant : variants) {
        const std::size_t known_passes = log.passes().size();
        FrameScene scene(variant, stage, software);
        do scene.draw();
        while (scene.awaits_map());
        ROWLAND_CHECK(log.last_mesh().has_value(), "a frame without its disc");
        add(variant.name, log.last_mesh()->program, log.last_mesh()->lengths);
        for (std::size_t i = known_passes; i < log.passes().size() && variant.effect != Effect::None; ++i)
            add(fmt::format("{}/pass:{}", variant.name, i - known_passes + 1), log.passes()[i], {});
        progress.advance();
    }
    nlohmann::ordered_json names = nlohmann::ordered_json::array();
    for (const ProgramTexts& program : log.programs()) {
        names.push_back(std::to_string(names.size()));
        for (const auto& [stage_name, text] : program)
            write_file_atomic(folder / (names.back().get<std::string>() + "." + stage_name), text);
    }
    const nlohmann::ordered_json json = {{"programs", names}, {"frames", frames}};
    write_file_atomic(folder / "programs.json", json.dump(2) + "\n");
}

}  // namespace rowland::benchmark
