#pragma once

#include <optional>

namespace rowland::trade {

/// Times are doubtful if other programs used more of the processors than this.
inline constexpr double kLoaded = 0.1;

/// What other programs do while this one measures.
class OtherLoad {
 public:
    OtherLoad();

    /// The fraction of the machine's processor time that other programs, and other virtual machines, have used since
    /// the object was made, 0 to 1; nullopt where the system does not tell.
    std::optional<double> fraction() const;

 private:
    struct Used {
        double all_s = 0.0;   ///< the time of all processors, idle or not
        double busy_s = 0.0;  ///< of those that were not idle
        double own_s = 0.0;   ///< of this process
    };
    static std::optional<Used> used();

    std::optional<Used> start_;
};

}  // namespace rowland::trade
