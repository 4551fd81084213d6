#pragma once

#include <gtest/gtest.h>  // before RapidCheck's glue

#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <numbers>
#include <ostream>
#include <vector>

#include "engine/lighting/sh_light.h"
#include "engine/math/spherical_harmonics.h"
#include "modules/diffraction/model/brdf.h"
#include "modules/diffraction/model/grating.h"

// What the properties are tried on: values over many decades, with the edges of their ranges among them.

namespace rowland::diffraction {

inline void showValue(const Grating& grating, std::ostream& out) {
    const ProfileDescriptor& described = profile_descriptors()[grating.profile.index()];
    out << fmt::format("{{pitch {:.17g} nm, {} grooves, {}", grating.pitch_nm, grating.grooves, described.name);
    Profile profile = grating.profile;
    for (const ProfileMember& member : described.members)
        if (member.value != nullptr) out << fmt::format(" {:.17g}", member.value(profile));
    if (const auto* gaussian = std::get_if<GaussianLobe>(&grating.lobe))
        out << fmt::format(", sigma {:.17g}", gaussian->sigma);
    if (const auto* pits = std::get_if<PitsLobe>(&grating.lobe))
        out << fmt::format(", pits {:.17g} {:.17g}", pits->length_nm, pits->coherent);
    if (const auto* sequence = std::get_if<PitSequenceLobe>(&grating.lobe))
        out << fmt::format(", pit sequence {:.17g}, coherent {:.17g}, sigma {:.17g}",
                           fmt::join(sequence->spacings_nm, " "), sequence->coherent, sequence->sigma);
    if (grating.cover) out << fmt::format(", cover {:.17g}", grating.cover->ior);
    if (grating.transmission)
        out << fmt::format(", through {:.17g}, reflects {:.17g}", grating.transmission->ior,
                           grating.transmission->reflectance);
    if (const auto& lattice = grating.lattice)
        out << fmt::format(", lattice ({:.17g} {:.17g}) ({:.17g} {:.17g}) of profile {}, up to {}", lattice->a_nm.x,
                           lattice->a_nm.y, lattice->b_nm.x, lattice->b_nm.y, lattice->profile.index(),
                           lattice->orders);
    out << fmt::format(", orders {}}}", fmt::join(grating.orders, " "));
}

}  // namespace rowland::diffraction

namespace rowland::property {

/// Evenly in [low, high], whatever RapidCheck's size; shrinks toward low.
inline rc::Gen<double> uniform(double low, double high) {
    constexpr std::int64_t kSteps = std::int64_t{1} << 53;
    return rc::gen::map(rc::gen::resize(rc::kNominalSize, rc::gen::inRange<std::int64_t>(0, kSteps + 1)),
                        [=](std::int64_t step) {
                            return std::lerp(low, high, static_cast<double>(step) / static_cast<double>(kSteps));
                        });
}

/// Evenly in the logarithm; 0 < low < high.
inline rc::Gen<double> log_uniform(double low, double high) {
    return rc::gen::map(uniform(std::log(low), std::log(high)),
                        [=](double x) { return std::clamp(std::exp(x), low, high); });
}

inline rc::Gen<int> whole(int first, int last) {
    return rc::gen::resize(rc::kNominalSize, rc::gen::inRange(first, last + 1));
}

/// 50 nm … 1 mm.
inline rc::Gen<double> pitch() {
    return rc::gen::oneOf(log_uniform(50.0, 1e6), log_uniform(150.0, 5000.0),
                          rc::gen::element(50.0, 190.0, 195.0, 390.0, 740.0, 1600.0, 1e6));
}

inline rc::Gen<double> grooves() {
    return rc::gen::oneOf(rc::gen::map(log_uniform(1.0, 1e6), [](double n) { return std::round(n); }),
                          rc::gen::element(1.0, 2.0, 49.0, 50.0, 1500.0, 1e6));
}

inline rc::Gen<double> wavelength() {
    return rc::gen::oneOf(uniform(380.0, 780.0), rc::gen::element(380.0, 780.0, 550.0));
}

/// A unit vector of the upper hemisphere, down to 1e-7 above the horizon.
inline rc::Gen<glm::dvec3> upper_direction() {
    return rc::gen::exec([] {
        const double n = *rc::gen::oneOf(uniform(1e-3, 1.0), log_uniform(1e-7, 1.0), rc::gen::element(1.0, 1e-7));
        const double phi = *rc::gen::oneOf(uniform(0.0, 2.0 * std::numbers::pi),
                                           rc::gen::element(0.0, 0.5 * std::numbers::pi, std::numbers::pi));
        const double r = std::sqrt((1.0 - n) * (1.0 + n));
        return glm::dvec3(r * std::cos(phi), r * std::sin(phi), n);
    });
}

/// A unit vector anywhere, the axes among them.
inline rc::Gen<glm::dvec3> direction() {
    return rc::gen::exec([] {
        const double z = *rc::gen::oneOf(uniform(-1.0, 1.0), rc::gen::element(-1.0, 0.0, 1.0, 1.0 - 1e-12));
        const double phi = *rc::gen::oneOf(uniform(0.0, 2.0 * std::numbers::pi), rc::gen::element(0.0));
        const double r = std::sqrt((1.0 - z) * (1.0 + z));
        return glm::dvec3(r * std::cos(phi), r * std::sin(phi), z);
    });
}

/// A rotation about any axis by any angle: none, half a turn and hardly any among them.
inline rc::Gen<glm::dmat3> rotation() {
    return rc::gen::exec([] {
        const glm::dvec3 axis = *direction();
        const double angle =
            *rc::gen::oneOf(uniform(-std::numbers::pi, std::numbers::pi), log_uniform(1e-16, 1e-3),
                            rc::gen::element(0.0, 0.5 * std::numbers::pi, std::numbers::pi, std::numbers::pi - 1e-9));
        const double c = std::cos(angle);
        const double s = std::sin(angle);
        const glm::dmat3 cross(0.0, axis.z, -axis.y, -axis.z, 0.0, axis.x, axis.y, -axis.x, 0.0);
        return glm::dmat3(c) + s * cross + (1.0 - c) * glm::outerProduct(axis, axis);
    });
}

inline rc::Gen<diffraction::Profile> profile(double pitch_nm) {
    return rc::gen::exec([pitch_nm]() -> diffraction::Profile {
        const double depth_nm = *rc::gen::oneOf(uniform(0.0, 1000.0), log_uniform(1e-3, 1e4));
        switch (*whole(0, 3)) {
            case 0:
                return diffraction::SlitProfile{pitch_nm * *rc::gen::oneOf(uniform(1e-6, 1.0), log_uniform(1e-12, 1.0),
                                                                           rc::gen::element(0.0, 0.5, 1.0))};
            case 1:
                return diffraction::LamellarProfile{
                    *rc::gen::oneOf(uniform(0.0, 1.0), rc::gen::element(1e-9, 0.5, 1.0 - 1e-9)), depth_nm};
            case 2:
                return diffraction::SinusoidalProfile{depth_nm};
            default:
                return diffraction::BlazedProfile{depth_nm};
        }
    });
}

inline rc::Gen<diffraction::GrooveLobe> lobe() {
    return rc::gen::exec([]() -> diffraction::GrooveLobe {
        switch (*whole(0, 3)) {
            case 0:
                return diffraction::FlatLobe{};
            case 1:
                return diffraction::GaussianLobe{*log_uniform(1e-4, 10.0)};
            case 2: {
                std::vector<double> spacings_nm(static_cast<std::size_t>(*whole(1, 4)));
                for (double& spacing_nm : spacings_nm) spacing_nm = *log_uniform(100.0, 10000.0);
                std::sort(spacings_nm.begin(), spacings_nm.end());
                return diffraction::PitSequenceLobe{spacings_nm,
                                                    *rc::gen::oneOf(uniform(0.0, 1.0), rc::gen::element(0.0, 1.0)),
                                                    *log_uniform(0.01, 0.2)};
            }
            default:
                return diffraction::PitsLobe{*log_uniform(50.0, 20000.0),
                                             *rc::gen::oneOf(uniform(0.0, 1.0), rc::gen::element(0.0, 1.0))};
        }
    });
}

/// Some orders between −6 and 6, or all that propagate where they are few.
inline rc::Gen<std::vector<int>> orders(double pitch_nm) {
    return rc::gen::exec([pitch_nm] {
        if (pitch_nm < 3000.0 && *whole(0, 3) == 0) return diffraction::all_orders(pitch_nm);
        std::vector<int> some;
        for (int order = -6; order <= 6; ++order)
            if (*whole(0, 2) == 0) some.push_back(order);
        return some;
    });
}

/// A sheet that light passes, with or without a reflection, in place of a metal and a cover.
inline rc::Gen<diffraction::Transmission> transmission() {
    return rc::gen::exec([] {
        return diffraction::Transmission{.ior = *rc::gen::oneOf(uniform(1.0, 3.0), rc::gen::element(1.0, 1.5)),
                                         .reflectance = *rc::gen::oneOf(uniform(0.0, 1.0), rc::gen::element(0.0))};
    });
}

/// What lies over the grooves and under them.
inline void draw_layers(diffraction::Grating& grating) {
    if (*whole(0, 3) == 0) {
        grating.transmission = *transmission();
        return;
    }
    if (*whole(0, 3) == 0)
        grating.metal = *rc::gen::element(colour::Metal::Al, colour::Metal::Ag, colour::Metal::Au, colour::Metal::Cu);
    if (*whole(0, 3) == 0)
        grating.cover = diffraction::Cover{.ior = *uniform(1.0, 3.0),
                                           .tint = {*uniform(0.0, 1.0), *uniform(0.0, 1.0), *uniform(0.0, 1.0)}};
}

/// Any grating of grooves that the material file allows but tables, with at least `least_grooves` grooves.
inline rc::Gen<diffraction::Grating> grating(double least_grooves = 1.0) {
    return rc::gen::exec([least_grooves] {
        diffraction::Grating result;
        result.pitch_nm = *pitch();
        result.grooves = std::max(*grooves(), least_grooves);
        result.profile = *profile(result.pitch_nm);
        result.lobe = *lobe();
        result.orders = *orders(result.pitch_nm);
        draw_layers(result);
        if (std::holds_alternative<diffraction::SlitProfile>(result.profile) && *whole(0, 2) == 0)
            result.normalization = diffraction::Normalization::Agu;
        return result;
    });
}

inline rc::Gen<diffraction::LatticeProfile> lattice_profile(double a_nm, double b_nm, int orders) {
    return rc::gen::exec([=]() -> diffraction::LatticeProfile {
        switch (*whole(0, 2)) {
            case 0:
                return diffraction::CrossedProfile{.along_a = *profile(a_nm), .along_b = *profile(b_nm)};
            case 1:
                return diffraction::ApertureProfile{
                    .width_nm = a_nm * *rc::gen::oneOf(uniform(1e-6, 1.0), rc::gen::element(0.5, 1.0)),
                    .height_nm = b_nm * *rc::gen::oneOf(uniform(1e-6, 1.0), rc::gen::element(0.5, 1.0))};
            default: {
                diffraction::HeightMap map{.columns = 2 * orders + *whole(1, 4),
                                           .rows = 2 * orders + *whole(1, 4),
                                           .heights = {},
                                           .depth_nm = *uniform(0.0, 1000.0)};
                for (int i = 0; i < map.columns * map.rows; ++i)
                    map.heights.push_back(static_cast<std::uint8_t>(*whole(0, 255)));
                return map;
            }
        }
    });
}

/// Any lattice the material file allows, of few orders: sides from 300 nm to a tenth of a millimetre, at 5° or more.
inline rc::Gen<diffraction::Grating> lattice() {
    return rc::gen::exec([] {
        diffraction::Lattice cell;
        const double a_nm = *rc::gen::oneOf(log_uniform(300.0, 1e5), uniform(300.0, 3000.0), rc::gen::element(300.0));
        const double b_nm = *rc::gen::oneOf(log_uniform(300.0, 1e5), uniform(300.0, 3000.0), rc::gen::just(a_nm));
        const double a_angle = *rc::gen::oneOf(uniform(0.0, 2.0 * std::numbers::pi), rc::gen::element(0.0));
        const double between = std::numbers::pi / 36.0 *
                               *rc::gen::oneOf(uniform(1.0, 35.0), uniform(-35.0, -1.0), rc::gen::element(12.0, 18.0));
        cell.a_nm = a_nm * glm::dvec2(std::cos(a_angle), std::sin(a_angle));
        cell.b_nm = b_nm * glm::dvec2(std::cos(a_angle + between), std::sin(a_angle + between));
        cell.orders = *whole(1, 3);
        cell.profile = *lattice_profile(a_nm, b_nm, cell.orders);
        diffraction::Grating result;
        result.pitch_nm = std::min(a_nm, b_nm);
        result.orders.clear();
        result.lattice = std::move(cell);
        draw_layers(result);
        return result;
    });
}

/// What harmonics shade: grooves of an order so sharp that it is a point, of at most `most_orders`, or a lattice.
inline rc::Gen<diffraction::Grating> baked_grating(std::size_t most_orders) {
    return rc::gen::oneOf(rc::gen::suchThat(grating(diffraction::kManyGrooves),
                                            [=](const auto& one) { return one.orders.size() <= most_orders; }),
                          lattice());
}

/// Raw SH of 1 to `most_bands` bands, over twelve decades of strength, sometimes none.
inline rc::Gen<lighting::ShLight> sh_light(int most_bands) {
    return rc::gen::exec([most_bands] {
        lighting::ShLight light{*whole(1, most_bands), {}};
        const double strength = *rc::gen::oneOf(log_uniform(1e-6, 1e6), rc::gen::element(0.0, 1.0));
        for (int i = 0; i < math::sh_count(light.bands); ++i)
            light.coefficients.push_back(strength *
                                         glm::dvec3(*uniform(-1.0, 1.0), *uniform(-1.0, 1.0), *uniform(-1.0, 1.0)));
        return light;
    });
}

inline bool is_finite(const glm::dvec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

inline bool is_finite(const glm::dmat3& m) {
    return is_finite(m[0]) && is_finite(m[1]) && is_finite(m[2]);
}

inline bool is_finite_and_not_negative(const glm::dvec3& v) {
    return is_finite(v) && v.x >= 0.0 && v.y >= 0.0 && v.z >= 0.0;
}

inline double largest(const glm::dvec3& v) {
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

/// Σ|l_i|, the largest channel's: what a sum over coefficients of at most 1 can reach.
inline double total(const lighting::ShLight& light) {
    glm::dvec3 sum(0.0);
    for (const glm::dvec3& c : light.coefficients) sum += glm::abs(c);
    return largest(sum);
}

}  // namespace rowland::property
