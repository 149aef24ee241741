#![allow(clippy::unwrap_used, reason = "files that the tests write")]

use super::*;
use crate::generate::{builtin, geodesic};
use crate::topology::inspect;

fn read_text(text: &str) -> Result<Mesh, ObjError> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("model.obj");
    std::fs::write(&path, text).unwrap();
    read(&path)
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
    let nan = message("v 0 0 0\nv 1 nan 0\nv 0 1 0\nf 1 2 3\n");
    assert!(nan.contains(":2:") && nan.contains("not a finite number"), "{nan}");
    assert!(message("v 0 0 1e999\nf 1 1 1\n").contains("not a finite number"));
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
    assert!(parse(&[0xff, 0xfe, b'f', b' ', 0x80, b'\n']).is_err());
    assert!(parse(b"f\nf 1\n").is_err());
}
