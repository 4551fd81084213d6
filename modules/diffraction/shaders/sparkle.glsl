// Foil whose facets have random directions and are finer than a pixel (PHYSICS §11): takes the place of the parts in
// grooves.glsl. The texture's levels hold one facet of the four below (runtime/groove_map.h).

const int SPARKLE_PARTS = 16;

// A pixel with more facets than parts is shaded in equal ranges of directions, each as bright as the facets of the parts
// that are in it are many.
struct Sparkle {
    int parts;
    float noise;    // the deviation of the mean over the pixel's facets, over that of the mean over the parts'
    uvec2 counts;   // for each range, four bits: the number of parts whose facet is in it; 16 counts as 15
    float covered;  // parts that have a facet
    float within;   // where in its range a direction is shaded: random, and the same in all ranges
};
Sparkle sparkle;

vec4 facet_moments(MeshView mesh, int part) {
    vec2 width = (abs(mesh.map_uv_change[0]) + abs(mesh.map_uv_change[1])) * vec2(textureSize(groove_map, 0));
    // Of few facets the golden-ratio lattice tells the areas in the pixel, of many the square one meets each once.
    vec2 at = sparkle.noise < 1.0 ? (vec2(part & 3, part >> 2) + 0.5) / 4.0
                                  : vec2((float(part) + 0.5) / float(SPARKLE_PARTS), fract(0.61803399 * float(part)));
    // Texels half as wide as a part or less, so that parts do not share them. Parts take the next level one by one as
    // the pixel grows, so that facets are not replaced all at once.
    float level = log2(max(max(width.x, width.y) / 8.0, 0.5)) + (float(part) + 0.5) / float(SPARKLE_PARTS);
    vec2 uv = mesh.map_uv + mesh.map_uv_change * (at - 0.5);
#ifdef GL_ES
    return textureLod(groove_map, uv, floor(max(level, 0.0))) + textureLod(groove_map_rest, uv, floor(max(level, 0.0)));
#else
    return textureLod(groove_map, uv, floor(max(level, 0.0)));
#endif
}

// Of the moments' angle, over that of the direction.
#ifdef GROOVES_EVEN
const float ALL_DIRECTIONS = 6.28318531;
#else
const float ALL_DIRECTIONS = 3.14159265;
#endif

// Returns the moments of one of the pixel's facets, with the pixel's coverage. Call it first.
vec4 find_sparkle(MeshView mesh) {
    vec2 texels = vec2(textureSize(groove_map, 0));
    float facets = abs(determinant(mesh.map_uv_change)) * texels.x * texels.y / facet_texels;
    // The pixel's edges cut facets: a mean over a square of the side a > 1 has the variance (1/a - 1/(3 a^2))^2. The
    // square lattice adds a tenth to it between 4 and 16 facets.
    float side = sqrt(max(facets, 1.0));
    float noise = min(sqrt(float(SPARKLE_PARTS)) * (1.0 / side - 1.0 / (3.0 * side * side)), 0.95);
    sparkle = Sparkle(facets < 0.02 ? 1 : SPARKLE_PARTS, facets < 4.0 ? 1.0 : noise, uvec2(0u), 0.0, 0.5);
    vec4 seen = vec4(0.0);
    float coverage = 0.0;
    for (int part = 0; part < sparkle.parts; ++part) {
        vec4 moments = facet_moments(mesh, part);
        if (moments.z == 0.0) continue;
        seen = moments;
        coverage += moments.w;
        sparkle.covered += 1.0;
        vec2 mean = moments.xy - 0.5;
        float direction = float(SPARKLE_PARTS) * fract(atan(mean.y, mean.x) / ALL_DIRECTIONS);
        sparkle.within = fract(direction);
        uint range = min(uint(direction), uint(SPARKLE_PARTS) - 1u);
        uint one = 1u << (4u * (range & 7u));
        if (range < 8u)
            sparkle.counts.x += sparkle.counts.x / one % 16u < 15u ? one : 0u;
        else
            sparkle.counts.y += sparkle.counts.y / one % 16u < 15u ? one : 0u;
    }
#ifdef GROOVE_GAPS
    if (seen.z > 0.0) {
        coverage /= float(sparkle.parts);
        seen = vec4(0.5 + (seen.xy - 0.5) * coverage / seen.w, seen.z * coverage / seen.w, coverage);
    }
#endif
    return seen;
}

int groove_parts(GrooveView view) { return sparkle.parts; }

// A facet, or the facets whose directions are in a range.
GrooveView groove_part(GrooveView view, int parts, int part) {
    if (parts == 1) return view;
    vec4 moments = facet_moments(view.mesh, part);
    float weight = 1.0;
    if (sparkle.noise < 1.0) {
        float angle = ALL_DIRECTIONS * (float(part) + sparkle.within) / float(SPARKLE_PARTS);
        moments.xy = 0.5 + length(moments.xy - 0.5) * vec2(cos(angle), sin(angle));
        uint counts = part < 8 ? sparkle.counts.x : sparkle.counts.y;
        float count = float((counts >> (4u * uint(part & 7))) & 15u);
        weight = 1.0 + sparkle.noise * (count * float(SPARKLE_PARTS) / max(sparkle.covered, 1.0) - 1.0);
    }
    GrooveView one = grooves_of(view.mesh, view.g_change, view.v_g_change, moments);
    one.coverage *= weight;
    return one;
}
