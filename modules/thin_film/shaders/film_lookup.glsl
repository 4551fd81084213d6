// The table of modules/thin_film/bake/film_table.h: the layers of the first column of M, then of the second and the
// third. FILM_LINE: one thickness and one roughness, layers end to end. FILM_ROUGHNESSES: one thickness, a row for each
// roughness. Else a row for each path difference, and layers stacked along y; FILM_LOBE_NODES: the smooth film's alone.
#ifdef FILM_LINE
TEXTURE_UNIT(8) uniform SAMPLER_LINE film_table;
#else
TEXTURE_UNIT(8) uniform sampler2D film_table;
#endif
uniform vec4 film_path;  // x: n^2 - 1 of the outermost layer; y, z: scale and bias from the logarithm of the path
                         // difference, or from the roughness, to rows; w: the greatest roughness
uniform vec4 film_axes;  // x, y: scale and bias from the root of the cosine to columns; z: from the smooth layer to the
                         // rough one; w: from one column of M to the next

// The row of a lobe is that of its mean_square_cosine() in film_table.h.
float film_row(float cosine, float thickness_nm, float roughness) {
    float spread = 1.0 + 3.1 * roughness * roughness * roughness;
    float path_nm = 2.0 * thickness_nm * sqrt(film_path.x + 0.72 + (cosine * cosine - 0.72) / spread);
    return log2(path_nm + 250.0) * film_path.y + film_path.z;
}

// M: light in the working space to what a film reflects of it. The fourth row is what the film reflects of white.
mat3x4 film_matrix(float cosine, float thickness_nm, float roughness) {
    float column = sqrt(cosine + 0.02) * film_axes.x + film_axes.y;
#ifdef FILM_LINE
    float at = column + (roughness > 0.0 ? film_axes.z : 0.0);
    return mat3x4(LINE_LOD(film_table, at, 0.0), LINE_LOD(film_table, at + film_axes.w, 0.0),
                  LINE_LOD(film_table, at + 2.0 * film_axes.w, 0.0));
#else
#ifdef FILM_ROUGHNESSES
    float row = min(roughness, film_path.w) * film_path.y + film_path.z;
#else
    float row = film_row(cosine, thickness_nm, roughness) + (roughness > 0.0 ? film_axes.z : 0.0);
#endif
    return mat3x4(textureLod(film_table, vec2(column, row), 0.0), textureLod(film_table, vec2(column, row + film_axes.w), 0.0),
                  textureLod(film_table, vec2(column, row + 2.0 * film_axes.w), 0.0));
#endif
}

// M averaged over the lobe that a view sees.
mat3x4 film_lobe(float n_v, float thickness_nm, float roughness) {
#ifdef FILM_LOBE_NODES
    LobeNodes nodes = lobe_nodes(n_v, roughness);
    mat3x4 sum = mat3x4(0.0);
    for (int i = 0; i < 4; ++i) sum += nodes.weights[i] * film_matrix(nodes.cosines[i], thickness_nm, 0.0);
    return sum;
#else
    return film_matrix(n_v, thickness_nm, roughness);
#endif
}
