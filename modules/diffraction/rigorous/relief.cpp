#include "modules/diffraction/rigorous/relief.h"

#include <fmt/format.h>

#include <cmath>

#include "engine/core/error.h"

namespace rowland::diffraction {

namespace {

struct Bounds {
    const std::string& name;

    /// Refuses values outside [low, high], or outside (low, high) if `open`.
    void check(const std::string& location, double value, double low, double high, bool open,
               const char* remedy) const {
        if (open ? value > low && value < high : value >= low && value <= high) return;
        refuse_input(name, location, fmt::format("{}", value),
                     fmt::format("a number {} {} and {}", open ? "between" : "from", low, high), remedy);
    }
};

}  // namespace

void check_relief(const Relief& relief, const std::string& name) {
    const Bounds bounds{name};
    bounds.check("pitch_nm", relief.pitch_nm, 0.0, 1e5, true, "use scalar theory for coarser gratings");
    bounds.check("cover/ior", relief.ambient_ior, 1.0, 4.0, false, "name a transparent medium");
    std::visit(
        [&](const auto& shape) {
            bounds.check("profile/depth_nm", shape.depth_nm, 0.0, 4.0 * relief.pitch_nm, false,
                         "reduce the depth: the solver knows reliefs up to four pitches deep");
            if constexpr (requires { shape.duty; })
                bounds.check("profile/duty", shape.duty, 0.0, 1.0, true, "for a flat surface set the depth to 0");
        },
        relief.shape);
    if (relief.films.size() > kMaximumFilms)
        refuse_input(name, "films", fmt::format("{} films", relief.films.size()),
                     fmt::format("at most {}", kMaximumFilms), "leave out the thinnest");
    for (std::size_t i = 0; i < relief.films.size(); ++i) {
        bounds.check(fmt::format("films/{}/ior", i), relief.films[i].ior, 1.0, 4.0, false, "name a transparent film");
        bounds.check(fmt::format("films/{}/thickness_nm", i), relief.films[i].thickness_nm, 0.0, relief.pitch_nm, false,
                     "a film that is thicker than the pitch does not follow the relief: use a cover");
    }
}

Relief relief_of(const Grating& grating, const std::string& name) {
    const char* const expected = "lamellar, sinusoidal or blazed grooves of a metal";
    if (grating.lattice) refuse_input(name, "/grating/lattice", "a lattice", expected, "use scalar theory");
    if (grating.transmission)
        refuse_input(name, "/transmission", "a sheet that transmits", expected, "use scalar theory");
    if (!grating.metal) refuse_input(name, "/metal", "no metal", expected, "add \"metal\": \"Al\"");
    Relief relief{.pitch_nm = grating.pitch_nm, .shape = {}, .ambient_ior = groove_medium(grating.cover)};
    std::visit(
        [&](const auto& shape) {
            if constexpr (requires { relief.shape = shape; })
                relief.shape = shape;
            else
                refuse_input(name, "/grating/profile/type", "a profile without a relief", expected,
                             "use scalar theory, or another profile");
        },
        grating.profile);
    return relief;
}

}  // namespace rowland::diffraction
