#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <glm/vec2.hpp>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "editor/inspector/document.h"
#include "editor/inspector/inspected_light.h"
#include "editor/inspector/physics/point_radiance.h"
#include "editor/inspector/physics/price.h"
#include "editor/inspector/preview.h"
#include "engine/core/latest_task.h"

namespace rowland::inspector {

struct SessionSettings {
    std::filesystem::path content_folder;    ///< holds materials/ and probes/
    std::string probe_mapping = "equirect";  ///< of images
    bool still = false;                      ///< for pictures: nothing is spread over frames
};

/// A pixel that the user picked.
struct PickedPixel {
    glm::vec2 at{0.5F};        ///< from the picture's upper left corner, in [0, 1]
    diffraction::Frame frame;  ///< of the surface there, in the probe's axes
    glm::vec3 working{0.0F};   ///< scene-linear
    glm::ivec3 display{0};     ///< 8-bit values
};

/// What the slow panes show, and what it was computed for.
struct SlowNumbers {
    PointRadiance point;
    ViewSweep sweep;
    std::uint64_t of_material = 0;
};

/// Everything the inspector does, without its controls: the document, the work beside the frames, the preview. Bad
/// input becomes a message, and all stays as it was. Needs a current context.
class Session {
 public:
    Session(const post::OcioConfig& config, SessionSettings settings);

    Document& document() { return document_; }
    const Document& document() const { return document_; }

    /// A material, a glTF file, a probe or a table of efficiencies, by what the file is.
    void open(const std::filesystem::path& path);
    /// A shipped material as a start for a new one: "cd".
    void open_preset(const std::string& name);
    void save();
    void save_as(const std::filesystem::path& path);
    void choose_light(const std::filesystem::path& path);
    void choose_shape(PreviewShape shape);

    /// Once a frame: starts what edits ask for, takes over what has ended.
    void update();
    /// Whether something is being computed that the picture or the panes will show.
    bool busy() const;
    /// Draws the preview, if there is something to draw and it is not as it was.
    void draw(glm::ivec2 size, const scene::Camera& camera, bool with_saved, float seconds);
    /// Picks the surface at a point of the last picture; nothing happens where there is none.
    void pick(const glm::vec2& at);

    /// Measures all choices from now on, or stops. What the material pins is measured whenever nothing else is done.
    void price() { start_pricing(false); }
    void stop_pricing() { price_task_.cancel(); }
    bool pricing() const { return price_task_.busy(); }
    PriceList prices() const;
    /// Whether prices() are of the material as it is.
    bool prices_are_current() const { return priced_version_ == document_.version() && priced_light_ == light_; }
    /// Pins a choice that was measured.
    void choose_priced(const PricedChoice& choice);
    /// Pins the cheapest measured choice within an error.
    void cook_to_budget(double max_error);

    const Preview& preview() const { return preview_; }
    const std::shared_ptr<const InspectedLight>& light() const { return light_; }
    /// As last cooked: of the last good material, or on its way to be. Null before the first.
    const std::shared_ptr<const diffraction::CookedMaterial>& cooked() const { return cooked_; }
    bool cooking() const { return cook_task_.busy(); }
    bool loading_light() const { return light_task_.busy(); }
    bool has_model() const { return model_.has_value(); }
    const std::optional<PickedPixel>& picked() const { return picked_; }
    const std::optional<SlowNumbers>& slow_numbers() const { return slow_; }
    bool slow_numbers_are_current() const { return slow_ && slow_->of_material == cooked_count_ && !slow_task_.busy(); }
    /// The other grating of the efficiency pane: a table to lay beside a scalar profile, or the last scalar one.
    const std::optional<diffraction::Grating>& compared() const { return compared_; }

    std::vector<std::string> presets() const;
    std::vector<std::filesystem::path> shipped_lights() const;

    Stage stage;
    PreviewShape shape() const { return shape_; }

    /// What the user is to know, newest last.
    struct Message {
        std::string text;
        bool failure = false;
    };
    const std::vector<Message>& messages() const { return messages_; }
    void say(std::string text, bool failure);

 private:
    using Cooked = std::shared_ptr<const diffraction::CookedMaterial>;

    template <typename F>
    bool attempt(F&& action);
    void open_gltf(const std::filesystem::path& path);
    void open_table(const std::filesystem::path& path);
    void adopt_document(Document document);
    void start_cooking();
    void start_slow_numbers();
    void start_pricing(bool present_only);
    bool rested() const;
    diffraction::Frame middle_frame() const;
    void read_picked_pixel();

    /// All that the picture depends on.
    struct PictureKey {
        glm::ivec2 size{0};
        glm::vec3 eye{0.0F};
        glm::vec3 target{0.0F};
        Stage stage;
        bool with_saved = false;
        std::uint64_t cooked = 0;
        const InspectedLight* light = nullptr;
        PreviewShape shape = PreviewShape::Disc;
        bool has_saved = false;

        friend bool operator==(const PictureKey&, const PictureKey&) = default;
    };

    SessionSettings settings_;
    Preview preview_;
    Document document_;
    std::shared_ptr<const InspectedLight> light_;
    Cooked cooked_;
    std::optional<scene::Mesh> model_;
    PreviewShape shape_ = PreviewShape::Disc;
    std::optional<PickedPixel> picked_;
    std::optional<SlowNumbers> slow_;
    std::optional<diffraction::Grating> compared_;
    std::vector<Message> messages_;

    std::uint64_t asked_version_ = 0;  ///< of the document, that cooking was last started for
    std::uint64_t cooked_count_ = 0;
    std::uint64_t slow_asked_ = 0;  ///< a count of cooked_count_ and of other reasons
    std::uint64_t slow_reasons_ = 0;
    std::optional<Json> saved_asked_;
    std::chrono::steady_clock::time_point last_edit_;
    std::uint64_t seen_version_ = 0;
    PictureKey picture_key_;
    int unchanged_ = 0;  ///< frames in a row
    std::uint64_t drawn_ = 0;
    std::uint64_t picked_of_draw_ = 0;
    std::uint64_t priced_version_ = 0;
    std::shared_ptr<const InspectedLight> priced_light_;

    struct SharedPrices {
        std::mutex lock;
        PriceList list;
    };
    std::shared_ptr<SharedPrices> prices_ = std::make_shared<SharedPrices>();

    // Last, so that they end before what they work on.
    LatestTask<Cooked> cook_task_;
    LatestTask<Cooked> saved_task_;
    LatestTask<std::shared_ptr<const InspectedLight>> light_task_;
    LatestTask<SlowNumbers> slow_task_;
    LatestTask<int> price_task_;
};

}  // namespace rowland::inspector
