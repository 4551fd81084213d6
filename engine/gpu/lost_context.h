#pragma once

namespace rowland::gpu {

/// Throws Error (system) if the current context is lost, as after a reset of the GPU: nothing that it draws or reads
/// from then on means anything. To be asked once a frame, and before a picture that was read is written. Drivers tell
/// it of contexts that asked to be told, as platform's do where that can be had.
void require_context();

}  // namespace rowland::gpu
