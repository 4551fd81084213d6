// The end of fragment stages that shade pixels. Before it, the program defines
//   vec3 diffracted_xyz(GrooveView view);
// of a view above the horizon.
MaterialTerms material_terms() {
    GrooveView view = groove_view();
    vec3 xyz = lights_from_vertices_xyz();
    if (view.direction.z > 0.0 && view.pitch > 0.0) xyz += diffracted_xyz(view) + direct_xyz(view);
    return MaterialTerms(base_weight, mirror_weight, mat3(xyz_to_working) * xyz);
}
