//! A cube shows what its lat-long original shows, spread over its texels.

use super::texel::{Chart, Texel};
use super::{Cube, LatLong, Map, Repair};
use glam::{DVec2, DVec3};

fn random(size_px: [u32; 2]) -> LatLong {
    let value = |i: u32| (f64::from(i) * 12.9898).sin().abs() as f32 + 0.1;
    let count = size_px[0] * size_px[1];
    LatLong {
        size_px,
        texels: (0..count).map(|i| [value(i), value(3 * i), value(7 * i)]).collect(),
    }
}

fn cube(lat_long: &LatLong, rotation_deg: f64, size_px: u32) -> Cube {
    Map::from_lat_long("", lat_long.clone(), rotation_deg, Some(size_px), Repair::default()).cube
}

fn texels(size_px: u32) -> impl Iterator<Item = (usize, Texel)> {
    let (stride, edge) = (size_px as usize + 2, 1.0 / f64::from(size_px));
    (0..6 * size_px * size_px).map(move |i| {
        let [x, y, face] = [i % size_px, i / size_px % size_px, i / size_px / size_px];
        let low = edge * DVec2::new(f64::from(x), f64::from(y));
        let texel = Texel { chart: Chart::Face(face as usize), low, size: DVec2::splat(edge) };
        ((face as usize * stride + y as usize + 1) * stride + x as usize + 1, texel)
    })
}

/// Against many lookups in each texel, in every face, turned and not.
#[test]
fn a_texel_shows_the_mean_of_the_original() {
    for (image, rotation_deg, size_px) in [
        ([64, 32], 0.0, 4),
        ([64, 32], 33.0, 8),
        ([16, 8], -200.0, 16),
        ([1, 1], 5.0, 2),
        ([6, 3], 0.0, 3),
    ] {
        let lat_long = random(image);
        let cube = cube(&lat_long, rotation_deg, size_px);
        for (index, texel) in texels(size_px).step_by(5) {
            let mut light = DVec3::ZERO;
            let steps = 1024 / size_px;
            let size = texel.size / f64::from(steps);
            for place in 0..steps * steps {
                let at = DVec2::new(f64::from(place % steps), f64::from(place / steps));
                let piece = Texel { low: texel.low + at * size, size, ..texel };
                let seen = lat_long.radiance(piece.direction(0.5, 0.5), rotation_deg);
                light += seen * piece.solid_angle();
            }
            let expected = light / texel.solid_angle();
            let [r, g, b, _] = cube.texels[index].map(f64::from);
            let off = (DVec3::new(r, g, b) - expected).length();
            assert!(off < 3e-3, "{image:?} {size_px} {texel:?}: {off}");
        }
    }
}

/// One bright texel, a sun in a photograph, gives all its light to every cube.
#[test]
fn a_bright_texel_keeps_its_flux() {
    let [width, height] = [512, 256];
    for bright in [[200, 0], [64, 64], [511, 128]] {
        let mut lat_long = LatLong { size_px: [width, height], texels: vec![[0.0; 3]; 512 * 256] };
        lat_long.texels[(bright[1] * width + bright[0]) as usize] = [1e4; 3];
        let row = Texel {
            chart: Chart::LatLong,
            low: DVec2::new(f64::from(bright[0]) / 512.0, f64::from(bright[1]) / 256.0),
            size: DVec2::new(1.0 / 512.0, 1.0 / 256.0),
        };
        let flux = 1e4 * row.solid_angle() / row.area_over_lookup_weight();
        for size_px in [16, 64, 128] {
            let cube = cube(&lat_long, 21.0, size_px);
            let kept = texels(size_px)
                .map(|(index, texel)| f64::from(cube.texels[index][0]) * texel.solid_angle())
                .sum::<f64>();
            assert!((kept / flux - 1.0).abs() < 1e-4, "{bright:?} {size_px}: {}", kept / flux);
        }
    }
}

/// Uniform light stays uniform to the last bit of f32.
#[test]
fn a_constant_stays_constant() {
    let lat_long = LatLong { size_px: [37, 19], texels: vec![[0.7, 1.0, 3e5]; 37 * 19] };
    let cube = cube(&lat_long, 10.0, 16);
    assert!(cube.texels.iter().all(|texel| *texel == [0.7, 1.0, 3e5, 1.0]));
}
