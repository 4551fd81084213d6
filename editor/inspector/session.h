#pragma once

#include <cstddef>
#include <filesystem>
#include <future>
#include <memory>
#include <string>

#include "editor/inspector/cooked_surfaces.h"
#include "editor/inspector/document.h"
#include "editor/inspector/foil_studio.h"
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
    bool still = false;                    ///< for captures: maps are complete in the second frame, no card moves
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
    std::unique_ptr<FoilStudio> foil;  ///< shown in place of the document; null: none

    /// Opens a light; a foil recipe, or a picture as the artwork of a foil card; else a file as OpenDocument::open()
    /// does, which ends the work on a foil card.
    void open(const std::filesystem::path& path);
    /// Whether opening the file would replace the document or the foil card.
    bool is_replaced_by(const std::filesystem::path& path) const;
    /// Starts a foil card with this artwork.
    void make_foil(const std::filesystem::path& artwork);
    void close_foil();
    /// The name of the foil recipe, else of the document.
    std::string document_name() const { return foil ? foil->recipe().name() : opened.document().name(); }
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
    bool busy() const {
        return light.loading() || (foil ? foil->busy() : opened.busy() || measurement.busy()) || capturing();
    }

 private:
    /// Says how a capture that has ended went. Returns whether one has.
    bool take_capture();
    void start_foil(FoilRecipe recipe);

    bool still_;
    std::future<int> capture_;
    bool was_busy_ = false;  ///< after the last update
};

}  // namespace rowland::inspector
