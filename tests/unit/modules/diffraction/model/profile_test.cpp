// A profile is described once. The schema and the page, which are written by hand, agree with the descriptors.

#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "engine/core/file.h"
#include "modules/diffraction/model/brdf.h"
#include "modules/diffraction/model/profile.h"
#include "tests/support/csv.h"
#include "tests/support/files.h"

namespace rowland::diffraction {
namespace {

using std::numbers::pi;
constexpr double kCdPitch_nm = 1600.0;
constexpr double kWavelength_nm = 550.0;

/// The number after `name=` in a parameter text.
double parameter(const std::string& text, const std::string& name) {
    const auto at = text.find(name + "=");
    EXPECT_NE(at, std::string::npos) << text;
    return std::stod(text.substr(at + name.size() + 1));
}

/// A groove depth whose phase φ = 4πt/λ is `phase`.
double depth_of(double phase) {
    return phase * kWavelength_nm / (4.0 * pi);
}

Profile profile_of(const std::string& name, const std::string& parameters) {
    if (name == "binary_phase")
        return LamellarProfile{parameter(parameters, "duty"), depth_of(parameter(parameters, "phase_step"))};
    // The table's phase amplitude is J_m's argument, φ/2.
    if (name == "sinusoidal_phase") return SinusoidalProfile{depth_of(2.0 * parameter(parameters, "phase_amplitude"))};
    if (name == "blazed_phase") return BlazedProfile{depth_of(2.0 * pi * parameter(parameters, "blaze_order"))};
    EXPECT_EQ(name, "amplitude_ronchi");
    return SlitProfile{parameter(parameters, "open_fraction") * kCdPitch_nm};
}

/// Twelve printed decimals, parameters printed to six (duty) and nine (phase): 1e-6.
TEST(Profile, MatchesPublishedScalarEfficiencies) {
    ROWLAND_TEST_DATA(path, "data/facts/grating_efficiencies_scalar.csv");
    const rowland::test::Csv facts = rowland::test::read_csv(path);
    ASSERT_EQ(facts.rows.size(), 193U);
    for (std::size_t row = 0; row < facts.rows.size(); ++row) {
        const Profile profile = profile_of(facts.text(row, "profile"), facts.text(row, "parameter"));
        const double found = profile_efficiency(profile, kCdPitch_nm, facts.integer(row, "order"), kWavelength_nm);
        EXPECT_NEAR(found, facts.number(row, "efficiency"), 1e-6)
            << facts.text(row, "profile") << " " << facts.text(row, "parameter") << " order "
            << facts.text(row, "order");
    }
}

double sum_of_orders(const Profile& profile, int highest) {
    double sum = 0.0;
    for (int order = -highest; order <= highest; ++order)
        sum += profile_efficiency(profile, kCdPitch_nm, order, kWavelength_nm);
    return sum;
}

/// The tail beyond order M of Σ sinc² falls as 1/(π² M): 2e-5 at M = 10 000.
TEST(Profile, SlitOrdersSumToFillFactor) {
    for (const double fill : {0.1, 0.5, 0.9})
        EXPECT_NEAR(sum_of_orders(SlitProfile{fill * kCdPitch_nm}, 10000), fill, 3e-5) << fill;
}

/// Parseval: a phase grating sends all it gets somewhere. Tails as above; the sinusoid's vanish.
TEST(Profile, PhaseGratingOrdersSumToOne) {
    EXPECT_NEAR(sum_of_orders(LamellarProfile{0.43, 100.0}, 10000), 1.0, 1e-4);
    EXPECT_NEAR(sum_of_orders(BlazedProfile{260.0}, 10000), 1.0, 3e-5);
    EXPECT_NEAR(sum_of_orders(SinusoidalProfile{150.0}, 40), 1.0, 1e-12);
}

TEST(Profile, FullWidthSlitIsAMirror) {
    const SlitProfile mirror{kCdPitch_nm};
    EXPECT_EQ(profile_efficiency(mirror, kCdPitch_nm, 0, kWavelength_nm), 1.0);
    for (const int order : {-200, -3, -1, 1, 2, 7})
        EXPECT_EQ(profile_efficiency(mirror, kCdPitch_nm, order, kWavelength_nm), 0.0);
}

TEST(Profile, NarrowSlitVanishesWithoutNaN) {
    EXPECT_NEAR(profile_efficiency(SlitProfile{1e-6}, kCdPitch_nm, 1, kWavelength_nm), 0.0, 1e-17);
    EXPECT_EQ(profile_efficiency(SlitProfile{0.0}, kCdPitch_nm, 1, kWavelength_nm), 0.0);
}

TEST(Profile, FlatPhaseGratingsAreMirrors) {
    for (const Profile& profile :
         {Profile{LamellarProfile{0.3, 0.0}}, Profile{SinusoidalProfile{0.0}}, Profile{BlazedProfile{0.0}}}) {
        EXPECT_EQ(profile_efficiency(profile, kCdPitch_nm, 0, kWavelength_nm), 1.0);
        EXPECT_EQ(profile_efficiency(profile, kCdPitch_nm, 1, kWavelength_nm), 0.0);
    }
}

TEST(Profile, BlazeFavoursPositiveOrders) {
    const BlazedProfile blazed{0.5 * kWavelength_nm};  // one wavelength of path: all light in order 1
    EXPECT_NEAR(profile_efficiency(blazed, kCdPitch_nm, 1, kWavelength_nm), 1.0, 1e-15);
    EXPECT_NEAR(profile_efficiency(blazed, kCdPitch_nm, -1, kWavelength_nm), 0.0, 1e-15);
}

/// The slow reference: |∫ exp(iφ(y)) exp(−2πi x y) dy|² by the midpoint rule, 1e5 nodes (error ~1e-9 smooth, ~1e-5 at
/// steps).
TEST(Profile, GrooveSpectrumIsTheGroovesFourierTransform) {
    const double x = 1.37;
    const auto brute_force = [&](const auto& depth_nm) {
        double re = 0.0;
        double im = 0.0;
        const int nodes = 100000;
        for (int i = 0; i < nodes; ++i) {
            const double y = (i + 0.5) / nodes - 0.5;
            const double phase = 4.0 * pi * depth_nm(y) / kWavelength_nm - 2.0 * pi * x * y;
            re += std::cos(phase) / nodes;
            im += std::sin(phase) / nodes;
        }
        return re * re + im * im;
    };
    EXPECT_NEAR(groove_spectrum(LamellarProfile{0.35, 130.0}, kCdPitch_nm, x, kWavelength_nm),
                brute_force([](double y) { return std::abs(y) < 0.175 ? 130.0 : 0.0; }), 2e-5);
    EXPECT_NEAR(groove_spectrum(SinusoidalProfile{150.0}, kCdPitch_nm, x, kWavelength_nm),
                brute_force([](double y) { return 75.0 * std::cos(2.0 * pi * y); }), 1e-8);
    EXPECT_NEAR(groove_spectrum(BlazedProfile{260.0}, kCdPitch_nm, x, kWavelength_nm),
                brute_force([](double y) { return 260.0 * y; }), 1e-8);
}

std::string read_module_file(const std::string& path) {
    return read_text_file(rowland::test::source_path("modules/diffraction/" + path), 1 << 20);
}

TEST(ProfileDescriptor, PageHasEveryProfileAndItsMembers) {
    const std::string page = read_module_file("README.md");
    for (const ProfileDescriptor& descriptor : profile_descriptors()) {
        const auto begin = page.find("\n| `" + std::string(descriptor.name) + "` |");
        ASSERT_NE(begin, std::string::npos) << descriptor.name;
        const std::string row = page.substr(begin, page.find('\n', begin + 1) - begin);
        for (const ProfileMember& member : descriptor.members)
            EXPECT_NE(row.find(std::string("`") + member.key + "`"), std::string::npos) << row;
    }
}

TEST(ProfileDescriptor, FollowTheVariantAndHaveNamesOfTheirOwn) {
    std::set<std::string_view> names;
    for (std::size_t i = 0; i < profile_descriptors().size(); ++i) {
        EXPECT_EQ(profile_descriptors()[i].empty.index(), i);
        EXPECT_TRUE(names.insert(profile_descriptors()[i].name).second) << profile_descriptors()[i].name;
    }
    EXPECT_EQ(names.size(), std::variant_size_v<Profile>);
}

TEST(ProfileDescriptor, EveryNumberChangesTheEfficiencies) {
    for (const ProfileDescriptor& descriptor : profile_descriptors()) {
        for (const ProfileMember& changed : descriptor.members) {
            if (changed.value == nullptr) continue;
            Profile profile = descriptor.empty;
            for (const ProfileMember& member : descriptor.members) member.value(profile) = member.initial;
            const double before = profile_efficiency(profile, 1600.0, 1, 550.0);
            changed.value(profile) *= 0.9;
            EXPECT_NE(profile_efficiency(profile, 1600.0, 1, 550.0), before) << descriptor.name << " " << changed.key;
        }
    }
}

TEST(ProfileDescriptor, InitialValuesAreInRange) {
    for (const ProfileDescriptor& descriptor : profile_descriptors()) {
        for (const ProfileMember& member : descriptor.members) {
            if (member.value == nullptr) continue;
            EXPECT_GT(member.initial, 0.0) << member.key;
            EXPECT_TRUE(member.within_pitch || member.initial < member.less_than) << member.key;
        }
    }
}

/// User interfaces show one control for a key that several profiles have.
TEST(ProfileDescriptor, MembersOfOneKeyMeanTheSame) {
    std::map<std::string, ProfileMember> known;
    for (const ProfileDescriptor& descriptor : profile_descriptors()) {
        for (const ProfileMember& member : descriptor.members) {
            const ProfileMember& first = known.emplace(member.key, member).first->second;
            EXPECT_STREQ(member.label, first.label);
            EXPECT_STREQ(member.unit, first.unit);
            EXPECT_STREQ(member.help, first.help);
            EXPECT_EQ(member.less_than, first.less_than) << member.key;
            EXPECT_EQ(member.within_pitch, first.within_pitch) << member.key;
        }
    }
}

constexpr double kPitch_nm = 1000.0;

/// d = 1000 nm, so that order ±2 is cut off at 500 nm at normal incidence and R+2 printed there is noise.
EfficiencyTable three_rows() {
    return {.orders = {-2, 0, 2},
            .slices = {{.incidence_deg = 0.0,
                        .wavelengths_nm = {400.0, 480.0, 500.0, 560.0},
                        .efficiencies = {0.20, 0.30, 0.20,  //
                                         0.16, 0.40, 0.16,  //
                                         0.00, 0.70, 3e-5,  //
                                         0.00, 0.90, 0.00}}}};
}

double at(const EfficiencyTable& table, int order, double wavelength_nm, double s_g = 0.0) {
    return table_efficiency(table, kPitch_nm, order, wavelength_nm, s_g);
}

/// Exact but for the rounding of one linear interpolation.
constexpr double kRounding = 1e-15;

TEST(EfficiencyTable, IsLinearBetweenRowsAndHeldBeyondThem) {
    const EfficiencyTable table = three_rows();
    EXPECT_NEAR(at(table, 0, 440.0), 0.35, kRounding);
    EXPECT_NEAR(at(table, 2, 420.0), 0.19, kRounding);
    EXPECT_NEAR(at(table, 0, 530.0), 0.80, kRounding);
    EXPECT_EQ(at(table, 0, 380.0), 0.30);
    EXPECT_EQ(at(table, 0, 780.0), 0.90);
}

TEST(EfficiencyTable, OrdersItDoesNotNameAreZero) {
    for (const int order : {-3, -1, 1, 3}) EXPECT_EQ(at(three_rows(), order, 440.0), 0.0);
}

TEST(EfficiencyTable, HoldsAnOrderUpToItsCutOffAndNoFurther) {
    EfficiencyTable table = three_rows();
    table.slices[0].efficiencies[7] = 0.6;  // leaves room for what holds
    for (const int order : {-2, 2}) {
        EXPECT_EQ(at(table, order, 490.0), 0.16) << order;
        EXPECT_EQ(at(table, order, 499.999), 0.16) << order;
        EXPECT_EQ(at(table, order, 500.0), 0.0) << order;
        EXPECT_EQ(at(table, order, 530.0), 0.0) << order;
    }
}

/// With a pitch that puts no cut-off between the last row and the first 0, the table's own 0 is the cut-off.
TEST(EfficiencyTable, AnOrderThatEndsWithoutACutOffEndsAtItsFirstZero) {
    EXPECT_EQ(table_efficiency(three_rows(), 3000.0, -2, 499.0, 0.0), 0.16);
    EXPECT_EQ(table_efficiency(three_rows(), 3000.0, -2, 500.0, 0.0), 0.0);
}

/// A table with power beyond an order's cut-off at normal incidence means it: pairs at a slant still show the order.
TEST(EfficiencyTable, PowerBeyondTheCutOffIsTheTablesOwn) {
    EfficiencyTable table = three_rows();
    table.slices[0].efficiencies.back() = 0.08;
    EXPECT_NEAR(at(table, 2, 530.0), 0.5 * (3e-5 + 0.08), kRounding);
}

TEST(EfficiencyTable, ATableThatEndsBeforeTheCutOffIsHeldUpToIt) {
    EfficiencyTable table = three_rows();
    table.slices[0].wavelengths_nm.resize(2);
    table.slices[0].efficiencies.resize(6);
    EXPECT_EQ(at(table, 2, 499.0), 0.16);
    EXPECT_EQ(at(table, 2, 501.0), 0.0);
}

/// Two incidences, one row each: linear in the angle.
EfficiencyTable two_incidences() {
    return {.orders = {-1, 1},
            .slices = {{.incidence_deg = 0.0, .wavelengths_nm = {500.0}, .efficiencies = {0.4, 0.4}},
                       {.incidence_deg = 40.0, .wavelengths_nm = {500.0}, .efficiencies = {0.0, 0.6}}}};
}

double s_g(double incidence_deg) {
    return std::sin(incidence_deg * std::numbers::pi / 180.0);
}

TEST(EfficiencyTable, IsLinearInTheAngleOfIncidenceAndHeldBeyondIt) {
    const EfficiencyTable table = two_incidences();
    EXPECT_NEAR(at(table, 1, 500.0, s_g(10.0)), 0.45, 1e-14);  // the sine and its inverse round
    EXPECT_EQ(at(table, 1, 500.0, s_g(60.0)), 0.6);
    EXPECT_EQ(at(table, 1, 500.0, -0.5), 0.4);
    EXPECT_TRUE(depends_on_incidence(table));
    EXPECT_FALSE(depends_on_incidence(three_rows()));
}

/// Order −1 of 500 nm turns evanescent at s_g = ½, 30°.
TEST(EfficiencyTable, IsNotInterpolatedAcrossTheAngleWhereAnOrderIsCutOff) {
    const EfficiencyTable table = two_incidences();
    EXPECT_EQ(at(table, -1, 500.0, s_g(29.0)), 0.4);
    EXPECT_EQ(at(table, -1, 500.0, s_g(31.0)), 0.0);
}

}  // namespace
}  // namespace rowland::diffraction
