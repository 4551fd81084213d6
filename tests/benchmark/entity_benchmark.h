#pragma once

namespace rowland::benchmark {

/// Moves ten thousand entities per frame and uploads their matrices; prints the minimum time of each part over `rounds`
/// frames. A context must be current.
void print_entity_times(int rounds);

}  // namespace rowland::benchmark
