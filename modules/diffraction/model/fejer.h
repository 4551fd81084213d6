#pragma once

namespace rowland::diffraction {

/// The Fejér ratio F_N(m + δ) = [sin(πN(m+δ)) / (N sin(π(m+δ)))]², the interference of N grooves, at distance `delta`
/// from any whole order m: 1 at δ = 0, mean 1/N over a period (Lindsay & Agu 2006, eq. 1; PHYSICS §8). `grooves` is a
/// whole number N ≥ 1.
///
/// The order is not a parameter because F_N has period 1, and m + δ would lose digits of δ: near a peak the error is up
/// to 230 in float where the value is 1. Error: in double 1e-12 relative down to 1e-20, in float 1e-5 absolute.
double fejer(double grooves, double delta);
float fejer(float grooves, float delta);

}  // namespace rowland::diffraction
