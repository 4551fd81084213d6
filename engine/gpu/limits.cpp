#include "engine/gpu/limits.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "engine/core/error.h"

namespace rowland::gpu {

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

}  // namespace rowland::gpu
