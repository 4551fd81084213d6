#pragma once

namespace rowland::gpu {

/// Throws Error (system) if the current context is lost, as after a reset of the GPU: nothing that it draws or reads
/// from then on is valid. Call it once a frame, and before a picture that was read is written. Drivers report it for
/// contexts created with reset notification, as platform's are where that is supported.
void require_context();

}  // namespace rowland::gpu
