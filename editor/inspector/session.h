#pragma once

#include <cstddef>
#include <filesystem>
#include <future>
#include <string>

#include "editor/inspector/cooked_surfaces.h"
#include "editor/inspector/document.h"
#include "editor/inspector/light.h"
#include "editor/inspector/measurement.h"
#include "editor/inspector/open_document.h"
#include "editor/inspector/preview.h"
#include "editor/inspector/view.h"
#include "engine/core/computed.h"
#include "engine/core/log.h"

namespace rowland::inspector {

struct SessionSettings {
    std::filesystem::path content_folder;  ///< holds materials/ and probes/
    std::string probe_mapping = "auto";    ///< of images
    std::filesystem::path captures{};      ///< folder of the recipes of captured probes; empty: none
    bool still = false;                    ///< for captures: maps are complete in the second frame
};

/// The inspector without its controls. Its parts are updated together, once a frame. Bad input becomes a message and
/// changes nothing else. Needs a current context.
struct Session {
    Session(const post::OcioConfig& config, const SessionSettings& settings);

    Messages messages;
    LightChoice light;
    OpenDocument opened;
    View view;
    Measurement measurement;

    /// Opens a light, or a file as OpenDocument::open() does.
    void open(const std::filesystem::path& path);
    /// Opens a shipped material ("cd") on the shape that shows its colours, or as the grating of a scene's material.
    void open_preset(const std::string& name);

    /// Starts the demo, which shows the document as edited under the session's light.
    void open_in_demo();

    /// Number of the scene's boxes with a light probe of their own.
    std::size_t boxes() const;
    /// Captures their light again from the scene as saved, under the session's light, by `rowland-cook capture` in the
    /// background.
    void capture_probes();
    bool capturing() const { return capture_.valid(); }

    /// Returns whether there is a new result or message, or background work began or ended.
    bool update();
    /// Whether background work for the picture or the panes is not complete.
    bool busy() const { return opened.busy() || light.loading() || measurement.busy() || capturing(); }

 private:
    /// Says how a capture that has ended went. Returns whether one has.
    bool take_capture();

    std::future<int> capture_;
    bool was_busy_ = false;  ///< after the last update
};

}  // namespace rowland::inspector
