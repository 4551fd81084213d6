#version 450 core
// The largest radius of a disc in a tile.
layout(location = 0) out float widest;

layout(binding = 0) uniform sampler2D discs;
uniform int tile;

void main() {
    ivec2 first = tile * ivec2(gl_FragCoord.xy);
    ivec2 end = min(first + tile, textureSize(discs, 0));
    widest = 0.0;
    for (int y = first.y; y < end.y; ++y)
        for (int x = first.x; x < end.x; ++x) widest = max(widest, abs(texelFetch(discs, ivec2(x, y), 0).a));
}
