//! `snell plan SCENE`: what will run, what is left out, and why.

use crate::Error;
use crate::cli::arguments::adapter::AdapterArg;
use crate::cli::arguments::exact::ExactArgs;
use crate::cli::arguments::scene::SceneArgs;
use crate::cli::arguments::values::parameter;
use crate::cli::arguments::view::ViewArgs;
use crate::cli::output::{Output, table};
use crate::cli::status::Status;
use crate::support::repeats::stretches;
use scenes::Plan;
use serde::Serialize;

/// List the passes and buffers that a scene needs, and what is left out and why
#[derive(clap::Args, Debug)]
#[command(group = clap::ArgGroup::new("renderer").required(true))]
pub(in crate::cli) struct Args {
    #[command(flatten)]
    scene: SceneArgs,
    /// Method to plan, or FILE.wgsl with one of your own
    #[arg(short, long, value_name = "METHOD", group = "renderer",
        conflicts_with_all = ["ExactArgs", "RestrictionArgs"])]
    method: Option<String>,
    /// Parameter of the method, such as a=0.33; repeat for several
    #[arg(short, long = "param", value_name = "NAME=VALUE", value_parser = parameter,
        requires = "method", conflicts_with = "reference")]
    parameters: Vec<(String, String)>,
    /// Plan the exact renderer
    #[arg(long, group = "renderer", conflicts_with = "AdapterArg")]
    reference: bool,
    #[command(flatten)]
    view: ViewArgs,
    #[command(flatten)]
    exact: ExactArgs,
    #[command(flatten)]
    adapter: AdapterArg,
}

const NO_ADAPTER: &str = "there is no GPU adapter to plan for: limits are not checked, layers are \
     not counted, and the bytes of one are stated";

/// The answer for programs.
#[derive(Serialize)]
struct Answer<'a> {
    scene: &'a str,
    renderer: String,
    /// That the plan is for; none for the exact renderer, and where there is none.
    adapter: Option<String>,
    total_bytes: u64,
    #[serde(flatten)]
    plan: &'a Plan,
}

pub(in crate::cli) fn run(args: &Args, output: Output) -> Result<Status, Error> {
    let scene = args.scene.load(output)?;
    let view = args.view.view(&scene)?;
    let mut adapter = None;
    let (renderer, plan) = match &args.method {
        Some(method) => {
            let parameters = args.parameters.iter().cloned().collect();
            let keep = realtime::Keep::Needed;
            let request =
                realtime::Request { parameters, ..realtime::Request::new(view, method, keep) };
            let plan = match args.adapter.open_if_any()? {
                Some(gpu) => {
                    adapter = Some(gpu.info().name.clone());
                    realtime::plan_on(&gpu, &scene, &request)?
                }
                None => {
                    output.warn(method, &[NO_ADAPTER.to_owned()])?;
                    realtime::plan(&scene, &request)?
                }
            };
            (request.method.clone(), plan)
        }
        None => {
            let request = args.exact.request(view, args.view.positions_given())?;
            ("reference".to_owned(), reference::plan(&scene, &request)?)
        }
    };
    if output.json {
        let (scene, total_bytes) = (scene.name.as_str(), plan.bytes());
        let answer = Answer { scene, renderer, adapter, total_bytes, plan: &plan };
        output.object("snell.plan/1", &answer)?;
    } else {
        let mut lines = text(&plan);
        lines.extend(adapter.map(|name| format!("for {name}, which allows it")));
        let warnings = output.warnings.all();
        lines.extend((!warnings.is_empty()).then(|| "warnings".to_owned()));
        lines.extend(warnings.iter().map(|warning| format!("  {warning}")));
        output.line(&lines.join("\n"))?;
    }
    Ok(Status::Done)
}

fn text(plan: &Plan) -> Vec<String> {
    let mut lines = vec!["passes, in order".to_owned()];
    for (times, passes) in stretches(&plan.passes) {
        let (indent, repeated) = if times > 1 { ("    ", true) } else { ("  ", false) };
        lines.extend(repeated.then(|| format!("  {times} times")));
        lines.extend(passes.iter().map(|pass| format!("{indent}{pass}")));
    }
    lines.push(format!("buffers, {} in all", bytes(plan.bytes())));
    if plan.peak_bytes > 0 {
        lines.push(format!(
            "  at most {} at once ({} bytes), with the layers that are handed over",
            bytes(plan.peak_bytes),
            plan.peak_bytes
        ));
    }
    let buffers = plan.buffers.iter().map(|b| vec![format!("  {}", b.name), bytes(b.bytes)]);
    lines.extend(table(&buffers.collect::<Vec<_>>()).lines().map(str::to_owned));
    if !plan.features.is_empty() {
        lines.push("specialised for".to_owned());
        lines.extend(plan.features.iter().map(|feature| format!("  {feature}")));
    }
    lines.push("left out".to_owned());
    for left in &plan.left_out {
        let kind = format!("{:?}", left.kind).to_lowercase();
        let saves = if left.saves_bytes == 0 {
            String::new()
        } else {
            format!(" ({})", bytes(left.saves_bytes))
        };
        lines.push(format!("  {kind} {}{saves}: {}", left.what, left.reason));
    }
    if !plan.unsupported.is_empty() {
        lines.push("not shown".to_owned());
        lines.extend(plan.unsupported.iter().map(|u| format!("  {}: {}", u.what, u.instead)));
    }
    lines
}

/// A number of bytes in the unit that suits it.
fn bytes(count: u64) -> String {
    match count as f64 {
        c if c < 1e3 => format!("{count} B"),
        c if c < 1e6 => format!("{:.1} kB", c / 1e3),
        c if c < 1e9 => format!("{:.1} MB", c / 1e6),
        c => format!("{:.2} GB", c / 1e9),
    }
}
