//! `snell bench --reference`: how fast the exact renderer is.

use crate::Error;
use crate::bench::{self, BesideMitsuba, Measured, Program};
use crate::cli::output::{Output, table};
use crate::cli::status::Status;
use crate::support::files::FileError;
use crate::support::progress::Progress;
use crate::support::statistics::{FEWEST, Interval};
use clap::ValueEnum;
use serde::Serialize;

/// Measure how fast the exact renderer is, alone or beside another program
#[derive(clap::Args, Debug)]
#[command(group = clap::ArgGroup::new("renderer").required(true))]
pub(in crate::cli) struct Args {
    /// Measure the exact renderer: rays that a camera's image sends into glass
    #[arg(long, group = "renderer")]
    reference: bool,
    /// Also measure another program at the same work
    #[arg(long, value_enum, value_name = "PROGRAM")]
    against: Option<Other>,
    /// Instead, build a ball with bumps of at least N triangles, and say how long that takes and
    /// how much memory
    #[arg(long, value_name = "N", conflicts_with_all = ["against", "repetitions"],
        value_parser = clap::value_parser!(u32).range(20..=100_000_000))]
    triangles: Option<u32>,
    /// How often everything is measured, in turns [default: 9]
    #[arg(long, value_name = "N",
        value_parser = clap::value_parser!(u16).range(FEWEST as i64..=1000))]
    repetitions: Option<u16>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Other {
    /// Embree 3, compiled here with `CXX` or c++: the same rays and triangles
    Embree,
    /// Mitsuba 3, by the Python that `PYTHON` names or python3: processor time to the same error
    /// (minutes)
    Mitsuba,
}

/// On what and how everything is measured.
#[derive(Serialize)]
struct Machine<'a> {
    processor: &'a str,
    threads: &'a [usize],
    repetitions: u16,
    confidence: f64,
    image_px: u32,
    eta: f64,
    start_beyond_surface_of_diagonal: f64,
    left_out: &'a [String],
}

pub(in crate::cli) fn run(args: &Args, output: Output) -> Result<Status, Error> {
    if let Some(triangles) = args.triangles {
        return footprint(triangles, output);
    }
    if args.against == Some(Other::Mitsuba) {
        if args.repetitions.is_some() {
            return Err(Error::Usage(format!(
                "--repetitions: beside Mitsuba everything is measured {} times\nleave it out",
                bench::MITSUBA_REPETITIONS
            )));
        }
        return mitsuba(output);
    }
    // What is missing is found out before anything is measured.
    let embree = (args.against == Some(Other::Embree))
        .then(|| Program::compile(&bench::compiler()))
        .transpose()?;
    let all = std::thread::available_parallelism().map_or(1, usize::from);
    let mut threads = vec![1, 2, all];
    threads.sort_unstable();
    threads.dedup();
    let progress = Progress::new("reading meshes");
    let (inputs, left_out) = bench::inputs();
    let repetitions = args.repetitions.unwrap_or(9);
    let mut measured = Vec::new();
    for (place, input) in inputs.iter().enumerate() {
        progress.now(&format!("tracing {}", input.name));
        let share = |done: f64| progress.at((place as f64 + done) / inputs.len() as f64);
        measured.push(bench::measure(input, &threads, repetitions.into(), embree.as_ref(), share)?);
    }
    drop(progress);
    left_out.iter().for_each(|sentence| Output::note(sentence));
    let machine = Machine {
        processor: &bench::processor(),
        threads: &threads,
        repetitions,
        confidence: 0.95,
        image_px: bench::IMAGE_PX,
        eta: bench::ETA,
        start_beyond_surface_of_diagonal: bench::BEYOND,
        left_out: &left_out,
    };
    if output.json {
        output.object("snell.bench.machine/1", &machine)?;
        measured.iter().try_for_each(|one| output.object("snell.bench.rays/1", one))?;
    } else {
        output.line(&text(&machine, &measured))?;
    }
    Ok(Status::Done)
}

fn footprint(triangles: u32, output: Output) -> Result<Status, Error> {
    let progress = Progress::new("building");
    let found = bench::footprint(triangles)?;
    drop(progress);
    if output.json {
        output.object("snell.bench.footprint/1", &found)?;
    } else {
        output.line(&format!(
            "{} triangles: mesh {:.1} s, build {:.1} s; {:.0} B a triangle while tracing, {:.0} at most",
            found.triangles,
            found.mesh_s,
            found.build_s,
            found.resident_bytes_per_triangle,
            found.peak_bytes_per_triangle
        ))?;
    }
    Ok(Status::Done)
}

fn mitsuba(output: Output) -> Result<Status, Error> {
    let snell = std::env::current_exe()
        .map_err(FileError::of(std::path::Path::new("snell"), "cannot be found"))?;
    let progress = Progress::new("beside Mitsuba");
    let found = bench::beside_mitsuba(&bench::python(), &snell)?;
    drop(progress);
    if output.json {
        found.iter().try_for_each(|one| output.object("snell.bench.mitsuba/1", one))?;
        return Ok(Status::Done);
    }
    let (px, repetitions) = (bench::MITSUBA_PX, bench::MITSUBA_REPETITIONS);
    output.line(&format!(
        "{}; {px} x {px} pixels, {repetitions} repetitions: medians, and the ratio's extremes",
        bench::processor()
    ))?;
    found.iter().try_for_each(|one| output.line(&beside(one))).map(|()| Status::Done)
}

/// Processor seconds to one error, of both.
fn beside(one: &BesideMitsuba) -> String {
    let head = ["  samples", "RMSE", "Mitsuba, CPU s", "snell, CPU s", "by", "snell of Mitsuba"];
    let mut rows = vec![head.map(str::to_owned).to_vec()];
    rows.extend(one.rows.iter().map(|row| {
        vec![
            format!("  {}", row.samples),
            format!("{:.2e}", row.rmse),
            format!("{:.2}", row.mitsuba_cpu_s),
            format!("{:.2}", row.snell_cpu_s),
            row.snell_by.clone(),
            format!("{:.3} ({:.3} to {:.3})", row.ratio, row.ratio_low, row.ratio_high),
        ]
    }));
    format!(
        "\n{}: Mitsuba {} {}; {:.1} % of the pixels left out; means {:+.1} standard errors apart \
         ({:+.1e})\n{}",
        one.scene,
        one.mitsuba,
        one.variant,
        100.0 * one.left_out,
        one.mean_difference_in_se,
        one.relative_mean_difference,
        table(&rows)
    )
}

fn text(machine: &Machine<'_>, measured: &[Measured]) -> String {
    let mut lines = vec![
        format!("{}; {} repetitions in turns", machine.processor, machine.repetitions),
        format!(
            "medians and 95 % intervals; rays of a {0} x {0} image of the fitted camera, refracted once",
            machine.image_px
        ),
    ];
    for one in measured {
        let (triangles, rays) = (one.triangles, one.rays);
        lines.push(format!("\n{}: {triangles} triangles, {rays} rays", one.input));
        let head = ["", "threads", "Mrays per CPU s", "Mrays/s", "scaling, CPU", "scaling, wall"];
        let mut rows = vec![head.map(str::to_owned).to_vec()];
        for speed in &one.speeds {
            let mut row = vec![
                format!("  {}", speed.instructions),
                speed.threads.to_string(),
                interval(speed.mrays_per_cpu_s),
                interval(speed.mrays_per_wall_s),
            ];
            if speed.threads > 1 {
                row.extend([speed.scaling_cpu, speed.scaling_wall].map(interval));
            }
            rows.push(row);
        }
        for beside in &one.embree {
            let robust = if beside.robust { "robust" } else { "not robust" };
            let name = format!("  {}, {robust}", beside.program);
            rows.push(vec![name, "1".to_owned(), interval(beside.mrays_per_cpu_s)]);
        }
        lines.push(table(&rows));
        for beside in &one.embree {
            let robust = if beside.robust { "robust" } else { "not robust" };
            lines.push(format!(
                "  ours is {} times as fast as {}, {robust}; same triangle {:.4} %",
                interval(beside.ratio),
                beside.program,
                100.0 * beside.same_triangle
            ));
        }
    }
    lines.join("\n")
}

fn interval(Interval { median, low, high }: Interval) -> String {
    format!("{median:.3} ({low:.3} to {high:.3})")
}
