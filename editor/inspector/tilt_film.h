#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/gtc/quaternion.hpp>
#include <string>
#include <vector>

#include "editor/inspector/preview.h"
#include "editor/inspector/webp_animation.h"

namespace rowland::inspector {

/// The rotation of a card that faces card_camera().
glm::quat resting_tilt();
/// The rotation of a card that a hand tilts, at a phase in [0, 1) of a closed path: 20° to both sides about its
/// vertical axis and 15° about its horizontal one, about resting_tilt().
glm::quat hand_tilt(double phase);
/// The opening camera's direction and lens, at a distance in metres from the middle of the object.
scene::Camera card_camera(float distance);

struct FilmSettings {
    std::filesystem::path path;  ///< .webp
    int width = 720;
    int height = 960;
    double seconds = 4.0;  ///< of one turn of the tilt, after which the film repeats
    int pictures_per_second = 20;
    bool pngs = false;  ///< numbered pictures as well, in the folder of the film's name without its extension

    int count() const;
};
/// Throws Error (input) for settings out of range, and if the folder of the pictures exists.
void check_film(const FilmSettings& settings);

/// A film of a tilting card, drawn picture by picture. Nothing is left if it is not finished. Needs a current context.
class TiltFilm {
 public:
    /// `inputs`: the object, its light and the camera; size and tilt are those of the film. Throws as check_film()
    /// does.
    TiltFilm(const post::OcioConfig& config, const FilmSettings& settings, PreviewInputs inputs);
    ~TiltFilm();
    TiltFilm(const TiltFilm&) = delete;
    TiltFilm& operator=(const TiltFilm&) = delete;

    /// Draws and encodes the next picture; after the last one, writes the film. Throws Error (system).
    void step();
    bool finished() const { return finished_; }
    int drawn() const { return drawn_; }
    const FilmSettings& settings() const { return settings_; }

 private:
    void finish();

    FilmSettings settings_;
    PreviewInputs inputs_;
    Preview preview_;
    WebpAnimation webp_;
    std::filesystem::path pngs_;  ///< folder of the pictures until the film is finished; empty: none
    int drawn_ = 0;
    bool finished_ = false;
};

}  // namespace rowland::inspector
