//! `snell mesh FILE`: whether a mesh is a body, what is amiss, and mending it.

use crate::Error;
use crate::cli::output::Output;
use crate::cli::status::Status;
use crate::support::files::{FileError, replace};
use scenes::import;
use scenes::obj::{self, Model};
use scenes::topology::{Repaired, Survey, repair, survey};
use serde::Serialize;
use std::io::BufWriter;
use std::path::{Path, PathBuf};

/// Most holes and parts that are listed for people.
const LISTED: usize = 8;

/// Say what a mesh is: bounds, volume, holes, faces that run the wrong way, parts
///
/// Glass needs a closed mesh whose triangles run counter-clockwise seen from outside.
#[derive(clap::Args, Debug)]
pub(in crate::cli) struct Args {
    /// Wavefront OBJ or glTF file
    file: PathBuf,
    /// Write a mended copy: doubled triangles dropped, triangles turned outwards, holes
    /// closed
    #[arg(long, value_name = "OUT.obj")]
    repair: Option<PathBuf>,
    /// Longest hole that --repair closes, metres along its edge [default: the diagonal of
    /// the mesh's bounds]
    #[arg(long, value_name = "METRES", requires = "repair", value_parser = length, allow_negative_numbers = true)]
    longest_hole: Option<f64>,
}

fn length(text: &str) -> Result<f64, String> {
    let value = text.parse::<f64>().ok().filter(|value| *value >= 0.0);
    value.ok_or_else(|| "write a length in metres, such as 0.1; 0 closes no hole".to_owned())
}

/// The answer for programs.
#[derive(Serialize)]
struct Answer<'a> {
    file: &'a Path,
    /// The mesh's name, in a glTF file.
    name: Option<String>,
    /// It can be filled with a medium.
    is_solid: bool,
    /// Why not.
    flaw: Option<String>,
    #[serde(flatten)]
    shape: Described,
    repair: Option<Mended<'a>>,
}

/// A mesh in numbers.
#[derive(Serialize)]
struct Described {
    bounds_m: [[f64; 3]; 2],
    triangles: usize,
    vertices: usize,
    volume_m3: f64,
    /// Left out while reading, and those without area.
    duplicate_triangles: usize,
    degenerate_triangles: usize,
    open_edges: usize,
    holes: Vec<Hole>,
    /// `null` where the surface has only one side.
    wrong_way_triangles: Option<usize>,
    /// There in both senses.
    two_sided_triangles: usize,
    non_manifold_edges: usize,
    parts: Vec<Part>,
}

#[derive(Serialize)]
struct Hole {
    edges: usize,
    length_m: f64,
    centre_m: [f64; 3],
    is_ring: bool,
}

#[derive(Serialize)]
struct Part {
    triangles: usize,
    volume_m3: f64,
    bounds_m: [[f64; 3]; 2],
    /// How many other parts it lies in.
    lies_in: usize,
}

#[derive(Serialize)]
struct Mended<'a> {
    file: &'a Path,
    longest_hole_m: f64,
    doubles_dropped: usize,
    turned: usize,
    holes_closed: usize,
    triangles_added: usize,
    holes_left: usize,
    normals_dropped: bool,
    is_solid: bool,
    flaw: Option<String>,
}

pub(in crate::cli) fn run(args: &Args, output: Output) -> Result<Status, Error> {
    let models = models(&args.file)?;
    if args.repair.is_some() && models.len() != 1 {
        return Err(Error::Usage(format!(
            "--repair writes one mesh, and {} has {}\nexport the one to be mended alone",
            args.file.display(),
            models.len()
        )));
    }
    models.into_iter().try_for_each(|(name, model)| describe(args, name, &model, output))?;
    Ok(Status::Done)
}

/// The meshes of a file, with their names where it has any.
fn models(file: &Path) -> Result<Vec<(Option<String>, Model)>, Error> {
    let is = |wanted: &str| file.extension().is_some_and(|e| e.eq_ignore_ascii_case(wanted));
    if is("gltf") || is("glb") {
        let meshes = import::meshes(file).map_err(::scenes::Error::from)?;
        return Ok(meshes.into_iter().map(|(name, model)| (Some(name), model)).collect());
    }
    Ok(vec![(None, obj::read(file).map_err(::scenes::Error::from)?)])
}

fn describe(args: &Args, name: Option<String>, model: &Model, output: Output) -> Result<(), Error> {
    output.warn(&args.file.display().to_string(), &model.warnings)?;
    let found = survey(&model.mesh);
    let mended = args.repair.as_deref().map(|to| mend(args, model, to)).transpose()?;
    if output.json {
        let flaw = found.flaw.as_ref().map(ToString::to_string);
        let (is_solid, shape) = (flaw.is_none(), described(model, &found));
        let file = args.file.as_path();
        let answer = Answer { file, name, is_solid, flaw, shape, repair: mended };
        return output.object("snell.mesh/1", &answer);
    }
    if let Some(name) = name {
        output.line(&format!("mesh \"{name}\""))?;
    }
    lines(model, &found).iter().try_for_each(|line| output.line(line))?;
    mended.iter().flat_map(mended_lines).try_for_each(|line| output.line(&line))
}

fn mend<'a>(args: &Args, model: &Model, to: &'a Path) -> Result<Mended<'a>, Error> {
    let [low, high] = model.mesh.bounds();
    let longest_hole_m = args.longest_hole.unwrap_or((high - low).length());
    let (mended, done) = repair(&model.mesh, longest_hole_m);
    replace(to, |partial| {
        let file = std::fs::File::create(partial).map_err(FileError::unwritten(to))?;
        obj::write(&mended, BufWriter::new(file)).map_err(FileError::unwritten(to))
    })?;
    let Repaired { doubles_dropped, turned, holes_closed, triangles_added, .. } = done;
    let flaw = survey(&mended).flaw.as_ref().map(ToString::to_string);
    Ok(Mended {
        file: to,
        longest_hole_m,
        doubles_dropped,
        turned,
        holes_closed,
        triangles_added,
        holes_left: done.holes_left,
        normals_dropped: done.normals_dropped,
        is_solid: flaw.is_none(),
        flaw,
    })
}

fn described(model: &Model, found: &Survey) -> Described {
    let corners = |[low, high]: [glam::DVec3; 2]| [low.to_array(), high.to_array()];
    Described {
        bounds_m: corners(found.bounds),
        triangles: found.report.triangles,
        vertices: model.mesh.positions.len(),
        volume_m3: found.report.signed_volume_m3,
        duplicate_triangles: model.removed.duplicate + found.report.duplicate,
        degenerate_triangles: model.removed.degenerate + found.report.degenerate,
        open_edges: found.report.boundary_edges,
        holes: found
            .holes
            .iter()
            .map(|hole| Hole {
                edges: hole.edges,
                length_m: hole.length_m,
                centre_m: hole.centre.to_array(),
                is_ring: hole.is_ring,
            })
            .collect(),
        wrong_way_triangles: found.wrong_way,
        two_sided_triangles: found.opposed,
        non_manifold_edges: found.report.non_manifold_edges,
        parts: found
            .parts
            .iter()
            .map(|(part, lies_in)| Part {
                triangles: part.triangles.len(),
                volume_m3: part.signed_volume_m3,
                bounds_m: corners(part.bounds),
                lies_in: *lies_in,
            })
            .collect(),
    }
}

/// What people read: the verdict first.
fn lines(model: &Model, found: &Survey) -> Vec<String> {
    let [low, high] = found.bounds;
    let report = &found.report;
    let mut lines = vec![
        match &found.flaw {
            None => "solid: closed and facing outwards".to_owned(),
            Some(flaw) => format!("not a solid: {flaw}"),
        },
        format!("bounds: {low} to {high} m"),
        format!(
            "triangles: {}, vertices: {}, volume: {:.6e} m³",
            report.triangles,
            model.mesh.positions.len(),
            report.signed_volume_m3
        ),
        match found.holes.len() {
            0 => "holes: none".to_owned(),
            count => format!("holes: {count}, of {} edges", report.boundary_edges),
        },
    ];
    lines.extend(found.holes.iter().take(LISTED).map(|hole| {
        let open = if hole.is_ring { "" } else { " (no ring: triangles disagree beside it)" };
        let (edges, length_m, centre) = (hole.edges, hole.length_m, hole.centre);
        format!("  {edges} edges, {length_m:.6} m around, about {centre:.6}{open}")
    }));
    lines.extend(more(found.holes.len()));
    lines.push(match found.wrong_way {
        None => "triangles that run the wrong way: the surface has only one side".to_owned(),
        Some(count) => format!("triangles that run the wrong way: {count}"),
    });
    lines.push(format!(
        "repeated triangles: {}, in both senses: {}, without area: {}, edges of three or more: {}",
        model.removed.duplicate + report.duplicate,
        found.opposed,
        model.removed.degenerate + report.degenerate,
        report.non_manifold_edges
    ));
    lines.push(format!("parts: {}", found.parts.len()));
    lines.extend(found.parts.iter().take(LISTED).map(|(part, lies_in)| {
        let (triangles, volume_m3) = (part.triangles.len(), part.signed_volume_m3);
        let inside = match lies_in {
            0 => String::new(),
            count => format!(", inside {count} of the others"),
        };
        format!("  {triangles} triangles, volume {volume_m3:.6e} m³{inside}")
    }));
    lines.extend(more(found.parts.len()));
    lines
}

fn more(count: usize) -> Option<String> {
    (count > LISTED).then(|| format!("  and {} more (--json lists all)", count - LISTED))
}

fn mended_lines(mended: &Mended<'_>) -> Vec<String> {
    let mut lines = vec![
        format!("repaired: {}", mended.file.display()),
        format!(
            "  {} doubled triangles dropped, {} turned, {} holes closed by {} triangles, {} left",
            mended.doubles_dropped,
            mended.turned,
            mended.holes_closed,
            mended.triangles_added,
            mended.holes_left
        ),
        format!("  holes of up to {:.6} m around are closed", mended.longest_hole_m),
    ];
    if mended.holes_left > 0 {
        lines.push("  --longest-hole METRES closes longer ones".to_owned());
    }
    if mended.normals_dropped {
        lines.push("  its normals are left out: they are made from the faces".to_owned());
    }
    lines.push(match &mended.flaw {
        None => "  it is a solid now".to_owned(),
        Some(flaw) => format!("  it is still not a solid: {flaw}"),
    });
    lines
}
