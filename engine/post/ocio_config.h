#pragma once

#include <OpenColorIO/OpenColorIO.h>

#include <clocale>
#include <filesystem>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <locale>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/core/text.h"

namespace rowland::post {

/// A colour configuration: which displays and views there are, and how scene-linear light becomes what they show.
class OcioConfig {
 public:
    /// content/ocio/rowland.ocio, as built into the program, with the computed views (computed_views.h).
    static OcioConfig shipped();

    /// Throws Error (input) if the file is missing, is no valid configuration, or is of a later version than the
    /// OpenColorIO in use reads; the message then names both versions.
    static OcioConfig from_file(const std::filesystem::path& path);

    /// `path` if given, else the file $OCIO names, else the shipped one. Throws as from_file does.
    static OcioConfig choose(const std::optional<std::filesystem::path>& path = std::nullopt);

    /// What messages call it: a path, or the name of the shipped one.
    const std::string& source() const { return source_; }

    /// Makes a display and one of its views the defaults; an empty name changes nothing. Throws Error (input) that
    /// lists the displays or views and names the nearest if there is none of that name.
    void prefer(const std::string& display, const std::string& view);

    std::vector<std::string> displays() const;
    std::string default_display() const;
    /// Throws Error (input) that lists the displays and names the nearest if there is none of that name.
    std::vector<std::string> views(const std::string& display) const;
    /// Throws Error (input) that lists the display's views and names the nearest if there is none of that name.
    void require_view(const std::string& display, const std::string& view) const;
    std::string default_view(const std::string& display) const;

    const OCIO_NAMESPACE::ConstConfigRcPtr& ocio() const { return config_; }

 private:
    OcioConfig(OCIO_NAMESPACE::ConstConfigRcPtr config, std::string source);
    static OcioConfig from_named_file(const std::filesystem::path& path, const std::string& source);

    OCIO_NAMESPACE::ConstConfigRcPtr config_;
    std::string source_;
    std::string preferred_display_;
    std::string preferred_view_;
};

/// Sets the classic locale during its lifetime. OpenColorIO reads and writes numbers in the global locale, which in an
/// application may have a decimal comma. To be used while no other thread changes or needs the locale.
class ClassicLocale {
 public:
    ClassicLocale() : c_(std::setlocale(LC_ALL, nullptr)), before_(std::locale::global(std::locale::classic())) {}
    ~ClassicLocale() {
        std::locale::global(before_);
        std::setlocale(LC_ALL, c_.c_str());
    }
    ClassicLocale(const ClassicLocale&) = delete;
    ClassicLocale& operator=(const ClassicLocale&) = delete;

 private:
    std::string c_;  ///< the C library's
    std::locale before_;
};

/// One file: content/ocio/rowland.ocio.
std::span<const EmbeddedFile> shipped_config_file();

/// The matrix from CIE XYZ (white colour::white_d65()) to the working space, which is the configuration's scene_linear
/// role; white stays neutral. It is the product of colour::xyz_to_acescg() and OpenColorIO's matrix from ACEScg through
/// the role aces_interchange, or else cie_xyz_d65_interchange, whichever is a scene space. A configuration with neither
/// does not say what its colours are: ACEScg is assumed, with a warning in the log. Good to float precision, 1e-6.
/// Throws Error (input) if scene_linear is missing or is not linear.
glm::dmat3 xyz_to_scene_linear(const OcioConfig& config);

/// Luminance as a weighted sum of scene_linear components: the Y row of the inverse of xyz_to_scene_linear. White has
/// luminance 1. Throws as xyz_to_scene_linear() does.
glm::vec3 luminance_weights(const OcioConfig& config);

}  // namespace rowland::post
