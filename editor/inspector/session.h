#pragma once

#include <filesystem>
#include <glm/vec2.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "editor/inspector/cook_grating.h"
#include "editor/inspector/document.h"
#include "editor/inspector/inspected_light.h"
#include "editor/inspector/open_file.h"
#include "editor/inspector/physics/pattern_figure.h"
#include "editor/inspector/physics/point_radiance.h"
#include "editor/inspector/physics/price.h"
#include "editor/inspector/preview.h"
#include "editor/inspector/scene_gratings.h"
#include "engine/core/computed.h"
#include "engine/core/messages.h"

namespace rowland::inspector {

struct SessionSettings {
    std::filesystem::path content_folder;  ///< holds materials/ and probes/
    std::string probe_mapping = "auto";    ///< of images
    bool still = false;                    ///< for captures: maps are complete in the second frame
};

struct PickedPixel {
    glm::vec2 at{0.5F};                                        ///< from the picture's upper left corner, in [0, 1]
    std::shared_ptr<const diffraction::ShadingPoint> surface;  ///< there, in the probe's axes
    glm::vec3 working{0.0F};                                   ///< scene-linear
    glm::ivec3 display{0};                                     ///< 8-bit values
};

/// What takes seconds to compute at a point of the surface.
struct PointNumbers {
    PointRadiance radiance;
    ViewSweep sweep;
};

/// The inspector without its controls: the document, the values computed from it, the preview. Bad input becomes a
/// message and changes nothing else. Needs a current context.
class Session {
 public:
    using Cooked = std::shared_ptr<const diffraction::CookedMaterial>;
    using Light = std::shared_ptr<const InspectedLight>;

    Session(const post::OcioConfig& config, SessionSettings settings);

    Document& document() { return document_; }
    const Document& document() const { return document_; }
    Stage stage;
    bool looks_through = false;  ///< the chosen material is held before the camera as well
    bool shows_grooves = false;  ///< strokes along the grooves of the chosen material

    /// A material, a glTF file, a probe or a table of efficiencies. A glTF file is opened in the background; a material
    /// becomes the grating of the chosen material, if a scene is open.
    void open(const std::filesystem::path& path);
    /// Waits until the glTF file is open.
    void finish_opening();
    void cancel_opening();
    /// The glTF file that is being opened; empty: none.
    std::filesystem::path opening() const { return opening_of_ ? *opening_of_ : std::filesystem::path(); }
    /// A shipped material ("cd") as the start of a new one, on the shape that shows its colours, or as the grating of a
    /// scene's chosen material.
    void open_preset(const std::string& name);
    /// Whether opening the file or a preset would drop the document.
    bool replaces_document(const std::filesystem::path& path) const;
    /// Leaves the scene for the start of a new material.
    void close_scene();
    /// `over_changes`: of another program, to a scene file; without it they only set asks_to_overwrite.
    void save(bool over_changes = false);
    bool asks_to_overwrite = false;
    void save_as(const std::filesystem::path& path);
    /// Writes a picture into the current folder, under a name that no file has.
    void write_screenshot(const gpu::Framebuffer& picture);
    void choose_light(const std::filesystem::path& path);
    /// How images cover the sphere: "auto", "equirect" or "angular".
    void choose_mapping(const std::string& mapping);
    const std::string& mapping() const { return settings_.probe_mapping; }
    void choose_shape(PreviewShape shape);
    /// Picks the surface at a point of the last picture, if there is one; in a scene that chooses its material.
    void pick(const glm::vec2& at);
    /// Chooses a material of the scene.
    void choose_material(std::size_t material);
    /// Gives the scene's chosen material a grating, JSON text; removes it.
    void paste_grating(const std::string& text);
    void remove_grating();
    /// Gives the chosen material a foil pattern (groove_picture.h) as its groove texture; a picture is opened for that.
    void set_foil_pattern(const std::string& name);

    /// Updates all values from their inputs; call it every frame. Returns whether a result, a message or the end of
    /// background work is new.
    bool update();
    /// Whether something is being computed that the picture or the panes will show.
    bool busy() const;
    /// Draws the preview if there is something to draw and the picture may have changed.
    void draw(glm::ivec2 size, const scene::Camera& camera, bool with_saved, float seconds);

    /// Measures all choices for the present material and light. What the material pins is measured without this, once
    /// nothing else is computed.
    void price() { measure_all_of_ = price_inputs(true); }
    void stop_pricing();
    bool pricing() const { return all_prices_.busy() || pinned_price_.busy(); }
    PriceList prices() const;
    /// Whether prices() are those of the present material and light.
    bool prices_are_current() const {
        return all_prices_.is_of(price_inputs(true)) || pinned_price_.is_of(price_inputs(false));
    }
    void choose_priced(const PricedChoice& choice);
    /// Pins the cheapest choice within an error, once all choices are measured.
    void cook_to_budget(double max_error);

    const Preview& preview() const { return preview_; }
    Preview& preview() { return preview_; }
    /// The open scene; null: the document is a material file.
    const SceneObject* scene() const { return scene_.get(); }
    /// Whether the next frame's picture may differ from the last though its inputs are the same.
    bool picture_changes() const { return ready() && preview_.changes(); }
    /// Null before the first is loaded.
    Light light() const { return light_.value() ? *light_.value() : nullptr; }
    /// The last material that was cooked; null before the first, and for a material of a scene without a grating.
    Cooked cooked() const {
        return document_.has_grating() && cooked_.value() ? (*cooked_.value())->material : nullptr;
    }
    /// The file's material, cooked; null if there is none, or not yet.
    Cooked saved() const { return document_.saved() && saved_.value() ? (*saved_.value())->material : nullptr; }
    bool cooking() const { return cooked_.busy(); }
    bool loading_light() const { return light_.busy(); }
    /// Whether there are a light and a material, or a scene, to draw.
    bool ready() const { return light() && (cooked() || document_.is_scene()); }
    PreviewShape shape() const { return object_->shape; }
    bool has_model() const { return scene_ != nullptr; }
    const std::optional<PickedPixel>& picked() const { return picked_; }
    /// In a scene: the picked point of the chosen material, or another one of it that was seen; nullopt: none was.
    const std::optional<PickedSurface>& surface() const { return surface_; }
    /// Of the picked point, or one near the picture's middle; null before the first.
    const PointNumbers* point_numbers() const { return point_.value(); }
    bool point_numbers_are_current() const { return point_.current(); }
    /// Of the last material with a lattice; null before the first is computed.
    std::shared_ptr<const PatternFigure> pattern() const { return pattern_.value() ? *pattern_.value() : nullptr; }
    /// The grating that the efficiency pane compares the material with: a scalar profile with the opened table, a table
    /// with the last scalar profile. nullopt: none.
    std::optional<diffraction::Grating> compared() const;

    static std::span<const char* const> presets();
    std::vector<std::filesystem::path> shipped_lights() const;

    /// What the user is told, newest last.
    const std::vector<Message>& messages() const { return messages_.all(); }

 private:
    struct PointInputs {
        Cooked cooked;
        Light light;
        std::shared_ptr<const diffraction::ShadingPoint> surface;  ///< null: near the middle of the picture

        friend bool operator==(const PointInputs&, const PointInputs&) = default;
    };
    struct PixelInputs {
        PointInputs point;
        Stage stage;

        friend bool operator==(const PixelInputs&, const PixelInputs&) = default;
    };
    struct PriceInputs {
        Json material;
        Light light;

        friend bool operator==(const PriceInputs&, const PriceInputs&) = default;
    };
    using PriceWork = Computed<PriceInputs, PriceList>::Work;

    template <typename Key, typename Value>
    bool poll(Computed<Key, Value>& computed);
    void adopt(Document document);
    void adopt(OpenedScene opened);
    void drop_scene();
    /// A material file becomes the document, or the grating of a scene's material.
    void use_material(Document document, const std::filesystem::path& path);
    std::string chosen_name() const;
    std::filesystem::path preset_path(const std::string& name) const {
        return settings_.content_folder / "materials" / (name + ".json");
    }
    using Opening = Computed<std::shared_ptr<const std::filesystem::path>, std::shared_ptr<OpenedScene>>;
    void want_opening();
    void take_opened(const Opening::Change& change);
    using CookedOf = Computed<std::shared_ptr<const MaterialSource>, SceneGratings::Grating>;
    /// What the object shows, with that grating on the chosen material.
    Gratings shown_with(const CookedOf& chosen) const;
    /// Adds a picture to the scene and makes it the groove texture of the chosen material.
    void set_groove_picture(std::vector<std::byte> picture, const std::string& name);
    void set_groove_picture(const std::filesystem::path& path);
    std::optional<PickedSurface> find_surface();
    diffraction::ShadingPoint middle_frame();
    void update_surface();
    PointInputs point_inputs() const { return {cooked(), light(), picked_ ? picked_->surface : scene_frame_}; }
    /// The material decides the errors of all choices but for its own choice; `of_all` leaves that out.
    PriceInputs price_inputs(bool of_all) const;
    PriceWork price_work(bool present_only) const;
    void want_pattern();
    void want_point_numbers();
    void want_prices();
    bool all_measured() const;
    void use_budget();
    void read_picked_pixel();

    SessionSettings settings_;
    Messages messages_;
    Preview preview_;
    Document document_;
    std::shared_ptr<const LightSource> chosen_light_;
    std::shared_ptr<const SceneObject> scene_;
    std::shared_ptr<const PreviewObject> scene_on_gpu_;
    std::shared_ptr<const PreviewObject> object_;
    std::shared_ptr<GratingCook> cook_;
    std::shared_ptr<const std::filesystem::path> opening_of_;
    std::optional<PickedPixel> picked_;
    std::optional<PickedSurface> surface_;
    std::shared_ptr<const diffraction::ShadingPoint> scene_frame_;  ///< of surface_
    std::optional<std::size_t> searched_for_;                       ///< the material of which surface_ was searched
    PixelInputs pixel_inputs_;                                      ///< of the colours in picked_
    std::optional<diffraction::EfficiencyTable> opened_table_;
    std::optional<diffraction::Grating> last_scalar_;  ///< the last cooked grating with a scalar profile
    std::optional<PriceInputs> measure_all_of_;        ///< the user asked for it
    std::optional<PriceInputs> stopped_price_of_;      ///< the user stopped it
    std::optional<double> budget_;                     ///< to cook to, once all choices are measured
    bool news_ = false;                                ///< in this update
    bool was_busy_ = false;                            ///< after the last update

    // The destructors wait for the work, so these are last.
    SceneGratings gratings_;
    Opening opening_;
    CookedOf cooked_;
    CookedOf saved_;
    Computed<std::shared_ptr<const LightSource>, Light> light_;
    Computed<std::shared_ptr<const MaterialSource>, std::shared_ptr<const PatternFigure>> pattern_;
    Computed<PointInputs, PointNumbers> point_;
    Computed<PriceInputs, PriceList> all_prices_;
    Computed<PriceInputs, PriceList> pinned_price_;
};

}  // namespace rowland::inspector
