// Which lights of their own there are, and which stage shades them: points and spots always at the pixels; the probe's key
// lights and directional lights, where the surface has SEPARATE_LIGHTS, at the vertices under LIGHTS_AT_VERTICES.
#if defined(PUNCTUAL_LIGHTS) || (defined(SEPARATE_LIGHTS) && !defined(LIGHTS_AT_VERTICES))
#define LIGHTS_AT_PIXELS
#endif
#if defined(SEPARATE_LIGHTS) || defined(PUNCTUAL_LIGHTS)
#define HAS_DIRECT
#endif
// Lights without extent among them.
#if (defined(SEPARATE_LIGHTS) && defined(DIRECTIONAL_LIGHTS)) || defined(PUNCTUAL_LIGHTS)
#define SMALL_LIGHTS
#endif
// A light that the vertices shade, but only the pixels know its shadow.
#if defined(LIGHTS_AT_VERTICES) && defined(DIRECTIONAL_LIGHTS) && defined(SHADOWS)
#define SHADOWED_AT_PIXELS
#endif
// What vertices know of the light needs no more of the pixels than to be interpolated, in one value where they shade the
// rest, too.
#if defined(LIGHTS_AT_VERTICES) && !defined(VERTEX_SHADED)
#define LIGHTS_BESIDE
#endif
// A streak shows the whole probe, key lights and all, but for the rest of Stam's pits.
#if defined(SEPARATE_LIGHTS) && !defined(NO_KEY_LIGHTS) && !(defined(STREAK) && defined(LOBE_GAUSSIAN))
#define KEY_LOBES
// Each in one look-up, but for what a table of them does not know: zero orders, and pitches that vary.
#if !defined(ZERO_ORDER) && !defined(GROOVE_MAP)
#define KEY_LOBE_TABLE
#endif
#endif
