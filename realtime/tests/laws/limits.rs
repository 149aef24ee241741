//! A plan for an adapter is decided as a rendering decides, by the same limits.

use crate::*;
use realtime::{Error, Timing};

#[test]
fn a_plan_for_an_adapter_is_that_of_what_runs() {
    let scene = scenes::builtin("teapot").unwrap();
    let layers = [LayerName::Radiance, LayerName::Exit, LayerName::Flags];
    for (method, peel) in [
        ("multi", "slots"),
        ("multi", "everitt"),
        ("multi-paper", "dual"),
        ("multi", "auto"),
        ("two-interface", ""),
    ] {
        let mut request = request(&scene, method, &layers);
        if !peel.is_empty() {
            request = with(request, &[("peel", peel)]);
        }
        request.view.resolution_px = [40, 24];
        request.view.positions_per_axis = 2;
        let timing = Timing {
            warm_up: 0,
            seconds: 0.0,
            min_frames: 1,
            max_frames: 1,
            positions_per_axis: 1,
        };
        request.timing = Some(timing);
        let plan = realtime::plan_on(&GPU, &scene, &request).unwrap();
        let rendering = realtime::render(&GPU, &scene, &request).unwrap();
        assert_eq!(plan, rendering.plan, "{method} {peel}");
        assert_eq!(plan.bytes(), rendering.counters["bytes"], "{method} {peel}");
        // Frames are drawn one after the other, and the largest decides.
        let layers = 8 * 40 * 24 * (3 + 3 + 1);
        let at_once = plan.peak_bytes - layers;
        assert!(at_once < plan.bytes() + (16 << 20) && 2 * at_once > plan.bytes(), "{at_once}");
        let general = realtime::plan(&scene, &request).unwrap();
        assert_eq!(general == plan, method == "two-interface", "layers are counted");
    }
}

/// One number more per pixel that is handed over: 8 bytes more at the peak.
#[test]
fn the_peak_counts_what_is_handed_over() {
    let scene = scene_of(Shape::Sphere { radius_m: 0.7 }, 1.5, parallel(2.1, [32, 16]));
    let peak = |layers: &[LayerName]| {
        realtime::plan_on(&GPU, &scene, &request(&scene, "blended", layers)).unwrap().peak_bytes
    };
    let [light, covered] =
        [peak(&[LayerName::Radiance]), peak(&[LayerName::Radiance, LayerName::Coverage])];
    assert_eq!(covered, light + 8 * 32 * 16);
}

#[test]
fn what_no_adapter_allows_is_refused_by_plans_and_renderings_alike() {
    let scene = scene_of(Shape::Sphere { radius_m: 0.7 }, 1.5, parallel(2.1, [32, 32]));
    let mut request = request(&scene, "multi", &[LayerName::Radiance]);
    assert!(realtime::plan_on(&GPU, &scene, &request).is_ok());
    request.view.resolution_px = [32_768; 2];
    let planned = realtime::plan_on(&GPU, &scene, &request).unwrap_err();
    let rendered = realtime::render(&GPU, &scene, &request).unwrap_err();
    assert!(matches!(planned, Error::Limit { .. }), "{planned}");
    assert_eq!(planned.to_string(), rendered.to_string());
    for part in ["fewer pixels", GPU.info().name.as_str()] {
        assert!(planned.to_string().contains(part), "{planned}");
    }
}
