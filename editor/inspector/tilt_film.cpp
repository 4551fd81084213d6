#include "editor/inspector/tilt_film.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>
#include <system_error>
#include <utility>

#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/image/byte_image.h"

namespace rowland::inspector {

namespace {

constexpr double kRest_deg = -13.5;  ///< faces a camera that looks down by so much

std::filesystem::path png_folder(const FilmSettings& settings) {
    return std::filesystem::path(settings.path).replace_extension();
}

}  // namespace

glm::quat resting_tilt() {
    return glm::angleAxis(static_cast<float>(glm::radians(kRest_deg)), glm::vec3(1.0F, 0.0F, 0.0F));
}

glm::quat hand_tilt(double phase) {
    constexpr double kYaw_deg = 20.0;
    constexpr double kPitch_deg = 15.0;
    const double turn = 2.0 * std::numbers::pi * phase;
    const auto about = [](double degrees, const glm::vec3& axis) {
        return glm::angleAxis(static_cast<float>(glm::radians(degrees)), axis);
    };
    // A figure of eight: it passes all combinations of left, right, up and down.
    return resting_tilt() * about(kPitch_deg * std::sin(2.0 * turn), {1.0F, 0.0F, 0.0F}) *
           about(kYaw_deg * std::sin(turn), {0.0F, 1.0F, 0.0F});
}

scene::Camera card_camera(float distance) {
    scene::Camera camera = opening_camera();
    camera.target = kObjectPosition;
    camera.eye = kObjectPosition + resting_tilt() * glm::vec3(0.0F, 0.0F, distance);
    return camera;
}

int FilmSettings::count() const {
    return static_cast<int>(std::lround(seconds * pictures_per_second));
}

void check_film(const FilmSettings& settings) {
    const std::string file = settings.path.string();
    const auto sane = [](int side) { return side >= 32 && side <= 4096; };
    if (settings.path.extension() != ".webp") refuse_input(file, "", "another extension", ".webp");
    if (!sane(settings.width) || !sane(settings.height))
        refuse_input(file, "", fmt::format("{} x {} pixels", settings.width, settings.height), "sides of 32 to 4096");
    if (!(settings.seconds >= 0.2 && settings.seconds <= 60.0))
        refuse_input(file, "", fmt::format("{:g} seconds", settings.seconds), "0.2 to 60");
    if (settings.pictures_per_second < 2 || settings.pictures_per_second > 60)
        refuse_input(file, "", fmt::format("{} pictures per second", settings.pictures_per_second), "2 to 60");
    std::error_code ignored;
    if (settings.pngs && std::filesystem::exists(png_folder(settings), ignored))
        refuse_input(png_folder(settings).string(), "", "a file or folder that exists", "a new folder for the pictures",
                     "choose another name for the film, or remove the folder");
}

TiltFilm::TiltFilm(const post::OcioConfig& config, const FilmSettings& settings, PreviewInputs inputs)
    : settings_((check_film(settings), settings)),
      inputs_(std::move(inputs)),
      preview_(config, true),
      webp_(settings.width, settings.height, 1.0 / settings.pictures_per_second) {
    inputs_.size = {settings.width, settings.height};
    if (!settings_.pngs) return;
    pngs_ = png_folder(settings_) += ".part";
    create_folder(pngs_);
}

TiltFilm::~TiltFilm() {
    std::error_code ignored;
    if (!pngs_.empty()) std::filesystem::remove_all(pngs_, ignored);
}

void TiltFilm::step() {
    if (finished_) return;
    inputs_.tilt = hand_tilt(static_cast<double>(drawn_) / settings_.count());
    preview_.show(inputs_);
    // Maps are complete in the second frame without motion.
    for (int frame = 0; frame < 2; ++frame) preview_.draw(static_cast<float>(1.0 / settings_.pictures_per_second));
    const std::vector<std::uint8_t> rgba = preview_.display().read_rgba8();
    webp_.add(rgba);
    if (!pngs_.empty()) {
        std::vector<std::uint8_t> rgb;
        rgb.reserve(rgba.size() / 4 * 3);
        for (std::size_t i = 0; i < rgba.size(); i += 4) rgb.insert(rgb.end(), {rgba[i], rgba[i + 1], rgba[i + 2]});
        image::write_png(pngs_ / fmt::format("{:04}.png", drawn_), settings_.width, settings_.height, rgb);
    }
    if (++drawn_ == settings_.count()) finish();
}

void TiltFilm::finish() {
    write_file_atomic(settings_.path, webp_.finish());
    if (!pngs_.empty()) {
        std::error_code failure;
        std::filesystem::rename(pngs_, png_folder(settings_), failure);
        if (failure) fail_system(png_folder(settings_).string(), failure.message());
        pngs_.clear();
    }
    finished_ = true;
}

}  // namespace rowland::inspector
