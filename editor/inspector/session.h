#pragma once

#include <filesystem>
#include <glm/vec2.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "editor/inspector/document.h"
#include "editor/inspector/inspected_light.h"

#include "editor/inspector/open_file.h"
#include "editor/inspector/physics/point_radiance.h"
#include "editor/inspector/physics/price.h"
#include "editor/inspector/preview.h"
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

    /// A material, a glTF file, a probe or a table of efficiencies.
    void open(const std::filesystem::path& path);
    /// A shipped material as the start of a new one ("cd"), on the shape that shows its colours; a model stays.
    void open_preset(const std::string& name);
    void save();
    void save_as(const std::filesystem::path& path);
    /// Writes a picture into the current folder, under a name that no file has.
    void write_screenshot(const gpu::Framebuffer& picture);
    void choose_light(const std::filesystem::path& path);
    /// How images cover the sphere: "auto", "equirect" or "angular".
    void choose_mapping(const std::string& mapping);
    const std::string& mapping() const { return settings_.probe_mapping; }
    void choose_shape(PreviewShape shape);
    /// Picks the surface at a point of the last picture, if there is one.
    void pick(const glm::vec2& at);

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
    /// Whether the next frame's picture may differ from the last though its inputs are the same.
    bool picture_changes() const { return ready() && preview_.changes(); }
    /// Null before the first is loaded.
    Light light() const { return light_.value() ? *light_.value() : nullptr; }
    /// The last material that was cooked; null before the first.
    Cooked cooked() const { return cooked_.value() ? *cooked_.value() : nullptr; }
    /// The file's material, cooked; null if there is none, or not yet.
    Cooked saved() const { return document_.saved() && saved_.value() ? *saved_.value() : nullptr; }
    bool cooking() const { return cooked_.busy(); }
    bool loading_light() const { return light_.busy(); }
    /// Whether there are a light and a material to draw.
    bool ready() const { return light() && cooked(); }
    PreviewShape shape() const { return object_->shape; }
    bool has_model() const { return model_.has_value(); }
    const std::optional<PickedPixel>& picked() const { return picked_; }
    /// Of the picked point, or one near the picture's middle; null before the first.
    const PointNumbers* point_numbers() const { return point_.value(); }
    bool point_numbers_are_current() const { return point_.current(); }
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
    void adopt(OpenedModel model, const std::string& file);
    PointInputs point_inputs() const { return {cooked(), light(), picked_ ? picked_->surface : nullptr}; }
    /// The material decides the errors of all choices but for its own choice; `of_all` leaves that out.
    PriceInputs price_inputs(bool of_all) const;
    PriceWork price_work(bool present_only) const;
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
    std::optional<scene::Mesh> model_;
    std::shared_ptr<const PreviewObject> object_;
    std::optional<PickedPixel> picked_;
    PixelInputs pixel_inputs_;  ///< of the colours in picked_
    std::optional<diffraction::EfficiencyTable> opened_table_;
    std::optional<diffraction::Grating> last_scalar_;  ///< the last cooked grating with a scalar profile
    std::optional<PriceInputs> measure_all_of_;        ///< the user asked for it
    std::optional<PriceInputs> stopped_price_of_;      ///< the user stopped it
    std::optional<double> budget_;                     ///< to cook to, once all choices are measured
    bool news_ = false;                                ///< in this update
    bool was_busy_ = false;                            ///< after the last update

    // The destructors wait for the work, so these are last.
    Computed<std::shared_ptr<const MaterialSource>, Cooked> cooked_;
    Computed<std::shared_ptr<const MaterialSource>, Cooked> saved_;
    Computed<std::shared_ptr<const LightSource>, Light> light_;
    Computed<PointInputs, PointNumbers> point_;
    Computed<PriceInputs, PriceList> all_prices_;
    Computed<PriceInputs, PriceList> pinned_price_;
};

}  // namespace rowland::inspector
