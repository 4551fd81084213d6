#include "modules/diffraction/rigorous/relief.h"

#include <fmt/format.h>

#include <string_view>
#include <type_traits>

#include "engine/core/error.h"

namespace rowland::diffraction {

namespace {

constexpr double kDeepest = 4.0;  ///< in pitches

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

std::optional<ReliefShape> relief_shape(const Profile& profile) {
    return std::visit(
        [](const auto& shape) -> std::optional<ReliefShape> {
            if constexpr (std::is_constructible_v<ReliefShape, decltype(shape)>) return shape;
            return std::nullopt;
        },
        profile);
}

void check_relief(const Relief& relief, const std::string& name) {
    const Bounds bounds{name};
    bounds.check("pitch_nm", relief.pitch_nm, 0.0, 1e5, true, "use scalar theory for coarser gratings");
    bounds.check("cover/ior", relief.ambient_ior, 1.0, 4.0, false, "name a transparent medium");
    std::visit(
        [&](const auto& shape) {
            bounds.check("profile/depth_nm", shape.depth_nm, 0.0, kDeepest * relief.pitch_nm, false,
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

std::optional<Refusal> rigorous_refusal(const Grating& grating) {
    const auto with = [](const std::string& found, const std::string& expected) {
        return Refusal{"/grating/theory", "\"rigorous\" with " + found, expected, "use \"scalar\""};
    };
    constexpr const char* kReliefs = "lamellar, sinusoidal or blazed grooves";
    if (grating.lattice) return with("a lattice", kReliefs);
    const std::optional<ReliefShape> shape = relief_shape(grating.profile);
    if (!shape) {
        const std::string_view name = std::visit([](const auto& other) { return other.kName; }, grating.profile);
        return with(fmt::format("profile \"{}\"", name), kReliefs);
    }
    if (grating.side_reflectance) return with("the reflected side of a sheet", "grooves of a metal");
    if (!grating.metal && !grating.transmission)
        return Refusal{"/grating/theory", "\"rigorous\" without a metal",
                       "grooves of a metal, or of a sheet that transmits", "add \"metal\": \"Al\""};
    const double finest_nm = colour::kVisibleMin / 2.0;
    if (!(grating.pitch_nm > finest_nm && grating.pitch_nm <= kCoarsestSolved_nm))
        return with(fmt::format("a pitch of {} nm", grating.pitch_nm),
                    fmt::format("more than {} nm, below which no order but 0 propagates, and up to {} nm", finest_nm,
                                kCoarsestSolved_nm));
    const double depth = std::visit([](const auto& known) { return known.depth_nm; }, *shape);
    if (depth > kDeepest * grating.pitch_nm)
        return with(fmt::format("a depth of {} nm", depth), "grooves up to four pitches deep");
    if (grating.grooves < kManyGrooves)
        return Refusal{"/grating/grooves", fmt::format("{} with rigorous theory", grating.grooves),
                       fmt::format("at least {}", kManyGrooves),
                       "it does not give the groove's spectrum between the orders"};
    return std::nullopt;
}

std::complex<double> index_of(const Substrate& substrate, double wavelength_nm) {
    if (const auto* metal = std::get_if<colour::Metal>(&substrate)) return colour::metal_index(*metal, wavelength_nm);
    return std::get<double>(substrate);
}

Substrate substrate_of(const Grating& grating) {
    if (grating.transmission) return grating.transmission->ior;
    return *grating.metal;
}

Relief relief_of(const Grating& grating, const std::string& name) {
    if (const auto refused = rigorous_refusal(grating))
        refuse_input(name, refused->key, refused->found, refused->expected, refused->remedy);
    Relief relief{.pitch_nm = grating.pitch_nm,
                  .shape = *relief_shape(grating.profile),
                  .films = grating.films,
                  .ambient_ior = groove_medium(grating.cover),
                  .mirrored = grating.transmission.has_value()};
    check_relief(relief, name);
    return relief;
}

}  // namespace rowland::diffraction
