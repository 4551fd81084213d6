// Whether pixels are lit by lights of their own: points and spots always are, the probe's key lights and directional
// lights where the surface has SEPARATE_LIGHTS.
#if defined(SEPARATE_LIGHTS) || defined(PUNCTUAL_LIGHTS)
#define HAS_DIRECT
#endif
// Lights without extent among them.
#if (defined(SEPARATE_LIGHTS) && defined(DIRECTIONAL_LIGHTS)) || defined(PUNCTUAL_LIGHTS)
#define SMALL_LIGHTS
#endif
// A streak shows the whole probe, key lights and all, but for the rest of Stam's pits.
#if defined(SEPARATE_LIGHTS) && !defined(NO_KEY_LIGHTS) && !(defined(STREAK) && defined(LOBE_GAUSSIAN))
#define KEY_LOBES
// Each in one look-up, but for what a table of them does not know: zero orders, and pitches that vary.
#if !defined(ZERO_ORDER) && !defined(GROOVE_MAP)
#define KEY_LOBE_TABLE
#endif
#endif
