#pragma once

namespace rowland::gpu {

/// Routes the driver's messages (KHR_debug) to the log, synchronously, so that a debugger stops at the call at fault.
/// The context must be a debug context. Errors, undefined behaviour and deprecated use are logged as errors and, if
/// `fatal`, end the program (tests run so); portability and performance notes are logged at most. The same message is
/// logged once.
void enable_debug_output(bool fatal);

}  // namespace rowland::gpu
