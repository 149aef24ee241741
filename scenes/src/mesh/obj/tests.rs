#![allow(clippy::unwrap_used, reason = "files that the tests write")]

use super::*;
use crate::Mesh;
use crate::generate::{builtin, geodesic};
use crate::topology::inspect;
use glam::DVec3;

fn model(text: &str) -> Result<Model, ObjError> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("model.obj");
    std::fs::write(&path, text).unwrap();
    read(&path)
}

fn read_text(text: &str) -> Result<Mesh, ObjError> {
    model(text).map(|model| model.mesh)
}

fn message(text: &str) -> String {
    read_text(text).unwrap_err().to_string()
}

const TRIANGLE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

#[test]
fn what_is_written_is_read_back_to_the_bit() {
    for mesh in [builtin("cup").unwrap(), geodesic(3)] {
        let mut text = Vec::new();
        write(&mesh, &mut text).unwrap();
        let back = read_text(std::str::from_utf8(&text).unwrap()).unwrap();
        assert!(inspect(&back).is_manifold());
        for index in 0..mesh.triangles.len() {
            assert_eq!(mesh.corners(index), back.corners(index));
        }
        assert_eq!(mesh.normals.is_some(), back.normals.is_some());
        let Some((ours, theirs)) = mesh.normals.as_ref().zip(back.normals.as_ref()) else {
            continue;
        };
        for (one, other) in ours.indices.iter().zip(&theirs.indices) {
            for (i, j) in one.iter().zip(other) {
                assert!(ours.values[*i as usize].distance(theirs.values[*j as usize]) < 1e-15);
            }
        }
    }
}

#[test]
fn polygons_groups_and_repeated_positions_become_one_closed_mesh() {
    let text = "\
# a cube of quads, each side with its own vertices, relative indices, groups
o one
v 0 0 0\nv 0 1 0\nv 1 1 0\nv 1 0 0\nf -4 -3 -2 -1
v 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\nf -4 -3 -2 -1
g two
v 0 0 0\nv 1 0 0\nv 1 0 1\nv 0 0 1\nf -4 -3 -2 -1
v 0 1 0\nv 0 1 1\nv 1 1 1\nv 1 1 0\nf -4 -3 -2 -1
usemtl missing
v 0 0 0\nv 0 0 1\nv 0 1 1\nv 0 1 0\nf -4 -3 -2 -1
v 1 0 0\nv 1 1 0\nv 1 1 1\nv 1 0 1\nf -4 -3 -2 -1
";
    let mesh = read_text(text).unwrap();
    assert_eq!((mesh.positions.len(), mesh.triangles.len()), (8, 12));
    let report = inspect(&mesh);
    assert!(report.is_manifold());
    assert!((report.signed_volume_m3 - 1.0).abs() < 1e-15);
}

#[test]
fn bad_files_are_refused_with_line_and_advice() {
    let missing = message(&format!("{TRIANGLE}f 1 2 4\n"));
    assert!(missing.contains("model.obj:4:") && missing.contains("index 4"), "{missing}");
    assert!(message(&format!("{TRIANGLE}f 1 2 0\n")).contains("index 0"));
    assert!(message(&format!("{TRIANGLE}f 1 2 -4\n")).contains("index -4"));
    assert!(message(&format!("{TRIANGLE}f 1//1 2//1 3//1\n")).contains("0 normals"));
    assert!(message(&format!("{TRIANGLE}f 1 2 three\n")).contains("v//vn"));
    assert!(message(&format!("{TRIANGLE}f /1 2 3\n")).contains("v//vn"));
    let nan = message("v 0 0 0\nv 1 nan 0\nv 0 1 0\nf 1 2 3\n");
    assert!(nan.contains(":2:") && nan.contains("not finite"), "{nan}");
    assert!(message("v 0 0 1e999\nf 1 1 1\n").contains("not finite"));
    assert!(message("v 0 zero 0\n").contains("\"zero\" is not a number"));
    assert!(message("v 0 0\n").contains("2 numbers"));
    assert!(message("").contains("no faces"));
    assert!(message(TRIANGLE).contains("no faces"));
    let absent = read(Path::new("/nowhere/model.obj")).unwrap_err().to_string();
    assert!(absent.starts_with("/nowhere/model.obj: "), "{absent}");
}

/// Bytes that are no text must not panic.
#[test]
fn arbitrary_bytes_are_refused() {
    assert!(model::parse(&[0xff, 0xfe, b'f', b' ', 0x80, b'\n']).is_err());
    assert!(model::parse(b"f\nf 1\n").is_err());
}

/// A cube of quads.
const CUBE: &str = "\
v -1 -1 1\nv 1 -1 1\nv -1 1 1\nv 1 1 1\nv -1 -1 -1\nv 1 -1 -1\nv -1 1 -1\nv 1 1 -1
f 1 2 4 3\nf 6 5 7 8\nf 2 6 8 4\nf 5 1 3 7\nf 3 4 8 7\nf 5 6 2 1
";
/// A prism over an L, whose two caps are concave hexagons.
const L_PRISM: &str = "\
v -1 -1 0.5\nv 1 -1 0.5\nv 1 0 0.5\nv 0 0 0.5\nv 0 1 0.5\nv -1 1 0.5
v -1 -1 -0.5\nv 1 -1 -0.5\nv 1 0 -0.5\nv 0 0 -0.5\nv 0 1 -0.5\nv -1 1 -0.5
f 1 7 8 2\nf 2 8 9 3\nf 3 9 10 4\nf 4 10 11 5\nf 5 11 12 6\nf 6 12 7 1
";

#[test]
fn lines_comments_and_continued_lines_make_no_faces() {
    let plain = model(CUBE).unwrap();
    assert!(inspect(&plain.mesh).is_manifold());
    for (from, to) in [
        ("f 5 6 2 1\n", "f 5 6 2 1\nl 1 2 4 3 1\nl 1 2\np 3\n"),
        ("f 1 2 4 3\n", "f 1 2 \\\n4 3\n"),
        ("f 1 2 4 3\n", "f 1 2 \\\r\n4 \\\r\n 3 # front\r\n"),
        ("f 1 2 4 3\n", "f 1 2 4 3# front\n# made in C:\\models\\\n"),
    ] {
        assert!(CUBE.contains(from));
        assert_eq!(model(&CUBE.replace(from, to)).unwrap(), plain, "{to}");
    }
    // A face more is another mesh.
    assert_ne!(model(&format!("{CUBE}f 1 2 4\n")).unwrap(), plain);
}

/// The polygons of a text begin with another corner.
fn turned(text: &str, by: usize) -> String {
    let line = |line: &str| match line.strip_prefix("f ") {
        Some(corners) => {
            let mut corners: Vec<&str> = corners.split(' ').collect();
            let count = corners.len();
            corners.rotate_left(by % count);
            format!("f {}\n", corners.join(" "))
        }
        None => format!("{line}\n"),
    };
    text.lines().map(line).collect()
}

fn normals_at(mesh: &Mesh) -> Vec<(DVec3, DVec3)> {
    let normals = mesh.normals.clone().unwrap_or_else(|| crate::normals::smooth(mesh));
    let corners = mesh.triangles.iter().flatten().zip(normals.indices.iter().flatten());
    let mut list: Vec<_> =
        corners.map(|(p, n)| (mesh.positions[*p as usize], normals.values[*n as usize])).collect();
    list.sort_by(|a, b| a.0.to_array().partial_cmp(&b.0.to_array()).unwrap());
    list.dedup();
    list
}

#[test]
fn where_a_polygon_begins_changes_no_bit() {
    // Twisted, so that no polygon is planar.
    let twisted = L_PRISM.replace("v 1 -1 0.5", "v 1.1 -1.2 0.8").replace("v 0 1 -0.5", "v 0 1 -1");
    for text in [
        format!("{L_PRISM}f 1 2 3 4 5 6\nf 12 11 10 9 8 7\n"),
        twisted + "f 1 2 3 4 5 6\nf 12 11 10 9 8 7\n",
    ] {
        let wanted = read_text(&text).unwrap();
        assert!(inspect(&wanted).is_manifold());
        for by in 1..6 {
            let corners = |text: &str| {
                let mesh = read_text(text).unwrap();
                (0..mesh.triangles.len()).map(|i| mesh.corners(i)).collect::<Vec<_>>()
            };
            assert_eq!(corners(&turned(&text, by)), corners(&text), "{by}");
            let (a, b) = (normals_at(&read_text(&turned(&text, by)).unwrap()), normals_at(&wanted));
            assert_eq!(a, b, "{by}");
        }
    }
}

/// Cut by hand, the caps of the L give the same normals; a fan from the wrong corner
/// turns one by 100 degrees.
#[test]
fn a_concave_face_shades_like_its_parts() {
    let whole = format!("{L_PRISM}f 1 2 3 4 5 6\nf 12 11 10 9 8 7\n");
    let by_hand = format!(
        "{L_PRISM}f 4 5 6\nf 12 11 10\nf 4 6 1\nf 7 12 10\nf 4 1 2\nf 8 7 10\nf 4 2 3\nf 9 8 10\n"
    );
    let fan = format!(
        "{L_PRISM}f 2 3 4\nf 2 4 5\nf 2 5 6\nf 2 6 1\nf 12 11 10\nf 7 12 10\nf 8 7 10\nf 9 8 10\n"
    );
    let apart = |one: &str, other: &str| {
        let (one, other) =
            (normals_at(&read_text(one).unwrap()), normals_at(&read_text(other).unwrap()));
        let nearest = |(p, n): &(DVec3, DVec3)| {
            let there = other.iter().filter(|(q, _)| q == p);
            there.map(|(_, m)| m.distance(*n)).fold(f64::INFINITY, f64::min)
        };
        one.iter().map(nearest).fold(0.0, f64::max)
    };
    // Light bends by what is interpolated between: the triangles are the same too.
    let pieces = |text: &str| {
        let mesh = read_text(text).unwrap();
        let mut list: Vec<Vec<[i64; 3]>> = (0..mesh.triangles.len())
            .map(|i| {
                let mut corners = mesh.corners(i).map(|p| (2.0 * p).to_array().map(|x| x as i64));
                corners.sort_unstable();
                corners.to_vec()
            })
            .collect();
        list.sort_unstable();
        list
    };
    assert_eq!(pieces(&whole), pieces(&by_hand));
    assert_ne!(pieces(&whole), pieces(&fan));
    assert!(apart(&whole, &by_hand) < 1e-12, "{}", apart(&whole, &by_hand));
    assert!(apart(&whole, &fan) > 0.1);
}

/// Ball of triangles with the normals that `corner` writes.
fn ball(normals: &str, corner: impl Fn(u32) -> String) -> String {
    let mesh = geodesic(4);
    let mut text = String::new();
    for p in &mesh.positions {
        text += &format!("v {} {} {}\n", p.x, p.y, p.z);
    }
    text += normals;
    for t in &mesh.triangles {
        let [a, b, c] = t.map(|i| corner(i + 1));
        text += &format!("f {a} {b} {c}\n");
    }
    text
}

#[test]
fn normals_that_no_face_uses_change_nothing_and_are_told() {
    let without = model(&ball("", |i| i.to_string())).unwrap();
    assert_eq!(without.warnings, [""; 0]);
    let unused = model(&ball("vn 0 1 0\nvn 1 0 0\n", |i| i.to_string())).unwrap();
    assert_eq!(unused.mesh, without.mesh);
    assert!(unused.warnings[0].starts_with("2 normals (vn)"), "{:?}", unused.warnings);
}

#[test]
fn missing_zero_and_nan_normals_are_made_from_the_faces_and_counted() {
    let made = geodesic(4);
    let made: Vec<(DVec3, DVec3)> = normals_at(&made);
    let wrong = DVec3::new(0.0, 0.6, 0.8);
    let written = "vn 0 0.6 0.8\nvn 0 0 0\nvn nan nan nan\nvn -nan(ind) 0 1\n";
    for (corner, word) in
        [("1//2", "zero"), ("1//3", "zero"), ("1//4", "zero"), ("1", "have no normal")]
    {
        let text = ball(written, |i| if i == 1 { corner.to_owned() } else { format!("{i}//1") });
        let found = model(&text).unwrap();
        assert!(found.warnings[0].contains(word), "{:?}", found.warnings);
        assert!(found.warnings[0].starts_with("5 of 960 corners"), "{:?}", found.warnings);
        let first = geodesic(4).positions[0];
        for (p, n) in normals_at(&found.mesh) {
            let wanted = made.iter().find(|(q, _)| *q == p).unwrap().1;
            let wanted = if p == first { wanted } else { wrong };
            assert!(n.distance(wanted) < 1e-12, "{p} {n} {wanted}");
        }
    }
    let all = model(&ball(written, |i| format!("{i}//1"))).unwrap();
    assert_eq!(all.warnings, [""; 0]);
}

#[test]
fn seams_and_repeated_faces_are_told() {
    let torn = CUBE
        .replace("v 1 1 -1\n", "v 1 1 -1\nv 1.0000000000000002 1 -1\n")
        .replace("f 3 4 8 7", "f 3 4 9 7");
    let found = model(&torn).unwrap();
    assert!(inspect(&found.mesh).is_manifold());
    assert_eq!(found.seams.merged, 1);
    assert!(found.warnings.concat().contains("along open edges"), "{:?}", found.warnings);
    let twice = model(&format!("{CUBE}f 1 2 4 3\n")).unwrap();
    assert!(inspect(&twice.mesh).is_manifold());
    assert!(twice.warnings.concat().contains("2 triangles repeat others"), "{:?}", twice.warnings);
}
