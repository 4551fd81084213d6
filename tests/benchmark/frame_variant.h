#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace rowland::benchmark {

/// How the disc is shaded.
enum class Shader {
    Unlit,      ///< its base colour: what a frame costs without any shading
    Plain,      ///< the engine's metallic-roughness surface alone
    Grating,    ///< a diffraction material
    Film,       ///< the engine's surface under a thin film
    LightLoop,  ///< the grating's lights and orders one by one (editor/trade/stage.h)
    Peer,       ///< what others use for discs, light by light (tests/evidence/peers/)
};

/// Where light comes from besides the sun, one directional light.
enum class Lighting {
    Studio,           ///< a probe whose lights are all SH
    StudioKeyLights,  ///< the same, its key lights shaded one by one
    LampsInProbe,     ///< a room whose lamps are part of the probe
    LampsInScene,     ///< the dark room and directional lights; without the sun
};

/// An effect of the renderer: engine/render/effects.h.
enum class Effect {
    None,
    AmbientOcclusion,  ///< with contact shadows, where the sun casts a shadow
    SoftShadow,
    LocalReflection,  ///< of a plane that faces the disc
    RoughReflection,
};

/// A frame that is timed.
struct FrameVariant {
    std::string name;
    std::string baseline;  ///< the name of the variant that this one's time is divided by
    Shader shader = Shader::Plain;
    nlohmann::json material;  ///< of Shader::Grating and Film: a material file
    std::string peer = {};    ///< of Shader::Peer: its name
    Lighting lighting = Lighting::Studio;
    int lamps = 0;
    bool shadow = false;  ///< the sun casts one
    Effect effect = Effect::None;
    bool groove_map = false;     ///< a texture varies the grooves' direction and pitch
    bool thickness_map = false;  ///< a texture varies the film's thickness from 100 nm to its own
    bool mean_colour = false;    ///< of a grating: the cheapest rung of a frame budget
    bool worn = false;           ///< scratches, fingerprints and dust
    bool in_box = false;         ///< lit by the same probe, as that of a box around the disc
    bool between_boxes = false;  ///< lit by that and by the renderer's probe, half and half
    bool instance = false;       ///< the disc is drawn as an instance; the others lie beside the picture
};

/// All frames that are timed, each baseline before the variants that are compared with it.
std::vector<FrameVariant> all_variants();

/// The variants whose names match one of the patterns (as in a shell), and their baselines; without patterns all.
/// Throws Error (input) for a pattern that matches none.
std::vector<FrameVariant> choose_variants(const std::vector<std::string>& patterns);

}  // namespace rowland::benchmark
