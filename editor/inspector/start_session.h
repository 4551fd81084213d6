#pragma once

#include "editor/inspector/layout.h"
#include "editor/inspector/options.h"
#include "editor/inspector/session.h"

namespace rowland::inspector {

/// The layout that the options name, with what they ask for in place of it.
Layout chosen_layout(const Options& options);

/// Opens what the options name, else what the layout remembers. A file of the command line that is refused throws
/// Error; a probe of the layout that has gone is passed over.
void start_session(Session& session, const Options& options, const Layout& layout);

}  // namespace rowland::inspector
