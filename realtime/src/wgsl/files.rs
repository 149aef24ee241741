//! Every file of WGSL in this crate, by its name. A name is unique, whatever
//! folder it is in.

/// A file: its name without the ending, and its text.
pub(crate) type File = (&'static str, &'static str);

macro_rules! files {
    ($($folder:literal: $($name:literal)*;)*) => {
        &[$($((
            $name,
            include_str!(concat!(
                env!("CARGO_MANIFEST_DIR"), "/src/shaders/", $folder, "/", $name, ".wgsl"
            )),
        ),)*)*]
    };
}

/// All of them.
#[rustfmt::skip]
pub(crate) static FILES: &[File] = files! {
    "core": "camera_orthographic" "camera_perspective" "cube" "frame" "interface" "noise";
    "environment": "environment_manual" "environment_sampler" "environment_uniform";
    "inside": "air" "air_none" "air_shown" "clip_analytic" "clip_depth" "clip_layers"
        "clip_none" "clip_targets" "cracks" "cracks_none" "cracks_onto_normals" "cracks_shown"
        "interior" "interior_lookup" "interval_of_clip" "interval_of_frame";
    "layers": "layers" "march" "media_nested" "media_single" "pack_nested" "pack_single"
        "peel_camera_fitted" "peel_camera_screen";
    "layers/peel": "peel_cascade" "peel_cascade_unpack" "peel_count" "peel_dual"
        "peel_dual_close" "peel_dual_keep" "peel_everitt" "peel_everitt_keep" "peel_packed"
        "peel_slots" "peel_sort" "stored_targets";
    "methods": "anything" "blended" "dx7" "dx7_formula" "dx7_vertex" "interpolated" "multi"
        "multi_paper" "normal_cube" "one_interface" "one_interface_vertex" "two_interface"
        "undeviated" "vertex_dx7" "vertex_eye" "vertex_none" "vertex_snell";
    "methods/words": "a_direct" "a_inverse" "a_nonzero" "a_zero" "back_format_32_bit"
        "back_format_8_bit" "back_normal_inward" "back_normal_outward" "depth_format_16_bit"
        "depth_format_float" "depth_planes_default" "depth_planes_fitted" "distance_normal"
        "distance_view" "distance_weighted" "eye_fragment" "eye_vertex" "fresnel_eq4"
        "fresnel_exact" "fresnel_none" "fresnel_schlick" "index_ball" "index_own"
        "lookup_direction" "lookup_position" "n2_filter_bilinear" "n2_filter_nearest"
        "normal_flip" "normal_normalised" "normal_raw" "tir_clamp" "tir_reflect";
    "raster": "analytic_targets" "bump" "bump_none" "intersect_box" "intersect_cylinder"
        "intersect_half_space" "intersect_sphere" "raster_analytic" "raster_mesh" "sky"
        "varyings";
    "shade": "absorb" "absorb_none" "colours_apart" "colours_together" "eta_dispersed"
        "eta_single" "first_event" "reflect" "reflect_nothing" "shade" "shade_background"
        "trace";
    "shade/outputs": "no_count" "no_exit" "no_first" "no_hit2" "no_radiance" "out_count"
        "out_exit" "out_first" "out_hit2" "out_radiance";
    "surfaces": "back" "back_analytic" "back_targets" "background_analytic" "background_drawn"
        "background_sky" "background_targets" "face_analytic" "face_targets" "front"
        "front_analytic" "front_targets" "geometric_same" "geometric_stored"
        "normal_face_analytic" "normal_face_targets" "opaque" "sky_behind_background"
        "sky_behind_face";
};
