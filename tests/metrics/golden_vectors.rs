//! Our metrics against values that other people's tools gave for the same
//! bytes: numpy, scikit-image, FLIP 1.7 and PU21 (`data/vectors`).
#![allow(clippy::unwrap_used, reason = "a test that cannot read its vectors must fail")]

use compare::metric::{
    Candidate, Exposures, Judgement, Metric, Reference, Selection, display, error, exit_angle,
    flip, judge, pu21, relative, ssim, stack,
};
use compare::results::Validity;
use compare::support::sum;
use scenes::image::{Alpha, Picture as Image, open};
use scenes::{LayerName, Layers};
use serde_json::Value;
use sha2::{Digest, Sha256};
use std::path::{Path, PathBuf};

fn path(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("data/vectors").join(name)
}

fn expected() -> Value {
    serde_json::from_str(&std::fs::read_to_string(path("expected.json")).unwrap()).unwrap()
}

fn read(name: &str) -> Image {
    open(&path(name), Alpha::default()).unwrap()
}

fn colours(image: &Image) -> &[f64] {
    &image.layers.get(&LayerName::Radiance).unwrap().data
}

fn size(image: &Image) -> [usize; 2] {
    image.layers.resolution_px.map(|side| side as usize)
}

/// Reads both images of a pair and checks that their pixels are the ones
/// that the other tools saw.
fn pair(value: &Value) -> [Image; 2] {
    ["ref", "test"].map(|side| {
        let image = read(value[side].as_str().unwrap());
        let bytes: Vec<u8> = if value["kind"] == "hdr" {
            colours(&image).iter().flat_map(|&v| (v as f32).to_le_bytes()).collect()
        } else {
            colours(&image).iter().map(|&v| (v * 255.0).round() as u8).collect()
        };
        let digest = Sha256::digest(&bytes);
        let hash: String = digest.iter().map(|byte| format!("{byte:02x}")).collect();
        assert_eq!(hash, value[format!("sha256_{side}")], "{} is not the same image", value[side]);
        image
    })
}

fn pairs(kind: &str) -> Vec<(String, Value, [Image; 2])> {
    let expected = expected();
    let all = expected["pairs"].as_object().unwrap();
    let chosen: Vec<_> = all
        .iter()
        .filter(|(_, value)| value["kind"] == kind)
        .map(|(name, value)| (name.clone(), value["expected"].clone(), pair(value)))
        .collect();
    assert_eq!(chosen.len(), 3);
    chosen
}

/// Relative agreement of two numbers, absolute below 1.
#[track_caller]
fn close(what: &str, ours: f64, theirs: &Value, tolerance: f64) {
    let theirs = theirs.as_f64().unwrap_or_else(|| panic!("{what}: no expected value"));
    let bound = tolerance * theirs.abs().max(1e-3);
    assert!((ours - theirs).abs() <= bound, "{what}: ours {ours}, theirs {theirs}");
}

#[track_caller]
fn within(what: &str, ours: f64, theirs: &Value, bound: f64) {
    let theirs = theirs.as_f64().unwrap_or_else(|| panic!("{what}: no expected value"));
    assert!((ours - theirs).abs() <= bound, "{what}: ours {ours}, theirs {theirs}");
}

#[test]
fn plain_and_relative_errors_equal_numpy_to_1e_12() {
    for kind in ["hdr", "ldr"] {
        for (name, expected, [reference, candidate]) in pairs(kind) {
            let (r, t) = (colours(&reference), colours(&candidate));
            let simple = &expected["simple"];
            let check = |metric: &str, ours: f64| {
                close(&format!("{name} {metric}"), ours, &simple[metric], 1e-12);
            };
            check("bias", error::bias(r, t));
            check("mae", error::mae(r, t));
            check("mse", error::mse(r, t));
            check("rmse", error::rmse(r, t));
            check("max_abs", error::max_abs(r, t));
            check("mape_1e-2", relative::mape(r, t, 1e-2));
            check("smape_1e-2", relative::smape(r, t, 1e-2));
            check("relmse_1e-2", relative::relmse(r, t, 1e-2));
            check("relmse_1e-3", relative::relmse(r, t, 1e-3));
            check("relmse_1e-4", relative::relmse(r, t, 1e-4));
            check("relmse_1e-2_trim_0.1pct", relative::relmse_trimmed(r, t, 1e-2, 0.001));
            check("relmse_1e-2_trim_1pct", relative::relmse_trimmed(r, t, 1e-2, 0.01));
            let mut map = relative::relmse_map(r, t, 1e-2);
            map.sort_unstable_by(f64::total_cmp);
            check("relmse_1e-2_p99_pixel", sum::quantile(&map, 0.99).unwrap());
            check("relmse_1e-2_median_pixel", sum::quantile(&map, 0.5).unwrap());
            for (channel, metric) in ["mse_r", "mse_g", "mse_b"].into_iter().enumerate() {
                let one =
                    |v: &[f64]| v.iter().skip(channel).step_by(3).copied().collect::<Vec<_>>();
                check(metric, error::mse(&one(r), &one(t)));
            }
        }
    }
}

/// The sides of a comparison matter: swapped, the same check must fail.
#[test]
fn swapped_sides_do_not_pass_for_the_reference() {
    for (name, expected, [reference, candidate]) in pairs("hdr") {
        let (r, t) = (colours(&reference), colours(&candidate));
        for (metric, swapped) in [
            ("bias", error::bias(t, r)),
            ("relmse_1e-2", relative::relmse(t, r, 1e-2)),
            ("mape_1e-2", relative::mape(t, r, 1e-2)),
        ] {
            let theirs = expected["simple"][metric].as_f64().unwrap();
            assert!((swapped - theirs).abs() > 1e-3 * theirs.abs(), "{name} {metric}");
        }
    }
}

#[test]
fn psnr_and_ssim_equal_scikit_image() {
    for (name, expected, [reference, candidate]) in pairs("ldr") {
        let codes = |image: &Image| -> Vec<f64> {
            colours(image).iter().map(|v| (v * 255.0).round()).collect()
        };
        let (r, t) = (codes(&reference), codes(&candidate));
        let psnr = display::psnr_db(&r, &t, 255.0).unwrap();
        close(&format!("{name} psnr"), psnr, &expected["psnr_255"], 1e-12);
        let mut total = 0.0;
        for channel in 0..3 {
            let one = |v: &[f64]| v.iter().skip(channel).step_by(3).copied().collect::<Vec<_>>();
            let map = ssim::ssim_map(&one(&r), &one(&t), size(&reference), 255.0).unwrap();
            total += sum::mean(map.into_iter()) / 3.0;
        }
        within(&format!("{name} ssim"), total, &expected["ssim_wang"], 1e-7);
        // Negative control: the 7x7 box that some tools call SSIM is another number.
        assert!((total - expected["ssim_uniform7"].as_f64().unwrap()).abs() > 1e-3);

        // The same values come out of the judgement, on code values / 255.
        let judgement = judged(&reference, &candidate);
        within("psnr", value(&judgement, "psnr"), &expected["psnr_255"], 1e-9);
        within("ssim", value(&judgement, "ssim"), &expected["ssim_wang"], 1e-7);
    }
}

fn judged(reference: &Image, candidate: &Image) -> Judgement {
    let selection = Selection::all(reference.encoding);
    judge(Reference(&reference.layers), Candidate(&candidate.layers), &selection).unwrap()
}

#[track_caller]
fn value(judgement: &Judgement, metric: &str) -> f64 {
    let found = judgement.measurements.iter().find(|m| m.metric == metric);
    found.unwrap_or_else(|| panic!("no {metric}")).value.unwrap()
}

#[test]
fn pu21_equals_its_published_encoding() {
    for (luminance, theirs) in expected()["pu21_encode_table"].as_object().unwrap() {
        within(luminance, pu21::encode(luminance.parse().unwrap()), theirs, 1e-8);
    }
    for (name, expected, [reference, candidate]) in pairs("hdr") {
        let psnr = pu21::pu21_psnr_db(colours(&reference), colours(&candidate), 100.0).unwrap();
        close(&name, psnr, &expected["pu21_psnr_x100"], 1e-10);
    }
}

/// Values of a `.npy` file of 32-bit floats.
fn npy(name: &str) -> Vec<f64> {
    let bytes = std::fs::read(path(name)).unwrap();
    let header = usize::from(u16::from_le_bytes([bytes[8], bytes[9]]));
    assert!(String::from_utf8_lossy(&bytes[10..10 + header]).contains("<f4"));
    let values = bytes[10 + header..].chunks_exact(4);
    values.map(|v| f64::from(f32::from_le_bytes(v.try_into().unwrap()))).collect()
}

#[test]
fn flip_equals_flip_1_7_pixel_by_pixel() {
    for (name, expected, [reference, candidate]) in pairs("hdr") {
        let exposures = |setting: &str| Exposures {
            start: expected[setting]["start_exposure"].as_f64().unwrap(),
            stop: expected[setting]["stop_exposure"].as_f64().unwrap(),
            count: expected[setting]["num_exposures"].as_u64().unwrap() as usize,
        };
        let map = |e| {
            let (r, t) = (colours(&reference), colours(&candidate));
            flip::hdr_flip_map(r, t, size(&reference), e).unwrap()
        };
        let found = map(exposures("flip_hdr"));
        let theirs = npy(&format!("flip_maps/{name}_hdr.npy"));
        assert_eq!(found.len(), theirs.len());
        let worst = error::max_abs(&theirs, &found);
        assert!(worst <= 1e-4, "{name}: a pixel differs by {worst}");
        let mean = |map: &[f64]| sum::mean(map.iter().copied());
        within(&name, mean(&found), &expected["flip_hdr"]["mean"], 1e-5);
        let fixed = map(exposures("flip_hdr_fixed"));
        within(&name, mean(&fixed), &expected["flip_hdr_fixed"]["mean"], 1e-5);
        // Negative control: other exposures are another metric.
        assert!((mean(&fixed) - mean(&found)).abs() > 1e-4, "{name}");
    }
    for (name, expected, [reference, candidate]) in pairs("ldr") {
        let map = |ppd| {
            let (r, t) = (colours(&reference), colours(&candidate));
            flip::ldr_flip_map(r, t, size(&reference), ppd).unwrap()
        };
        let found = map(flip::PIXELS_PER_DEGREE);
        let worst = error::max_abs(&npy(&format!("flip_maps/{name}_ldr.npy")), &found);
        assert!(worst <= 1e-4, "{name}: a pixel differs by {worst}");
        for (setting, ppd) in [
            ("flip_ldr", flip::PIXELS_PER_DEGREE),
            ("flip_ldr_ppd30", 30.0),
            ("flip_ldr_ppd120", 120.0),
        ] {
            let mean = sum::mean(map(ppd).into_iter());
            within(&format!("{name} {setting}"), mean, &expected[setting]["mean"], 1e-5);
        }
        within(
            &name,
            value(&judged(&reference, &candidate), "flip_ldr"),
            &expected["flip_ldr"]["mean"],
            1e-5,
        );
    }
}

fn degenerate(case: &str) -> [Image; 2] {
    ["ref", "test"].map(|side| read(&format!("degenerate/{case}_{side}.exr")))
}

#[test]
fn a_candidate_with_nan_or_infinity_has_no_number() {
    for case in ["nan_in_test", "inf_in_test", "neginf_in_test"] {
        let [reference, candidate] = degenerate(case);
        let judgement = judged(&reference, &candidate);
        assert!(judgement.measurements.len() > 10);
        for found in &judgement.measurements {
            assert_eq!((found.status, found.value), (Validity::Invalid, None), "{case} {found:?}");
            assert!(found.reason.contains("3 of 2304 values are NaN or infinite"), "{found:?}");
            assert!(found.reason.contains("pixel (7, 5)"), "{found:?}");
        }
    }
}

#[test]
fn a_reference_with_nan_or_infinity_is_refused() {
    for case in ["nan_in_ref", "inf_in_ref"] {
        let [reference, candidate] = degenerate(case);
        let selection = Selection::all(reference.encoding);
        let refused = judge(Reference(&reference.layers), Candidate(&candidate.layers), &selection);
        assert!(refused.unwrap_err().to_string().contains("the reference is not usable"), "{case}");
    }
}

#[test]
fn equal_images_are_not_computed_and_have_no_infinite_psnr() {
    for case in ["identical", "black_both"] {
        let [reference, candidate] = degenerate(case);
        for found in judged(&reference, &candidate).measurements {
            assert_eq!(found.status, Validity::Identical, "{case} {found:?}");
            let expected = match found.metric.as_str() {
                "ssim_reinhard_srgb8" => Some(1.0),
                "psnr_reinhard_srgb8" | "pu21_psnr_x100" => None,
                _ => Some(0.0),
            };
            assert_eq!(found.value, expected, "{case} {}", found.metric);
        }
    }
}

#[test]
fn a_black_reference_has_flip_only_at_pinned_exposures() {
    let [reference, candidate] = degenerate("black_ref");
    let judgement = judged(&reference, &candidate);
    let flip = judgement.measurements.iter().find(|m| m.metric == "flip_hdr").unwrap();
    assert_eq!((flip.status, flip.value), (Validity::Undefined, None));
    close("relmse", value(&judgement, "relmse_e1e-2"), &Value::from(27.996902633458376), 1e-12);

    let exposures = Some(Exposures { start: -2.0, stop: 2.0, count: 5 });
    let selection = Selection { flip_exposures: exposures, ..Selection::all(reference.encoding) };
    let pinned =
        judge(Reference(&reference.layers), Candidate(&candidate.layers), &selection).unwrap();
    assert!(value(&pinned, "flip_hdr") > 0.0);
}

#[test]
fn negative_huge_and_tiny_images_have_the_values_numpy_gives_them() {
    let expected = expected();
    for case in ["negative_in_test", "negative_in_ref", "huge_in_test", "one_pixel", "tiny_5x5"] {
        let [reference, candidate] = degenerate(case);
        let judgement = judged(&reference, &candidate);
        let values = &expected["degenerate"][case];
        close(case, value(&judgement, "mse"), &values["numpy_mse"], 1e-12);
        close(case, value(&judgement, "relmse_e1e-2"), &values["numpy_relmse_1e-2"], 1e-12);
        let ssim = judgement.measurements.iter().find(|m| m.metric.starts_with("ssim")).unwrap();
        let too_small = case == "one_pixel" || case == "tiny_5x5";
        assert_eq!(
            ssim.status,
            if too_small { Validity::Undefined } else { Validity::Ok },
            "{case}"
        );
    }
}

#[test]
fn a_noisy_reference_is_corrected_as_numpy_does_and_covers_the_truth() {
    let expected = &expected()["mc_stack"];
    let method = read("mc_stack/method.exr");
    let truth = read("mc_stack/truth.exr");
    let images: Vec<Image> = (0..16).map(|k| read(&format!("mc_stack/ref_{k:02}.exr"))).collect();
    let batches: Vec<&[f64]> = images.iter().map(colours).collect();
    let found = stack::corrected_mse(&batches, colours(&method), None).unwrap();
    close("raw", found.raw, &expected["mse_raw"], 1e-9);
    close("corrected", found.corrected, &expected["mse_corrected"], 1e-9);
    close("noise", found.noise, &expected["reference_noise_mse_estimated"], 1e-9);
    let se = &expected["jackknife_se_of_mse_corrected"];
    close("standard error", found.standard_error, se, 1e-9);
    let exact = error::mse(colours(&truth), colours(&method));
    close("truth", exact, &expected["mse_true"], 1e-9);
    assert!(found.interval.0 < exact && exact < found.interval.1, "{found:?} misses {exact}");
    // Negative control: the uncorrected value lies far outside.
    assert!(found.raw > found.interval.1);
    let (first, second) = batches.split_at(8);
    let halves = [stack::mean_image(first), stack::mean_image(second)];
    let dual = stack::dual_mse(&halves[0], &halves[1], colours(&method));
    close("dual", dual, &expected["mse_dual_buffer"], 1e-9);
}

/// Two candidates against the same noisy reference: the difference of their
/// errors is known far better than either error.
#[test]
fn a_paired_difference_holds_the_truth_in_a_narrow_interval() {
    let method = read("mc_stack/method.exr");
    let truth = read("mc_stack/truth.exr");
    let images: Vec<Image> = (0..16).map(|k| read(&format!("mc_stack/ref_{k:02}.exr"))).collect();
    let batches: Vec<&[f64]> = images.iter().map(colours).collect();
    let (base, truth) = (colours(&method), colours(&truth));
    let head: Vec<f64> = base.iter().map(|value| 1.01 * value).collect();
    let found = stack::paired_difference(&batches, &head, base, None).unwrap();
    let exact = error::mse(truth, &head) - error::mse(truth, base);
    assert!(found.interval.0 < exact && exact < found.interval.1, "{found:?} misses {exact}");
    let apart = stack::corrected_mse(&batches, base, None).unwrap().standard_error;
    assert!(found.standard_error < apart / 2.0, "{found:?} is no better than {apart}");
    // Negative control: equal images do not differ, and the other sign is refused.
    let none = stack::paired_difference(&batches, base, base, None).unwrap();
    assert_eq!((none.value, none.standard_error), (0.0, 0.0));
    let swapped = stack::paired_difference(&batches, base, &head, None).unwrap();
    assert_eq!(swapped.value, -found.value);
}

/// A mean with its variance says the same as the batches it is made of.
#[test]
fn a_variance_layer_corrects_as_the_batches_do() {
    let expected = &expected()["mc_stack"];
    let method = read("mc_stack/method.exr");
    let images: Vec<Image> = (0..16).map(|k| read(&format!("mc_stack/ref_{k:02}.exr"))).collect();
    let batches: Vec<&[f64]> = images.iter().map(colours).collect();
    let mean = stack::mean_image(&batches);
    let variance: Vec<f64> = (0..mean.len())
        .map(|i| batches.iter().map(|b| (b[i] - mean[i]).powi(2)).sum::<f64>() / 15.0 / 16.0)
        .collect();
    let mut layers = Layers::new(method.layers.resolution_px);
    layers.push(LayerName::Radiance, 3, mean);
    layers.push(LayerName::Variance, 3, variance);
    let selection = Selection::all(method.encoding);
    let judgement = judge(Reference(&layers), Candidate(&method.layers), &selection).unwrap();
    let found = judgement.measurements.iter().find(|m| m.metric == "mse_corrected").unwrap();
    close("corrected", found.value.unwrap(), &expected["mse_corrected"], 1e-9);
    let (low, high) = found.interval.unwrap();
    let exact = expected["mse_true"].as_f64().unwrap();
    assert!(low < exact && exact < high, "{low} to {high} misses {exact}");
    // Not so wide that it would hold anything: the raw value is outside.
    assert!(expected["mse_raw"].as_f64().unwrap() > high);
    let jackknife = expected["jackknife_se_of_mse_corrected"].as_f64().unwrap();
    let ours = (high - low) / 2.0 / 1.96;
    assert!((0.5..2.5).contains(&(ours / jackknife)), "{ours} against {jackknife}");
}

/// A layer that one side lacks leaves its metrics out, with the reason.
#[test]
fn without_exit_layers_there_is_no_angle_and_with_them_there_is() {
    let image = |exit: Option<[f64; 3]>| {
        let mut layers = Layers::new([2, 1]);
        layers.push(LayerName::Radiance, 3, vec![exit.map_or(0.5, |v| v[0]); 6]);
        if let Some(exit) = exit {
            layers.push(LayerName::Exit, 3, [exit, [0.0; 3]].concat());
        }
        layers
    };
    let angle = 2.0f64.to_radians();
    let (bare, straight) = (image(None), image(Some([0.0, 0.0, 1.0])));
    let bent = image(Some([angle.sin(), 0.0, angle.cos()]));
    let selection = Selection::all(compare::metric::Encoding::Linear);
    let without = judge(Reference(&straight), Candidate(&bare), &selection).unwrap();
    assert!(without.measurements.iter().all(|m| !m.metric.starts_with("exit")));
    let reasons: Vec<_> = without.left_out.iter().map(|l| (&*l.what, &*l.reason)).collect();
    assert!(reasons.contains(&("exit_angle_median_deg", "no exit layer on both sides")));

    let with = judge(Reference(&straight), Candidate(&bent), &selection).unwrap();
    assert!((value(&with, "exit_angle_median_deg") - 2.0).abs() < 1e-12);
    assert_eq!(value(&with, "exit_angle_within_1deg"), 0.0);
    assert_eq!(with.measurements.iter().find(|m| m.metric == "exit_angle_mean_deg").unwrap().n, 1);
    assert!(exit_angle::summarise([]).is_none());
}

#[test]
fn every_metric_is_described_and_found_by_its_name() {
    for metric in Metric::ALL {
        let description = metric.describe();
        assert_eq!(Metric::named(description.name), Some(metric));
        assert!(!description.formula.is_empty() && !description.source.is_empty());
    }
    assert_eq!(Metric::named("relmse"), None, "no relMSE without its constant");
}
