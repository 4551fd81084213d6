#include "modules/diffraction/asset/material.h"

#include <gmock/gmock.h>

#include "engine/core/file.h"
#include "modules/diffraction/asset/cooked_material.h"
#include "tests/support/expect.h"
#include "tests/support/files.h"

namespace rowland::diffraction {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

HeightMap staircase() {
    HeightMap map{.columns = 16, .rows = 8, .heights = {}, .depth_nm = 120.0};
    for (int i = 0; i < 16 * 8; ++i) map.heights.push_back(static_cast<std::uint8_t>(2 * i));
    return map;
}

/// The files that the materials below name: a table in "t.csv", one that is not sane in "bad.csv", a cell in
/// "cell.png".
NamedText read_named(const std::string& name) {
    if (name == "t.csv") return {.text = "wavelength_nm,R+1\n500,0.4\n", .file = name};
    if (name == "bad.csv") return {.text = "wavelength_nm,R+1\n500,1.4\n", .file = "folder/" + name};
    return {.text = name == "cell.png" ? write_height_map(staircase()) : "no picture", .file = name};
}

Material parse(const std::string& text) {
    return parse_material(parse_json(text, "m.json"), "m.json", read_named);
}

/// A material whose grating has a pitch, a profile and these members.
std::string with_profile(const std::string& profile, const std::string& grating = "", const std::string& more = "") {
    return R"({"grating": {"pitch_nm": 1600, "profile": )" + profile + grating + "}" + more + "}";
}

const std::string kSlit = R"({"type": "slit", "width_nm": 800})";
const std::string kTable = R"({"type": "table", "file": "t.csv"})";

/// A slit grating with these members, and the material with more.
std::string grating(const std::string& members, const std::string& more = "") {
    return with_profile(kSlit, members, more);
}

std::string with_cell(const std::string& profile, const std::string& grating = "", const std::string& more = "") {
    return R"({"grating": {"lattice": {"a_nm": [50000, 0], "b_nm": [0, 40000]}, "profile": )" + profile + grating +
           "}" + more + "}";
}

const std::string kAperture = R"({"type": "aperture", "width_nm": 15000, "height_nm": 40000})";

std::string with_sides(const std::string& a_nm, const std::string& b_nm) {
    return R"({"grating": {"lattice": {"a_nm": )" + a_nm + R"(, "b_nm": )" + b_nm + R"(}, "profile": )" + kAperture +
           "}}";
}

/// Unless the file names it: rigorous where the solver knows the grooves and the representation takes it.
TEST(Material, TheTheoryFollowsTheGrooves) {
    const std::string al = R"(, "metal": "Al")";
    const auto theory = [](const std::string& profile, const std::string& grating, const std::string& more) {
        return parse(with_profile(profile, grating, more)).grating.theory;
    };
    for (const char* relief : {R"({"type": "sinusoidal", "depth_nm": 100})", R"({"type": "blazed", "depth_nm": 100})",
                               R"({"type": "lamellar", "duty": 0.4, "depth_nm": 100})"}) {
        EXPECT_EQ(theory(relief, "", al), Theory::Rigorous) << relief;
        EXPECT_EQ(theory(relief, "", al + R"(, "cover": {"ior": 1.5})"), Theory::Rigorous) << relief;
        EXPECT_EQ(theory(relief, R"(, "theory": "scalar")", al), Theory::Scalar) << relief;
        EXPECT_EQ(theory(relief, "", ""), Theory::Scalar) << relief;
        EXPECT_EQ(theory(relief, R"(, "grooves": 20)", al), Theory::Scalar) << relief;
        EXPECT_EQ(
            theory(relief, R"(, "groove_lobe": {"sigma": 0.1})", al + R"(, "quality": {"representation": "streak"})"),
            Theory::Scalar)
            << relief;
    }
    EXPECT_EQ(theory(kSlit, "", al), Theory::Scalar);
    EXPECT_EQ(theory(kTable, "", ""), Theory::Scalar);
    const Material filmed = parse(with_profile(R"({"type": "sinusoidal", "depth_nm": 100})",
                                               R"(, "films": [{"ior": 1.6, "thickness_nm": 120}])", al));
    EXPECT_EQ(filmed.grating.films, (std::vector<DielectricFilm>{{.ior = 1.6, .thickness_nm = 120.0}}));
}

TEST(MaterialJson, OnlyPitchAndProfileAreRequired) {
    const Material material = parse(grating(""));
    EXPECT_EQ(material.grating.pitch_nm, 1600.0);
    EXPECT_EQ(std::get<SlitProfile>(material.grating.profile).width_nm, 800.0);
    EXPECT_EQ(material.grating.grooves, 1500.0);
    EXPECT_THAT(material.grating.orders, ElementsAre(-2, -1, 1, 2));
    EXPECT_EQ(material.grating.normalization, Normalization::Energy);
    EXPECT_TRUE(is_flat(material.grating.lobe));
    EXPECT_FALSE(material.grating.metal.has_value());
    EXPECT_EQ(material.base.colour, glm::vec3(0.0F));
    EXPECT_EQ(material.base.roughness, 0.3F);
    EXPECT_EQ(material.quality.max_error, 0.05);
    EXPECT_FALSE(material.quality.pinned.has_value());
}

TEST(MaterialJson, EveryFieldReachesTheMaterial) {
    const Material material = parse(R"({
        "grating": { "pitch_nm": 740, "grooves": 900, "profile": { "type": "lamellar", "duty": 0.43, "depth_nm": 100 },
                     "orders": [1, -1, 0], "normalization": "energy", "groove_lobe": { "sigma": 0.2 } },
        "metal": "Au", "base": { "color": [0.1, 0.2, 0.3], "roughness": 0.7 },
        "quality": { "max_error": 0.1, "representation": "spikes", "bands": 8, "spikes": 16, "view_mapping": "spherical",
                     "view_resolution": 48, "storage": "fp16" } })");
    EXPECT_EQ(std::get<LamellarProfile>(material.grating.profile).duty, 0.43);
    EXPECT_EQ(std::get<LamellarProfile>(material.grating.profile).depth_nm, 100.0);
    EXPECT_EQ(material.grating.grooves, 900.0);
    EXPECT_THAT(material.grating.orders, ElementsAre(-1, 0, 1));
    EXPECT_EQ(std::get<GaussianLobe>(material.grating.lobe).sigma, 0.2);
    EXPECT_EQ(material.grating.metal, colour::Metal::Au);
    EXPECT_EQ(material.base.colour, glm::vec3(0.1F, 0.2F, 0.3F));
    EXPECT_EQ(material.base.roughness, 0.7F);
    EXPECT_EQ(material.quality.max_error, 0.1);
    const auto settings = std::get<SpikeTableSettings>(representation(material));
    EXPECT_EQ(settings.spikes.bands, 8);
    EXPECT_EQ(settings.spikes.spikes, 16);
    EXPECT_EQ(settings.grid.rows, 48);
    EXPECT_EQ(settings.grid.columns, 96);
    EXPECT_EQ(settings.storage, Storage::Half);
}

TEST(MaterialJson, EveryVariantReachesTheMaterial) {
    const Material pits = parse(grating(R"(, "groove_lobe": {"pits": {"length_nm": 900, "coherent": 0.4}})"));
    EXPECT_EQ(std::get<PitsLobe>(pits.grating.lobe).length_nm, 900.0);
    EXPECT_EQ(std::get<PitsLobe>(pits.grating.lobe).coherent, 0.4);
    const Material sequence = parse(grating(
        R"(, "groove_lobe": {"pit_sequence": {"spacings_nm": [900, 1250.5], "coherent": 0.4, "sigma": 0.03}})"));
    EXPECT_EQ(std::get<PitSequenceLobe>(sequence.grating.lobe).spacings_nm, (std::vector<double>{900.0, 1250.5}));
    EXPECT_EQ(std::get<PitSequenceLobe>(sequence.grating.lobe).coherent, 0.4);
    EXPECT_EQ(std::get<PitSequenceLobe>(sequence.grating.lobe).sigma, 0.03);
    const Material one_spacing = parse(grating(R"(, "groove_lobe": {"pit_sequence": {"spacings_nm": [1800]}})"));
    EXPECT_EQ(std::get<PitSequenceLobe>(one_spacing.grating.lobe).coherent, PitSequenceLobe{}.coherent);
    EXPECT_EQ(std::get<PitSequenceLobe>(one_spacing.grating.lobe).sigma, kCoherentSigma);
    EXPECT_EQ(parse(grating(R"(, "normalization": "agu")")).grating.normalization, Normalization::Agu);
    EXPECT_EQ(parse(grating(R"(, "grooves": 1)")).grating.grooves, 1.0);
    EXPECT_EQ(
        std::get<SlitProfile>(parse(with_profile(R"({"type": "slit", "width_nm": 1600})")).grating.profile).width_nm,
        1600.0);
    const Cover clear = parse(grating("", R"(, "cover": {"ior": 1.58})")).grating.cover.value();
    EXPECT_EQ(clear.ior, 1.58);
    EXPECT_EQ(clear.tint, glm::dvec3(1.0));
    EXPECT_EQ(parse(grating("", R"(, "cover": {"ior": 1, "tint": [0, 0.5, 1]})")).grating.cover->tint,
              glm::dvec3(0.0, 0.5, 1.0));
    EXPECT_EQ(parse(with_profile(kTable, "", R"(, "cover": {"ior": 1.5})")).grating.cover->ior, 1.5);
    const Transmission sheet =
        parse(grating("", R"(, "transmission": {"ior": 1.5, "reflectance": 0.25})")).grating.transmission.value();
    EXPECT_EQ(sheet.ior, 1.5);
    EXPECT_EQ(sheet.reflectance, 0.25);
}

TEST(MaterialJson, EveryProfileOfALatticeReachesTheMaterial) {
    const Material screen = parse(with_cell(kAperture, R"(, "orders": 12)"));
    ASSERT_TRUE(screen.grating.lattice);
    EXPECT_EQ(screen.grating.lattice->a_nm, glm::dvec2(50000.0, 0.0));
    EXPECT_EQ(screen.grating.lattice->b_nm, glm::dvec2(0.0, 40000.0));
    EXPECT_EQ(screen.grating.lattice->orders, 12);
    EXPECT_EQ(std::get<ApertureProfile>(screen.grating.lattice->profile).width_nm, 15000.0);
    EXPECT_EQ(std::get<ApertureProfile>(screen.grating.lattice->profile).height_nm, 40000.0);
    EXPECT_TRUE(screen.grating.orders.empty());
    const Material crossed = parse(with_cell(
        R"({"type": "crossed", "along_a": {"type": "sinusoidal", "depth_nm": 120}, "along_b": {"type": "blazed", "depth_nm": 90}})"));
    const auto& grooves = std::get<CrossedProfile>(crossed.grating.lattice->profile);
    EXPECT_EQ(std::get<SinusoidalProfile>(grooves.along_a).depth_nm, 120.0);
    EXPECT_EQ(std::get<BlazedProfile>(grooves.along_b).depth_nm, 90.0);
    EXPECT_EQ(crossed.grating.lattice->orders, 2);
    const Material relief = parse(with_cell(R"({"type": "height_map", "file": "cell.png", "depth_nm": 75})"));
    const auto& heights = std::get<HeightMap>(relief.grating.lattice->profile);
    EXPECT_EQ(heights.columns, 16);
    EXPECT_EQ(heights.heights, staircase().heights);
    EXPECT_EQ(heights.depth_nm, 75.0);
}

TEST(MaterialJson, AllOrdersAreThoseThatPropagateSomewhere) {
    // d = 600 nm: |u| <= 2, so m λ <= 1200 nm: orders to ±3 at 380 nm.
    const std::string text = R"({"grating": {"pitch_nm": 600, "profile": {"type": "slit", "width_nm": 300},
                                 "orders": "all"}})";
    EXPECT_THAT(parse(text).grating.orders, ElementsAre(-3, -2, -1, 1, 2, 3));
    const std::string coarse = R"({"grating": {"pitch_nm": 50000, "orders": "all", "profile": )" + kSlit + "}}";
    EXPECT_EQ(parse(coarse).grating.orders.size(), 2U * 263U);
}

TEST(MaterialJson, ATableIsReadBesideTheMaterial) {
    const rowland::test::TemporaryFolder folder;
    write_file_atomic(folder.path() / "t.csv", "wavelength_nm,R-1,R+1\n500,0.1,0.4\n");
    write_file_atomic(folder.path() / "m.json", with_profile(kTable));
    const Material material = load_material(folder.path() / "m.json");
    EXPECT_EQ(profile_efficiency(material.grating.profile, 1600.0, 1, 500.0), 0.4);
    EXPECT_EQ(profile_efficiency(material.grating.profile, 1600.0, -1, 500.0), 0.1);
    EXPECT_EQ(profile_efficiency(material.grating.profile, 1600.0, 2, 500.0), 0.0);
}

/// A material, and parts of the message that refuses it.
struct Refused {
    std::string text;
    std::vector<const char*> told;
};

TEST(MaterialJson, MembersOutOfTheirDomainAreRefusedByFileAndPointer) {
    const auto pitch = [](const char* value) {
        return R"({"grating": {"pitch_nm": )" + std::string(value) + R"(, "profile": )" + kSlit + "}}";
    };
    const auto member = [](const std::string& text) { return grating(", " + text); };
    const auto beside = [](const std::string& text) { return grating("", ", " + text); };
    const auto sheet = [](const std::string& text) {
        return with_profile(R"({"type": "lamellar", "duty": 0.5, "depth_nm": 550})", "",
                            R"(, "transmission": )" + text);
    };
    std::vector<Refused> cases = {
        {"[]", {"object"}},
        {R"({"grating": {"profile": {"type": "slit", "width_nm": 800}}})", {"pitch_nm"}},
        {R"({"grating": {"pitch": 1600, "profile": {"type": "slit", "width_nm": 800}}})", {"pitch_nm"}},
        {member(R"("ordres": [1])"), {"/grating/ordres", "orders"}},
        {with_profile(R"({"type": "slitt", "width_nm": 800})"), {"\"slit\""}},
        {with_profile(R"({"type": "slit", "width": 800})"), {"width_nm"}},
        {member(R"("orders": [])"), {"/grating/orders"}},
        {member(R"("orders": "every")"), {"\"all\""}},
        {member(R"("orders": [1, 1.5])"), {"/grating/orders/1"}},
        {member(R"("orders": [1, 10001])"), {"/grating/orders/1"}},
        {member(R"("orders": [1, 1])"), {"twice"}},
        {R"({"grating": {"pitch_nm": 1e6, "orders": "all", "profile": )" + kSlit + "}}", {"/grating/orders", "190000"}},
        {member(R"("groove_lobe": {"sigma": 0})"), {"/grating/groove_lobe/sigma"}},
        {member(R"("groove_lobe": 0.2)"), {"/grating/groove_lobe", "pits"}},
        {member(R"("groove_lobe": {"sigma": 0.2, "pits": {"length_nm": 850, "coherent": 0.3}})"), {"sigma"}},
        {member(R"("groove_lobe": {"pits": {"length_nm": 850}})"), {"/grating/groove_lobe/pits/coherent"}},
        {member(R"("groove_lobe": {"pits": {"length_nm": 0, "coherent": 0.3}})"), {"/groove_lobe/pits/length_nm"}},
        {member(R"("groove_lobe": {"pits": {"length_nm": 850, "coherent": 1.3}})"), {"/groove_lobe/pits/coherent"}},
        {member(R"("grooves": 7, "groove_lobe": {"pits": {"length_nm": 850, "coherent": 0.3}})"),
         {"/grating/grooves", "pits"}},
        {member(R"("groove_lobe": {"pit_sequense": {"spacings_nm": [900]}})"), {"pit_sequense", "pit_sequence"}},
        {member(R"("groove_lobe": {"pit_sequence": {}})"), {"/groove_lobe/pit_sequence/spacings_nm"}},
        {member(R"("groove_lobe": {"pit_sequence": {"spacings": [900]}})"), {"spacings_nm"}},
        {member(R"("groove_lobe": {"pit_sequence": {"spacings_nm": 900}})"), {"/pit_sequence/spacings_nm", "list"}},
        {member(R"("groove_lobe": {"pit_sequence": {"spacings_nm": []}})"), {"/pit_sequence/spacings_nm", "1 to 16"}},
        {member(R"("groove_lobe": {"pit_sequence": {"spacings_nm": [1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16,17]}})"),
         {"/pit_sequence/spacings_nm", "1 to 16"}},
        {member(R"("groove_lobe": {"pit_sequence": {"spacings_nm": [99]}})"), {"/spacings_nm/0", "[100, 100000]"}},
        {member(R"("groove_lobe": {"pit_sequence": {"spacings_nm": [900, "x"]}})"), {"/spacings_nm/1"}},
        {member(R"("groove_lobe": {"pit_sequence": {"spacings_nm": [900, 900]}})"), {"/spacings_nm/1", "ascending"}},
        {member(R"("groove_lobe": {"pit_sequence": {"spacings_nm": [900], "coherent": 1.3}})"), {"/coherent"}},
        {member(R"("groove_lobe": {"pit_sequence": {"spacings_nm": [900], "sigma": 0.3}})"), {"/sigma"}},
        {member(
             R"("groove_lobe": {"pits": {"length_nm": 850, "coherent": 0.3}, "pit_sequence": {"spacings_nm": [900]}})"),
         {"pit_sequence"}},
        {member(R"("grooves": 7, "groove_lobe": {"pit_sequence": {"spacings_nm": [900]}})"),
         {"/grating/grooves", "pits"}},
        {with_profile(kTable, R"(, "grooves": 49)"), {"/grating/grooves", "table"}},
        {with_profile(R"({"type": "sinusoidal", "depth_nm": 100})", R"(, "normalization": "agu")"), {"slit"}},
        {with_profile(R"({"type": "table", "file": "bad.csv"})"), {"folder/bad.csv: row 2", "1.4"}},
        {with_profile(R"({"type": "table", "file": ""})"), {"/grating/profile/file"}},
        {with_profile(kTable, "", R"(, "metal": "Al")"), {"/metal", "already"}},
        {with_profile(kTable, "", R"(, "cover": {"ior": 1.5, "tint": [1, 1, 0]})"), {"/cover/tint", "already"}},
        {beside(R"("metal": "Fe")"), {"/metal"}},
        {beside(R"("base": {"color": [0.1, 0.2]})"), {"/base/color"}},
        {beside(R"("base": {"color": [0.1, 0.2, 1.1]})"), {"/base/color/2"}},
        {beside(R"("base": {"roughness": 2})"), {"/base/roughness"}},
        {beside(R"("quality": {"max_error": 0})"), {"/quality/max_error"}},
        {beside(R"("quality": {"illuminant": "F12"})"), {"/quality/illuminant", "F11"}},
        {beside(R"("cover": 1.5)"), {"/cover"}},
        {beside(R"("cover": {})"), {"/cover/ior"}},
        {beside(R"("cover": {"ior": 0.99})"), {"/cover/ior", "[1, 3]"}},
        {beside(R"("cover": {"ior": 3.1})"), {"/cover/ior"}},
        {beside(R"("cover": {"ior": 1.5, "tint": [1, 1]})"), {"/cover/tint"}},
        {beside(R"("cover": {"ior": 1.5, "tint": [1, 1, 1.2]})"), {"/cover/tint/2"}},
        {beside(R"("cover": {"ior": 1.5, "tnt": [1, 1, 1]})"), {"tnt", "tint"}},
        {sheet(R"({"ior": 1.5, "reflectance": 1.5})"), {"/transmission/reflectance"}},
        {sheet("{}"), {"/transmission"}},
        {sheet(R"({"ior": 0.9})"), {"/transmission/ior"}},
        {sheet(R"({"ior": 3.1})"), {"/transmission/ior"}},
        {sheet(R"({"ior": 1.5, "tint": 1})"), {"tint"}},
        {sheet(R"({"ior": 1.5}, "metal": "Al")"), {"a metal beside a transmission"}},
        {sheet(R"({"ior": 1.5}, "cover": {"ior": 1.4})"), {"a cover beside a transmission"}},
    };
    // Rigorous theory.
    const auto solved = [&](const std::string& profile, const std::string& grating, const std::string& others) {
        return with_profile(profile, R"(, "theory": "rigorous")" + grating, others);
    };
    constexpr const char* sine = R"({"type": "sinusoidal", "depth_nm": 100})";
    const std::string al = R"(, "metal": "Al")";
    cases.push_back({with_profile(sine, R"(, "theory": "vector")", al), {"/grating/theory", "rigorous"}});
    cases.push_back({solved(kTable, "", ""), {"/grating/theory", "lamellar, sinusoidal or blazed"}});
    cases.push_back({solved(kSlit, "", al), {"/grating/theory", "lamellar, sinusoidal or blazed"}});
    cases.push_back({solved(sine, "", ""), {"/grating/theory", "metal"}});
    cases.push_back({solved(sine, R"(, "grooves": 20)", al), {"/grating/grooves", "rigorous"}});
    constexpr const char* deep = R"({"type": "sinusoidal", "depth_nm": 6401})";
    cases.push_back({solved(deep, "", al), {"/grating/theory", "6401"}});
    for (const auto& [film, pointer] : {std::pair{R"({"ior": 0.9, "thickness_nm": 50})", "/grating/films/0/ior"},
                                        {R"({"ior": 4.1, "thickness_nm": 50})", "/grating/films/0/ior"},
                                        {R"({"ior": 1.5, "thickness_nm": 0})", "/grating/films/0/thickness_nm"},
                                        {R"({"ior": 1.5, "thickness_nm": 1601})", "/grating/films/0/thickness_nm"},
                                        {R"({"ior": 1.5})", "/grating/films/0/thickness_nm"},
                                        {R"({"ior": 1.5, "thickness_nm": 9, "k": 1})", "/grating/films/0"}})
        cases.push_back({with_profile(sine, std::string(R"(, "films": [)") + film + "]", al), {pointer}});
    const std::string film = R"({"ior": 1.5, "thickness_nm": 9})";
    const std::string films = R"(, "films": [)" + film + "]";
    cases.push_back({with_profile(sine, R"(, "films": [])", al), {"/grating/films"}});
    cases.push_back(
        {with_profile(sine, R"(, "films": [)" + film + "," + film + "," + film + "," + film + "," + film + "]", al),
         {"/grating/films"}});
    cases.push_back({with_profile(sine, films), {"/grating/films", "rigorous"}});
    cases.push_back({with_profile(kSlit, films, al), {"/grating/films", "rigorous"}});
    cases.push_back({with_profile(sine, films + R"(, "theory": "scalar")", al), {"/grating/films", "rigorous"}});
    cases.push_back(
        {solved(sine, R"(, "groove_lobe": {"sigma": 0.1})", al + R"(, "quality": {"representation": "streak"})"),
         {"/quality/representation", "directions"}});
    for (const char* nm : {"190", "20001"}) {
        std::string text = solved(sine, "", al);
        text.replace(text.find("1600"), 4, nm);
        cases.push_back({text, {"/grating/theory", nm}});
    }
    // JSON has no NaN and no infinity: the text itself is refused.
    for (const char* value : {"NaN", "nan", "Infinity", "-inf", "1e999"}) cases.push_back({pitch(value), {}});
    for (const char* value : {"0", "-1600", "0.5", "1e8", "\"1600\"", "null", "true"})
        cases.push_back({pitch(value), {"/grating/pitch_nm"}});
    for (const char* value : {"1600.5", "0", "-5"})
        cases.push_back({with_profile(R"({"type": "slit", "width_nm": )" + std::string(value) + "}"),
                         {"/grating/profile/width_nm"}});
    for (const char* value : {"0", "1", "-0.2", "1.2"})
        cases.push_back({with_profile(R"({"type": "lamellar", "depth_nm": 1, "duty": )" + std::string(value) + "}"),
                         {"/grating/profile/duty"}});
    for (const char* type : {"sinusoidal", "blazed"})
        for (const char* value : {"0", "-100"})
            cases.push_back({with_profile(R"({"type": ")" + std::string(type) + R"(", "depth_nm": )" + value + "}"),
                             {"/grating/profile/depth_nm"}});
    for (const char* value : {"0", "0.5", "-3"})
        cases.push_back({member(R"("grooves": )" + std::string(value)), {"/grating/grooves"}});
    // Lattices.
    for (const auto& [a, b] : {std::pair("[50000, 0]", "[40000, 0]"), std::pair("[500, 500]", "[-5000, -5000]"),
                               std::pair("[50000, 0]", "[40000, 1000]")})
        cases.push_back({with_sides(a, b), {"/grating/lattice/b_nm", "degrees"}});
    cases.push_back({with_sides("[299, 0]", "[0, 50000]"), {"length of 299"}});
    cases.push_back({with_sides("[9e6, 9e6]", "[0, 50000]"), {"/lattice/a_nm"}});
    cases.push_back({with_sides("[50000]", "[0, 50000]"), {"/lattice/a_nm"}});
    for (const char* text :
         {R"("pitch_nm": 1600)", R"("grooves": 1500)", R"("normalization": "agu")", R"("groove_lobe": {"sigma": 0.2})"})
        cases.push_back({with_cell(kAperture, std::string(", ") + text), {"beside a lattice"}});
    cases.push_back({with_cell(kAperture, R"(, "orders": [1, 2])"), {"/grating/orders"}});
    cases.push_back({with_cell(kAperture, R"(, "orders": 10000)"), {"/grating/orders"}});
    cases.push_back({with_cell(kSlit), {"/grating/profile/type"}});
    cases.push_back({with_profile(kAperture), {"/grating/profile/type"}});
    cases.push_back(
        {with_cell(R"({"type": "crossed", "along_b": {"type": "blazed", "depth_nm": 9}, "along_a": )" + kTable + "}"),
         {"/grating/profile/along_a", "table"}});
    cases.push_back(
        {with_cell(R"({"type": "height_map", "file": "other.png", "depth_nm": 75})"), {"other.png", "PNG"}});
    cases.push_back({with_cell(R"({"type": "height_map", "file": "cell.png", "depth_nm": 75})", R"(, "orders": 4)"),
                     {"/grating/profile/file", "more than 8 texels"}});
    cases.push_back({with_cell(kAperture, "", R"(, "quality": {"representation": "circle"})"),
                     {"/quality/representation", "with a lattice", "\"planar\""}});
    for (const Refused& one : cases) {
        const std::string message = rowland::test::message_of([&] { parse(one.text); });
        for (const char* told : one.told) EXPECT_THAT(message, HasSubstr(told)) << one.text;
        EXPECT_THAT(message, testing::AnyOf(HasSubstr("m.json"), HasSubstr("bad.csv"), HasSubstr("other.png")))
            << one.text;
    }
    EXPECT_THAT(rowland::test::message_of([] { load_material("no_folder/no_such_material.json"); }),
                HasSubstr("no_such_material.json"));
}

TEST(MaterialJson, LatticesTakeTheRepresentationsThatShadeThem) {
    EXPECT_NO_THROW(parse(with_sides("[50000, 0]", "[50000, 4374]")));  // 5 degrees
    for (const RepresentationInfo* info : representations()) {
        if (!info->lattices) continue;
        const std::string quality = R"(, "quality": {"representation": ")" + std::string(info->name) + "\"}";
        EXPECT_NO_THROW(parse(with_cell(kAperture, "", quality))) << info->name;
    }
}

TEST(MaterialJson, ACookedMaterialHoldsItsHeights) {
    const nlohmann::json json =
        parse_json(with_cell(R"({"type": "height_map", "file": "cell.png", "depth_nm": 75})"), "m.json");
    const CookedMaterial cooked = cook_material(json, "m.json", read_named);
    const CookedMaterial again = read_cooked_material(write_cooked_material(json, cooked), "m.material");
    EXPECT_EQ(std::get<HeightMap>(again.material.grating.lattice->profile).heights, staircase().heights);
    EXPECT_THAT(describe(again), AllOf(HasSubstr("a_nm: 50000 0"), HasSubstr("representation: planar")));
}

}  // namespace
}  // namespace rowland::diffraction
