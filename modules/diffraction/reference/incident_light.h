#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "engine/lighting/probe_image.h"
#include "engine/lighting/sh_light.h"

namespace rowland::diffraction {

/// Light as the reference integrates it: radiance from any direction, and how fine a quadrature must be to follow it.
class IncidentLight {
 public:
    virtual ~IncidentLight() = default;
    /// Linear RGB radiance from a unit vector in world axes.
    virtual glm::dvec3 radiance(const glm::dvec3& direction) const = 0;
    /// Length of a quadrature panel along an arc, in radians, and the Gauss–Legendre nodes a panel takes.
    virtual double panel_angle() const = 0;
    virtual int nodes_per_panel() const = 0;
};

/// A probe at full resolution. Bilinear light has kinks at every texel, so panels are shorter than a texel and take one
/// node each.
class ProbeLight final : public IncidentLight {
 public:
    explicit ProbeLight(const lighting::ProbeImage& probe);
    glm::dvec3 radiance(const glm::dvec3& direction) const override { return probe_.radiance(direction); }
    double panel_angle() const override { return panel_angle_; }
    int nodes_per_panel() const override { return 1; }

 private:
    const lighting::ProbeImage& probe_;
    double panel_angle_;
};

/// Band-limited light: smooth, so a few long panels of many nodes are exact to rounding.
class BandlimitedLight final : public IncidentLight {
 public:
    explicit BandlimitedLight(const lighting::ShLight& light);
    glm::dvec3 radiance(const glm::dvec3& direction) const override;
    double panel_angle() const override { return panel_angle_; }
    int nodes_per_panel() const override { return 12; }

 private:
    const lighting::ShLight& light_;
    double panel_angle_;
};

}  // namespace rowland::diffraction
