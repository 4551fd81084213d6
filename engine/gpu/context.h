#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "engine/gpu/texture.h"

namespace rowland::gpu {

/// Routes the driver's messages (KHR_debug) to the log, synchronously, so that a debugger stops at the call at fault.
/// The context must be a debug context. Errors, undefined behaviour and deprecated use are logged as errors and, if
/// `fatal`, end the program (tests run so). Other messages of medium or high severity are logged as warnings. The same
/// message is logged once.
void enable_debug_output(bool fatal);

/// Limits of a driver. The values here are those that OpenGL 4.5 guarantees.
struct Limits {
    std::int64_t storage_block_bytes = 1 << 24;  ///< of a storage buffer, as a shader sees it
    int vertex_storage_blocks = 0;               ///< storage buffers of a vertex stage
    int buffer_texels = 1 << 16;                 ///< of a buffer that a shader reads as a texture
    int texture_side = 16384;                    ///< texels; of a line, a plane, a layer
    int cube_side = 16384;
    int volume_side = 2048;
    int texture_layers = 2048;
};

/// The limits of the current context. Asks the driver: call it while loading.
Limits read_limits();

/// Throws Error (system) that names a side or a number of layers that is too large.
void require_texture(const TextureDesc& desc, const Limits& limits);

/// Buffers that an object's vertex stage reads.
struct VertexStorage {
    std::string what;        ///< what needs them, for the message
    int blocks = 1;          ///< storage buffers
    std::size_t bytes = 0;   ///< of the largest
    std::size_t texels = 0;  ///< of a buffer that is read as a texture
    std::string remedy;
};
/// Throws Error (system) with the given remedy if a number is above its limit.
void require_vertex_storage(const VertexStorage& storage, const Limits& limits);

/// Throws Error (system) if the current context is lost, as after a reset of the GPU: nothing that it draws or reads
/// from then on is valid. Call it once a frame, and before a picture that was read is written. Drivers report it for
/// contexts created with reset notification, as platform's are where that is supported.
void require_context();

/// Whether a renderer of this name (GL_RENDERER) is a CPU rasteriser: llvmpipe and its like.
bool is_software_renderer(std::string_view renderer);
/// Whether the current context's is one.
bool renders_in_software();

}  // namespace rowland::gpu
