#include "editor/trade/other_load.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <string>

namespace rowland::trade {

OtherLoad::OtherLoad() : start_(used()) {}

std::optional<OtherLoad::Used> OtherLoad::used() {
    std::ifstream file("/proc/stat");
    std::string name;
    // user, nice, system, idle, waiting for disks, interrupts, soft interrupts, other virtual machines
    std::array<double, 8> ticks{};
    file >> name;
    for (double& value : ticks) file >> value;
    rusage own{};
    if (!file || name != "cpu" || ::getrusage(RUSAGE_SELF, &own) != 0) return std::nullopt;
    const double per_second = static_cast<double>(::sysconf(_SC_CLK_TCK));
    Used result;
    for (const double value : ticks) result.all_s += value / per_second;
    result.busy_s = result.all_s - (ticks[3] + ticks[4]) / per_second;
    for (const timeval& time : {own.ru_utime, own.ru_stime})
        result.own_s += static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
    return result;
}

std::optional<double> OtherLoad::fraction() const {
    const std::optional<Used> now = used();
    if (!start_ || !now || now->all_s <= start_->all_s) return std::nullopt;
    const double others = (now->busy_s - start_->busy_s) - (now->own_s - start_->own_s);
    return std::clamp(others / (now->all_s - start_->all_s), 0.0, 1.0);
}

}  // namespace rowland::trade
