//! What has to change for one more method or metric, counted in files. The
//! guide to the architecture states these numbers.
#![allow(clippy::unwrap_used, reason = "a test that cannot read the sources must fail")]

mod sources;

use sources::Crate;
use std::collections::BTreeSet;

/// Modules of a crate whose code, not its comments or tests, says a word.
fn modules_that_say(krate: &str, word: &str) -> BTreeSet<String> {
    let modules = Crate::read(&snell_tests::root().join(krate).join("src"));
    modules.that_say(word).map(|module| format!("{krate}/{}", module.join("/"))).collect()
}

/// A metric is a row of what it is and a line of how it is computed: two files,
/// and a third where its formula is new.
#[test]
fn a_metric_is_named_in_two_files() {
    let own = ["compare/metric/describe", "compare/metric/pair"].map(str::to_owned);
    for metric in ["MaxAbs", "Smape", "PsnrToneMapped", "ExitUnmatched"] {
        assert!(compare::metric::Metric::ALL.iter().any(|m| format!("{m:?}") == metric));
        assert_eq!(modules_that_say("compare", metric), own.clone().into(), "{metric}");
    }
    // The search finds more where there is more: this one heads the report.
    let headline = modules_that_say("compare", "ExitAngleMedian");
    assert!(headline.contains("compare/report/runs") && headline.len() > 2, "{headline:?}");
}

/// A built-in method is a file of WGSL and a row of the registry. Only what lists
/// and composes shaders may name it once more; no pass, no plan, no report asks
/// a method for its name.
#[test]
fn a_method_is_named_where_methods_are_listed_and_composed_only() {
    let may = ["realtime/methods/registry", "realtime/wgsl/", "realtime/composition/"];
    for method in realtime::METHODS.iter() {
        let word = format!("\"{}\"", method.id);
        let mut found = BTreeSet::new();
        for krate in ["scenes", "reference", "realtime", "compare"] {
            found.extend(modules_that_say(krate, &word));
        }
        assert!(found.contains(may[0]), "{word} is not found where it is: {found:?}");
        found.retain(|module| !may.iter().any(|place| module.starts_with(place)));
        assert_eq!(found, BTreeSet::new(), "{word}");
    }
}
