//! Every built-in scene with every method: what ran is what was planned, and the
//! image is the same when nothing is left out.

use crate::leaving_out::differing;
use crate::plans::kept;
use crate::*;
use realtime::{METHODS, Timing};

#[test]
fn every_method_executes_its_plan_and_leaving_out_changes_no_image() {
    let mut pairs = 0;
    for builtin in scenes::builtins() {
        let Ok(mut scene) = builtin.load() else {
            assert!(builtin.missing().is_some(), "{} cannot be read", builtin.name);
            continue;
        };
        scene.camera.resolution_px = [48, 32];
        for method in METHODS.iter() {
            let layers = [LayerName::Radiance, LayerName::Exit, LayerName::Flags];
            let mut lean = request(&scene, method.id, &layers);
            lean.timing = Some(Timing {
                warm_up: 0,
                seconds: 0.0,
                min_frames: 1,
                max_frames: 1,
                positions_per_axis: 1,
            });
            let full = Request { keep: Keep::Everything, ..lean.clone() };
            let [lean, full] = [lean, full].map(|request| {
                let plan = realtime::plan(&scene, &request).unwrap();
                let rendering = realtime::render(&GPU, &scene, &request).unwrap();
                let what = (builtin.name, method.id, request.keep);
                assert!(kept(&plan, &rendering), "{what:?}: {:?}", plan.passes);
                rendering
            });
            let share = differing(&lean, &full);
            assert!(share <= 1e-4, "{} {}: {share}", builtin.name, method.id);
            assert!(lean.plan.bytes() <= full.plan.bytes(), "{} {}", builtin.name, method.id);
            pairs += 1;
        }
    }
    assert!(pairs >= 20 * METHODS.len(), "{pairs}");
}
