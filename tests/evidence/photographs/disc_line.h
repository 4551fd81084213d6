#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <vector>

namespace rowland::evidence {

/// A lamp and an eye above a disc. The disc lies in the XZ plane about the origin, its normal is +Y. An azimuth on it
/// is 0 toward +Z and 90° toward +X. Metres, world axes.
struct LampAndEye {
    glm::dvec3 lamp{0.0};
    glm::dvec3 eye{0.0};
};

/// Distance from the disc's centre, and angle from its normal.
struct Station {
    double distance_m = 0.0;
    double from_normal_deg = 0.0;
};

/// Egholm & Christensen 2006 (GRAPHITE, "Rendering compact disks and other diffractive surfaces illuminated by linear
/// light sources"): where the lamp and the cameras of their photographs stand, and by how much the disc is turned.
inline constexpr Station kLamp{0.7, 83.5};
inline constexpr std::array<Station, 3> kCameras = {{{0.227, 38.0}, {0.298, 29.0}, {0.35, 23.0}}};
inline constexpr int kFirstTurn_deg = 15;
inline constexpr int kLastTurn_deg = 180;
inline constexpr int kTurnStep_deg = 5;

/// The eye is at azimuth 0. The turn is taken as the azimuth of the lamp from there: a disc that turns in its own plane
/// looks the same.
LampAndEye lamp_and_eye(const Station& camera, double turned_deg);

glm::dvec3 disc_point(double radius_m, double azimuth);

/// s_h + v_h and s_g + v_g: components of the directions to lamp and eye along the track and across it (radially).
double along_track(const LampAndEye& setup, double radius_m, double azimuth);
double across_tracks(const LampAndEye& setup, double radius_m, double azimuth);

/// The azimuths, in [0, 2π), where light leaves a circle of the disc toward the eye: the roots of s_h + v_h = 0, which
/// is sin α sin θ_s = sin φ sin θ_o of the angles from the grating vector. To 1e-12 rad.
std::vector<double> line_azimuths(const LampAndEye& setup, double radius_m);

/// The wavelength that order m, m > 0 standing for both signs, sends there: s_g + v_g = ± m λ/d. nm.
double line_wavelength_nm(const LampAndEye& setup, double radius_m, double azimuth, double pitch_nm, int order);

/// |a − b| on the circle.
double azimuth_difference(double a, double b);

}  // namespace rowland::evidence
