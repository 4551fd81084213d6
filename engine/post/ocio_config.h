#pragma once

#include <OpenColorIO/OpenColorIO.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

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

}  // namespace rowland::post
