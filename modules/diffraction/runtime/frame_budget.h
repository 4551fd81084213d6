#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <span>
#include <vector>

namespace rowland::diffraction {

/// Component, of one entity: the GPU's time that all gratings may take in a frame. Their materials are then drawn by
/// the rungs that give the least error within it, each weighted by the pixels that it covers.
struct FrameBudget {
    double gratings_ms = 0.0;  ///< at least 0: below what the cheapest rungs take, these are drawn
};

/// Component, beside a FrameBudget: what became of it.
struct FrameBudgetReport {
    double last_ms = 0.0;       ///< of the last frame that the GPU has finished
    double spent_ms = 0.0;      ///< averaged over the last ones
    double predicted_ms = 0.0;  ///< of the chosen rungs
    /// Averages over the pixels, of errors as multiples of those that budgets ask for by default.
    double error = 0.0;
    double least_error = 0.0;  ///< if every object were drawn by its best rung
    int objects = 0;           ///< seen
    int at_best = 0;           ///< of these, drawn by their best rung
    int fading = 0;            ///< from one rung to another
};

/// Component of an object, beside its DiffractionSurface: the rung that draws it under a FrameBudget, in place of one
/// that is chosen by measured times. A recorded play is played back by it.
struct RecordedRung {
    std::size_t rung = std::numeric_limits<std::size_t>::max();  ///< from 0, the cheapest; the best one if it has fewer
};

/// The time, as a multiple of a budget, from which on rungs become cheaper.
inline constexpr double kTooLong = 1.05;

/// Frames in which one rung fades into another: as many as their difference needs, so that nothing jumps.
inline constexpr int kLeastFadeFrames = 7;
inline constexpr int kMostFadeFrames = 64;
/// For the larger of the rungs' relative errors, 1: as large as the radiance itself.
int fade_frames(double relative_error);

/// A way to draw an object.
struct RungOption {
    double error = 0.0;  ///< times its pixels
    double ms = 0.0;
};

/// The index of an option for each object, such that the sum of errors is the least with a sum of times of at most
/// `ms`; the fastest options if even these take longer. Each object has at least one. Exact for a few objects; for
/// many, the sum of errors exceeds the least by no more than a change of one object's option saves.
std::vector<std::size_t> assign_rungs(std::span<const std::vector<RungOption>> objects, double ms);

/// An object whose rung is chosen, and which is drawn by its rung `shown`.
struct ObjectRungs {
    std::vector<RungOption> options = {};
    std::size_t shown = 0;
    std::size_t wanted = 0;  ///< the rung that it will be drawn by
    bool fades = false;      ///< from `shown` to `wanted`, and is drawn by both; `wanted` is not to change
};

/// Chooses the rungs of all objects in each frame so that the sum of errors is the least within a time, and changes
/// few: cheaper rungs are wanted when the time has been exceeded for some frames, better ones when the error has been a
/// tenth too large, and then no more of them fade at once than the time allows.
class RungChooser {
 public:
    /// Updates `wanted` of the objects that do not fade. A time that not even the fastest rungs keep is taken for a
    /// little more than they take.
    void choose(std::span<ObjectRungs> objects, double ms);

 private:
    int frames_too_long_ = 0;
    int frames_too_coarse_ = 0;
};

/// The size of a draw, or of several.
struct DrawSize {
    double samples = 0.0;
    double vertices = 0.0;
};

/// What draws of each kind cost on this machine, learned from what they took: a price per sample for each kind, and the
/// time that a unit of price takes, which follows the machine's load.
class DrawCosts {
 public:
    /// The price of a vertex of any kind.
    explicit DrawCosts(double price_of_vertex) : price_of_vertex_(price_of_vertex) {}

    /// Adds a kind, unless it is known, at an estimated price per sample. The unit is any, but the same for all kinds.
    void expect(std::uint64_t kind, double price) { prices_.try_emplace(kind, price); }

    struct Run {
        std::uint64_t kind = 0;
        DrawSize size = {};
        double ms = 0.0;
    };
    /// Updates prices and load from the runs of a frame.
    void learn(std::span<const Run> frame);

    /// The expected time; 0 for an unknown kind and before learn().
    double ms(std::uint64_t kind, const DrawSize& size) const;

 private:
    /// In units of price; 0 for an unknown kind.
    double work(std::uint64_t kind, const DrawSize& size) const;

    double price_of_vertex_;
    std::map<std::uint64_t, double> prices_;
    std::array<double, 3> recent_{};  ///< ms per unit of the last frames
    double ms_per_unit_ = 0.0;        ///< 0: nothing was measured
};

}  // namespace rowland::diffraction
