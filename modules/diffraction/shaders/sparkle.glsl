// Foil whose facets have random directions and are finer than a pixel (PHYSICS §11): takes the place of the parts in
// grooves.glsl. The texture's levels hold one facet of the four below (runtime/groove_map.h).

const int SPARKLE_PARTS = 16;
const float FEW_FACETS = 4.0;
const int MOST_ALONG = 8;  // texels along a side; a pixel covers six, of which it cuts two

// A pixel with few facets is shaded at points. One with more is shaded in equal ranges of directions, each as bright as
// the facets in it are many, of those whose texels the pixel covers in a level with few: they belong to the surface, so
// that a pixel that moves by half its width keeps half of them.
struct Sparkle {
    int parts;
    float noise;   // the deviation of the mean over the pixel's facets, over that of the mean over those that were read
    uvec4 counts;  // eight bits for each range: the weight of the facets in it
    float total;
    float within;  // where in its range a direction is shaded: the same in all ranges
    vec4 moments;  // of one facet, with the pixel's coverage
};
Sparkle sparkle;

vec4 facet_at(vec2 uv, int level) {
#ifdef GL_ES
    return textureLod(groove_map, uv, float(level)) + textureLod(groove_map_rest, uv, float(level));
#else
    return textureLod(groove_map, uv, float(level));
#endif
}

// The facet at a point of a golden-ratio lattice, which tells areas in the pixel.
vec4 facet_moments(MeshView mesh, int part) {
    vec2 at = vec2((float(part) + 0.5) / float(SPARKLE_PARTS), fract(0.61803399 * float(part)));
    return facet_at(mesh.map_uv + mesh.map_uv_change * (at - 0.5), 0);
}

// Of the moments' angle, over that of the direction.
#ifdef GROOVES_EVEN
const float ALL_DIRECTIONS = 6.28318531;
#else
const float ALL_DIRECTIONS = 3.14159265;
#endif

// The sums over facets that a pixel's moments are made of.
struct FacetSums {
    vec4 seen;       // of one of them
    float coverage;  // times its weight
    float weight;    // of all texels, with a facet or not
    float squares;   // of the facets' weights
};

// The texels of a level that the pixel covers.
float texels_in(MeshView mesh, int level) {
    vec2 texels = vec2(textureSize(groove_map, level));
    return abs(determinant(mesh.map_uv_change)) * texels.x * texels.y;
}

// The weight of a texel that the pixel covers whole: 200 for all texels of a level, so that a range's eight bits hold
// them, whatever the pixel's shape.
float texel_weight(MeshView mesh, int level) { return 200.0 / min(texels_in(mesh, level), float(MOST_ALONG * MOST_ALONG)); }

// Adds the facets of a level. `unit`: the weight of a texel that the pixel covers whole; `below`: that of one of the level
// below, whose facets these are as well.
void count_facets(MeshView mesh, int level, float unit, float below, inout FacetSums sums) {
    vec2 texels = vec2(textureSize(groove_map, level));
    mat2 to_texels = mat2(mesh.map_uv_change[0] * texels, mesh.map_uv_change[1] * texels);
    mat2 to_pixel = inverse(to_texels);
    vec2 half_pixel = 0.5 * (abs(to_texels[0]) + abs(to_texels[1]));
    vec2 half_texel = 0.5 * (abs(to_pixel[0]) + abs(to_pixel[1]));
    vec2 middle = mesh.map_uv * texels;
    vec2 first = floor(middle - half_pixel);
    ivec2 count = min(ivec2(floor(middle + half_pixel) - first) + 1, ivec2(MOST_ALONG));
    for (int i = 0; i < count.x * count.y; ++i) {
        vec2 texel = first + vec2(i % count.x, i / count.x) + 0.5;
        vec2 at = to_pixel * (texel - middle);
        vec2 covered = max(min(at + half_texel, 0.5) - max(at - half_texel, -0.5), 0.0) / (2.0 * half_texel);
        float weight = floor(unit * covered.x * covered.y + 0.5);
        if (weight == 0.0) continue;
        sums.weight += weight;
        vec4 moments = facet_at(texel / texels, level);
        if (moments.z == 0.0) continue;
        sums.seen = moments;
        sums.coverage += weight * moments.w;
        sums.squares += weight * weight * (1.0 + 2.0 * below / unit);
        sparkle.total += weight;
        vec2 mean = moments.xy - 0.5;
        float direction = float(SPARKLE_PARTS) * fract(atan(mean.y, mean.x) / ALL_DIRECTIONS);
        sparkle.within = fract(direction);
        int range = min(int(direction), SPARKLE_PARTS - 1);
        sparkle.counts[range >> 2] += uint(weight) << uint(8 * (range & 3));
    }
}

// Returns the moments of one of the pixel's facets, with the pixel's coverage. Call it first.
vec4 find_sparkle(MeshView mesh) {
    vec2 size = vec2(textureSize(groove_map, 0));
    float facets = texels_in(mesh, 0) / facet_texels;
    sparkle = Sparkle(facets < 0.02 ? 1 : SPARKLE_PARTS, 1.0, uvec4(0u), 0.0, 0.5, vec4(0.0));
    FacetSums sums = FacetSums(vec4(0.0), 0.0, 0.0, 0.0);
    if (facets < FEW_FACETS) {
        for (int part = 0; part < sparkle.parts; ++part) {
            vec4 moments = facet_moments(mesh, part);
            sums.weight += 1.0;
            if (moments.z == 0.0) continue;
            sums.seen = moments;
            sums.coverage += moments.w;
        }
    } else {
        // At most six texels along the longer side. Their weights go over to the next level's before these are three.
        vec2 width = (abs(mesh.map_uv_change[0]) + abs(mesh.map_uv_change[1])) * size;
        float across = max(width.x, width.y);
        int last = int(log2(max(size.x, size.y)) + 0.01);
        int level = clamp(int(ceil(log2(across / 6.0))), 0, last);
        float next = level == last ? 0.0 : smoothstep(3.0, 6.0, across / exp2(float(level)));
        float unit = (1.0 - next) * texel_weight(mesh, level);
        count_facets(mesh, level, unit, 0.0, sums);
        if (next > 0.0) count_facets(mesh, level + 1, next * texel_weight(mesh, level + 1), unit, sums);
        // The pixel's edges cut facets: a mean over a square of the side a > 1 has the variance (1/a - 1/(3 a^2))^2.
        float side = sqrt(facets);
        float read = sparkle.total * sparkle.total / max(sums.squares, 1.0);
        sparkle.noise = min(sqrt(read) * (1.0 / side - 1.0 / (3.0 * side * side)), 1.0);
    }
#ifdef GROOVE_GAPS
    if (sums.seen.z > 0.0) {
        float coverage = sums.coverage / sums.weight;
        sums.seen = vec4(0.5 + (sums.seen.xy - 0.5) * coverage / sums.seen.w, sums.seen.z * coverage / sums.seen.w, coverage);
    }
#endif
    sparkle.moments = sums.seen;
    return sums.seen;
}

int groove_parts(GrooveView view) { return sparkle.parts; }

// A facet, or the facets whose directions are in a range.
GrooveView groove_part(GrooveView view, int parts, int part) {
    if (parts == 1) return view;
    if (sparkle.total == 0.0)
        return grooves_of(view.mesh, view.g_change, view.v_g_change, facet_moments(view.mesh, part));
    float angle = ALL_DIRECTIONS * (float(part) + sparkle.within) / float(SPARKLE_PARTS);
    float count = float((sparkle.counts[part >> 2] >> uint(8 * (part & 3))) & 255u);
    vec4 moments = sparkle.moments;
    moments.xy = 0.5 + length(moments.xy - 0.5) * vec2(cos(angle), sin(angle));
    GrooveView one = grooves_of(view.mesh, view.g_change, view.v_g_change, moments);
    one.coverage *= 1.0 + sparkle.noise * (count * float(SPARKLE_PARTS) / sparkle.total - 1.0);
    return one;
}
