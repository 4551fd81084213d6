#pragma once

#include "content/demo/options.h"
#include "content/demo/session.h"

namespace rowland::demo {

/// Whether the options name files for pictures.
bool names_a_capture(const Options& options);

/// Writes the pictures that the options name: of each frame, 1/30 s apart. Throws Error.
void write_captures(Session& session, const Options& options);

/// Writes the pictures that the options name of the frame as it was drawn last, the `frame`-th of `frames`.
void write_captures_of(Session& session, const Options& options, int frame, int frames);

/// Writes a short flight through the scene's views as numbered PNG files in the output folder, its frames shared out to
/// the probes. Throws Error.
void write_tour(Session& session, const Options& options);

}  // namespace rowland::demo
