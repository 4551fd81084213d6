#include "engine/gpu/context.h"

#include <epoxy/gl.h>
#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cstdlib>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "engine/core/check.h"
#include "engine/core/error.h"
#include "engine/core/log.h"

namespace rowland::gpu {

namespace {

bool is_fault(GLenum type) {
    return type == GL_DEBUG_TYPE_ERROR || type == GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR ||
           type == GL_DEBUG_TYPE_DEPRECATED_BEHAVIOR;
}

std::string_view text_of(GLsizei length, const GLchar* message) {
    return length < 0 ? std::string_view(message) : std::string_view(message, static_cast<std::size_t>(length));
}

/// The messages logged so far in this thread: the driver calls back from the thread that calls it.
std::set<std::string, std::less<>>& logged() {
    thread_local std::set<std::string, std::less<>> texts;
    return texts;
}

void on_message(GLenum source, GLenum type, GLuint id, GLenum severity, GLsizei length, const GLchar* message,
                const void* fatal) {
    // The errors of a compiler are also in the info log, from which Program makes an exception.
    if (source == GL_DEBUG_SOURCE_SHADER_COMPILER && type == GL_DEBUG_TYPE_ERROR) return;
    const std::string_view text = text_of(length, message);
    const bool is_new = logged().emplace(text).second;
    if (is_fault(type)) {
        if (is_new) log_error("OpenGL [{}]: {}", id, text);
        // The driver called us: an exception must not pass through its frames.
        if (fatal != nullptr) std::abort();
    } else if (is_new && (severity == GL_DEBUG_SEVERITY_HIGH || severity == GL_DEBUG_SEVERITY_MEDIUM)) {
        log_warning("OpenGL [{}]: {}", id, text);
    }
}

}  // namespace

void enable_debug_output(bool fatal) {
    static const char fatal_mark = 0;
    GLint flags = 0;
    glGetIntegerv(GL_CONTEXT_FLAGS, &flags);
    ROWLAND_CHECK((flags & GL_CONTEXT_FLAG_DEBUG_BIT) != 0, "a debug context");
    logged().clear();
    glEnable(GL_DEBUG_OUTPUT);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    glDebugMessageControl(GL_DONT_CARE, GL_DONT_CARE, GL_DONT_CARE, 0, nullptr, GL_TRUE);
    glDebugMessageCallback(on_message, fatal ? &fatal_mark : nullptr);
}

namespace {

int read(GLenum name) {
    GLint value = 0;
    glGetIntegerv(name, &value);
    return value;
}

[[noreturn]] void refuse(std::string what, std::string found, std::string expected, std::string remedy) {
    fail_system(std::move(what), std::move(found), std::move(remedy), std::move(expected) + ", this GPU's limit");
}

int longest_side(const TextureDesc& desc) {
    return std::max({desc.width, desc.height, desc.kind == TextureKind::Volume ? desc.depth : 1});
}

int side_limit(TextureKind kind, const Limits& limits) {
    if (kind == TextureKind::Volume) return limits.volume_side;
    return kind == TextureKind::CubeMap ? limits.cube_side : limits.texture_side;
}

}  // namespace

Limits read_limits() {
    Limits limits{.vertex_storage_blocks = read(GL_MAX_VERTEX_SHADER_STORAGE_BLOCKS),
                  .buffer_texels = read(GL_MAX_TEXTURE_BUFFER_SIZE),
                  .texture_side = read(GL_MAX_TEXTURE_SIZE),
                  .cube_side = read(GL_MAX_CUBE_MAP_TEXTURE_SIZE),
                  .volume_side = read(GL_MAX_3D_TEXTURE_SIZE),
                  .texture_layers = read(GL_MAX_ARRAY_TEXTURE_LAYERS)};
    GLint64 bytes = 0;
    glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &bytes);
    limits.storage_block_bytes = bytes;
    return limits;
}

void require_texture(const TextureDesc& desc, const Limits& limits) {
    const int longest = side_limit(desc.kind, limits);
    if (longest_side(desc) > longest)
        refuse("texture", fmt::format("{} x {} x {} texels", desc.width, desc.height, desc.depth),
               fmt::format("at most {} to a side", longest), "scale the image or the picture down");
    if (desc.kind == TextureKind::PlaneArray && desc.depth > limits.texture_layers)
        refuse("texture", fmt::format("{} layers", desc.depth), fmt::format("at most {}", limits.texture_layers),
               "make the table smaller");
}

void require_vertex_storage(const VertexStorage& storage, const Limits& limits) {
    if (storage.blocks > limits.vertex_storage_blocks)
        refuse(storage.what, fmt::format("{} storage buffers that its vertex stage reads", storage.blocks),
               fmt::format("at most {}", limits.vertex_storage_blocks), storage.remedy);
    if (storage.bytes > static_cast<std::uint64_t>(limits.storage_block_bytes))
        refuse(storage.what, fmt::format("a storage buffer of {} bytes", storage.bytes),
               fmt::format("at most {}", limits.storage_block_bytes), storage.remedy);
    if (storage.texels > static_cast<std::uint64_t>(limits.buffer_texels))
        refuse(storage.what, fmt::format("a buffer of {} texels", storage.texels),
               fmt::format("at most {}", limits.buffer_texels), storage.remedy);
}

namespace {

const char* reason_for(GLenum status) {
    switch (status) {
        case GL_GUILTY_CONTEXT_RESET:
            return "the GPU was reset for what this program drew, and its context is lost";
        case GL_INNOCENT_CONTEXT_RESET:
            return "the GPU was reset for another program, and this one's context is lost";
        default:
            return "the GPU was reset, and the context is lost";
    }
}

}  // namespace

void require_context() {
    const GLenum status = glGetGraphicsResetStatus();
    if (status == GL_NO_ERROR) return;
    fail_system("OpenGL", reason_for(status), "start the program again");
}

bool is_software_renderer(std::string_view renderer) {
    constexpr std::array names{"llvmpipe", "softpipe", "swrast", "SWR", "Software Rasterizer"};
    return std::any_of(names.begin(), names.end(),
                       [&](const char* name) { return renderer.find(name) != std::string_view::npos; });
}

bool renders_in_software() {
    return is_software_renderer(reinterpret_cast<const char*>(glGetString(GL_RENDERER)));
}

}  // namespace rowland::gpu
