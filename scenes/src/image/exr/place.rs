//! Samples to their pixels: every block is unpacked once, and each of its rows
//! goes where data window and display window say.

use super::block::{Block, samples};
use super::chroma::Samples;
use super::codec::Codec;
use super::header::{Part, Sample, Window};
use super::names::Group;
use half::f16;
use rayon::prelude::*;
use std::collections::BTreeMap;

/// Blocks that are unpacked before any is placed.
const BATCH: usize = 64;

/// The values of one layer on the display window.
#[derive(Debug)]
pub(super) struct Planes {
    /// Values per pixel.
    pub(super) channels: usize,
    /// Interleaved, rows from the top, 0 where the file has no pixel.
    pub(super) data: Vec<f64>,
    /// Opacity; 0 where the file has no pixel.
    pub(super) alpha: Option<Vec<f64>>,
}

/// Where the samples of a channel go.
struct Target {
    group: usize,
    /// Component, or `None` for the opacity.
    component: Option<usize>,
    /// Samples of a channel that does not have one per pixel.
    sparse: Option<Samples>,
}

/// Unpacks all blocks; one result per group.
pub(super) fn planes(
    parts: &[Part],
    codecs: &[Codec],
    blocks: &[Block],
    display: Window,
    groups: &[Group],
) -> Result<Vec<Planes>, String> {
    let pixels = display.pixels() as usize;
    let empty = |group: &Group| Planes {
        channels: group.channels.len(),
        data: vec![0.0; pixels * group.channels.len()],
        alpha: group.alpha.map(|_| vec![0.0; pixels]),
    };
    let mut all: Vec<Planes> = groups.iter().map(empty).collect();
    let mut targets = targets(parts, groups);
    for batch in blocks.chunks(BATCH) {
        let unpack = |block: &Block| codecs[block.part].unpack(&parts[block.part], block);
        let unpacked: Result<Vec<_>, _> = batch.par_iter().map(unpack).collect();
        for (block, bytes) in batch.iter().zip(unpacked?) {
            place(&parts[block.part], block, &bytes, display, &mut targets, &mut all);
        }
    }
    for target in targets.values().flatten() {
        if let Some(sparse) = &target.sparse {
            let full = sparse.at_every_pixel();
            let [width, _] = sparse.window.size_px().map(|n| n as usize);
            for (row, values) in (sparse.window.min[1]..).zip(full.chunks_exact(width.max(1))) {
                let to = &mut all[target.group];
                put(to, target.component, display, [sparse.window.min[0], row], values);
            }
        }
    }
    Ok(all)
}

/// Targets by part and channel: a channel that was chosen by its own name can be
/// wanted twice.
fn targets(parts: &[Part], groups: &[Group]) -> BTreeMap<(usize, usize), Vec<Target>> {
    let mut targets: BTreeMap<_, Vec<Target>> = BTreeMap::new();
    for (number, group) in groups.iter().enumerate() {
        let components = group.channels.iter().enumerate().map(|(i, place)| (Some(i), *place));
        for (component, place) in components.chain(group.alpha.map(|place| (None, place))) {
            let part = &parts[place.0];
            let channel = &part.channels[place.1];
            let sparse = (channel.sampling != [1, 1]).then(|| {
                let size = samples(part.data.min, part.data.size_px(), channel.sampling);
                let (window, sampling) = (part.data, channel.sampling);
                Samples { window, sampling, size, values: vec![0.0; size[0] * size[1]] }
            });
            targets.entry(place).or_default().push(Target { group: number, component, sparse });
        }
    }
    targets
}

fn place(
    part: &Part,
    block: &Block,
    bytes: &[u8],
    display: Window,
    targets: &mut BTreeMap<(usize, usize), Vec<Target>>,
    all: &mut [Planes],
) {
    let mut rest = bytes;
    for y in block.min[1]..block.min[1] + block.size_px[1] as i64 {
        for (number, channel) in part.channels.iter().enumerate() {
            let step = channel.sampling[1] as i64;
            if y.rem_euclid(step) != 0 {
                continue;
            }
            let [columns, _] = samples(block.min, block.size_px, channel.sampling);
            // The sizes were checked: a block holds exactly its samples.
            let (row, after) = rest.split_at(columns * channel.sample.bytes());
            rest = after;
            let Some(targets) = targets.get_mut(&(block.part, number)) else { continue };
            let values = numbers(channel.sample, row);
            for target in targets {
                if let Some(sparse) = &mut target.sparse {
                    let before = |axis: usize, at: i64| {
                        let size = (at - part.data.min[axis]) as u64;
                        samples(part.data.min, [size; 2], channel.sampling)[axis]
                    };
                    let at = before(1, y) * sparse.size[0] + before(0, block.min[0]);
                    sparse.values[at..at + columns].copy_from_slice(&values);
                } else {
                    let to = &mut all[target.group];
                    put(to, target.component, display, [block.min[0], y], &values);
                }
            }
        }
    }
}

fn numbers(sample: Sample, row: &[u8]) -> Vec<f64> {
    match sample {
        Sample::Half => {
            let pairs = row.as_chunks::<2>().0.iter();
            pairs.map(|bytes| f16::from_le_bytes(*bytes).to_f64()).collect()
        }
        Sample::Float => {
            let words = row.as_chunks::<4>().0.iter();
            words.map(|bytes| f64::from(f32::from_le_bytes(*bytes))).collect()
        }
        Sample::Uint => {
            let words = row.as_chunks::<4>().0.iter();
            words.map(|bytes| f64::from(u32::from_le_bytes(*bytes))).collect()
        }
    }
}

/// Writes the values of a row that begins at a pixel; what lies outside the
/// display window is not shown.
fn put(to: &mut Planes, component: Option<usize>, display: Window, min: [i64; 2], row: &[f64]) {
    let [x, y] = min;
    if y < display.min[1] || y > display.max[1] {
        return;
    }
    let width = display.size_px()[0] as i64;
    let line = (y - display.min[1]) * width;
    for (x, value) in (x..).zip(row) {
        if x >= display.min[0] && x <= display.max[0] {
            let pixel = (line + x - display.min[0]) as usize;
            match (component, &mut to.alpha) {
                (Some(component), _) => to.data[pixel * to.channels + component] = *value,
                (None, Some(alpha)) => alpha[pixel] = *value,
                (None, None) => {}
            }
        }
    }
}
