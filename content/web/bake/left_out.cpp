// What the package leaves out. Lattices are refused when a material is read, so that no module holds what they need. Of
// a file's "quality" only the illuminant is read: the page chooses representations by the mesh.
#include "modules/diffraction/asset/material.h"
#include "modules/diffraction/bake/diffraction_pattern.h"
#include "modules/diffraction/bake/lattice_terms.h"
#include "modules/diffraction/reference/reference.h"

namespace rowland::diffraction {

Quality parse_quality(JsonReader json, const Grating&, const ReadNamed&) {
    Quality quality;
    if (json.has("illuminant")) quality.illuminant = colour::illuminant(json.text("illuminant"));
    return quality;
}

Grating parse_lattice_grating(JsonReader& json, const ReadNamed&) {
    json.fail("lattice", "a lattice", "grooves of one direction (pitch_nm)", "the package does not shade lattices");
}

// These are never called: lattices are refused, and so are materials that name a file.
EfficiencyTable parse_efficiency_csv(std::string_view, const std::string&) {
    return {};
}

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

LatticeTerms::LatticeTerms(const Grating&, const colour::LightSpectra&, int bands) : grid_step_(0.0), bands_(bands) {}

std::vector<glm::dmat3> LatticeTerms::coefficients(const glm::dvec2&) const {
    return {};
}

std::vector<glm::dvec3> lattice_radiance(const Grating&, const IncidentLight&, const colour::LightSpectra&,
                                         std::span<const ShadingPoint>, int) {
    return {};
}

}  // namespace rowland::diffraction
