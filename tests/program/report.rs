//! A report of a small made-up study.
#![allow(clippy::unwrap_used, reason = "a test may stop at the first failure")]

mod made_up_study;

use compare::report::{self, Report};
use compare::results::write_rows;
use made_up_study::study;
use std::path::Path;

fn page(name: &str) -> (Report, String) {
    let directory = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    study(&directory);
    let report = report::write(&directory, report::Options::default()).unwrap();
    let html = std::fs::read_to_string(&report.html).unwrap();
    (report, html)
}

#[test]
fn a_page_holds_tables_plots_and_pictures_and_needs_no_network() {
    let (report, html) = page("whole-report");
    assert_eq!(html.matches("class=\"plot\"><svg").count(), 6, "three plots per scene");
    assert!(html.matches("src=\"data:image/png;base64,").count() >= 12);
    for address in ["http://", "https://", "src=\"/", "@import"] {
        let foreign = html.replace("http://www.w3.org/2000/svg", "");
        assert!(!foreign.contains(address), "the page refers to {address}");
    }
    assert!(html.contains("one-interface sends light in the best direction in 2 of 2 scenes"));
    assert!(html.contains("bunny.obj is not in target/assets"));
    assert!(html.contains("back normals") && html.contains("512 KiB"));
    let picture = |name: &str| {
        let path = report.html.with_file_name("pictures").join(name);
        std::fs::read(path).unwrap()
    };
    assert_eq!(
        picture("ball-one-interface-flip.png"),
        picture("a____script_alert_1___script_-one-interface-flip.png"),
        "a stored FLIP map and a computed one differ"
    );
    for path in &report.pictures {
        let bytes = std::fs::read(path).unwrap();
        assert!(bytes.len() > 100, "{}", path.display());
        let is_plot = path.extension().is_some_and(|end| end == "svg");
        assert!(!is_plot || !String::from_utf8(bytes).unwrap().contains("var("), "{path:?}");
    }
}

#[test]
fn text_of_scenes_and_adapters_is_never_markup() {
    let (report, html) = page("hostile-report");
    assert!(!html.contains("<script>alert"), "a scene's name became a script");
    assert!(!html.contains("</pre><b>"), "a scene file became markup");
    assert!(html.contains("&#60;script&#62;alert(1)") || html.contains("&lt;script&gt;alert(1)"));
    let markdown = std::fs::read_to_string(report.markdown).unwrap();
    assert!(markdown.contains("| a \\| &lt;script&gt;"), "{markdown}");
    let columns = |line: &str| line.replace("\\|", "").matches('|').count();
    let mut table = markdown.lines().filter(|line| line.starts_with('|')).map(columns);
    let first = table.next().unwrap();
    assert!(table.all(|count| count == first), "{markdown}");
}

#[test]
fn the_spreadsheet_has_a_line_per_row() {
    let (report, _) = page("spreadsheet-report");
    let rows = compare::results::read_rows(report.csv.parent().unwrap()).unwrap();
    let text = std::fs::read_to_string(report.csv).unwrap();
    assert_eq!(text.lines().count(), rows.len() + 1);
    assert!(text.starts_with("schema,kind,id,scene,method,"));
}

/// A results directory without its study says which file is missing.
#[test]
fn an_incomplete_directory_is_refused_by_name() {
    let directory = tempfile::tempdir().unwrap();
    let error =
        report::write(directory.path(), report::Options::default()).unwrap_err().to_string();
    assert!(error.contains("results.jsonl"), "{error}");
    write_rows(directory.path(), &[]).unwrap();
    let error =
        report::write(directory.path(), report::Options::default()).unwrap_err().to_string();
    assert!(error.contains("study.json"), "{error}");
}
