#pragma once

#include "editor/inspector/layout.h"
#include "editor/inspector/options.h"
#include "editor/inspector/session.h"

namespace rowland::inspector {

/// The layout that the options name, changed by the other options.
Layout chosen_layout(const Options& options);

/// Opens the files of the options, else of the layout. Throws Error (input) if one of the options' is refused; a probe
/// of the layout that no longer exists is ignored.
void start_session(Session& session, const Options& options, const Layout& layout);

}  // namespace rowland::inspector
