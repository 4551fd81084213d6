// The package does not shade lattices: refused when a material is read, so that no module holds what they need.
#include "modules/diffraction/model/lattice.h"
#include "modules/diffraction/asset/lattice_json.h"
#include "modules/diffraction/bake/lattice_nodes.h"
#include "modules/diffraction/bake/lattice_terms.h"
#include "modules/diffraction/reference/lattice_radiance.h"
#include "modules/diffraction/representations/streak/lattice_streak.h"

namespace rowland::diffraction {

Grating parse_lattice_grating(JsonReader& json, const ReadNamed&) {
    json.fail("lattice", "a lattice", "grooves of one direction (pitch_nm)", "the package does not shade lattices");
}

// Nothing reaches these.
std::vector<double> lattice_efficiencies(const Lattice&, double) {
    return {};
}

double lattice_zero_order(const Lattice&, double) {
    return 0.0;
}

std::vector<DiffractionPattern::Node> lattice_nodes(const Grating&, const colour::LightSpectra&, double) {
    return {};
}

std::vector<LatticeOrder> shaded_lattice_orders(const Grating&) {
    return {};
}

std::vector<double> lattice_spectrum(const std::vector<LatticeOrder>&, const std::optional<Cover>&, const glm::dvec2&,
                                     int) {
    return {};
}

LatticeTerms::LatticeTerms(const Grating&, const colour::LightSpectra&, int bands) : cell_(0.0), bands_(bands) {}

std::vector<glm::dmat3> LatticeTerms::coefficients(const glm::dvec2&) const {
    return {};
}

LatticeStreak make_lattice_streak(const Grating&, const StreakSettings&) {
    return {};
}

StreakMapSize lattice_map_size(int) {
    return {};
}

glm::dvec3 evaluate(const LatticeStreak&, const StreakMap&, const glm::dmat3&, const glm::dvec3&,
                    const std::optional<Cover>&) {
    return glm::dvec3(0.0);
}

void write(const LatticeStreak&, ByteWriter&) {}

LatticeStreak read_lattice_streak(ByteReader&) {
    return {};
}

std::vector<glm::dvec3> lattice_radiance(const Grating&, const IncidentLight&, const colour::LightSpectra&,
                                         std::span<const ShadingPoint>, int) {
    return {};
}

}  // namespace rowland::diffraction
