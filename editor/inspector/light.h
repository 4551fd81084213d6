#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "engine/core/computed.h"
#include "engine/core/log.h"
#include "engine/lighting/light_probe.h"
#include "engine/lighting/probe_image.h"
#include "modules/diffraction/representations/point_shader.h"

namespace rowland::inspector {

/// A probe in the forms that the preview and the panes need.
struct InspectedLight {
    std::filesystem::path path;
    lighting::ProbeImage image;            ///< at full resolution, for the reference
    lighting::LightProbe probe;            ///< as the demo loads it
    int key_lights = 0;                    ///< the largest number of key lights
    diffraction::EvaluationLight divided;  ///< into key lights and the residual
};

/// Loads a probe recipe (.json) or an image (.hdr, .exr; `mapping` "auto", "equirect" or "angular"). Runs on any
/// thread; takes seconds. Throws Error (input), also for a cooked .probe file.
std::shared_ptr<const InspectedLight> load_light(const std::filesystem::path& path, const std::string& mapping);

/// Takes over a result of background work. A failure becomes a message.
template <typename Key, typename Value>
typename Computed<Key, Value>::Change poll(Computed<Key, Value>& computed, Messages& messages) {
    auto change = computed.poll();
    if (!change.failure.empty()) messages.say(change.failure, true);
    return change;
}

/// The light of the session: a probe that the user chooses, loaded in the background.
class LightChoice {
 public:
    using Light = std::shared_ptr<const InspectedLight>;

    /// `folders` hold the shipped probes. `mapping` of images: "auto", "equirect" or "angular".
    LightChoice(std::vector<std::filesystem::path> folders, std::string mapping, Messages& messages)
        : folders_(std::move(folders)), mapping_(std::move(mapping)), messages_(messages) {}

    void choose(const std::filesystem::path& path);
    void choose_mapping(const std::string& mapping);
    const std::string& mapping() const { return mapping_; }
    /// The shipped probe recipes, folder by folder.
    std::vector<std::filesystem::path> shipped() const;

    /// Call it every frame. Returns whether there is a new light or message.
    bool update();
    bool loading() const { return light_.busy(); }
    /// The last light that was loaded; null before the first.
    Light current() const { return light_.value() ? *light_.value() : nullptr; }

 private:
    std::vector<std::filesystem::path> folders_;
    std::string mapping_;
    Messages& messages_;
    std::shared_ptr<const std::filesystem::path> path_;  ///< a new pointer for every choice, also of the same file
    Computed<std::shared_ptr<const std::filesystem::path>, Light> light_;
};

}  // namespace rowland::inspector
