// The end of fragment stages that shade pixels. Before it, the program defines
//   vec3 diffracted_xyz(GrooveView view);
// of a view above the horizon.
MaterialTerms material_terms() {
    GrooveView view = groove_view();
    vec3 xyz = vec3(0.0);
    if (view.direction.z > 0.0 && view.pitch > 0.0) {
        xyz = diffracted_xyz(view);
#ifdef HAS_DIRECT
        xyz += direct_xyz(view);
#endif
    }
    return MaterialTerms(base_weight, mirror_weight, mat3(xyz_to_working) * xyz);
}
